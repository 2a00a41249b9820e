"""Monte Carlo moves of one particle."""

import pickle
import unittest

import numpy as np
from support import fluid

import lanescape


class ParticleMovesTest(unittest.TestCase):
    def setUp(self):
        self.model, self.species, self.positions, self.box = fluid()
        self.moves = lanescape.ParticleMoves(self.model, self.species, self.positions, self.box)
        self.potential = lanescape.Potential(self.model, self.species, self.box)

    def moved(self, positions, particle, to):
        changed = positions.copy()
        changed[particle] = to
        return changed

    def test_a_move_changes_the_energy_as_the_potential_tells(self):
        rng, now = np.random.default_rng(3), self.positions
        before = self.potential.energy(now)
        for k in range(20):
            particle, step = int(rng.integers(108)), 0.1 * rng.normal(size=3)
            then = self.moved(now, particle, now[particle] + step)
            change = self.moves.energy_change(particle, then[particle])
            after = self.potential.energy(then)
            self.assertAlmostEqual(change, after - before, delta=1e-9 * max(1.0, abs(after)))
            if k % 2 == 0:
                self.moves.accept()
                now, before = then, after
            np.testing.assert_array_equal(self.moves.positions, now)

    def test_a_pickle_holds_the_moves_that_were_made(self):
        to = self.positions[5] + 0.1
        self.moves.energy_change(5, to)
        self.moves.accept()
        again = pickle.loads(pickle.dumps(self.moves))
        self.assertEqual(again.particles, 108)
        np.testing.assert_array_equal(again.positions, self.moved(self.positions, 5, to))
        there = self.positions[7] - 0.1
        self.assertAlmostEqual(again.energy_change(7, there), self.moves.energy_change(7, there), delta=1e-9)

    def test_diameters_reach_the_moves(self):
        model = lanescape.Model.named("polydisperse")
        start = lanescape.make_start(model, 108, 1.0)
        moves = lanescape.ParticleMoves(model, None, start.positions, start.box, diameters=start.diameters)
        potential = lanescape.Potential(model, None, start.box, particles=108, diameters=start.diameters)
        to = start.positions[3] + 0.05
        expected = potential.energy(self.moved(start.positions, 3, to)) - potential.energy(start.positions)
        for one in (moves, pickle.loads(pickle.dumps(moves))):
            self.assertAlmostEqual(one.energy_change(3, to), expected, delta=1e-9)

    def test_unfit_moves_are_refused(self):
        with self.assertRaisesRegex(lanescape.InputError, "no move to accept"):
            self.moves.accept()
        for particle, to in ((108, np.zeros(3)), (0, np.zeros(2)), (0, [0.0, np.nan, 0.0])):
            with self.assertRaises(lanescape.InputError):
                self.moves.energy_change(particle, to)
        for particle, to in ((-1, np.zeros(3)), (0.5, np.zeros(3)), (0, "abc")):
            with self.assertRaises(TypeError):
                self.moves.energy_change(particle, to)
        with self.assertRaises(lanescape.InputError):
            lanescape.ParticleMoves(self.model, self.species, self.positions[1:], self.box)
        with self.assertRaises(lanescape.InputError):
            lanescape.ParticleMoves(lanescape.Model.named("ucg"), ["A"] * 108, self.positions, self.box)


if __name__ == "__main__":
    unittest.main()
