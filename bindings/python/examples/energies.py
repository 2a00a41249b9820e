"""Energies, forces and stress of a mixture; other boxes; own parameters."""

# %% A named model, a start and its energy
import numpy as np

import lanescape

model = lanescape.Model.named("kob-andersen")
start = lanescape.make_start(model, particles=108, density=1.2)
potential = lanescape.Potential(model, start.species, start.box)
positions = start.positions + 0.05 * np.random.default_rng(1).normal(size=(108, 3))
print("V =", potential.energy(positions))

# %% Results in memory of one's own: nothing is allocated in a loop
gradient = np.empty_like(positions)
for _ in range(3):
    energy, _ = potential.energy_and_gradient(positions, out=gradient)
    positions -= 1e-4 * gradient
print("after three steps down:", energy)

# %% All that an evaluation has
found = potential.evaluate(positions, forces=True, stress=True, energies=True)
print("pressure without the kinetic part:", -found.stress[:3].mean())
assert np.isclose(found.energies.sum(), found.energy)

# %% Another box
potential.box = start.box * 1.01
print("V in a box 1 % longer:", potential.energy(positions * 1.01))

# %% A mixture by its own parameters, in any units
own = lanescape.Model.mixture(["Ar", "Kr"], epsilon=[[0.0104, 0.0122], [0.0122, 0.0143]], sigma=[[3.40, 3.53], [3.53, 3.65]], cutoff=2.5,
                              masses=[39.95, 83.80])
pair = lanescape.evaluate(own, [[0.0, 0.0, 0.0], [3.9, 0.0, 0.0]], [40.0, 40.0, 40.0], ["Ar", "Kr"])
print("Ar-Kr at 3.9 A:", pair.energy, "eV")
