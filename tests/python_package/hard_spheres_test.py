"""Hard spheres and insertion."""

import pickle
import unittest

import numpy as np
from support import fluid

import lanescape


class HardSpheresTest(unittest.TestCase):
    def test_overlaps_are_those_of_all_pairs(self):
        model = lanescape.Model.named("hard-sphere")
        start = lanescape.make_start(model, 108, 0.4)
        positions = start.positions + 0.2 * np.random.default_rng(2).normal(size=start.positions.shape)
        separation = positions[:, None] - positions[None]
        separation -= start.box * np.round(separation / start.box)
        gap = np.sqrt((separation**2).sum(axis=2)) - 1.0
        first, second = np.nonzero(np.triu(gap < 0.0, 1))
        found = lanescape.overlap(positions, start.diameters / 2, start.box)
        np.testing.assert_array_equal(found.pairs, np.column_stack((first, second)))
        self.assertEqual(found.pairs.dtype, np.int64)
        np.testing.assert_allclose(found.gaps, gap[first, second], atol=1e-12)
        self.assertAlmostEqual(found.smallest_gap, gap[np.triu_indices(108, 1)].min(), delta=1e-12)
        spheres = lanescape.HardSpheres(start.diameters / 2, start.box, skin=0.3)
        self.assertTrue(spheres.any_overlap(positions))
        self.assertFalse(spheres.any_overlap(start.positions))
        self.assertTrue(pickle.loads(pickle.dumps(spheres)).any_overlap(positions))

    def test_unfit_input_is_refused(self):
        for radii, box, error in (([-0.5], [3.0] * 3, ValueError), ([0.5], [1.0] * 3, ValueError), (None, [3.0] * 3, TypeError),
                                  ([[0.5]], [3.0] * 3, ValueError), ([np.nan], [3.0] * 3, ValueError), (["a"], [3.0] * 3, TypeError)):
            with self.assertRaises(error):
                lanescape.HardSpheres(radii, box)
        with self.assertRaises(lanescape.InputError):
            lanescape.overlap([[np.nan, 0.0, 0.0]], [0.5], [3.0] * 3)

    def test_spheres_collide_at_constant_energy_and_go_on_from_a_pickle(self):
        start = lanescape.make_start(lanescape.Model.named("hard-sphere"), 108, 0.4)
        dynamics = lanescape.EventDrivenDynamics(start.diameters / 2, start.positions, start.box)
        with self.assertRaises(lanescape.InputError):
            dynamics.collide(1)
        dynamics.draw_velocities(seed=5)
        energy = dynamics.kinetic_energy
        dynamics.collide(2000)
        self.assertEqual(dynamics.collisions, 2000)
        self.assertAlmostEqual(dynamics.kinetic_energy, energy, delta=1e-9 * energy)
        self.assertGreaterEqual(lanescape.overlap(dynamics.positions, start.diameters / 2, start.box).smallest_gap, -1e-12)
        again = pickle.loads(pickle.dumps(dynamics))
        for one in (dynamics, again):
            one.collide(100)
        np.testing.assert_array_equal(again.positions, dynamics.positions)
        dynamics.advance_to(dynamics.time + 0.1)
        with self.assertRaises(lanescape.InputError):
            dynamics.advance_to(0.0)

    def test_a_path_of_hard_spheres_reaches_its_end(self):
        model = lanescape.Model.named("hard-sphere")
        start = lanescape.make_start(model, 108, 0.3)
        pair, = lanescape.make_end_points(model, start, quick=True, distance=3.0, equilibration=2000)
        path = lanescape.find_path(model, pair.start, pair.finish, species=start.species, box=start.box, method="away")
        self.assertTrue(path.reached, path.reason)
        self.assertLess(path.largest_violation, 1e-6)


class InserterTest(unittest.TestCase):
    def test_the_energy_of_one_more_particle_is_the_rise_of_the_whole(self):
        model, species, positions, box = fluid("lennard-jones", density=0.7)
        inserter = lanescape.Inserter(model, None, positions, box)
        point = np.array([0.3, 0.4, 0.5]) * box
        rise = lanescape.evaluate(model, np.vstack((positions, point)), box).energy - lanescape.evaluate(model, positions, box).energy
        energy, force = inserter.energy_and_force(point)
        self.assertAlmostEqual(energy, rise, delta=1e-9 * max(1.0, abs(rise)))
        np.testing.assert_array_equal(inserter.energies([point, point]), [energy, energy])
        self.assertEqual(inserter.energy(point), energy)
        self.assertEqual(force.shape, (3,))

    def test_particles_are_inserted_at_the_energy(self):
        model, species, positions, box = fluid("lennard-jones", density=0.5)
        inserter = lanescape.Inserter(model, None, positions, box)
        found = inserter.insert(-4.0, 3, tolerance=0.01, seed=7)
        self.assertEqual(inserter.particles, 111)
        for one in found:
            self.assertTrue(one.found)
            self.assertAlmostEqual(one.energy, -4.0, delta=0.05)
        self.assertTrue(inserter.remove(found[-1].position))
        self.assertAlmostEqual(inserter.energy(found[-1].position), found[-1].energy, delta=1e-9)
        same = lanescape.insert(model, None, positions, box, -4.0, 3, tolerance=0.01, seed=7)
        np.testing.assert_array_equal(same[2].position, found[2].position)

    def test_unfit_input_is_refused(self):
        model, species, positions, box = fluid("lennard-jones", density=0.5)
        inserter = lanescape.Inserter(model, None, positions, box)
        for bad in ({"method": "none"}, {"tolerance": -1.0}, {"measure": "none"}, {"region": [[0.0, 0.0, 0.0]]}, {"threads": 0}):
            with self.assertRaises(lanescape.InputError, msg=bad):
                inserter.find(-4.0, **bad)
        for bad, error in (([0.0, 0.0], ValueError), (None, TypeError), ([np.nan] * 3, ValueError), ("abc", TypeError)):
            with self.assertRaises(error, msg=bad):
                inserter.energy(bad)


if __name__ == "__main__":
    unittest.main()
