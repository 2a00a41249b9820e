"""Pairs of particles within a cutoff."""

# %% A function with matscipy's signature
import numpy as np

import lanescape

rng = np.random.default_rng(1)
box, positions = np.array([8.0, 9.0, 10.0]), rng.uniform(0.0, 8.0, size=(500, 3))
i, j, d = lanescape.neighbour_list("ijd", None, 1.5, positions=positions, cell=box, pbc=True)
print("coordination number", len(i) / len(positions))

# %% An object with vesin's, which keeps its memory
pairs = lanescape.NeighbourList(cutoff=1.5, full_list=False)
for _ in range(3):
    first, second, separation = pairs.compute(positions, box, periodic=True, quantities="ijD")
    positions += 0.01 * rng.normal(size=positions.shape)
assert 2 * len(first) > 0.9 * len(i)

# %% The first pair of each particle
starts, second = lanescape.NeighbourList(1.5, sorted=True).compute(positions, box, True, "sj")
print("neighbours of particle 7:", second[starts[7]:starts[8]])

# %% Cutoffs of pairs of species, and bonded pairs that are left out
numbers = np.where(np.arange(500) % 5 == 0, 36, 18)
i, j = lanescape.neighbour_list("ij", None, {(18, 36): 2.0, (18, 18): 1.5}, positions=positions, cell=box, numbers=numbers)
assert not np.any((numbers[i] == 36) & (numbers[j] == 36))
pairs = lanescape.NeighbourList(cutoff=1.5)
pairs.exclusions = [(0, 1), (1, 2)]
pairs.compute(positions, box)
