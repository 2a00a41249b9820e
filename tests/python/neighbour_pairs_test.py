#!/usr/bin/python3
"""Compares the facade's neighbour pairs with ASE's neighbor_list: tests/python/neighbour_pairs_test.py NEIGHBOUR_PAIRS_DUMP"""

import subprocess
import sys
import unittest
from pathlib import Path

import ase.io
import numpy as np
from ase import Atoms
from ase.build import bulk
from ase.neighborlist import neighbor_list

DATA = Path(__file__).resolve().parents[1] / "data"
DUMP = None


def run(box, cutoff, positions):
    numbers = [*box, cutoff, *np.ravel(positions)]
    return subprocess.run([DUMP], input="\n".join(repr(float(x)) for x in numbers), capture_output=True, text=True)


def ours(atoms, cutoff):
    done = run(atoms.cell.lengths(), cutoff, atoms.positions)
    assert done.returncode == 0, done.stderr
    rows = np.array([line.split() for line in done.stdout.splitlines()], dtype=float).reshape(-1, 9)
    return rows[:, :5].astype(int), rows[:, 5:8], rows[:, 8]


def of_ase(atoms, cutoff):
    first, second, shift, separation, distance = neighbor_list("ijSDd", atoms, cutoff)
    keys = np.column_stack([first, second, shift]).astype(int)
    order = np.lexsort(keys.T[::-1])
    return keys[order], separation[order], distance[order]


def periodic(positions, box):
    return Atoms(f"Ar{len(positions)}", positions=positions, cell=box, pbc=True)


def gas(seed, particles, box, boxes_away=0.0):
    place = np.random.default_rng(seed).uniform(-boxes_away, 1.0 + boxes_away, (particles, 3))
    return periodic(place * box, box)


def fcc(cells, rattle=0.0):
    atoms = bulk("Ar", "fcc", a=1.6, cubic=True).repeat(cells)
    if rattle:
        atoms.rattle(rattle, seed=1)
    return atoms


class NeighbourPairs(unittest.TestCase):
    def assert_same(self, atoms, *cutoffs, least=1):
        for cutoff in cutoffs:
            with self.subTest(particles=len(atoms), box=atoms.cell.lengths().tolist(), cutoff=cutoff):
                keys, separations, distances = ours(atoms, cutoff)
                expected_keys, expected_separations, expected_distances = of_ase(atoms, cutoff)
                self.assertGreaterEqual(len(expected_keys), least)
                np.testing.assert_array_equal(keys, expected_keys)
                np.testing.assert_allclose(separations, expected_separations, rtol=0, atol=1e-12)
                np.testing.assert_allclose(distances, expected_distances, rtol=0, atol=1e-12)

    def test_a_gas(self):
        self.assert_same(gas(1, 200, [12.0, 12.0, 12.0]), 1.0, 2.5, 3.7)

    def test_a_box_of_three_different_edges(self):
        self.assert_same(gas(2, 150, [4.0, 9.5, 17.0]), 1.3, 3.0, 5.1)

    def test_a_dense_liquid(self):
        self.assert_same(fcc((5, 5, 5), rattle=0.15), 1.5, 2.5)

    def test_a_crystal_between_its_shells(self):
        # Exactly at a shell, equal distances differ in their last digits.
        self.assert_same(fcc((3, 3, 3)), *(1.6 * np.sqrt(0.5 * (shell + 0.5)) for shell in range(1, 6)))

    def test_the_last_digit_of_the_cutoff(self):
        atoms = periodic(np.mgrid[0:4, 0:4, 0:4].reshape(3, -1).T, [4.0, 4.0, 4.0])
        for distance in (1.0, np.sqrt(2.0), np.sqrt(3.0), 3.0):
            self.assert_same(atoms, distance, np.nextafter(distance, np.inf), least=0)

    def test_boxes_of_which_many_images_are_within_the_cutoff(self):
        self.assert_same(gas(3, 1, [1.0, 1.0, 1.0]), 1.01, 2.5, 6.3)
        self.assert_same(gas(4, 3, [0.9, 1.2, 0.7]), 2.5)
        self.assert_same(gas(5, 12, [1.5, 0.6, 5.0]), 2.5)
        self.assert_same(bulk("Ar", "fcc", a=1.6, cubic=True), 2.5, 4.1)

    def test_positions_that_are_not_wrapped(self):
        self.assert_same(gas(6, 120, np.array([6.0, 7.0, 8.0]), boxes_away=3.0), 1.5, 2.5)
        self.assert_same(gas(7, 5, np.array([1.1, 0.8, 2.0]), boxes_away=5.0), 2.5)
        self.assert_same(gas(8, 120, np.array([6.0, 7.0, 8.0]), boxes_away=1000.0), 2.5)

    def test_configurations_of_the_test_data(self):
        for name in ("ka_melted_144", "ar_unwrapped_61", "ka_tiny_8"):
            atoms = ase.io.read(DATA / f"{name}.extxyz")
            self.assert_same(atoms, 1.25, 2.5)

    def test_no_particles_and_none_near_have_no_pairs(self):
        for positions in ([], [[1.0, 1.0, 1.0]], [[1.0, 1.0, 1.0], [4.0, 4.0, 4.0]]):
            done = run([9.0, 9.0, 9.0], 2.5, positions)
            self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))

    def test_bad_input_is_refused_in_one_line(self):
        for box, cutoff, position in (([0.01, 1.0, 1.0], 1.0, [0.0, 0.0, 0.0]), ([2.0, 2.0, 2.0], 0.0, [0.0, 0.0, 0.0]),
                                      ([2.0, -1.0, 2.0], 1.0, [0.0, 0.0, 0.0]), ([2.0, 2.0, 2.0], 1.0, [0.0, 1e300, 0.0])):
            done = run(box, cutoff, [position])
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertRegex(done.stderr, "^[^\n]*is not allowed[^\n]*\n$")


if __name__ == "__main__":
    DUMP = sys.argv.pop(1)
    unittest.main()
