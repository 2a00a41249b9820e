"""GROMACS as a peer: its input files, runs and logs. Lengths in nm are sigma, energies in kJ/mol epsilon, masses in u are 1: times in ps are then
those of reduced units."""

import re

import numpy as np

from ours import Failed, run
from systems import CUTOFF, Configuration, check_melted, lattice, wrapped

KELVIN = 1.0 / 0.00831446261815324  # of one epsilon
MELT_TIMESTEP, HOT_STEPS, COLD_STEPS = 0.004, 500, 1000

TOPOLOGY = """[ defaults ]
1 1 no 1 1
[ atomtypes ]
LJ 1.0 0.0 A 4.0 4.0
[ moleculetype ]
LJ 0
[ atoms ]
1 LJ 1 LJ LJ 1 0 1.0
[ system ]
liquid
[ molecules ]
LJ {particles}
"""

PARAMETERS = """integrator = md
dt = {timestep}
nsteps = {steps}
cutoff-scheme = Verlet
nstlist = {nstlist}
verlet-buffer-tolerance = {tolerance}
rlist = 2.8
coulombtype = cut-off
rcoulomb = {cutoff}
vdwtype = cut-off
vdw-modifier = potential-shift
rvdw = {cutoff}
nstcalcenergy = 100
nstenergy = {output}
nstlog = {output}
nstcomm = 100
gen-vel = yes
gen-seed = 1
gen-temp = {kelvin}
tcoupl = {coupling}
tc-grps = System
tau-t = 0.1
ref-t = {kelvin}
"""


def write_gro(file, configuration):
    """Eight decimals: finer than single precision."""
    lines = ["liquid", str(len(configuration))]
    for k, (x, y, z) in enumerate(configuration.positions.tolist(), 1):
        lines.append(f"{k % 100000:5d}{'LJ':5}{'LJ':>5}{k % 100000:5d}{x:15.8f}{y:15.8f}{z:15.8f}")
    lines.append(" ".join(3 * [f"{configuration.edge:.8f}"]))
    file.write_text("\n".join(lines) + "\n")


def read_gro(file, liquid):
    """A configuration as GROMACS writes it, with three decimals, the particles in the box."""
    _, count, *rows = file.read_text().splitlines()
    positions = np.array([[float(x) for x in row[20:].split()[:3]] for row in rows[:int(count)]])
    edge = float(rows[int(count)].split()[0])
    return Configuration(liquid, edge, np.zeros(len(positions), int), wrapped(positions, edge))


class Gromacs:
    """One installed GROMACS. Input files and logs go into `folder`."""

    def __init__(self, program, folder):
        self.program, self.folder = program, folder
        text = run([program, "--version"])
        found = {key: re.search(key + r":\s*(.+)", text) for key in ("GROMACS version", "SIMD instructions", "Precision")}
        self.version, self.simd, self.precision = (match.group(1).strip() if match else "unknown" for match in found.values())

    def mdrun(self, name, gro, threads, options, coupling="no", **parameters):
        """Prepares and runs molecular dynamics and returns the log."""
        base = self.folder / name
        particles = int(gro.read_text().split("\n", 2)[1])
        base.with_suffix(".top").write_text(TOPOLOGY.format(particles=particles))
        base.with_suffix(".mdp").write_text(PARAMETERS.format(cutoff=CUTOFF, coupling=coupling, **parameters))
        prepared, log = base.with_suffix(".tpr"), base.with_suffix(".log")
        run([self.program, "grompp", "-f", base.with_suffix(".mdp"), "-c", gro, "-p", base.with_suffix(".top"), "-o", prepared,
             "-po", base.with_suffix(".out.mdp"), "-maxwarn", 5])
        log.unlink(missing_ok=True)
        run([self.program, "mdrun", "-s", prepared, "-deffnm", base, "-ntmpi", 1, "-ntomp", threads, "-nb", "cpu", *options])
        return log.read_text(errors="replace")


def melt(gromacs, liquid, particles, seed, threads):
    """A liquid from a lattice."""
    start = gromacs.folder / "lattice.gro"
    write_gro(start, lattice(liquid, particles, seed))
    for name, temperature, steps in (("hot", liquid.melting_temperature, HOT_STEPS), ("cold", liquid.temperature, COLD_STEPS)):
        gromacs.mdrun(name, start, threads, [], coupling="v-rescale", timestep=MELT_TIMESTEP, steps=steps, nstlist=20, tolerance=0.005,
                      output=steps, kelvin=KELVIN * temperature)
        start = gromacs.folder / f"{name}.gro"
    configuration = read_gro(start, liquid)
    check_melted(configuration, particles, "GROMACS")
    return configuration


def potential_energy(gromacs, name, gro):
    """Of the configuration as it is [epsilon]: the log has six digits."""
    log = gromacs.mdrun(f"{name}-energy", gro, 1, [], timestep=0.001, steps=0, nstlist=10, tolerance=-1, output=1, kelvin=KELVIN)
    table = re.search(r"^\s*LJ \(SR\).*\n(.*)$", log, re.MULTILINE)
    if not table:
        raise Failed("GROMACS: no energy in its log")
    return float(table.group(1)[:15])


def measure(gromacs, name, gro, threads, options):
    """Wall-clock nanoseconds per particle and step, of the second half of a run: whole steps, and forces in them."""
    log = gromacs.mdrun(f"{name}-step", gro, threads, ["-resethway", "-pin", "auto"], timestep=options.timestep, steps=options.steps,
                        nstlist=options.nstlist, tolerance=0.005, output=options.steps, kelvin=KELVIN)
    accounting = log[log.find("R E A L   C Y C L E"):]
    # Of each row: threads, how often, and seconds, after its name.
    rows = {what: re.search(rf"^\s*{what}\s+([\d.\s]+)$", accounting, re.MULTILINE) for what in ("Force", "Total")}
    if not all(rows.values()):
        raise Failed("GROMACS: no cycle accounting in its log")
    (_, _, steps, force, *_), (total, *_) = (row.group(1).split() for row in rows.values())
    per_step = 1e9 / (int(steps) * int(gro.read_text().split("\n", 2)[1]))
    buffers = [line.strip() for line in log.splitlines() if re.search(r"(outer|inner) list|updated every", line)]
    return {"step": float(total) * per_step, "force": float(force) * per_step, "lists": buffers}
