"""Metropolis Monte Carlo: moves of one particle at a time."""

# %% What a move changes costs the particle's neighbours, whatever N
import numpy as np

import lanescape

model = lanescape.Model.named("lennard-jones")
start = lanescape.make_start(model, particles=500, density=0.8)
moves = lanescape.ParticleMoves(model, start.species, start.positions, start.box)
rng, temperature, positions, accepted = np.random.default_rng(1), 1.0, start.positions.copy(), 0
for _ in range(5000):
    particle = int(rng.integers(500))
    to = positions[particle] + rng.uniform(-0.15, 0.15, size=3)
    if rng.random() < np.exp(-moves.energy_change(particle, to) / temperature):
        moves.accept()
        positions[particle] = to
        accepted += 1
print("accepted:", accepted / 5000)

# %% The energy of the whole
print("V =", lanescape.evaluate(model, moves.positions, start.box, start.species, forces=False).energy)
