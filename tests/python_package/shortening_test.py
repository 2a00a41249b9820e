"""Paths made as short as they can be, and the certificate of any path."""

import pickle
import unittest

import numpy as np

import lanescape

ANGLE = np.radians(170.0)
SHORTEST = 6.1620 / np.sqrt(2.0)  # of two spheres of diameter 1, 3 apart at both ends
BOX = [10.0] * 3
SPHERES = lanescape.Model.named("hard-sphere")


def turned(distance, angle):
    """Two particles with a resting centre."""
    half = 0.5 * distance * np.array([np.cos(angle), np.sin(angle), 0.0])
    return 5.0 + np.array([half, -half])


START, FINISH = turned(3.0, 0.0), turned(3.0, ANGLE)


def nearness(positions):
    """E_L = 0 is the surface of hard spheres of diameter 1."""
    d = positions[0] - positions[1]
    r = np.linalg.norm(d)
    return 1.0 - r, np.array([-d, d]) / r


def around(radius, segments=200):
    """The path of two spheres around each other: straight, along a circle, straight."""
    tangent = np.arccos(radius / 3.0)
    return np.array([START, *(turned(radius, a) for a in np.linspace(tangent, ANGLE - tangent, segments + 1)), FINISH])


class ShortenPathTest(unittest.TestCase):
    def shorten(self, path=None, **options):
        return lanescape.shorten_path(nearness, START, FINISH, path, **{"landscape_energy": 0.0, "adaptive": True, **options})

    def test_every_method_shortens_a_path_on_a_landscape_in_python(self):
        self.assertIn("montecarlo", lanescape.shorten_methods())
        for method in lanescape.shorten_methods():
            short = self.shorten(method=method, starts=2)
            self.assertTrue(short.reached, short.reason)
            self.assertLessEqual(short.length, short.length_before)
            self.assertAlmostEqual(short.ratio_squared, (short.distance / short.length) ** 2, delta=1e-12)
            self.assertEqual(short.frames.shape[1:], (2, 3))
            np.testing.assert_array_equal(short.frames[[0, -1]], [START, FINISH])
            self.assertEqual(short.length, min(short.start_lengths))
            self.assertEqual(short.multipliers is None, short.kuhn_tucker_residual is None)
            self.assertEqual(pickle.loads(pickle.dumps(short)).length, short.length)
            if short.kuhn_tucker_residual is not None:
                self.assertAlmostEqual(short.length, SHORTEST, delta=1e-4 * SHORTEST)
                self.assertLess(short.kuhn_tucker_residual, 1e-2)
                self.assertEqual(short.multipliers.shape, short.frames.shape[:1])

    def test_monte_carlo_brings_down_a_path_that_leaves_its_landscape_wide_of_the_surface(self):
        short = self.shorten(around(1.5), method="montecarlo", seed=3)
        self.assertTrue(short.reached, short.reason)
        self.assertLess(short.length, short.length_before)
        np.testing.assert_array_equal(self.shorten(around(1.5)[::-1], method="montecarlo", seed=3).frames[0], START)

    def test_the_landscapes_of_one_model_have_one_short_path(self):
        model = lanescape.Model.named("lennard-jones")
        start, finish = turned(1.3, 0.0), turned(1.25, 2.0)
        potential = lanescape.Potential(model, None, BOX, particles=2)
        options = {"method": "montecarlo", "path_method": "escape"}
        expected = lanescape.shorten_path(model, start, finish, box=BOX, **options)
        self.assertTrue(expected.reached, expected.reason)
        self.assertLess(expected.largest_violation, 1e-3)
        for landscape in (potential, potential.energy_and_gradient):
            self.assertEqual(lanescape.shorten_path(landscape, start, finish, **options).length, expected.length)
        both = lanescape.shorten_path(model, start, finish, box=BOX, starts=3, threads=2, **options)
        self.assertEqual(len(both.start_lengths), 3)
        self.assertEqual(both.start_lengths[0], expected.length)

    def test_hard_spheres_do_not_overlap(self):
        short = lanescape.shorten_path(SPHERES, START, FINISH, box=BOX, method="montecarlo", path_method="away")
        self.assertTrue(short.reached, short.reason)
        self.assertGreater(short.length, SHORTEST - 1e-4)
        self.assertLess(short.largest_violation, 1e-9)

    def test_progress_is_told_and_ends_the_work(self):
        told = []

        def until_two(made):
            told.append(made)
            return made < 2

        self.assertEqual(self.shorten(progress=until_two).outcome, "interrupted")
        self.assertEqual((told[0], told[-1]), (0.0, 2.0))
        at_once = self.shorten(progress=lambda made: False, adaptive=False, step=1e-5)
        self.assertEqual((at_once.outcome, at_once.frames.shape, at_once.length), ("interrupted", (0, 0, 3), 0.0))
        for failure in (KeyboardInterrupt(), ZeroDivisionError()):
            def fail(made, failure=failure):
                if made >= 1:
                    raise failure

            with self.assertRaises(type(failure)) as raised:
                self.shorten(progress=fail)
            self.assertIs(raised.exception, failure)
            with self.assertRaises(type(failure)):
                lanescape.shorten_path(SPHERES, START, FINISH, box=BOX, method="montecarlo", starts=4, threads=2, progress=fail)

    def test_exceptions_of_a_landscape_pass_through(self):
        with self.assertRaises(ZeroDivisionError):
            lanescape.shorten_path(lambda r: 1 / 0, START, FINISH)
        with self.assertRaises(ZeroDivisionError):
            lanescape.check_path(lambda r: 1 / 0, around(1.0))

    def test_unfit_paths_and_options_are_refused(self):
        path = around(1.5)
        outside = path.copy()
        outside[100] = turned(0.5, 1.5)
        not_finite = path.copy()
        not_finite[7, 1, 2] = np.nan
        for bad, words in ((path[:2], "at least 3"), (path[:0], "at least 3"), (path[:-1], "are not the end points"), (path[:, :1], "6 are needed"),
                           (path[0], r"\(F, N, 3\) is needed"), (not_finite, "frame 8: z coordinate nan"), (outside, "frame 101: its energy 0.5")):
            with self.assertRaisesRegex(lanescape.InputError, words):
                self.shorten(bad)
        for bad in ({"method": "walk"}, {"path_method": "away"}, {"starts": 0}, {"landscape_energy": -5.0}, {"max_steps": 0}):
            with self.assertRaises(lanescape.InputError, msg=bad):
                self.shorten(**bad)
        for bad in ({"colour": 1}, {"starts": 1.5}, {"reverse": True}, {"box": BOX}, {"threads": 2}, {"progress": 3}):
            with self.assertRaises(TypeError, msg=bad):
                self.shorten(**bad)


class CheckPathTest(unittest.TestCase):
    def test_the_taut_path_has_a_certificate(self):
        path = around(1.0)
        for found in (lanescape.check_path(SPHERES, path, box=BOX), lanescape.check_path(nearness, path, landscape_energy=0.0)):
            self.assertAlmostEqual(found.length, SHORTEST, delta=1e-4)
            self.assertLess(found.kuhn_tucker_residual, 1e-2)
            self.assertLess(found.largest_violation, 1e-4)
            self.assertEqual(found.multipliers.shape, (len(path),))
            self.assertEqual(found.excess.shape, (len(path),))
            self.assertEqual(found.segment_violation.shape, (len(path) - 1,))
            self.assertGreater(found.multipliers[100], 0.0)
            self.assertEqual(pickle.loads(pickle.dumps(found)).length, found.length)
        self.assertAlmostEqual(lanescape.check_path(SPHERES, around(1.1), box=BOX).kuhn_tucker_residual, 1.0)

    def test_a_straight_line_tells_how_far_it_leaves_the_allowed_region(self):
        start, finish = np.array([[0.0, 0.0, 0.0], [2.0, 0.5, 0.0]]), np.array([[2.0, 0.0, 0.0], [0.0, 0.5, 0.0]])
        line = np.linspace(start, finish, 11)
        found = lanescape.check_path(nearness, line)
        self.assertAlmostEqual(found.largest_violation, np.hypot(2.0, 0.5) - 0.5)
        self.assertEqual(found.kuhn_tucker_residual, 0.0)
        self.assertAlmostEqual(found.length, found.distance)
        self.assertEqual(found.landscape_energy, nearness(start)[0])
        self.assertAlmostEqual(lanescape.check_path(SPHERES, line, box=BOX).largest_violation, 0.5)
        self.assertGreater(lanescape.check_path(nearness, around(1.0), masses=[3.0, 1.0]).length, 0.0)

    def test_unfit_paths_are_refused(self):
        path = around(1.0, 10)
        twice = path.copy()
        twice[1] = twice[0]
        for bad, words in ((path[:2], "at least 3"), (path[0], r"\(F, N, 3\)"), (twice, "coincide"), (path * np.nan, "finite"), (path[:, :0], "no particles")):
            with self.assertRaisesRegex(lanescape.InputError, words):
                lanescape.check_path(nearness, bad)
        with self.assertRaisesRegex(lanescape.InputError, "no landscape energy"):
            lanescape.check_path(SPHERES, path, box=BOX, landscape_energy=0.0)
        for bad in ({"box": BOX}, {"threads": 2}, {"landscape_energy": "low"}):
            with self.assertRaises(TypeError, msg=bad):
                lanescape.check_path(nearness, path, **bad)


if __name__ == "__main__":
    unittest.main()
