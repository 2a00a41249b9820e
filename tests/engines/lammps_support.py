"""Runs of LAMMPS that the tests of engines compare: a liquid by the pair style under test, and by LAMMPS's own."""

import dataclasses
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from environments import skip  # noqa: E402


@dataclasses.dataclass
class Lammps:
    """A LAMMPS and the MPI that it belongs to."""

    program: Path
    mpirun: list  # words before the number of ranks
    environment: dict = dataclasses.field(default_factory=dict)

    @staticmethod
    def of_debian():
        for name, package in (("lmp", "lammps"), ("mpirun", "mpi-default-bin")):
            if shutil.which(name) is None:
                skip(f"{name} is not here (Debian: package {package})")
        return Lammps(Path(shutil.which("lmp")), OPENMPI)

    def run(self, folder, script, *, ranks=1, timeout=300):
        """Output and exit status of LAMMPS on this script."""
        (folder / "in.lmp").write_text(script)
        before = [] if ranks == 1 else [*self.mpirun, str(ranks)]
        done = subprocess.run([*before, str(self.program), "-in", "in.lmp", "-log", "none"], cwd=folder, capture_output=True, text=True,
                              timeout=timeout, env={**os.environ, **OPENMPI_AS_ROOT, "OMP_NUM_THREADS": "1", **self.environment})
        return done.stdout + done.stderr, done.returncode


OPENMPI = ["mpirun", "--oversubscribe", "--bind-to", "none", "-np"]
OPENMPI_AS_ROOT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}

COLUMNS = ("pe", "press", "pxx", "pyy", "pzz", "pxy", "pxz", "pyz")
# Kob and Andersen's mixture (epsilon, sigma, cutoff of each pair of types), and its first species alone.
TWO_SPECIES = {(1, 1): (1.0, 1.0, 2.5), (1, 2): (1.5, 0.8, 2.0), (2, 2): (0.5, 0.88, 2.2)}
ONE_SPECIES = {(1, 1): (1.0, 1.0, 2.5)}


@dataclasses.dataclass
class Liquid:
    """A liquid on its way from a lattice, and how it is computed: argon where sigma is above 1, else particles of mass 1."""

    types: int = 1
    newton: str = "on"
    units: str = "lj"
    sigma: float = 1.0  # in these units
    epsilon: float = 1.0
    cells: int = 8  # of four atoms each, along an edge
    steps: int = 100

    def own_style(self):
        """The lines of lj/cut."""
        pairs = TWO_SPECIES if self.types == 2 else ONE_SPECIES
        lines = [f"pair_style lj/cut {2.5 * self.sigma!r}"]
        for (a, b), (epsilon, sigma, cutoff) in pairs.items():
            lines.append(f"pair_coeff {a} {b} {epsilon * self.epsilon!r} {sigma * self.sigma!r} {cutoff * self.sigma!r}")
        return "\n".join(lines)

    def time_step(self):
        """0.005 sigma sqrt(m/epsilon), or about that."""
        if self.units == "real":
            return 10.0  # fs, of argon
        return 0.005 if self.units == "lj" else 0.01 if self.sigma > 1.0 else 5e-5  # ps, of argon; of a mixture of mass, sigma and eV 1

    def script(self, styles, before=""):
        density = 1.2 if self.types == 2 else 0.8442
        scale = density if self.units == "lj" else (4.0 / density) ** (1 / 3) * self.sigma  # units lj take the density
        thermo = " ".join(COLUMNS)
        return f"""{before}
units {self.units}
newton {self.newton}
atom_style atomic
lattice custom {scale!r} a1 1 0 0 a2 0 1 0 a3 0 0 1 basis 0 0 0 basis 0 0.5 0.5 basis 0.5 0 0.5 basis 0.5 0.5 0
region box block 0 {self.cells} 0 {self.cells} 0 {self.cells}
create_box {self.types} box
create_atoms 1 box
{"set group all type/ratio 2 0.2 4711" if self.types == 2 else ""}
mass * {39.948 if self.sigma > 1.0 else 1.0}
displace_atoms all random {0.05 * self.sigma!r} {0.05 * self.sigma!r} {0.05 * self.sigma!r} 12345 units box
velocity all create {120.0 if self.sigma > 1.0 else 1.0 if self.units == "lj" else 11604.5} 87287 loop geom
{styles}
neighbor {0.3 * self.sigma!r} bin
neigh_modify delay 0 every 5 check yes
timestep {self.time_step()}
fix integrate all nve
compute each all pe/atom
thermo_style custom step {thermo}
thermo_modify format float %.17g
thermo {self.steps}
dump forces all custom {max(self.steps, 1)} forces.dump id x y z fx fy fz c_each
dump_modify forces format float %.17g sort id
run {self.steps}
"""


def results(lammps, folder, liquid, styles, *, ranks=1, before=""):
    """(rows of COLUMNS, frames of id x y z fx fy fz energy) at the first and the last step."""
    output, status = lammps.run(folder, liquid.script(styles, before), ranks=ranks)
    assert status == 0, output[-2000:]
    lines = output.splitlines()
    header = next(k for k, line in enumerate(lines) if line.split()[:2] == ["Step", "PotEng"])
    rows = 2 if liquid.steps > 0 else 1
    thermo = [[float(word) for word in line.split()[1:]] for line in lines[header + 1: header + 1 + rows]]
    frames = [[]]
    for line in (folder / "forces.dump").read_text().splitlines():
        if line.startswith("ITEM: TIMESTEP"):
            frames.append([])
        elif len(line.split()) == 8:
            frames[-1].append([float(word) for word in line.split()])
    return np.array(thermo), [np.array(frame) for frame in frames[1:]]


def largest_deviation(found, expected):
    """Of energy and stress, energies of atoms and forces, relative to the largest of their kind; the worst at all steps."""
    worst = 0.0
    for k in range(len(expected[0])):
        pressures = np.abs(expected[0][k][1:]).max()
        scales = np.array([abs(expected[0][k][0]), *[pressures] * (len(COLUMNS) - 1)])
        worst = max(worst, (np.abs(found[0][k] - expected[0][k]) / scales).max())
        assert (found[1][k][:, 0] == expected[1][k][:, 0]).all()
        for columns in (slice(4, 7), slice(7, 8)):
            a, b = found[1][k][:, columns], expected[1][k][:, columns]
            worst = max(worst, np.abs(a - b).max() / np.abs(b).max())
    return worst
