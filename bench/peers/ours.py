"""Lanescape's side of a comparison: `lanescape energy` and bench_lists on a file."""

import json
import os
import subprocess

from benchmark_results import ISAS, Unusable, check_results, parts_of, repetitions, value

CASES = ("force", "force+energy+virial", "step")


class Failed(Exception):
    """How a program failed, in one line."""


def last_line(text):
    """The last line with a letter or digit: where programs say why they failed."""
    lines = [line.strip() for line in text.splitlines() if any(c.isalnum() for c in line)]
    return lines[-1] if lines else "no message"


def run(command, environment=None):
    """The standard output of a program. Raises Failed if its exit status is not 0."""
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, errors="replace",
                          stdin=subprocess.DEVNULL, env={**os.environ, **(environment or {})})
    if done.returncode != 0:
        raise Failed(f"{command[0]}: exit status {done.returncode}: {last_line(done.stderr or done.stdout)}")
    return done.stdout


def core_counts():
    """1, 2, 4, ... up to the number of cores that this process may use, and that number."""
    cores = len(os.sched_getaffinity(0))
    return tuple(2**k for k in range(cores.bit_length()) if 2**k < cores) + (cores,)


def energy_and_virial(program, file, liquid, cutoff, truncation="shifted"):
    """Potential energy [epsilon] and virial [epsilon] of a configuration, truncated at `cutoff` [sigma_ab]."""
    result = json.loads(run([program, "energy", file, "--model", liquid.model, "--cutoff", cutoff, "--truncation", truncation, "--quiet"]))
    return result["energy"], result["virial"]


class Bench:
    """bench_lists on one configuration with one instruction set, by default the widest that it has."""

    def __init__(self, program, file, liquid, particles, cases, threads, isa=None):
        self.command = [program, f"--configuration={file}", f"--model={liquid.model}"]
        names = run([*self.command, "--benchmark_list_tests"]).split()
        there = {parts_of(name).get("isa") for name in names}
        self.isa = isa or next((known for known in ISAS if known in there), None)
        self.names, self.missing = {}, []
        for case in cases:
            for count in threads:
                wanted = {"case": case, "N": particles, "threads": count, "isa": self.isa}
                name = next((name for name in names if wanted.items() <= parts_of(name).items()), None)
                if name:
                    self.names[name] = (case, count)
                else:
                    self.missing.append((case, count))

    def measure(self):
        """Medians over repetitions by (case, threads): nanoseconds per particle, for whole steps per particle and step."""
        if not self.names:
            return {}
        pattern = "^(" + "|".join(name.replace("+", "[+]").replace(".", "[.]") for name in self.names) + ")$"
        source = str(self.command[0])
        try:
            data = check_results(json.loads(run([*self.command, f"--benchmark_filter={pattern}", "--benchmark_format=json"])), source)
            runs = repetitions(data, source)
        except json.JSONDecodeError as error:
            raise Failed(f"{source}: not JSON: {error.msg}") from error
        except Unusable as error:
            raise Failed(str(error)) from error
        measured = {}
        for name, key in self.names.items():
            if name not in runs:
                raise Failed(f"{source}: {name} is not among its results")
            values = sorted(value(entry, "ns_per_particle", source) for entry in runs[name])
            measured[key] = values[len(values) // 2]
        return measured
