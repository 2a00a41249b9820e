"""Hard spheres: overlaps and event-driven dynamics."""

# %% A start without overlaps
import numpy as np

import lanescape

model = lanescape.Model.named("hard-sphere")
start = lanescape.make_start(model, particles=108, density=0.4)  # a packing fraction
radii = start.diameters / 2

# %% Dynamics, event by event
dynamics = lanescape.EventDrivenDynamics(radii, start.positions, start.box)
dynamics.draw_velocities(seed=1)
dynamics.collide(20_000)
dynamics.advance_to(dynamics.time + 0.01)  # away from the last collision, where two spheres touch
print("Z = p V / (N k T) =", dynamics.compressibility)

# %% Overlaps of a configuration
found = lanescape.overlap(dynamics.positions, radii, start.box)
print(len(found.gaps), "overlaps, smallest gap", found.smallest_gap)
assert found.smallest_gap > -1e-12

# %% Many trial moves: the object keeps a list of close pairs
spheres = lanescape.HardSpheres(radii, start.box, skin=0.3)
rng, positions, accepted = np.random.default_rng(1), dynamics.positions, 0
for _ in range(200):
    trial = positions.copy()
    trial[rng.integers(108)] += 0.1 * rng.uniform(-1.0, 1.0, size=3)
    if not spheres.any_overlap(trial):
        positions, accepted = trial, accepted + 1
print("accepted", accepted, "of 200")
