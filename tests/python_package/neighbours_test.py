"""Neighbour pairs against ASE's neighbor_list."""

import pickle
import unittest

import numpy as np
from ase import Atoms
from ase.neighborlist import neighbor_list

import lanescape


def atoms(particles=60, pbc=True, seed=1, edges=(5.0, 6.0, 7.0)):
    positions = np.random.default_rng(seed).uniform(-1.0, 2.0, size=(particles, 3)) * edges
    return Atoms(f"Ar{particles}", positions=positions, cell=edges, pbc=pbc)


def ordered(arrays):
    i, j, shift, separation, distance = arrays
    order = np.lexsort((shift[:, 2], shift[:, 1], shift[:, 0], j, i))
    return i[order], j[order], shift[order], separation[order], distance[order]


class NeighbourListTest(unittest.TestCase):
    def test_pairs_are_ase_s(self):
        for pbc in (True, False, (True, False, True)):
            for cutoff in (1.5, 4.0, 12.0):
                with self.subTest(pbc=pbc, cutoff=cutoff):
                    one = atoms(pbc=pbc)
                    expected = ordered(neighbor_list("ijSDd", one, cutoff))
                    found = lanescape.neighbour_list("ijSDd", one, cutoff)
                    for ours, theirs in zip(found[:3], expected[:3]):
                        self.assertEqual(ours.dtype, np.int64)
                        np.testing.assert_array_equal(ours, theirs)
                    np.testing.assert_allclose(found[3], expected[3], atol=1e-12)
                    np.testing.assert_allclose(found[4], expected[4], atol=1e-12)

    def test_matscipy_s_signature_without_atoms(self):
        one = atoms()
        expected = lanescape.neighbour_list("ijd", one, 2.0)
        for cell in (one.cell.lengths(), one.cell.array):
            for found, same in zip(lanescape.neighbour_list("ijd", None, 2.0, positions=one.positions, cell=cell, pbc=one.pbc), expected):
                np.testing.assert_array_equal(found, same)
        distances = lanescape.neighbour_list("d", None, 2.0, positions=one.positions, cell=one.cell.lengths())
        self.assertIsInstance(distances, np.ndarray)

    def test_vesin_s_signature(self):
        one = atoms()
        expected = lanescape.neighbour_list("ijSDd", one, 2.5)
        found = lanescape.NeighbourList(cutoff=2.5, full_list=True).compute(points=one.positions, box=one.cell.array, periodic=True, quantities="ijSDd")
        for ours, same in zip(ordered(found), expected):
            np.testing.assert_array_equal(ours, same)
        half = lanescape.NeighbourList(cutoff=2.5, full_list=False).compute(one.positions, one.cell.array, True, "i")
        self.assertEqual(2 * len(half[0]), len(expected[0]))
        starts, first = lanescape.NeighbourList(2.5, sorted=True).compute(one.positions, one.cell.lengths(), quantities="si")
        np.testing.assert_array_equal(np.diff(starts), np.bincount(first, minlength=60))

    def test_cutoffs_of_species_and_a_pickle_give_the_same_pairs(self):
        one = atoms()
        species = np.arange(60) % 2
        pairs = pickle.loads(pickle.dumps(lanescape.NeighbourList([[2.0, 0.0], [0.0, 1.0]], sorted=True)))
        i, j, d = pairs.compute(one.positions, one.cell.lengths(), True, "ijd", species)
        all_i, all_j, all_d = lanescape.neighbour_list("ijd", one, 2.0)
        kept = (species[all_i] == species[all_j]) & (all_d < np.where(species[all_i] == 0, 2.0, 1.0))
        np.testing.assert_array_equal(np.column_stack((i, j)), np.column_stack((all_i, all_j))[kept])

    def test_cutoffs_by_name_are_ase_s(self):
        one = atoms()
        one.symbols[::3] = "Kr"
        one.symbols[::4] = "Xe"
        for cutoffs in ({("Ar", "Kr"): 3.0}, {("Kr", "Ar"): 2.0, (18, 18): 1.5, ("Xe", "Xe"): 4.0}, {("Kr", "Ne"): 2.0}, {("He", "Ne"): 2.0}):
            expected = ordered(neighbor_list("ijSDd", one, cutoffs))
            found = lanescape.neighbour_list("ijSDd", one, cutoffs)
            for ours, theirs in zip(found[:3], expected[:3]):
                np.testing.assert_array_equal(ours, theirs)
        without = {"positions": one.positions, "cell": one.cell.lengths()}
        expected = lanescape.neighbour_list("ij", one, {("Ar", "Kr"): 3.0})
        for cutoffs, numbers in (({("Ar", "Kr"): 3.0}, one.numbers), ({(18, 36): 3.0}, one.numbers), ({("Ar", "Kr"): 3.0}, one.get_chemical_symbols())):
            np.testing.assert_array_equal(lanescape.neighbour_list("ij", None, cutoffs, numbers=numbers, **without), expected)

    def test_unfit_cutoffs_by_name_are_refused(self):
        one = atoms()
        for bad in ({}, {("Ar", "Ar"): -1.0}, {("Ar", "Ar"): np.nan}, {("Ar", "Qq"): 2.0}, {("Ar", "Kr"): 2.0, ("Kr", "Ar"): 3.0}):
            with self.assertRaises(lanescape.InputError, msg=bad):
                lanescape.neighbour_list("ij", one, bad)
        for bad in ({"Ar": 2.0}, {("Ar", "Ar", "Ar"): 2.0}):
            with self.assertRaises(TypeError, msg=bad):
                lanescape.neighbour_list("ij", one, bad)
        with self.assertRaises(TypeError):
            lanescape.neighbour_list("ij", None, {("Ar", "Ar"): 2.0}, positions=one.positions, cell=one.cell.lengths())
        with self.assertRaises(lanescape.InputError):
            lanescape.neighbour_list("ij", None, {("Ar", "Ar"): 2.0}, positions=one.positions, cell=one.cell.lengths(), numbers=one.numbers[1:])

    def test_excluded_pairs_are_never_listed(self):
        one = atoms()
        i, j = lanescape.neighbour_list("ij", one, 2.5)
        pairs = lanescape.NeighbourList(2.5, sorted=True)
        bonds = np.column_stack((i, j))[:7]
        pairs.exclusions = bonds
        kept = ~(((i[:, None] == bonds[:, 0]) & (j[:, None] == bonds[:, 1])) | ((i[:, None] == bonds[:, 1]) & (j[:, None] == bonds[:, 0]))).any(axis=1)
        self.assertGreaterEqual(len(i) - kept.sum(), 7)
        for one_list in (pairs, pickle.loads(pickle.dumps(pairs))):
            np.testing.assert_array_equal(one_list.exclusions, bonds)
            for quantities in ("ij", "ijS"):
                found = one_list.compute(one.positions, one.cell.lengths(), quantities=quantities)
                np.testing.assert_array_equal(found[:2], (i[kept], j[kept]))
        for bad in ([[0, -1]], [[0, 1, 2]], [0, 1]):
            with self.assertRaises(lanescape.InputError):
                pairs.exclusions = bad
        np.testing.assert_array_equal(pairs.exclusions, bonds)
        pairs.exclusions = [[0, 60]]
        with self.assertRaises(lanescape.InputError):
            pairs.compute(one.positions, one.cell.lengths())
        pairs.exclusions = np.empty((0, 2), dtype=int)
        self.assertEqual(len(pairs.compute(one.positions, one.cell.lengths())[0]), len(i))

    def test_neighbours_of_other_points_are_those_of_all_pairs(self):
        one, queries = atoms(40), atoms(9, seed=5).positions
        species, query_species = np.arange(40) % 2, np.arange(9) % 2
        shifts = np.array([[a, b, c] for a in range(-3, 4) for b in range(-3, 4) for c in range(-3, 4)])
        for pbc in (True, (True, False, True)):
            far = one.positions[None, :, None] - queries[:, None, None] + (shifts * one.cell.lengths())[None, None]
            allowed = np.all((shifts == 0) | np.broadcast_to(pbc, 3), axis=1)
            distance = np.where(allowed, np.linalg.norm(far, axis=-1), np.inf)
            for cutoff, within in ((2.0, 2.0), ([[2.0, 0.0], [0.0, 1.0]], np.where(query_species[:, None] == species, 2.0 - query_species[:, None], 0.0)[..., None])):
                pairs = lanescape.NeighbourList(cutoff, full_list=False, sorted=True)
                kinds = {} if cutoff == 2.0 else {"query_species": query_species, "species": species}
                i, j, shift, d, starts = pairs.compute_around(queries, one.positions, one.cell.lengths(), pbc, "ijSds", **kinds)
                expected = np.argwhere(distance < within)
                np.testing.assert_array_equal(np.column_stack((i, j)), expected[:, :2])
                np.testing.assert_array_equal(shift, shifts[expected[:, 2]])
                np.testing.assert_allclose(d, distance[tuple(expected.T)], atol=1e-12)
                np.testing.assert_array_equal(np.diff(starts), np.bincount(i, minlength=9))
        with self.assertRaises(lanescape.InputError):
            lanescape.NeighbourList(2.0).compute_around(queries[:, :2], one.positions, one.cell.lengths())

    def test_arrays_outlive_later_calls_and_their_object(self):
        one, other = atoms(), atoms(seed=2, particles=100)
        pairs = lanescape.NeighbourList(2.0, sorted=True)
        first = pairs.compute(one.positions, one.cell.lengths(), True, "ijSDd")
        kept = [array.copy() for array in first]
        for _ in range(5):
            pairs.compute(other.positions, other.cell.lengths(), True, "ijSDd")
        del pairs
        for array, same in zip(first, kept):
            np.testing.assert_array_equal(array, same)

    def test_unfit_input_is_refused(self):
        one = atoms()
        skew = Atoms("Ar", cell=[[3.0, 1.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 3.0]], pbc=True)
        with self.assertRaisesRegex(ValueError, "not orthorhombic"):
            lanescape.neighbour_list("ij", skew, 2.0)
        for quantities, cutoff in (("ijx", 2.0), ("ij", -1.0), ("ij", np.nan), ("ij", 1e9), ("ij", [1.0, 2.0])):
            with self.assertRaises(ValueError, msg=(quantities, cutoff)):
                lanescape.neighbour_list(quantities, one, cutoff)
        for arguments in (("ij",), ("ij", None, 2.0), ("ij", one, "far"), (None, one, 2.0), ("ij", one, 2.0, one.positions)):
            with self.assertRaises(TypeError, msg=arguments):
                lanescape.neighbour_list(*arguments)
        positions = one.positions.copy()
        positions[3, 1] = np.nan
        with self.assertRaises(ValueError):
            lanescape.neighbour_list("ij", None, 2.0, positions=positions, cell=one.cell.lengths())
        with self.assertRaises((ValueError, TypeError)):
            lanescape.NeighbourList(2.0).compute(one.positions, one.cell.lengths(), "yes")
        with self.assertRaises(ValueError):
            lanescape.NeighbourList(2.0).compute(one.positions, one.cell.lengths(), quantities="ijs")
        with self.assertRaises(ValueError):
            lanescape.NeighbourList([[2.0, 1.0], [1.0, 2.0]]).compute(one.positions, one.cell.lengths(), species=[5] * 60)


if __name__ == "__main__":
    unittest.main()
