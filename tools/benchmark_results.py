"""Google Benchmark's JSON, for the scripts that compare and draw it."""

import argparse
import json
import math
import sys

from unusable import Unusable

TIME_UNITS = {"ns": 1.0, "us": 1e3, "ms": 1e6, "s": 1e9}  # [ns]
TIMES = ("cpu_time", "real_time")
ISAS = ("avx512", "avx2", "sse2", "generic")  # the widest first
MODELS = {"kob-andersen": "Kob-Andersen", "lennard-jones": "Lennard-Jones"}


class Arguments(argparse.ArgumentParser):
    """Refuses wrong usage in one line, exit status 2."""

    def error(self, message):
        print(f"{self.prog}: {message}", file=sys.stderr)
        sys.exit(2)


def read_json(file):
    try:
        with open(file, encoding="utf-8") as stream:
            return json.load(stream)
    except OSError as error:
        raise Unusable(f"{file}: {error.strerror}") from error
    except json.JSONDecodeError as error:
        raise Unusable(f"{file}: line {error.lineno}: not JSON: {error.msg}") from error
    except (UnicodeDecodeError, RecursionError) as error:
        raise Unusable(f"{file}: not JSON") from error


def check_results(data, source):
    """The object that Google Benchmark writes, or Unusable."""
    benchmarks = data.get("benchmarks") if isinstance(data, dict) else None
    if not isinstance(benchmarks, list) or not all(isinstance(entry, dict) and isinstance(entry.get("name"), str) for entry in benchmarks):
        raise Unusable(f"{source}: not Google Benchmark's JSON: no list 'benchmarks' of objects with a name")
    if not benchmarks:
        raise Unusable(f"{source}: no benchmark in it")
    return data


def read_results(file):
    return check_results(read_json(file), file)


def repetitions(data, source):
    """The single runs of each benchmark by name, without the aggregates. A benchmark that reports an error is refused."""
    runs = {}
    for entry in data["benchmarks"]:
        name = entry.get("run_name", entry["name"])
        if entry.get("error_occurred"):
            raise Unusable(f"{source}: {name} failed: {entry.get('error_message', 'no message')}")
        if entry.get("run_type", "iteration") == "iteration":
            runs.setdefault(name, []).append(entry)
    if not runs:
        raise Unusable(f"{source}: only aggregates, no single repetition: run without --benchmark_report_aggregates_only")
    return runs


def value(entry, metric, source):
    """A positive number of one run: a time in nanoseconds, or a counter as it is."""
    name, number = entry.get("run_name", entry["name"]), entry.get(metric)
    if number is None:
        raise Unusable(f"{source}: {name}: no {metric}")
    if isinstance(number, bool) or not isinstance(number, (int, float)) or not math.isfinite(number) or number <= 0:
        raise Unusable(f"{source}: {name}: {metric} is {number}, it must be a finite number above 0")
    if metric not in TIMES:
        return float(number)
    unit = entry.get("time_unit", "ns")
    if unit not in TIME_UNITS:
        raise Unusable(f"{source}: {name}: time_unit is {unit}, it must be one of {', '.join(TIME_UNITS)}")
    return number * TIME_UNITS[unit]


def parts_of(name):
    """`force/N:4000/threads:1/avx2` as {"case": "force", "N": 4000, "threads": 1, "isa": "avx2"}; the model where it is named."""
    parts, rest = {}, []
    for part in name.split("/"):
        key, colon, number = part.partition(":")
        if colon:
            parts[key] = int(number) if number.isdigit() else number
        elif part in ISAS:
            parts["isa"] = part
        elif part in MODELS:
            parts["model"] = part
        elif part not in ("real_time", "manual_time", "process_time"):  # how it was timed
            rest.append(part)
    parts["case"] = "/".join(rest)
    return parts
