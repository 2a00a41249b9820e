#!/usr/bin/python3
"""LAMMPS and bench_lists side by side on the same configurations: bench/peers/lammps.py [--json FILE]

For each liquid and size a lattice is melted by LAMMPS, wrapped into the box and written once as extended XYZ for Lanescape and once,
digit for digit, as a data file for LAMMPS. Then
  1. potential energy and virial by LAMMPS, with every pair style, and by `lanescape energy` have to agree to 1e-10; the first
     disagreement ends the run before anything is timed (exit status 1);
  2. all codes are timed in turn, --repetitions times, and the medians are compared:
       force                 the Pair time of a run in which no particle moves and the list is kept
       force+energy+virial   likewise with energy and pressure asked for at every step
       step                  the loop time of molecular dynamics, lists made anew when a particle has moved half the skin
LAMMPS's Pair time leaves out its communication and, of several processes, is that of the slowest. All times are of the clock, per
particle and step. Pair styles run on MPI processes; lj/cut/omp runs threads of one process instead.

What is not there (LAMMPS, a pair style, mpirun, a benchmark) is named as missing in the table and in the JSON.

Progress goes to stderr. Exit status 0; 1 if energies disagree or a program fails, the reason being the last line on stderr, or if there
is no LAMMPS; 2 with one line on stderr for wrong usage.
"""

import dataclasses
import datetime
import json
import os
import platform
import re
import shutil
import statistics
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))

from benchmark_results import ISAS, MODELS, Arguments, Unusable  # noqa: E402
from ours import CASES, Bench, Failed, energy_and_virial, last_line, run  # noqa: E402
from systems import (CUTOFF, LIQUIDS, Configuration, lattice, lattice_order, read_extended_xyz, wrapped,  # noqa: E402
                     write_extended_xyz)

import numpy as np  # noqa: E402

SKIN = 0.3  # [sigma], LAMMPS's own choice for Lennard-Jones units
TOLERANCE = 1e-10  # relative, of energy and virial: summation over 256000 particles leaves about 1e-13
STYLES = ("lj/cut", "lj/cut/opt", "lj/cut/omp")
MELT_TIMESTEP, HOT_STEPS, COLD_STEPS = 0.004, 500, 1000
LATTICE_ORDER_LIMIT = 0.3  # a lattice at these temperatures keeps more than 0.7, a liquid of 256 has about 0.1
BUSY_BELOW = 95.0  # [%] of the processor that a run could use


@dataclasses.dataclass(frozen=True)
class Peer:
    """A pair style on so many processes or threads."""
    style: str
    count: int

    @property
    def threaded(self):
        return self.style.endswith("/omp")

    @property
    def processes(self):
        return 1 if self.threaded else self.count

    def __str__(self):
        unit = ("thread", "threads") if self.threaded else ("process", "processes")
        return f"LAMMPS {self.style}, {self.count} {unit[self.count > 1]}"


# ---- LAMMPS

class Lammps:
    def __init__(self, program, launcher, folder):
        self.program, self.launcher, self.folder = program, launcher, folder
        text = run([program, "-h"])
        styles = text[text.find("* Pair styles:"):].split("\n\n* ")[0]
        self.styles = set(re.findall(r"\S+", styles))
        version = re.search(r"Simulator - (.+)", text)
        self.version = version.group(1).strip() if version else "unknown version"
        compiler = re.search(r"Compiler: (.+)", text)
        self.compiler = compiler.group(1).strip() if compiler else "unknown"
        self.launch = {1: []}

    def launch_command(self, processes):
        """The command before the program for so many processes; Failed where there is none."""
        if processes not in self.launch:
            if not self.launcher:
                raise Failed("mpirun: not on PATH")
            root = ["--allow-run-as-root"] if os.geteuid() == 0 else []
            for words in (root + ["--oversubscribe", "--bind-to", "core"], root + ["--oversubscribe"], []):
                command = [self.launcher, *words, "-np", str(processes)]
                try:
                    run([*command, "true"])
                except Failed as error:
                    failure = error
                else:
                    self.launch[processes] = command
                    break
            else:
                raise failure
        return self.launch[processes]

    def execute(self, name, lines, peer):
        """The log of a script; Failed where LAMMPS refuses it or where mpirun has started single processes."""
        script, log = self.folder / f"{name}.in", self.folder / f"{name}.log"
        script.write_text("\n".join(lines) + "\n")
        log.unlink(missing_ok=True)
        command = [*self.launch_command(peer.processes), self.program, "-in", script, "-log", log, "-screen", "none"]
        try:
            run(command, {"OMP_NUM_THREADS": str(peer.count if peer.threaded else 1)})
        except Failed as error:
            text = log.read_text(errors="replace") if log.exists() else ""
            raise Failed(f"{error}; {log}: {last_line(text)}") from error
        text = log.read_text(errors="replace")
        counts = {int(count) for count in re.findall(r"^Loop time of \S+ on (\d+) procs", text, re.M)}
        wanted = peer.count  # LAMMPS counts processes times threads
        if counts != {wanted}:
            ran = " and ".join(map(str, sorted(counts))) or "none"
            raise Failed(f"{log}: ran on {ran} instead of {wanted}: is {self.launcher} of the MPI that LAMMPS is linked to?")
        return text


def header(peer, data):
    package = [f"package omp {peer.count}"] if peer.threaded else []
    return [*package, "units lj", "atom_style atomic", f"read_data {data}"]


def interaction(peer, liquid):
    lines = [f"pair_style {peer.style} {CUTOFF}"]
    for (a, b), (epsilon, sigma) in liquid.pairs.items():
        lines.append(f"pair_coeff {a + 1} {b + 1} {epsilon} {sigma} {CUTOFF * sigma!r}")
    return [*lines, "pair_modify shift yes", f"neighbor {SKIN} bin"]


def write_data(file, configuration):
    types, edge = len(configuration.liquid.species), repr(float(configuration.edge))
    lines = ["# reduced units", "", f"{len(configuration)} atoms", f"{types} atom types", ""]
    lines += [f"0.0 {edge} {axis}lo {axis}hi" for axis in "xyz"]
    lines += ["", "Masses", "", *(f"{t + 1} 1.0" for t in range(types)), "", "Atoms # atomic", ""]
    rows = zip(configuration.species.tolist(), configuration.positions.tolist())
    lines += [f"{i} {s + 1} {x!r} {y!r} {z!r}" for i, (s, (x, y, z)) in enumerate(rows, 1)]
    file.write_text("\n".join(lines) + "\n")


def melt(lammps, liquid, particles, seed, peer):
    """A lattice, melted and brought to the liquid's temperature."""
    name = f"{liquid.model}-{particles}-melt"
    start = lattice(liquid, particles, seed)
    data, dump = lammps.folder / f"{name}.data", lammps.folder / f"{name}.dump"
    write_data(data, start)
    lines = [*header(peer, data), *interaction(peer, liquid), "neigh_modify every 1 delay 0 check yes",
             f"velocity all create {2.0 * liquid.melting_temperature} {seed} loop all", f"timestep {MELT_TIMESTEP}", "fix move all nve"]
    for temperature, steps in ((liquid.melting_temperature, HOT_STEPS), (liquid.temperature, COLD_STEPS)):
        lines += [f"fix bath all langevin {temperature} {temperature} 0.5 {seed}", f"run {steps}"]
    lines.append(f"write_dump all custom {dump} id type x y z modify sort id format float %.17g")
    lammps.execute(name, lines, peer)
    rows = np.loadtxt(dump, skiprows=9)
    melted = Configuration(liquid, start.edge, rows[:, 1].astype(int) - 1, wrapped(rows[:, 2:5], start.edge))
    order = lattice_order(melted)
    if len(melted) != particles or not order < LATTICE_ORDER_LIMIT:
        raise Failed(f"{dump}: not a liquid of {particles} particles: {len(melted)} with lattice order {order:.2f}")
    dump.unlink()
    return melted


def potential_energy(lammps, name, data, liquid, peer):
    """Energy and virial without motion: the pressure is virial/(3 V), as nothing has a velocity."""
    lines = [*header(peer, data), *interaction(peer, liquid), "thermo_style custom step pe press vol",
             "thermo_modify norm no format float %.17g", "run 0"]
    text = lammps.execute(f"{name}-energy", lines, peer)
    row = re.search(r"^\s*Step\s+PotEng\s+Press\s+Volume\s*\n\s*0\s+(\S+)\s+(\S+)\s+(\S+)", text, re.M)
    if not row:
        raise Failed(f"{lammps.folder / name}-energy.log: no energy in it")
    energy, pressure, volume = (float(number) for number in row.groups())
    return energy, 3.0 * pressure * volume


def measure(lammps, name, data, liquid, peer, cases, options):
    """By case: nanoseconds per particle and step, share of the processor, list builds; all from one script."""
    particles = int(data.read_text().splitlines()[2].split()[0])
    steps = max(10, round(options.work / particles))
    lines = [*header(peer, data), *interaction(peer, liquid), "neigh_modify once yes"]
    ran = []
    if "force" in cases:
        lines += ["thermo_style custom step", "thermo 0", f"run {steps}"]
        ran.append(("force", steps))
    if "force+energy+virial" in cases:
        lines += ["thermo_style custom step pe press", "thermo_modify norm no format float %.17g", "thermo 1", f"run {steps}"]
        ran.append(("force+energy+virial", steps))
    if "step" in cases:
        lines += ["neigh_modify once no every 1 delay 0 check yes", f"velocity all create {liquid.temperature} {options.seed} loop all",
                  f"timestep {options.timestep!r}", "fix move all nve", "thermo_style custom step", "thermo 0", f"run {options.steps}"]
        ran.append(("step", options.steps))
    text = lammps.execute(name, lines, peer)
    blocks = re.split(r"^Loop time of ", text, flags=re.M)[1:]
    if len(blocks) != len(ran):
        raise Failed(f"{lammps.folder / name}.log: {len(blocks)} runs in it, {len(ran)} asked for")
    return {case: read_block(block, case, count, particles, peer) for block, (case, count) in zip(blocks, ran)}


def read_block(block, case, steps, particles, peer):
    """One run of a log, from behind 'Loop time of'. The Pair line holds the least, mean and greatest time of the processes."""
    pair = re.search(r"^Pair\s+\|\s*(\S+)\s*\|\s*(\S+)\s*\|\s*(\S+)", block, re.M)
    builds = re.search(r"^Neighbor list builds = (\d+)", block, re.M)
    dangerous = re.search(r"^Dangerous builds = (\d+)", block, re.M)
    cpu = re.search(r"^\s*(\S+)% CPU use", block, re.M)
    if not (pair and builds and cpu):
        raise Failed("LAMMPS's log: no timing breakdown in it")
    builds = int(builds.group(1))
    if case != "step" and builds:
        raise Failed(f"LAMMPS's log: the list was made anew {builds} times in a run that is to keep it")
    loop = float(block.split()[0])
    seconds = loop if case == "step" else float(pair.group(3))
    return {"ns_per_particle": 1e9 * seconds / (steps * particles), "loop_ns_per_particle": 1e9 * loop / (steps * particles),
            "cpu_percent": float(cpu.group(1)) / (peer.count if peer.threaded else 1), "steps": steps, "list_builds": builds,
            "dangerous_builds": int(dangerous.group(1)) if dangerous else None}


# ---- the comparison

class Comparison:
    def __init__(self, options, lammps):
        self.options, self.lammps = options, lammps
        self.missing, self.energies, self.results = [], [], []
        self.peers = []

    def miss(self, what, why):
        self.missing.append({"what": what, "why": why})

    def choose_peers(self):
        """The pair styles, processes and threads that can do one evaluation."""
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
        """The file of a melted liquid, kept in the folder from one run to the next, and LAMMPS's copy of it."""
        file = self.options.folder / f"{liquid.model}-{particles}-seed{self.options.seed}.extxyz"
        data = file.with_suffix(".data")
        if file.exists():
            try:
                configuration = read_extended_xyz(file, liquid)
            except (ValueError, IndexError) as error:
                raise Failed(f"{file}: {error}; remove it to have it made again") from error
        else:
            say(f"{liquid.model}, N = {particles}: melting")
            configuration = melt(self.lammps, liquid, particles, self.options.seed, max(self.peers, key=lambda peer: peer.processes))
            write_extended_xyz(file, configuration)
        write_data(data, configuration)
        return file, data

    def check_energies(self, liquid, particles, file, data):
        """Every style against `lanescape energy`, and every number of processes: it changes LAMMPS's sums."""
        say(f"{liquid.model}, N = {particles}: energies")
        expected = energy_and_virial(self.options.lanescape, file, liquid, CUTOFF)
        for peer in self.peers:
            found = potential_energy(self.lammps, file.stem, data, liquid, peer)
            scales = abs(expected[0]), max(abs(expected[1]), abs(expected[0]))  # the virial may cancel, the energy does not
            relative = [abs(a - b) / scale for a, b, scale in zip(found, expected, scales)]
            self.energies.append({"model": liquid.model, "particles": particles, "peer": str(peer), "energy": expected[0],
                                  "virial": expected[1], "peer_energy": found[0], "peer_virial": found[1],
                                  "relative_difference": relative[0], "virial_difference": relative[1]})
            for quantity, difference, a, b in zip(("energies", "virials"), relative, found, expected):
                if not difference <= TOLERANCE:
                    raise Failed(f"{liquid.model}, N = {particles}: {quantity} disagree: {peer} {a!r}, lanescape {b!r}, "
                                 f"relative difference {difference:.2g}, allowed is {TOLERANCE:g}; nothing was timed")

    def time(self, liquid, particles, file, data):
        cases = [case for case in CASES if case != "step" or (liquid.model, particles) == ("kob-andersen", self.options.step_size)]
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
    group = None
    for row in report["results"]:
        if group != (row["model"], row["particles"]):
            group = row["model"], row["particles"]
            worst = max(e["relative_difference"] for e in report["energies"] if (e["model"], e["particles"]) == group)
            print(f"\n{MODELS[row['model']]}, N = {row['particles']}; energies agree to {worst:.1g}")
            print(f"  {'case':20} {'cores':>5}  {'code':22} {'ns':>9} {'spread':>7} {'ratio':>6}  remarks")
        spread = (max(row["samples"]) - min(row["samples"])) / row["ns_per_particle"]
        ratio = "" if row["ratio"] is None else f"{row['ratio']:.2f}"
        print(f"  {row['case']:20} {row['threads']:5}  {row['code'] + ' ' + row['variant']:22} {row['ns_per_particle']:9.2f} "
              f"{100 * spread:5.0f} % {ratio:>6}  {remarks(row)}".rstrip())
    if report["missing"]:
        print()
    for entry in report["missing"]:
        print(f"missing: {entry['what']}: {entry['why']}")


def remarks(row):
    said = []
    if row["case"] == "step" and row.get("list_builds") is not None:
        said.append(f"{row['list_builds']} lists in {row['steps']} steps")
        if row["dangerous_builds"]:
            said.append(f"{row['dangerous_builds']} of them late")
    if row.get("cpu_percent", 100.0) < BUSY_BELOW:
        said.append(f"had {row['cpu_percent']:.0f} % of the processor")
    return ", ".join(said)


# ---- program

def parse(arguments):
    parser = Arguments(prog="lammps.py", description="LAMMPS and bench_lists side by side; see the head of this file.")
    parser.add_argument("--lammps", metavar="PATH", help="the LAMMPS to use [lmp, lmp_mpi or lammps on PATH]")
    parser.add_argument("--mpirun", metavar="PATH", help="the mpirun of LAMMPS's MPI [mpirun on PATH]")
    parser.add_argument("--bench", type=Path, default=ROOT / "build/release/bench/bench_lists", help="[build/release/bench/bench_lists]")
    parser.add_argument("--lanescape", type=Path, default=ROOT / "build/release/lanescape", help="[build/release/lanescape]")
    parser.add_argument("--isa", choices=ISAS, help="instruction set of bench_lists [the widest]")
    parser.add_argument("--models", nargs="+", choices=tuple(LIQUIDS), default=tuple(LIQUIDS), help="[both]")
    parser.add_argument("--sizes", nargs="+", type=int, default=(256, 4000, 32000, 256000), metavar="N",
                        help="particles [256 4000 32000 256000]")
    parser.add_argument("--step-size", type=int, default=32000, metavar="N", help="the Kob-Andersen size that whole steps are timed for [32000]")
    parser.add_argument("--threads", nargs="+", type=int, default=(1, 2), metavar="T", help="threads, or processes of LAMMPS [1 2]")
    parser.add_argument("--repetitions", type=int, default=5, help="[5]")
    parser.add_argument("--work", type=float, default=2e7, help="particles times steps of one timing of forces [2e7]")
    parser.add_argument("--steps", type=int, default=300, help="of one timing of whole steps [300]")
    parser.add_argument("--timestep", type=float, default=0.005, help="of whole steps [0.005]")
    parser.add_argument("--seed", type=int, default=1, help="[1]")
    parser.add_argument("--folder", type=Path, default=ROOT / "build/peers", help="for configurations, which are used again, and logs [build/peers]")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the results there")
    options = parser.parse_args(arguments)
    for name, least in (("sizes", 256), ("threads", 1)):  # a box of 256 holds twice the cutoff and skin
        for number in getattr(options, name):
            if number < least:
                parser.error(f"--{name} {number}: must be at least {least}")
    for name in ("repetitions", "steps", "seed"):
        if getattr(options, name) < 1:
            parser.error(f"--{name} {getattr(options, name)}: must be at least 1")
    if not 1.0 <= options.work <= 1e12:
        parser.error(f"--work {options.work}: must be from 1 to 1e12")
    if not 0.0 < options.timestep <= 0.02:
        parser.error(f"--timestep {options.timestep}: must be above 0 and at most 0.02")
    for name in ("lammps", "mpirun"):
        if getattr(options, name) and not shutil.which(getattr(options, name)):
            parser.error(f"--{name} {getattr(options, name)}: no such program")
    for name in ("bench", "lanescape"):
        if not shutil.which(getattr(options, name)):
            parser.error(f"--{name} {getattr(options, name)}: no such program; is it built?")
    if options.json and not options.json.absolute().parent.is_dir():
        parser.error(f"--json {options.json}: no such folder")
    return options


def first_on_path(*names):
    return next((found for found in map(shutil.which, names) if found), None)


def main(arguments):
    options = parse(arguments)
    options.bench, options.lanescape = options.bench.absolute(), options.lanescape.absolute()
    comparison = Comparison(options, None)
    try:
        options.folder.mkdir(parents=True, exist_ok=True)
        options.folder = options.folder.absolute()
        program = options.lammps or first_on_path("lmp", "lmp_mpi", "lammps")
        if program:
            comparison.lammps = Lammps(program, options.mpirun or first_on_path("mpirun"), options.folder)
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
    return 0 if program else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
