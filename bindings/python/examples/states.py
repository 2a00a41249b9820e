"""Sites whose states follow their surroundings (ultra-coarse-graining)."""

# %% Energy and probabilities
import numpy as np

import lanescape

model = lanescape.Model.named("ucg")
start = lanescape.make_start(model, particles=108, density=0.5)
system = lanescape.StateSystem(model, start.species, start.box)
found = system.evaluate(start.positions, stress=True)
print("U =", found.energy)
print("probability of the first state:", system.probabilities()[:, 0].mean())

# %% It is a landscape
dynamics = lanescape.MolecularDynamics(system, start.positions, time_step=0.002)
dynamics.draw_velocities(temperature=1.0)
dynamics.run(200)
print("T =", dynamics.temperature)


# %% An order parameter and a response of one's own
class Neighbours:
    """The number of neighbours, each weighted with (1 - r^2/4)^3."""

    def reach(self, first_species, second_species):
        return 2.0

    def evaluate(self, pairs, species, values):
        inside = np.maximum(0.0, 1.0 - 0.25 * np.sum(pairs.separation**2, axis=1))
        values[:] = np.bincount(pairs.first, inside**3, minlength=len(values))

    def add_gradient(self, pairs, species, multipliers, gradient, virial):
        inside = np.maximum(0.0, 1.0 - 0.25 * np.sum(pairs.separation**2, axis=1))
        weights = -1.5 * inside**2 * (multipliers[pairs.first] + multipliers[pairs.second])
        np.add.at(gradient, pairs.first, weights[:, None] * pairs.separation)
        for k, (a, b) in enumerate(((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))):
            virial[k] -= 0.5 * np.sum(weights * pairs.separation[:, a] * pairs.separation[:, b])


class Logistic:
    def states(self):
        return 2

    def evaluate(self, species, value, states):
        p, q = 1.0 / (1.0 + np.exp(2.0 - value)), 1.0 / (1.0 + np.exp(value - 2.0))
        states[0] = p, p * q, np.log(p)
        states[1] = q, -p * q, np.log(q)


own = lanescape.StateSystem(model, start.species, start.box, order_parameter=Neighbours(), response=Logistic())
print("U =", own.energy(start.positions))
