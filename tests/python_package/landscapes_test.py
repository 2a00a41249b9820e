"""Paths and molecular dynamics on landscapes of any kind."""

import pickle
import threading
import unittest

import numpy as np
from support import end_points, potential

import lanescape


class Counting:
    """A landscape in Python over the library's, which fails at one evaluation."""

    def __init__(self, potential_, failure=None, at=10):
        self.potential, self.failure, self.at, self.calls, self.seen = potential_, failure, at, 0, []

    def energy(self, positions):
        return self.potential.energy(positions)

    def energy_and_gradient(self, positions):
        self.calls += 1
        self.seen.append((positions, positions.copy()))
        if self.failure is not None and self.calls == self.at:
            raise self.failure
        return self.potential.energy_and_gradient(positions)


class PathTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.model, cls.start, cls.pair = end_points()
        cls.potential = lanescape.Potential(cls.model, cls.start.species, cls.start.box)

    def path(self, landscape, **options):
        return lanescape.find_path(landscape, self.pair.start, self.pair.finish, **options)

    def path_of_model(self, **options):
        return self.path(self.model, species=self.start.species, box=self.start.box, **options)

    def test_end_points_are_their_distance_apart(self):
        self.assertGreaterEqual(self.pair.distance, 4.0)
        self.assertAlmostEqual(np.linalg.norm(self.pair.finish - self.pair.start), self.pair.distance, delta=1e-6)

    def test_a_path_joins_its_ends_below_the_landscape_energy(self):
        for method in ("contour", "escape"):
            path = self.path_of_model(method=method, frames=20)
            self.assertTrue(path.reached, path.reason)
            self.assertEqual(path.frames.shape[1:], (108, 3))
            np.testing.assert_allclose(path.frames[0], self.pair.start, atol=1e-9)
            self.assertGreaterEqual(path.length, path.distance)
            for frame in path.frames:
                self.assertLessEqual(self.potential.energy(frame), path.landscape_energy + path.largest_violation + 1e-9)
            self.assertEqual(pickle.loads(pickle.dumps(path)).length, path.length)

    def test_every_kind_of_landscape_gives_the_path_of_the_model(self):
        expected = self.path_of_model()
        for landscape in (self.potential, Counting(self.potential), self.potential.energy_and_gradient,
                          lambda r: tuple(self.potential.energy_and_gradient(r))):
            path = self.path(landscape)
            self.assertEqual(path.direct_steps, expected.direct_steps)
            self.assertAlmostEqual(path.length, expected.length, delta=1e-9 * expected.length)

    def test_adaptive_steps_find_the_path_with_fewer_evaluations(self):
        faithful = self.path_of_model()
        for path in (self.path_of_model(adaptive=True), self.path(self.potential.energy_and_gradient, adaptive=True)):
            self.assertTrue(path.reached, path.reason)
            self.assertAlmostEqual(path.length, faithful.length, delta=0.02 * faithful.length)
            self.assertLess(10 * path.evaluations, faithful.evaluations)
        with self.assertRaisesRegex(lanescape.InputError, "method escape has no adaptive steps: methods that have them are "):
            self.path_of_model(method="escape", adaptive=True)

    def test_exceptions_of_a_landscape_pass_through(self):
        class Own(Exception):
            pass

        for failure in (Own("mine"), KeyboardInterrupt(), SystemExit(3), MemoryError()):
            with self.assertRaises(type(failure)) as raised:
                self.path(Counting(self.potential, failure))
            self.assertIs(raised.exception, failure)

    def test_positions_that_a_landscape_keeps_do_not_change(self):
        landscape = Counting(self.potential)
        self.path(landscape)
        self.assertGreater(len(landscape.seen), 10)
        for kept, copy in landscape.seen:
            np.testing.assert_array_equal(kept, copy)

    def test_what_a_landscape_returns_is_checked(self):
        good = self.potential.energy_and_gradient
        for bad, error in ((lambda r: good(r)[0], TypeError), (lambda r: None, TypeError), (lambda r: (None, good(r)[1]), TypeError),
                           (lambda r: (good(r)[0], good(r)[1][1:]), ValueError), (lambda r: (good(r)[0], good(r)[1].ravel()), ValueError),
                           (lambda r: ("low", good(r)[1]), TypeError), (lambda r: (good(r)[0], None), TypeError), (lambda: 1.0, TypeError)):
            with self.assertRaises(error):
                self.path(bad)
        for bad in (None, 3.0, "landscape", object()):
            with self.assertRaises(TypeError):
                self.path(bad)
        for nothing in (lambda r: (np.nan, good(r)[1]), lambda r: (good(r)[0], good(r)[1] * np.nan)):
            try:
                self.assertFalse(self.path(nothing, max_steps=2000).reached)
            except lanescape.Error:
                pass

    def test_progress_is_told_and_ends_the_search(self):
        told = []
        self.assertTrue(self.path_of_model(progress=told.append).reached)
        self.assertTrue(told and all(0.0 <= part <= 1.0 + 1e-9 for part in told))
        self.assertEqual(self.path_of_model(progress=lambda part: False).outcome, "interrupted")
        with self.assertRaises(ZeroDivisionError):
            self.path_of_model(progress=lambda part: 1 / 0)
        with self.assertRaises(TypeError):
            self.path_of_model(progress=3)
        start = lanescape.make_start(lanescape.Model.named("kob-andersen"), 108, 1.2)
        with self.assertRaisesRegex(lanescape.InterruptedRunError, "^interrupted before all end points were made$"):
            lanescape.make_end_points(lanescape.Model.named("kob-andersen"), start, quick=True, progress=lambda part: False)

    def test_unfit_ends_and_options_are_refused(self):
        for bad in ({"method": "avoidance"}, {"method": "straight"}, {"step": -1.0}, {"landscape_energy": -1e9}, {"frames": 10**9},
                    {"threads": 0}, {"max_steps": 0}):
            with self.assertRaises(lanescape.InputError, msg=bad):
                self.path_of_model(**bad)
        for bad in ({"colour": 1}, {"step": object()}, {"masses": np.ones(108)}, {"step": "long"}, {"reverse": None}):
            with self.assertRaises(TypeError, msg=bad):
                self.path_of_model(**bad)
        with self.assertRaises(lanescape.InputError):
            lanescape.find_path(self.potential, self.pair.start, self.pair.start)
        with self.assertRaises(lanescape.InputError):
            lanescape.find_path(self.potential, self.pair.start, self.pair.finish[1:])
        with self.assertRaises(TypeError):
            lanescape.find_path(self.model, self.pair.start, self.pair.finish, species=self.start.species)
        for of_a_model in ({"box": self.start.box}, {"threads": 2}, {"precision": "mixed"}, {"instruction_set": "generic"}):
            with self.assertRaisesRegex(TypeError, "belong to a model"):
                self.path(self.potential, **of_a_model)


class MolecularDynamicsTest(unittest.TestCase):
    def dynamics(self, landscape=None):
        own, positions = potential()
        dynamics = lanescape.MolecularDynamics(landscape or own, positions, 0.001)
        dynamics.draw_velocities(0.5, seed=3)
        return dynamics

    def test_energy_is_conserved(self):
        dynamics = self.dynamics()
        before = dynamics.potential_energy + dynamics.kinetic_energy
        dynamics.run(200)
        self.assertEqual(dynamics.steps, 200)
        self.assertAlmostEqual(dynamics.potential_energy + dynamics.kinetic_energy, before, delta=0.1)
        self.assertAlmostEqual(dynamics.temperature, 2.0 * dynamics.kinetic_energy / (3 * 108), delta=1e-12)

    def test_a_pickle_goes_on_with_the_same_bits(self):
        dynamics = self.dynamics()
        dynamics.run(50)
        again = pickle.loads(pickle.dumps(dynamics))
        self.assertEqual(again.steps, 50)
        dynamics.run(50)
        again.run(50)
        np.testing.assert_array_equal(again.positions, dynamics.positions)
        np.testing.assert_array_equal(again.velocities, dynamics.velocities)

    def test_a_landscape_in_python_gives_the_same_trajectory(self):
        compiled, interpreted = self.dynamics(), self.dynamics(Counting(potential()[0]))
        compiled.run(20)
        interpreted.run(20)
        np.testing.assert_allclose(interpreted.positions, compiled.positions, atol=1e-12)

    def test_a_landscape_that_uses_its_dynamics_gets_an_error(self):
        inside = []

        def landscape(positions):
            if inside:
                inside[0].run(1)
            return potential()[0].energy_and_gradient(positions)

        dynamics = self.dynamics(landscape)
        inside.append(dynamics)
        with self.assertRaisesRegex(RuntimeError, "a callback cannot use it"):
            dynamics.run(1)
        inside.clear()
        dynamics.run(1)

    def test_unfit_input_is_refused(self):
        own, positions = potential()
        for arguments in ((own, positions[1:], 0.001), (own, positions, 0.0), (own, positions, np.nan), (own, positions * np.nan, 0.001)):
            with self.assertRaises(lanescape.InputError):
                lanescape.MolecularDynamics(*arguments)
        with self.assertRaises(lanescape.InputError):
            lanescape.MolecularDynamics(own, positions, 0.001, masses=np.zeros(108))
        for landscape in (None, 1, "V"):
            with self.assertRaises(TypeError):
                lanescape.MolecularDynamics(landscape, positions, 0.001)
        dynamics = self.dynamics()
        for velocities in (positions[1:], positions * np.inf):
            with self.assertRaises(lanescape.InputError):
                dynamics.velocities = velocities
        with self.assertRaises(TypeError):
            dynamics.run(-1)

    def test_dynamics_may_run_beside_others_in_threads(self):
        alone = self.dynamics()
        alone.run(100)
        shared = self.dynamics()
        threads = [threading.Thread(target=lambda: [shared.run(10) for _ in range(5)]) for _ in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        np.testing.assert_array_equal(shared.positions, alone.positions)


if __name__ == "__main__":
    unittest.main()
