#!/usr/bin/env python3
"""All peers in one report: bench/peers/report.py --json FILE [--python PYTHON] [--for "DRIVER ARGUMENTS"]...

Runs the drivers beside this file one after another, lammps.py, gromacs.py, openmm.py and neighbours.py, and joins what they write: the JSON has
  context   of this run, and of each driver by its name
  missing   what was not found or could not be run: `what` and `why`; a line each at the end of the table
  energies, results    of all drivers that time forces and steps, with the name of the driver; tools/plot_bench.py draws them
  pairs     of neighbours.py
The table gives for each liquid, size and case the fastest variant of each code, in nanoseconds of the clock per particle and as a multiple
of ours in the same driver's run: in mixed precision for GROMACS, else in double. Each driver compares energies or pairs before it times
anything; one that fails is named as missing.

--python is the interpreter of the drivers, for example of a virtual environment with openmm, vesin, matscipy and freud-analysis. --for gives
a driver arguments of its own, as in --for "lammps --lammps /opt/lmp --sizes 32000".

Exit status: 0; 1 if no driver has found a peer; 2 for wrong usage.
"""

import datetime
import json
import os
import platform
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parents[1] / "tools"))

from benchmark_results import MODELS, Arguments  # noqa: E402
from ours import last_line  # noqa: E402

DRIVERS = ("lammps", "gromacs", "openmm", "neighbours")


def run_driver(name, options, report):
    """Runs a driver and joins its JSON to the report; if it has written none, what it said last is why it is missing."""
    script = options.drivers / f"{name}.py"
    if not script.exists():
        report["missing"].append({"what": name, "why": f"no driver {script.name}"})
        return
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "report.json"
        command = [options.python, script, *options.arguments.get(name, []), "--json", file]
        done = subprocess.run([str(word) for word in command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False,
                              stdin=subprocess.DEVNULL, errors="replace")
        if not file.exists():
            report["missing"].append({"what": name, "why": last_line(done.stderr)})
            return
        found = json.loads(file.read_text())
    report["context"]["drivers"][name] = found.get("context", {})
    report["missing"] += [{"driver": name, **entry} for entry in found.get("missing", [])]
    report["energies"] += [{"driver": name, **entry} for entry in found.get("energies", [])]
    # Pairs of neighbours have no case of a liquid.
    report["pairs" if name == "neighbours" else "results"] += [{"driver": name, **row} for row in found["results"]]


def fastest(rows):
    """The fastest row of each code, in the order of codes in the file, ours first."""
    best = {}
    for row in rows:
        if row["code"] not in best or row["ns_per_particle"] < best[row["code"]]["ns_per_particle"]:
            best[row["code"]] = row
    return sorted(best.values(), key=lambda row: row["code"] != "lanescape")


def print_results(rows):
    groups = sorted({(row["model"], row["particles"], row["case"]) for row in rows})
    for model, particles, case in groups:
        chosen = [row for row in rows if (row["model"], row["particles"], row["case"]) == (model, particles, case)]
        print(f"\n{MODELS.get(model, model)}, N = {particles}, {case}")
        for cores in sorted({row["threads"] for row in chosen}):
            for row in fastest([row for row in chosen if row["threads"] == cores]):
                ratio = "" if row["ratio"] is None or row["code"] == "lanescape" else f"{row['ratio']:6.2f} times ours"
                label = f"{row['code']} {row['variant']}"
                print(f"  {cores:3} core{'s' if cores > 1 else ' '}  {label:28} {row['ns_per_particle']:9.2f} ns {ratio}".rstrip())


def print_pairs(rows):
    for code in dict.fromkeys(row["code"] for row in rows):
        ratios = [row["ratio"] for row in rows if row["code"] == code]
        print(f"  {code:12} {min(ratios):6.2f} to {max(ratios):6.2f} times ours, {len(ratios)} modes, sizes and orders")


def print_report(report):
    context = report["context"]
    print(f"{context['date']}, {context['processor']}, {context['cores']} cores, load {context['load_average']:.1f}")
    print_results(report["results"])
    if report["pairs"]:
        print("\nNeighbour pairs, one core")
        print_pairs(report["pairs"])
    print()
    for entry in report["missing"]:
        print(f"missing: {entry['what']}: {entry['why']}")
    if not report["missing"]:
        print("nothing is missing")


def processor():
    """The name of the processor, as Linux tells it."""
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        lines = []
    return next((line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), platform.machine())


def parse(arguments):
    parser = Arguments(prog="report.py", description="All peers in one report; the head of this file describes it.")
    parser.add_argument("--json", type=Path, metavar="FILE", required=True, help="the report")
    parser.add_argument("--python", default=sys.executable, metavar="PROGRAM", help="the interpreter of the drivers [this one]")
    parser.add_argument("--only", nargs="+", choices=DRIVERS, default=DRIVERS, metavar="DRIVER", help=f"[{' '.join(DRIVERS)}]")
    parser.add_argument("--for", dest="given", action="append", default=[], metavar="'DRIVER ARGUMENTS'", help="may be given several times")
    parser.add_argument("--drivers", type=Path, default=FOLDER, metavar="DIR", help="the folder of the drivers [that of this file]")
    options = parser.parse_args(arguments)
    options.arguments = {}
    for given in options.given:
        try:
            name, *words = shlex.split(given) or [""]
        except ValueError as error:
            parser.error(f"--for {given}: {error}")
        if name not in DRIVERS:
            parser.error(f"--for {given}: must begin with one of {', '.join(DRIVERS)}")
        options.arguments.setdefault(name, []).extend(words)
    if not shutil.which(options.python):
        parser.error(f"--python {options.python}: no such program")
    if not options.json.absolute().parent.is_dir():
        parser.error(f"--json {options.json}: no such folder")
    return options


def main(arguments):
    options = parse(arguments)
    report = {"context": {"date": datetime.datetime.now().astimezone().isoformat(timespec="seconds"), "processor": processor(),
                          "cores": len(os.sched_getaffinity(0)), "load_average": os.getloadavg()[0], "drivers": {}},
              "missing": [], "energies": [], "results": [], "pairs": []}
    for name in options.only:
        print(f"{name}.py", file=sys.stderr, flush=True)
        run_driver(name, options, report)
    options.json.write_text(json.dumps(report, indent=2) + "\n")
    print_report(report)
    return 0 if report["pairs"] or any(row["code"] != "lanescape" for row in report["results"]) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
