"""Sites in states, with the model's order parameter and with one in Python."""

import gc
import pickle
import unittest
import weakref

import numpy as np
from support import fluid

import lanescape


class Neighbours:
    """The number of neighbours, each weighted with (1 - r^2/4)^3."""

    def reach(self, first_species, second_species):
        return 2.0

    def inside(self, pairs):
        return np.maximum(0.0, 1.0 - 0.25 * np.sum(pairs.separation**2, axis=1))

    def evaluate(self, pairs, species, values):
        values[:] = np.bincount(pairs.first, self.inside(pairs)**3, minlength=len(values))

    def add_gradient(self, pairs, species, multipliers, gradient, virial):
        slope_over_r = -1.5 * self.inside(pairs)**2 * (multipliers[pairs.first] + multipliers[pairs.second])
        np.add.at(gradient, pairs.first, slope_over_r[:, None] * pairs.separation)
        for k, (a, b) in enumerate(((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))):
            virial[k] -= 0.5 * np.sum(slope_over_r * pairs.separation[:, a] * pairs.separation[:, b])


class Logistic:
    def states(self):
        return 2

    def evaluate(self, species, value, states):
        x = value - 2.0
        p, q = 1.0 / (1.0 + np.exp(-x)), 1.0 / (1.0 + np.exp(x))
        states[0] = p, p * q, -np.log1p(np.exp(-x))
        states[1] = q, -p * q, -np.log1p(np.exp(x))


class OwnOrderParameterTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.model, cls.species, cls.positions, cls.box = fluid("ucg", 64, 0.6)

    def system(self, order_parameter=None, response=None, **options):
        return lanescape.StateSystem(self.model, self.species, self.box, order_parameter=order_parameter or Neighbours(),
                                     response=response or Logistic(), **options)

    def test_values_are_those_of_all_pairs(self):
        system = self.system()
        system.energy(self.positions)
        separation = self.positions[:, None] - self.positions[None]
        separation -= self.box * np.round(separation / self.box)
        inside = np.maximum(0.0, 1.0 - 0.25 * np.sum(separation**2, axis=-1))
        np.fill_diagonal(inside, 0.0)
        np.testing.assert_allclose(system.order_parameters(), np.sum(inside**3, axis=1), atol=1e-12)
        p = 1.0 / (1.0 + np.exp(2.0 - system.order_parameters()))
        np.testing.assert_allclose(system.probabilities(), np.column_stack((p, 1.0 - p)), atol=1e-12)

    def test_forces_and_stress_are_slopes_of_the_energy(self):
        system, h = self.system(), 1e-6
        found = system.evaluate(self.positions, stress=True)
        for particle, axis in ((0, 0), (13, 1), (63, 2)):
            step = np.zeros_like(self.positions)
            step[particle, axis] = h
            slope = (system.energy(self.positions + step) - system.energy(self.positions - step)) / (2.0 * h)
            self.assertAlmostEqual(found.forces[particle, axis], -slope, delta=1e-6 * (1.0 + abs(slope)))
        energies = []
        for scale in (1.0 + h, 1.0 - h):
            system.box = self.box * scale
            energies.append(system.energy(self.positions * scale))
        slope = (energies[0] - energies[1]) / (2.0 * h)
        self.assertAlmostEqual(np.sum(found.stress[:3]) * np.prod(self.box), slope, delta=1e-5 * (1.0 + abs(slope)))

    def test_a_pickle_holds_the_user_s_objects(self):
        again = pickle.loads(pickle.dumps(self.system()))
        self.assertEqual(again.energy(self.positions), self.system().energy(self.positions))
        plain = lanescape.StateSystem(self.model, self.species, self.box)
        self.assertNotEqual(again.energy(self.positions), plain.energy(self.positions))

    def test_dynamics_runs_on_it(self):
        dynamics = lanescape.MolecularDynamics(self.system(), self.positions, 0.0005)
        before = dynamics.potential_energy
        dynamics.run(20)
        self.assertAlmostEqual(dynamics.potential_energy + dynamics.kinetic_energy, before, delta=1e-3 * abs(before))

    def test_exceptions_pass_through(self):
        class Own(Exception):
            pass

        failure = Own("mine")

        def fail(*_):
            raise failure

        for owner, name in ((Neighbours, "evaluate"), (Neighbours, "add_gradient"), (Logistic, "evaluate")):
            broken = type("Broken", (owner,), {name: fail})()
            system = self.system(**{"order_parameter" if owner is Neighbours else "response": broken})
            with self.assertRaises(Own) as raised:
                system.energy_and_gradient(self.positions)
            self.assertIs(raised.exception, failure)
        for owner, name in ((Neighbours, "reach"), (Logistic, "states")):
            broken = type("Broken", (owner,), {name: fail})()
            with self.assertRaises(Own):
                self.system(**{"order_parameter" if owner is Neighbours else "response": broken})

    def test_what_is_handed_over_to_read_cannot_be_written(self):
        seen = {}

        class Looking(Neighbours):
            def add_gradient(self, pairs, species, multipliers, gradient, virial):
                seen.update({name: array.flags.writeable for name, array in zip(pairs._fields, pairs)},
                            species=species.flags.writeable, multipliers=multipliers.flags.writeable, shape=gradient.shape)
                super().add_gradient(pairs, species, multipliers, gradient, virial)

        self.system(Looking()).energy_and_gradient(self.positions)
        self.assertEqual(seen, {"first": False, "second": False, "separation": False, "species": False, "multipliers": False, "shape": (64, 3)})

    def test_a_cycle_with_the_user_s_object_is_collected(self):
        order_parameter = Neighbours()
        order_parameter.system = self.system(order_parameter)
        order_parameter.system.energy(self.positions)
        gone = weakref.ref(order_parameter)
        del order_parameter
        gc.collect()
        self.assertIsNone(gone())

    def test_an_order_parameter_that_uses_its_system_gets_an_error(self):
        class Reentrant(Neighbours):
            def evaluate(self, pairs, species, values):
                self.system.order_parameters()

        order_parameter = Reentrant()
        order_parameter.system = self.system(order_parameter)
        with self.assertRaisesRegex(RuntimeError, "a callback cannot use it"):
            order_parameter.system.energy(self.positions)

    def test_unfit_objects_are_refused(self):
        for options in ({"order_parameter": object()}, {"response": 3}, {"response": type("R", (), {"states": 2, "evaluate": print})()},
                        {"order_parameter": type("O", (Neighbours,), {"reach": lambda *_: "far"})()}):
            with self.assertRaises((TypeError, ValueError), msg=options):
                self.system(**options)
        with self.assertRaisesRegex(lanescape.InputError, "go together"):
            lanescape.StateSystem(self.model, self.species, self.box, response=Logistic())
        with self.assertRaisesRegex(lanescape.InputError, "2 threads are not allowed"):
            self.system(threads=2)
        with self.assertRaisesRegex(lanescape.InputError, "3 states"):
            self.system(response=type("R", (Logistic,), {"states": lambda self: 3})())


if __name__ == "__main__":
    unittest.main()
