#!/usr/bin/env python3
"""GROMACS and bench_lists side by side, in mixed precision: a Lennard-Jones liquid, the same configuration, cutoff and time step.

GROMACS melts a lattice unless a driver has left a configuration in --folder. Energies must agree first, to the six digits of
GROMACS's log. Then all codes run in turn:
  step   whole steps of molecular dynamics at constant energy, time step --timestep. GROMACS lists pairs every --nstlist steps with a buffer
         that it chooses for its default tolerance (a few pairs may be missed), and prunes them in between; ours is exact
  force  GROMACS: the line Force of the cycle accounting of these steps, pruning included; ours: an evaluation of gradients alone
Times are of the clock, per particle and step, medians over --repetitions.

Exit status: 0; 1 if energies disagree, a program fails or there is no GROMACS; 2 for wrong usage.
"""

import datetime
import json
import os
import shutil
import statistics
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))

from benchmark_results import Arguments, Unusable  # noqa: E402
from gromacs_runs import Gromacs, measure, melt, potential_energy, write_gro  # noqa: E402
from ours import Bench, Failed, energy_and_virial  # noqa: E402
from peer_options import add_options, check_options, check_timestep  # noqa: E402
from peer_tables import print_rows  # noqa: E402
from systems import CUTOFF, LIQUIDS, kept_configuration  # noqa: E402

LIQUID = LIQUIDS["lennard-jones"]
TOLERANCE = 2e-5  # relative: single precision, six digits
CASES = ("force", "step")


class Comparison:
    """One GROMACS and bench_lists on the same configurations."""

    def __init__(self, options, gromacs):
        self.options, self.gromacs = options, gromacs
        self.missing, self.energies, self.results = [], [], []

    def configuration(self, particles):
        """The files of a melted liquid. Later runs and other drivers use the same ones."""
        def made():
            say(f"N = {particles}: melting")
            return melt(self.gromacs, LIQUID, particles, self.options.seed, max(self.options.threads))
        file, configuration = kept_configuration(self.options.folder, LIQUID, particles, self.options.seed, made)
        gro = file.with_suffix(".gro")
        write_gro(gro, configuration)
        return file, gro

    def check_energies(self, particles, file, gro):
        expected = energy_and_virial(self.options.lanescape, file, LIQUID, CUTOFF)[0]
        found = potential_energy(self.gromacs, file.stem, gro)
        difference = abs(found - expected) / abs(expected)
        self.energies.append({"model": LIQUID.model, "particles": particles, "peer": "GROMACS", "energy": expected, "peer_energy": found,
                              "relative_difference": difference})
        if not difference <= TOLERANCE:
            raise Failed(f"N = {particles}: energies disagree: GROMACS {found!r}, lanescape {expected!r}, allowed is {TOLERANCE:g}; "
                         "nothing was timed")

    def time(self, particles, file, gro):
        cases = [case + precision for case in CASES for precision in ("", "-mixed")]
        bench = Bench(self.options.bench, file, LIQUID, particles, cases, self.options.threads, self.options.isa)
        for case, count in bench.missing:
            self.missing.append({"what": f"bench_lists {case}, {count} threads", "why": f"no such benchmark for N = {particles}, {bench.isa}"})
        ours, peers = {}, {}
        for repetition in range(self.options.repetitions):
            say(f"N = {particles}: timing, {repetition + 1} of {self.options.repetitions}")
            for key, nanoseconds in bench.measure().items():
                ours.setdefault(key, []).append(nanoseconds)
            for count in self.options.threads:
                peers.setdefault(count, []).append(measure(self.gromacs, file.stem, gro, count, self.options))
        for count in self.options.threads:
            for case in CASES:
                self.collect(particles, case, count, bench.isa, ours, peers[count])

    def collect(self, particles, case, count, isa, ours, timings):
        """The medians of all samples; ratios are to ours in mixed precision."""
        common = {"model": LIQUID.model, "particles": particles, "case": case, "threads": count}
        own = ours.get((case + "-mixed", count))
        rows = [("lanescape", isa + of, samples) for of, samples in
                ((", mixed", own), ("", ours.get((case, count)))) if samples]
        rows.append(("GROMACS", self.gromacs.simd, [timing[case] for timing in timings]))
        for code, variant, samples in rows:
            median = statistics.median(samples)
            self.results.append({**common, "code": code, "variant": variant, "ns_per_particle": median, "samples": samples,
                                 "ratio": median / statistics.median(own) if own else None,
                                 **({"lists": timings[0]["lists"]} if code == "GROMACS" else {})})

    def run(self):
        systems = [(particles, *self.configuration(particles)) for particles in self.options.sizes]
        for system in systems:
            self.check_energies(*system)
        for system in systems:
            self.time(*system)

    def report(self):
        options, gromacs = self.options, self.gromacs
        return {"context": {"date": datetime.datetime.now().astimezone().isoformat(timespec="seconds"), "processors": os.cpu_count(),
                            "load_average": os.getloadavg()[0], "cutoff": CUTOFF, "tolerance": TOLERANCE, "timestep": options.timestep,
                            "repetitions": options.repetitions, "nstlist": options.nstlist,
                            "gromacs": f"{gromacs.version}, {gromacs.simd}, {gromacs.precision} precision" if gromacs else None},
                "missing": self.missing, "energies": self.energies, "results": self.results}


def say(text):
    print(text, file=sys.stderr, flush=True)


def parse(arguments):
    parser = Arguments(prog="gromacs.py", description="GROMACS and bench_lists side by side; the head of this file describes the comparison.")
    parser.add_argument("--gromacs", metavar="PATH", help="the GROMACS to use [gmx on PATH]")
    parser.add_argument("--sizes", nargs="+", type=int, default=(32000,), metavar="N", help="particles [32000]")
    parser.add_argument("--steps", type=int, default=400, help="of one run, of which the second half is timed [400]")
    parser.add_argument("--nstlist", type=int, default=50, help="steps between two searches of GROMACS [50]")
    parser.add_argument("--timestep", type=float, default=0.005, help="that of bench_lists is 0.005 [0.005]")
    add_options(parser, repetitions=3)
    options = parser.parse_args(arguments)
    check_options(parser, options, 500, ("steps", "nstlist"), ("gromacs",))
    check_timestep(parser, options)
    return options


def main(arguments):
    options = parse(arguments)
    options.bench, options.lanescape = options.bench.absolute(), options.lanescape.absolute()
    comparison = Comparison(options, None)
    try:
        options.folder.mkdir(parents=True, exist_ok=True)
        options.folder = options.folder.absolute()
        program = options.gromacs or shutil.which("gmx")
        if program:
            comparison.gromacs = Gromacs(program, options.folder)
            comparison.run()
        else:
            comparison.missing.append({"what": "GROMACS", "why": "gmx is not on PATH"})
        report = comparison.report()
        if options.json:
            options.json.write_text(json.dumps(report, indent=2) + "\n")
    except (Failed, Unusable, OSError, ValueError) as error:
        print(f"gromacs.py: {error}", file=sys.stderr)
        return 1
    print(f"GROMACS {report['context']['gromacs'] or 'missing'}; nanoseconds of the clock per particle and step, medians of "
          f"{options.repetitions}; ratio: to lanescape in mixed precision")
    print_rows(report)
    for line in next((row["lists"] for row in report["results"] if row.get("lists")), []):
        print(f"GROMACS: {line}")
    return 0 if program else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
