"""Paths as short as they can be, and how to see that a path is one of them."""

# %% A landscape in Python: two particles that must not come nearer than 1
import numpy
import lanescape


def nearness(positions):
    apart = positions[0] - positions[1]
    distance = numpy.linalg.norm(apart)
    return 1.0 - distance, numpy.array([-apart, apart]) / distance


start = numpy.array([[0.0, 0.1, 0.0], [3.0, -0.1, 0.0]])
finish = start * [-1.0, 1.0, 1.0] + [3.0, 0.0, 0.0]  # they change places along x

# %% A path, and shorter ones
path = lanescape.find_path(nearness, start, finish, landscape_energy=0.0, adaptive=True)
print(path.outcome, "length", path.length)
for method in lanescape.shorten_methods():
    short = lanescape.shorten_path(nearness, start, finish, path.frames, method=method, landscape_energy=0.0, adaptive=True)
    print(method, short.outcome, "length", short.length, "Kuhn-Tucker residual", short.kuhn_tucker_residual)

# %% The certificate of any path, from its frames alone
short = lanescape.shorten_path(nearness, start, finish, landscape_energy=0.0, adaptive=True)
found = lanescape.check_path(nearness, short.frames, landscape_energy=0.0)
print("leaves the allowed region by", found.largest_violation, "and bends where it must but for", found.kuhn_tucker_residual)

# %% The same of a model: hard spheres
spheres = lanescape.Model.named("hard-sphere")
short = lanescape.shorten_path(spheres, start, finish, box=[20.0] * 3, method="montecarlo", path_method="away", starts=3)
print("of three starts", short.start_lengths, "the shortest", short.length)
