"""ASE's calculators over the library, and ASE's own as landscapes."""

import copy
import json
import pickle
import tempfile
import unittest

import numpy as np
from ase import Atoms
from ase.build import bulk, make_supercell
from ase.calculators.calculator import CalculatorSetupError, PropertyNotImplementedError
from ase.calculators.emt import EMT
from ase.calculators.lj import LennardJones as AseLennardJones
from ase.io import read, write
from ase.optimize import BFGS, FIRE

try:
    from ase.filters import UnitCellFilter
except ImportError:  # before ASE 3.23
    from ase.constraints import UnitCellFilter

try:
    from ase.calculators.fd import calculate_numerical_forces
except ImportError:  # before ASE 3.23 calculators have it

    def calculate_numerical_forces(atoms, eps):
        return atoms.calc.calculate_numerical_forces(atoms, d=eps)


import lanescape
from lanescape.ase import AtomsLandscape, Calculator, KobAndersen, LennardJones


def argon(repeat=3, edge=1.7, shake=0.05, seed=1):
    atoms = bulk("Ar", "fcc", a=edge, cubic=True).repeat(repeat)
    atoms.positions += shake * np.random.default_rng(seed).normal(size=atoms.positions.shape)
    return atoms


def mixture(seed=1):
    start = lanescape.make_start(lanescape.Model.named("kob-andersen"), 108, 1.2, seed=seed)
    atoms = Atoms([("Ni", "P")[s] for s in start.species], positions=start.positions, cell=start.box, pbc=True)
    atoms.positions += 0.05 * np.random.default_rng(seed).normal(size=atoms.positions.shape)
    return atoms


def strained(atoms, voigt, strain):
    """The energy with one component of strain; only those along the axes keep the cell orthorhombic."""
    stretch = np.eye(3)
    stretch[voigt, voigt] += strain
    other = atoms.copy()
    other.calc = atoms.calc
    other.set_cell(atoms.cell.array @ stretch, scale_atoms=True)
    return other.get_potential_energy()


class CalculatorTest(unittest.TestCase):
    def test_results_are_those_of_ase(self):
        for repeat, edge in ((3, 1.7), (1, 1.7), (2, 1.6)):
            atoms = argon(repeat, edge)
            theirs = atoms.copy()
            theirs.calc = AseLennardJones(sigma=1.0, epsilon=1.0, rc=2.5, ro=2.5, smooth=False)
            atoms.calc = LennardJones()
            expected = theirs.get_potential_energy()
            self.assertAlmostEqual(atoms.get_potential_energy(), expected, delta=1e-10 * abs(expected))
            self.assertEqual(atoms.get_potential_energy(force_consistent=True), atoms.get_potential_energy())
            np.testing.assert_allclose(atoms.get_forces(), theirs.get_forces(), atol=1e-9)
            np.testing.assert_allclose(atoms.get_stress(), theirs.get_stress(), atol=1e-9)
            np.testing.assert_allclose(atoms.get_potential_energies(), theirs.get_potential_energies(), atol=1e-9)

    def test_ase_s_numeric_forces_agree(self):
        for atoms, calculator in ((argon(1), LennardJones(truncation="shifted-force")), (argon(2), LennardJones(truncation="shifted-force")),
                                  (mixture(), KobAndersen(truncation="smooth"))):
            atoms.calc = calculator
            forces = atoms.get_forces()
            np.testing.assert_allclose(calculate_numerical_forces(atoms, eps=1e-4), forces, atol=1e-5 * np.abs(forces).max())

    def test_stress_is_the_difference_of_energies(self):
        for atoms, calculator in ((argon(), LennardJones(truncation="shifted-force")), (mixture(), KobAndersen(truncation="smooth"))):
            atoms.calc = calculator
            stress = atoms.get_stress()
            for axis in range(3):
                slope = (strained(atoms, axis, 1e-5) - strained(atoms, axis, -1e-5)) / 2e-5 / atoms.get_volume()
                self.assertAlmostEqual(slope, stress[axis], delta=1e-5 * np.abs(stress).max())

    def test_energies_add_up(self):
        atoms = mixture()
        atoms.calc = KobAndersen()
        self.assertAlmostEqual(atoms.get_potential_energies().sum(), atoms.get_potential_energy(), delta=1e-9 * abs(atoms.get_potential_energy()))

    def test_matrices_of_a_mixture_are_its_own(self):
        atoms = mixture()
        atoms.calc = KobAndersen()
        expected = atoms.get_potential_energy()
        atoms.calc = LennardJones(["Ni", "P"], [[1.0, 1.5], [1.5, 0.5]], [[1.0, 0.8], [0.8, 0.88]])
        self.assertEqual(atoms.get_potential_energy(), expected)
        atoms.calc = Calculator(lanescape.Model.named("kob-andersen"), threads=2)
        self.assertEqual(atoms.get_potential_energy(), expected)

    def test_units_are_those_of_the_atoms(self):
        reduced, real = argon(), argon()
        real.set_cell(real.cell.array * 3.4, scale_atoms=True)
        reduced.calc, real.calc = LennardJones(), LennardJones(epsilon=0.0104, sigma=3.4)
        self.assertAlmostEqual(real.get_potential_energy(), 0.0104 * reduced.get_potential_energy(), delta=1e-10)
        np.testing.assert_allclose(real.get_forces(), reduced.get_forces() * 0.0104 / 3.4, atol=1e-10)

    def test_atoms_cells_and_species_may_change(self):
        calculator = KobAndersen()
        atoms = mixture()
        atoms.calc = calculator

        def fresh():
            other = atoms.copy()
            other.calc = KobAndersen()
            return other.get_potential_energy()

        atoms.get_potential_energy()
        kept = calculator.system(atoms)
        atoms.set_cell(atoms.cell.array * 1.02, scale_atoms=True)
        self.assertAlmostEqual(atoms.get_potential_energy(), fresh(), delta=1e-9)
        self.assertIs(calculator.system(atoms), kept)
        other = atoms.copy()
        other.set_cell(atoms.cell.array * 1.5, scale_atoms=True)
        calculator.system(other)
        atoms.positions[0, 0] += 1e-3
        self.assertAlmostEqual(atoms.get_potential_energy(), fresh(), delta=1e-9)
        del atoms[5]
        self.assertAlmostEqual(atoms.get_potential_energy(), fresh(), delta=1e-9)
        self.assertEqual(len(atoms.get_forces()), 107)
        atoms.symbols[3] = "P" if atoms.symbols[3] == "Ni" else "Ni"
        self.assertAlmostEqual(atoms.get_potential_energy(), fresh(), delta=1e-9)
        atoms.wrap()
        self.assertAlmostEqual(atoms.get_potential_energy(), fresh(), delta=1e-9)

    def test_what_is_not_allowed_is_refused_in_ase_s_way(self):
        skew = make_supercell(bulk("Ar", "fcc", a=1.7), np.eye(3))
        slab = argon()
        slab.pbc = (True, True, False)
        other = argon()
        other.symbols[0] = "He"
        for atoms, words in ((skew, "edges along x, y and z"), (slab, "periodic along all axes"), (other, "He: no species of model"),
                             (Atoms("Ar"), "pbc")):
            atoms.calc = LennardJones()
            with self.assertRaisesRegex(CalculatorSetupError, words):
                atoms.get_potential_energy()
        atoms = argon()
        atoms.calc = LennardJones()
        atoms.positions[2, 1] = np.nan
        with self.assertRaises(ValueError):
            atoms.get_forces()
        for bad in ({"epsilon": -1.0}, {"sigma": [[1.0, 1.0], [1.0, 1.0]]}, {"cutoff": 0.0}, {"truncation": "none"}, {"threads": 0}):
            with self.assertRaises(ValueError, msg=bad):
                atoms.calc = LennardJones(**bad)
                atoms.positions[2, 1] = 0.0
                atoms.get_potential_energy()
        with self.assertRaises(TypeError):
            LennardJones().set(epsilon=2.0)
        with self.assertRaises(ValueError):
            Calculator(lanescape.Model.named("hard-sphere")).system(Atoms("Ar", cell=[5.0] * 3, pbc=True))

    def test_strange_arguments_are_refused_with_what_is_needed(self):
        with self.assertRaisesRegex(TypeError, "lanescape.Model is needed, not str"):
            Calculator("kob-andersen")
        with self.assertRaisesRegex(TypeError, "LennardJones cannot set rc"):
            LennardJones(rc=3.0)
        for name in ("energy", "forces"):
            with self.assertRaisesRegex(CalculatorSetupError, "no atoms"):
                LennardJones().get_property(name)
        self.assertEqual(LennardJones("Ar").model, LennardJones(["Ar"]).model)

    def test_cells_relax_along_the_axes(self):
        atoms = argon(3, edge=1.6, shake=0.02)
        atoms.calc = LennardJones(truncation="shifted-force")
        self.assertGreater(np.abs(atoms.get_stress()[:3]).max(), 2.0)
        FIRE(UnitCellFilter(atoms, mask=[1, 1, 1, 0, 0, 0]), logfile=None).run(fmax=1e-3, steps=300)
        self.assertLess(np.abs(atoms.get_stress()[:3]).max(), 0.02)
        atoms = argon(3, edge=1.6, shake=0.05)
        atoms.calc = LennardJones(truncation="shifted-force")
        with self.assertRaisesRegex(CalculatorSetupError, r"mask=\[1, 1, 1, 0, 0, 0\]"):
            BFGS(UnitCellFilter(atoms), logfile=None).run(fmax=1e-3, steps=200)

    def test_a_cell_orthorhombic_to_rounding_is_allowed(self):
        atoms = argon()
        atoms.calc = LennardJones()
        energy = atoms.get_potential_energy()
        pairs = lanescape.neighbour_list("ij", atoms, 1.5)
        atoms.cell[1, 0] = 1e-14
        self.assertEqual(atoms.get_potential_energy(), energy)
        np.testing.assert_array_equal(lanescape.neighbour_list("ij", atoms, 1.5), pairs)
        atoms.cell[1, 0] = 1e-9
        with self.assertRaises(CalculatorSetupError):
            atoms.get_potential_energy()

    def test_files_of_ase_keep_results_and_the_model(self):
        atoms = argon()
        atoms.calc = LennardJones()
        energy, forces = atoms.get_potential_energy(), atoms.get_forces()
        with tempfile.TemporaryDirectory() as folder:
            for kind in ("extxyz", "traj", "json"):
                write(f"{folder}/atoms.{kind}", atoms)
                again = read(f"{folder}/atoms.{kind}")
                self.assertEqual(again.get_potential_energy(), energy)
                np.testing.assert_allclose(again.get_forces(), forces, atol=1e-7)
        kept = json.loads(json.dumps(atoms.calc.todict()))
        self.assertEqual(lanescape.Model.from_toml(kept["model"]), atoms.calc.model)

    def test_calculators_pickle_and_copy(self):
        atoms = argon()
        atoms.calc = LennardJones()
        energy = atoms.get_potential_energy()
        for same in (pickle.loads(pickle.dumps(atoms)), copy.deepcopy(atoms)):
            same.calc.reset()
            self.assertEqual(same.get_potential_energy(), energy)

    def test_properties_and_changes_are_told_in_ase_s_way(self):
        atoms = argon()
        calculator = atoms.calc = LennardJones()
        self.assertEqual(calculator.check_state(atoms), ["positions", "numbers", "cell", "pbc"])
        self.assertIsNone(calculator.atoms)
        self.assertIsNone(calculator.get_property("energy", atoms, allow_calculation=False))
        energy = atoms.get_potential_energy()
        self.assertEqual(calculator.check_state(atoms), [])
        self.assertEqual(calculator.get_potential_energy(), energy)
        np.testing.assert_array_equal(calculator.atoms.positions, atoms.positions)
        self.assertEqual(calculator.atoms, atoms)
        np.testing.assert_array_equal(calculator.get_stress(), atoms.get_stress())
        atoms.positions[0] += 0.01
        self.assertEqual(calculator.check_state(atoms), ["positions"])
        self.assertTrue(calculator.calculation_required(atoms, ["energy"]))
        self.assertNotEqual(atoms.get_potential_energy(), energy)
        forces = atoms.get_forces()
        forces[:] = 0.0
        self.assertGreater(np.abs(atoms.get_forces()).max(), 0.0)
        with self.assertRaises(PropertyNotImplementedError):
            atoms.get_dipole_moment()

    def test_optimisers_of_ase_run(self):
        atoms = argon(2)
        atoms.calc = LennardJones(truncation="shifted-force")
        BFGS(atoms, logfile=None).run(fmax=1e-3, steps=200)
        self.assertLess(np.abs(atoms.get_forces()).max(), 1e-3)


class AtomsLandscapeTest(unittest.TestCase):
    def test_a_calculator_of_ase_is_a_landscape(self):
        atoms = bulk("Cu", cubic=True).repeat(2)
        atoms.calc = EMT()
        landscape = AtomsLandscape(atoms)
        rng = np.random.default_rng(1)
        start, finish = (atoms.positions + 0.1 * rng.normal(size=atoms.positions.shape) for _ in range(2))
        energy, gradient = landscape.energy_and_gradient(start)
        self.assertEqual(landscape.energy(start), energy)
        step = np.zeros_like(start)
        step[3, 1] = 1e-5
        self.assertAlmostEqual((landscape.energy(start + step) - landscape.energy(start - step)) / 2e-5, gradient[3, 1], delta=1e-5)
        path = lanescape.find_path(landscape, start, finish, step=0.05, max_steps=300)
        self.assertIn(path.outcome, ("reached", "step_limit"))
        self.assertLessEqual(path.largest_violation, 1e-6)
        np.testing.assert_array_equal(atoms.positions, bulk("Cu", cubic=True).repeat(2).positions)

    def test_an_own_calculator_is_used_without_ase(self):
        atoms = mixture()
        atoms.calc = KobAndersen()
        landscape = AtomsLandscape(atoms)
        energy, gradient = landscape.energy_and_gradient(atoms.positions)
        self.assertEqual(energy, atoms.get_potential_energy())
        np.testing.assert_array_equal(gradient, -atoms.get_forces())
        atoms.set_cell(atoms.cell.array * 1.1, scale_atoms=False)
        atoms.get_potential_energy()
        self.assertEqual(landscape.energy_and_gradient(atoms.positions)[0], energy)

    def test_atoms_without_a_calculator_are_refused(self):
        with self.assertRaises(CalculatorSetupError):
            AtomsLandscape(argon())

    def test_exceptions_of_a_calculator_pass_through(self):
        atoms = Atoms("U2", positions=[[0, 0, 0], [1, 1, 1]], cell=[5.0] * 3, pbc=True)
        atoms.calc = EMT()
        with self.assertRaises(NotImplementedError):
            lanescape.find_path(AtomsLandscape(atoms), atoms.positions, atoms.positions + [[0.1, 0, 0], [0, 0, 0]])


if __name__ == "__main__":
    unittest.main()
