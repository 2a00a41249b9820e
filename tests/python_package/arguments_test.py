"""What the Python package takes as arrays, and how it refuses the rest."""

import unittest

import numpy as np
from support import fluid, potential

import lanescape


class PositionsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.potential, cls.positions = potential()
        cls.energy = cls.potential.energy(cls.positions)

    def test_other_layouts_and_dtypes_give_the_same_energy(self):
        for same in (np.asfortranarray(self.positions), self.positions[::-1][::-1], self.positions.tolist(), self.positions.astype(">f8"),
                     np.ma.asarray(self.positions), self.positions.astype(np.longdouble)):
            self.assertEqual(self.potential.energy(same), self.energy)

    def test_float32_and_integers_are_converted(self):
        single = self.positions.astype(np.float32)
        self.assertEqual(self.potential.energy(single), self.potential.energy(single.astype(float)))
        whole = np.arange(324).reshape(108, 3)
        self.assertEqual(self.potential.energy(whole), self.potential.energy(whole.astype(float)))

    def test_read_only_arrays_are_taken(self):
        positions = self.positions.copy()
        positions.flags.writeable = False
        self.assertEqual(self.potential.energy(positions), self.energy)

    def test_arrays_are_not_changed(self):
        before = self.positions.copy()
        self.potential.energy_and_gradient(self.positions)
        np.testing.assert_array_equal(self.positions, before)

    def test_what_holds_no_real_numbers_is_a_type_error(self):
        for bad in ("positions", self.positions.astype(complex), self.positions.astype(str), self.positions.astype(object),
                    self.positions > 0, object(), {1: 2}, lambda r: r):
            with self.assertRaises(TypeError, msg=repr(bad)[:40]) as refused:
                self.potential.energy(bad)
            self.assertRegex(str(refused.exception), "^positions: .* real numbers are needed$")
        with self.assertRaises(TypeError):
            self.potential.energy(None)

    def test_other_shapes_are_a_value_error(self):
        for bad in ([], 1.0, self.positions[0], self.positions[:, :2], self.positions[None], self.positions.ravel(), self.positions.T):
            with self.assertRaisesRegex(lanescape.InputError, r"positions: shape .* \(N, 3\) is needed"):
                self.potential.energy(bad)
        with self.assertRaisesRegex(lanescape.InputError, "321 coordinates were given for 108 particles"):
            self.potential.energy(self.positions[1:])
        with self.assertRaises(ValueError):
            self.potential.energy([[1.0, 2.0, 3.0], [1.0]])

    def test_coordinates_that_are_not_finite_are_named(self):
        for bad in (np.nan, np.inf, -np.inf):
            positions = self.positions.copy()
            positions[17, 2] = bad
            for call in (self.potential.energy, self.potential.energy_and_gradient, self.potential.evaluate):
                with self.assertRaisesRegex(lanescape.InputError, "17"):
                    call(positions)


class OutputsTest(unittest.TestCase):
    def test_results_are_written_to_out(self):
        potential_, positions = potential()
        energy, gradient = potential_.energy_and_gradient(positions)
        out = np.full_like(positions, np.nan)
        again, same = potential_.energy_and_gradient(positions, out=out)
        self.assertIs(same, out)
        self.assertEqual(again, energy)
        np.testing.assert_array_equal(out, gradient)
        forces = np.empty_like(positions)
        energies = np.empty(108)
        found = potential_.evaluate(positions, forces=forces, energies=energies)
        self.assertIs(found.forces, forces)
        self.assertIs(found.energies, energies)
        np.testing.assert_array_equal(forces, -gradient)
        self.assertAlmostEqual(energies.sum(), energy, delta=1e-10 * abs(energy))

    def test_out_may_be_the_positions(self):
        potential_, positions = potential()
        gradient = potential_.energy_and_gradient(positions)[1]
        potential_.energy_and_gradient(positions, positions)
        np.testing.assert_array_equal(positions, gradient)

    def test_unfit_out_is_refused(self):
        potential_, positions = potential()
        read_only = np.empty_like(positions)
        read_only.flags.writeable = False
        for bad in (np.empty((108, 3), np.float32), np.empty((3, 108)).T, [[0.0] * 3] * 108, read_only, "out", np.empty((216, 3))[::2]):
            with self.assertRaisesRegex(TypeError, "out: a writable array of float64 in C order is needed"):
                potential_.energy_and_gradient(positions, bad)
        for bad in (np.empty((107, 3)), np.empty(324), np.empty((108, 3, 1))):
            with self.assertRaisesRegex(lanescape.InputError, r"out: shape .* \(108, 3\) is needed"):
                potential_.energy_and_gradient(positions, bad)

    def test_new_results_outlive_their_object(self):
        potential_, positions = potential()
        gradient = potential_.energy_and_gradient(positions)[1]
        kept = gradient.copy()
        potential_.energy_and_gradient(positions + 0.1)
        del potential_
        np.testing.assert_array_equal(gradient, kept)


class SystemTest(unittest.TestCase):
    def test_species_are_names_or_indices(self):
        model, species, positions, box = fluid()
        names = [model.species[s] for s in species]
        energies = {lanescape.Potential(model, given, box).energy(positions)
                    for given in (species, species.astype(np.int8), species.tolist(), names, np.array(names), tuple(names))}
        self.assertEqual(len(energies), 1)

    def test_other_species_are_refused(self):
        model, species, positions, box = fluid()
        for bad, error in ((None, ValueError), ("Ni", TypeError), ([0.5] * 108, TypeError), ([True] * 108, TypeError), ([2] * 108, ValueError),
                           ([-1] * 108, ValueError), (["He"] * 108, ValueError), ([[0]] * 108, ValueError), ([None] * 108, TypeError),
                           ([2**70] * 108, (ValueError, TypeError)), (0, ValueError)):
            with self.assertRaises(error, msg=repr(bad)[:30]):
                lanescape.Potential(model, bad, box)

    def test_other_boxes_are_refused(self):
        model, species, positions, box = fluid()
        for bad, error in ((None, TypeError), (5.0, ValueError), ([5.0, 5.0], ValueError), ([5.0, 5.0, -5.0], ValueError),
                           ([5.0, 5.0, np.nan], ValueError), ("box", TypeError), (np.eye(3), ValueError)):
            with self.assertRaises(error, msg=repr(bad)):
                lanescape.Potential(model, species, bad)

    def test_other_options_are_refused(self):
        model, species, positions, box = fluid()
        for bad in ({"threads": 0}, {"precision": "single"}, {"instruction_set": "mmx"}, {"diameters": [1.0] * 108}):
            with self.assertRaises(lanescape.InputError, msg=bad):
                lanescape.Potential(model, species, box, **bad)
        for bad in ({"threads": "many"}, {"precision": None}, {"colour": 1}):
            with self.assertRaises(TypeError, msg=bad):
                lanescape.Potential(model, species, box, **bad)

    def test_objects_without_their_constructor_are_refused(self):
        for kind in (lanescape.Potential, lanescape.StateSystem, lanescape.HardSpheres, lanescape.Inserter, lanescape.NeighbourList,
                     lanescape.MolecularDynamics, lanescape.EventDrivenDynamics):
            with self.subTest(kind.__name__), self.assertRaises(TypeError), self.assertWarns(RuntimeWarning):
                getattr(kind.__new__(kind), "compute" if kind is lanescape.NeighbourList else "__getstate__" if
                        kind is not lanescape.Inserter else "energy")(*[[0.0, 0.0, 0.0]] * (kind in (lanescape.Inserter,)))

    def test_errors_say_of_what_kind_they_are(self):
        self.assertTrue(issubclass(lanescape.InputError, (lanescape.Error,)) and issubclass(lanescape.InputError, ValueError))
        self.assertTrue(issubclass(lanescape.RunError, (lanescape.Error,)) and issubclass(lanescape.RunError, RuntimeError))


if __name__ == "__main__":
    unittest.main()
