"""Paths over landscapes: of a model, of a function in Python, of hard spheres."""

# %% Two configurations of one trajectory
import lanescape

model = lanescape.Model.named("kob-andersen")
start = lanescape.make_start(model, particles=108, density=1.2)
pair, = lanescape.make_end_points(model, start, temperature=1.0, distance=8.0, quick=True, equilibration=300)
print("distance", pair.distance, "after", pair.steps, "steps")

# %% The path of a model
path = lanescape.find_path(model, pair.start, pair.finish, species=start.species, box=start.box)
print(path.outcome, "(distance / length)^2 =", path.ratio_squared)

# %% The same over a landscape: an object of the library's or one in Python
potential = lanescape.Potential(model, start.species, start.box)


class Landscape:
    evaluations = 0

    def energy(self, positions):
        self.evaluations += 1
        return potential.energy(positions)

    def energy_and_gradient(self, positions):
        self.evaluations += 1
        return potential.energy_and_gradient(positions)


landscape = Landscape()
same = lanescape.find_path(landscape, pair.start, pair.finish)
print(landscape.evaluations, "evaluations")
assert abs(same.length - path.length) < 1e-9 * path.length

# %% Hard spheres: no overlap anywhere
spheres = lanescape.Model.named("hard-sphere")
start = lanescape.make_start(spheres, particles=108, density=0.3)  # a packing fraction
pair, = lanescape.make_end_points(spheres, start, distance=3.0, quick=True, equilibration=2000)
path = lanescape.find_path(spheres, pair.start, pair.finish, species=start.species, box=start.box, method="away")
print(path.outcome, path.ratio_squared)
