"""ASE: the library as a calculator, and a calculator of ASE's as a landscape."""

# %% Forces and stress of a crystal of argon, in eV and Angstrom
import numpy as np
from ase.build import bulk
from ase.calculators.emt import EMT
from ase.optimize import BFGS

import lanescape
from lanescape.ase import AtomsLandscape, LennardJones

atoms = bulk("Ar", "fcc", a=5.3, cubic=True).repeat(3)
atoms.calc = LennardJones(epsilon=0.0104, sigma=3.40, truncation="shifted-force")
print("E =", atoms.get_potential_energy(), "eV, stress", atoms.get_stress()[:3])

# %% ASE's tools run over it
atoms.rattle(0.05, seed=1)
BFGS(atoms, logfile=None).run(fmax=1e-3, steps=100)
assert np.abs(atoms.get_forces()).max() < 1e-3

# %% A path over the landscape of a calculator of ASE's
copper = bulk("Cu", cubic=True).repeat(2)
copper.calc = EMT()
rng = np.random.default_rng(1)
ends = [copper.positions + 0.1 * rng.normal(size=copper.positions.shape) for _ in range(2)]
path = lanescape.find_path(AtomsLandscape(copper), *ends, step=0.05, max_steps=300)
print(path.outcome, "after", path.direct_steps + path.detour_steps, "steps")
