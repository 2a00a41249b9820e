#!/usr/bin/python3
"""LAMMPS and bench_lists side by side on the same configurations: bench/peers/lammps.py [--json FILE]

For each liquid and size, LAMMPS melts a lattice. The configuration is wrapped into the box and written twice with the same digits: as
extended XYZ for Lanescape and as a data file for LAMMPS. Then
  1. potential energy and virial are compared. LAMMPS with every pair style and `lanescape energy` must agree to 1e-10. The first
     disagreement ends the run before anything is timed (exit status 1);
  2. all codes are timed in turn, --repetitions times, and the medians are compared:
       force                 the Pair time of a run without motion, with one neighbour list
       force+energy+virial   the same with energy and pressure at every step
       step                  the loop time of molecular dynamics. Lists are rebuilt when a particle has moved half the skin
LAMMPS's Pair time excludes communication. With several processes it is the time of the slowest one. All times are wall-clock times per
particle and step. Pair styles run on MPI processes; lj/cut/omp runs on threads of one process instead. lj/cut/intel is in double.

The table and the JSON list what is missing: LAMMPS, a pair style, mpirun or a benchmark.

Progress goes to stderr. Exit status: 0; 1 if energies disagree, a program fails (the last line on stderr says why) or there is no LAMMPS;
2 with one line on stderr for wrong usage.
"""

import datetime
import json
import os
import platform
import shutil
import statistics
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))

from benchmark_results import Arguments, Unusable  # noqa: E402
from lammps_runs import SKIN, STYLES, Lammps, Peer, measure, melt, newest_on_path, potential_energy, write_data  # noqa: E402
from ours import CASES, Bench, Failed, energy_and_virial  # noqa: E402
from peer_options import add_options, check_options, check_timestep, check_work  # noqa: E402
from peer_tables import print_rows  # noqa: E402
from systems import CUTOFF, LIQUIDS, kept_configuration, lattice  # noqa: E402

TOLERANCE = 1e-10  # relative, for energy and virial: rounding in sums over 256000 particles gives about 1e-13


class Comparison:
    """The pair styles of one LAMMPS and bench_lists on the same configurations."""

    def __init__(self, options, lammps):
        self.options, self.lammps = options, lammps
        self.missing, self.energies, self.results = [], [], []
        self.peers = []

    def miss(self, what, why):
        self.missing.append({"what": what, "why": why})

    def choose_peers(self):
        """Keeps the pair styles and numbers of processes or threads that complete one evaluation; the others are missing."""
        liquid, data = LIQUIDS["lennard-jones"], self.options.folder / "probe.data"
        write_data(data, lattice(liquid, 256, 1))
        for style in STYLES:
            if style not in self.lammps.styles:
                self.miss(f"LAMMPS {style}", f"not in {self.lammps.program}")
                continue
            for count in self.options.threads:
                peer = Peer(style, count)
                try:
                    potential_energy(self.lammps, "probe", data, liquid, peer)
                except Failed as error:
                    self.miss(str(peer), str(error))
                else:
                    self.peers.append(peer)
        if not self.peers:
            raise Failed(f"{self.lammps.program}: none of the pair styles {', '.join(STYLES)} can be run")

    def configuration(self, liquid, particles):
        """The file of a melted liquid and LAMMPS's copy of it. Later runs use the same files."""
        def made():
            say(f"{liquid.model}, N = {particles}: melting")
            return melt(self.lammps, liquid, particles, self.options.seed, max(self.peers, key=lambda peer: peer.processes))
        file, configuration = kept_configuration(self.options.folder, liquid, particles, self.options.seed, made)
        data = file.with_suffix(".data")
        write_data(data, configuration)
        return file, data

    def check_energies(self, liquid, particles, file, data):
        """Every pair style and number of processes against `lanescape energy`. The number of processes changes the order of LAMMPS's sums."""
        say(f"{liquid.model}, N = {particles}: energies")
        expected = energy_and_virial(self.options.lanescape, file, liquid, CUTOFF)
        for peer in self.peers:
            found = potential_energy(self.lammps, file.stem, data, liquid, peer)
            scales = abs(expected[0]), max(abs(expected[1]), abs(expected[0]))  # terms of the virial may cancel, those of the energy do not
            relative = [abs(a - b) / scale for a, b, scale in zip(found, expected, scales)]
            self.energies.append({"model": liquid.model, "particles": particles, "peer": str(peer), "energy": expected[0],
                                  "virial": expected[1], "peer_energy": found[0], "peer_virial": found[1],
                                  "relative_difference": relative[0], "virial_difference": relative[1]})
            for quantity, difference, a, b in zip(("energies", "virials"), relative, found, expected):
                if not difference <= TOLERANCE:
                    raise Failed(f"{liquid.model}, N = {particles}: {quantity} disagree: {peer} {a!r}, lanescape {b!r}, "
                                 f"relative difference {difference:.2g}, allowed is {TOLERANCE:g}; nothing was timed")

    def time(self, liquid, particles, file, data):
        """All codes in turn, as many times as there are repetitions."""
        cases = [case for case in CASES if case != "step" or particles == self.options.step_size]
        bench = Bench(self.options.bench, file, liquid, particles, cases, self.options.threads, self.options.isa)
        for case, count in bench.missing:
            self.miss(f"bench_lists {case}, {count} threads", f"no such benchmark for N = {particles}, {bench.isa}")
        ours, peers = {}, {}
        for repetition in range(self.options.repetitions):
            say(f"{liquid.model}, N = {particles}: timing, {repetition + 1} of {self.options.repetitions}")
            for key, nanoseconds in bench.measure().items():
                ours.setdefault(key, []).append(nanoseconds)
            for peer in self.peers:
                for case, timing in measure(self.lammps, file.stem, data, liquid, peer, cases, self.options).items():
                    peers.setdefault((case, peer), []).append(timing)
        self.collect(liquid, particles, cases, bench.isa, ours, peers)

    def collect(self, liquid, particles, cases, isa, ours, peers):
        """The medians of all samples, and the ratios to ours, as rows of the results."""
        for case in cases:
            for count in self.options.threads:
                common = {"model": liquid.model, "particles": particles, "case": case, "threads": count}
                own = statistics.median(ours[case, count]) if (case, count) in ours else None
                if own is not None:
                    self.results.append({**common, "code": "lanescape", "variant": isa, "ns_per_particle": own, "ratio": 1.0,
                                         "samples": ours[case, count]})
                for peer in self.peers:
                    timings = peers.get((case, peer))
                    if peer.count != count or not timings:
                        continue
                    samples = [timing["ns_per_particle"] for timing in timings]
                    median = statistics.median(samples)
                    self.results.append({
                        **common, "code": "LAMMPS", "variant": peer.style, "ns_per_particle": median,
                        "ratio": median / own if own is not None else None, "samples": samples,
                        "loop_ns_per_particle": statistics.median(timing["loop_ns_per_particle"] for timing in timings),
                        "cpu_percent": statistics.median(timing["cpu_percent"] for timing in timings),
                        **{key: timings[0][key] for key in ("steps", "list_builds", "dangerous_builds")}})

    def run(self):
        self.choose_peers()
        systems = []
        for model in self.options.models:
            for particles in self.options.sizes:
                liquid = LIQUIDS[model]
                systems.append((liquid, particles, *self.configuration(liquid, particles)))
        for system in systems:
            self.check_energies(*system)
        for system in systems:
            self.time(*system)

    def report(self):
        lammps, load = self.lammps, os.getloadavg()[0]
        return {"context": {"date": datetime.datetime.now().astimezone().isoformat(timespec="seconds"), "processors": os.cpu_count(),
                            "machine": platform.machine(), "load_average": load, "cutoff": CUTOFF, "skin": SKIN,
                            "tolerance": TOLERANCE, "timestep": self.options.timestep, "repetitions": self.options.repetitions,
                            "lammps": lammps.version if lammps else None, "lammps_compiler": lammps.compiler if lammps else None},
                "missing": self.missing, "energies": self.energies, "results": self.results}


def say(text):
    print(text, file=sys.stderr, flush=True)


def print_table(report):
    context = report["context"]
    print(f"LAMMPS {context['lammps'] or 'missing'}; nanoseconds of the clock per particle and step, medians of {context['repetitions']}; "
          "ratio: peer/lanescape")
    print_rows(report)


def parse(arguments):
    parser = Arguments(prog="lammps.py", description="LAMMPS and bench_lists side by side; the head of this file describes the comparison.")
    parser.add_argument("--lammps", metavar="PATH", help="the LAMMPS to use [the newest of lmp, lmp_mpi and lammps on PATH]")
    parser.add_argument("--mpirun", metavar="PATH", help="the mpirun of LAMMPS's MPI [mpirun on PATH]")
    parser.add_argument("--models", nargs="+", choices=tuple(LIQUIDS), default=tuple(LIQUIDS), help="[both]")
    parser.add_argument("--sizes", nargs="+", type=int, default=(256, 4000, 32000, 256000), metavar="N",
                        help="particles [256 4000 32000 256000]")
    parser.add_argument("--step-size", type=int, default=32000, metavar="N", help="the size that whole steps are timed for [32000]")
    parser.add_argument("--work", type=float, default=2e7, help="particles times steps of one timing of forces [2e7]")
    parser.add_argument("--steps", type=int, default=300, help="of one timing of whole steps [300]")
    parser.add_argument("--timestep", type=float, default=0.005, help="of whole steps [0.005]")
    add_options(parser, repetitions=5, threads="threads, or processes of LAMMPS [1, 2, 4, ...]")
    options = parser.parse_args(arguments)
    check_options(parser, options, 256, ("steps",), ("lammps", "mpirun"))  # the box of 256 is wider than twice cutoff and skin
    check_work(parser, options)
    check_timestep(parser, options)
    return options


def main(arguments):
    options = parse(arguments)
    options.bench, options.lanescape = options.bench.absolute(), options.lanescape.absolute()
    comparison = Comparison(options, None)
    try:
        options.folder.mkdir(parents=True, exist_ok=True)
        options.folder = options.folder.absolute()
        launcher = options.mpirun or shutil.which("mpirun")
        if options.lammps:
            comparison.lammps = Lammps(options.lammps, launcher, options.folder)
        else:
            comparison.lammps, comparison.missing = newest_on_path(launcher, options.folder)
        if comparison.lammps:
            comparison.run()
        else:
            comparison.miss("LAMMPS", "none of lmp, lmp_mpi, lammps on PATH")
        report = comparison.report()
        if options.json:
            options.json.write_text(json.dumps(report, indent=2) + "\n")
    except (Failed, Unusable, OSError) as error:
        print(f"lammps.py: {error}", file=sys.stderr)
        return 1
    print_table(report)
    return 0 if comparison.lammps else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
