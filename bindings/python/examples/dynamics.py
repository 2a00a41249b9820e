"""Molecular dynamics on any landscape, saved and continued."""

# %% A fluid
import pickle

import numpy as np

import lanescape

model = lanescape.Model.named("lennard-jones")
start = lanescape.make_start(model, particles=108, density=0.8)
potential = lanescape.Potential(model, start.species, start.box)
dynamics = lanescape.MolecularDynamics(potential, start.positions, time_step=0.002)
dynamics.draw_velocities(temperature=1.5, seed=1)

# %% Energy is conserved
before = dynamics.kinetic_energy + dynamics.potential_energy
dynamics.run(1000)
print("T =", dynamics.temperature, "drift", dynamics.kinetic_energy + dynamics.potential_energy - before)

# %% A pickle goes on with the same bits
saved = pickle.dumps(dynamics)
dynamics.run(100)
again = pickle.loads(saved)
again.run(100)
assert np.array_equal(again.positions, dynamics.positions)

# %% A landscape of one's own: particles on springs
springs = lanescape.MolecularDynamics(lambda r: (0.5 * float((r**2).sum()), r), np.ones((2, 3)), time_step=0.01)
springs.run(314)
print("half a period later:", springs.positions[0])
