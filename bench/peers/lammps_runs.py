"""LAMMPS as a peer: its pair styles, scripts and logs."""

import dataclasses
import os
import re
import shutil

import numpy as np

from ours import Failed, last_line, run
from systems import CUTOFF, Configuration, check_melted, lattice, wrapped

SKIN = 0.3  # [sigma], the default of LAMMPS in Lennard-Jones units
STYLES = ("lj/cut", "lj/cut/opt", "lj/cut/intel", "lj/cut/omp")
MELT_TIMESTEP, HOT_STEPS, COLD_STEPS = 0.004, 500, 1000


@dataclasses.dataclass(frozen=True)
class Peer:
    """A pair style and its number of processes or threads."""
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


MONTHS = ("Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec")


def release_of(version):
    """Year, month, day and update of a version such as `22 Jul 2025 - Update 4`; zeros where it has none."""
    date = re.match(r"(\d+) (\w{3})\w* (\d{4})(?:.*Update (\d+))?", version)
    if not date or date.group(2) not in MONTHS:
        return 0, 0, 0, 0
    return int(date.group(3)), MONTHS.index(date.group(2)), int(date.group(1)), int(date.group(4) or 0)


def newest_on_path(launcher, folder):
    """The newest LAMMPS on PATH, None if there is none, and why others on PATH cannot be run."""
    found, broken = [], []
    for directory, name in ((d, n) for d in os.environ.get("PATH", "").split(os.pathsep) for n in ("lmp", "lmp_mpi", "lammps")):
        program = shutil.which(name, path=directory) if directory else None
        if program:
            try:
                found.append(Lammps(program, launcher, folder))
            except Failed as error:
                broken.append({"what": f"LAMMPS {program}", "why": str(error)})
    return max(found, key=lambda lammps: release_of(lammps.version), default=None), broken


class Lammps:
    """One installed LAMMPS and its mpirun. Scripts and logs go into `folder`."""

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
        """The command that starts the program on this number of processes. Raises Failed if no mpirun can."""
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
        """Runs a script and returns its log. Raises Failed if LAMMPS fails or mpirun has started single processes."""
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
        wanted = peer.count  # LAMMPS prints processes times threads
        if counts != {wanted}:
            ran = " and ".join(map(str, sorted(counts))) or "none"
            raise Failed(f"{log}: ran on {ran} instead of {wanted}: is {self.launcher} of the MPI that LAMMPS is linked to?")
        return text


def header(peer, data):
    package = [f"package omp {peer.count}"] if peer.threaded else []
    if peer.style.endswith("/intel"):
        package = ["package intel 0 omp 1 mode double"]  # its default is single precision
    return [*package, "units lj", "atom_style atomic", f"read_data {data}"]


def interaction(peer, liquid):
    lines = [f"pair_style {peer.style} {CUTOFF}"]
    for (a, b), (epsilon, sigma) in liquid.pairs.items():
        lines.append(f"pair_coeff {a + 1} {b + 1} {epsilon} {sigma} {CUTOFF * sigma!r}")
    return [*lines, "pair_modify shift yes", f"neighbor {SKIN} bin"]


def write_data(file, configuration):
    """A data file for LAMMPS, with the shortest digits that read back as the same bits."""
    types, edge = len(configuration.liquid.species), repr(float(configuration.edge))
    lines = ["# reduced units", "", f"{len(configuration)} atoms", f"{types} atom types", ""]
    lines += [f"0.0 {edge} {axis}lo {axis}hi" for axis in "xyz"]
    lines += ["", "Masses", "", *(f"{t + 1} 1.0" for t in range(types)), "", "Atoms # atomic", ""]
    rows = zip(configuration.species.tolist(), configuration.positions.tolist())
    lines += [f"{i} {s + 1} {x!r} {y!r} {z!r}" for i, (s, (x, y, z)) in enumerate(rows, 1)]
    file.write_text("\n".join(lines) + "\n")


def melt(lammps, liquid, particles, seed, peer):
    """A liquid: LAMMPS melts a lattice and brings it to the temperature. Raises Failed if it is still a lattice."""
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
    check_melted(melted, particles, dump)
    dump.unlink()
    return melted


def potential_energy(lammps, name, data, liquid, peer):
    """Potential energy and virial. All velocities are 0, so the pressure is virial / (3 V)."""
    lines = [*header(peer, data), *interaction(peer, liquid), "thermo_style custom step pe press vol",
             "thermo_modify norm no format float %.17g", "run 0"]
    text = lammps.execute(f"{name}-energy", lines, peer)
    row = re.search(r"^\s*Step\s+PotEng\s+Press\s+Volume\s*\n\s*0\s+(\S+)\s+(\S+)\s+(\S+)", text, re.M)
    if not row:
        raise Failed(f"{lammps.folder / name}-energy.log: no energy in it")
    energy, pressure, volume = (float(number) for number in row.groups())
    return energy, 3.0 * pressure * volume


def measure(lammps, name, data, liquid, peer, cases, options):
    """Timings by case, as read_block gives them. One script runs all cases."""
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
    """Times, CPU use and list builds of one run, whose log follows 'Loop time of'.

    The Pair line holds the minimum, mean and maximum over the processes.
    """
    pair = re.search(r"^Pair\s+\|\s*(\S+)\s*\|\s*(\S+)\s*\|\s*(\S+)", block, re.M)
    builds = re.search(r"^Neighbor list builds = (\d+)", block, re.M)
    dangerous = re.search(r"^Dangerous builds = (\d+)", block, re.M)
    cpu = re.search(r"^\s*(\S+)% CPU use", block, re.M)
    if not (pair and builds and cpu):
        raise Failed("LAMMPS's log: no timing breakdown in it")
    builds = int(builds.group(1))
    if case != "step" and builds:
        raise Failed(f"LAMMPS's log: the list was rebuilt {builds} times in a run that must keep it")
    loop = float(block.split()[0])
    seconds = loop if case == "step" else float(pair.group(3))
    return {"ns_per_particle": 1e9 * seconds / (steps * particles), "loop_ns_per_particle": 1e9 * loop / (steps * particles),
            "cpu_percent": float(cpu.group(1)) / (peer.count if peer.threaded else 1), "steps": steps, "list_builds": builds,
            "dangerous_builds": int(dangerous.group(1)) if dangerous else None}
