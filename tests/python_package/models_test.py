"""Models and energies of the Python package."""

import copy
import pickle
import tempfile
import unittest
from pathlib import Path

import numpy as np
from support import fluid, potential

import lanescape


class ModelTest(unittest.TestCase):
    def test_every_name_makes_a_model_that_its_text_makes_again(self):
        for name in lanescape.model_names():
            model = lanescape.Model.named(name)
            for same in (lanescape.Model.from_toml(model.to_toml()), pickle.loads(pickle.dumps(model)), copy.deepcopy(model)):
                self.assertEqual(model, same)
                self.assertEqual(hash(model), hash(same))

    def test_own_parameters_give_the_named_model(self):
        own = lanescape.Model.mixture(["Ni", "P"], [[1.0, 1.5], [1.5, 0.5]], [[1.0, 0.8], [0.8, 0.88]])
        model, species, positions, box = fluid()
        self.assertEqual(lanescape.evaluate(own, positions, box, species).energy, lanescape.evaluate(model, positions, box, species).energy)

    def test_wrong_parameters_are_refused(self):
        for bad in ({"epsilon": [1.0, 2.0]}, {"epsilon": [[1.0, 2.0], [3.0, 1.0]]}, {"sigma": -1.0}, {"cutoff": np.nan}, {"form": "none"},
                    {"truncation": "none"}, {"images": "none"}, {"masses": [1.0, 2.0, 3.0]}, {"numbers": {"n": 1.0}}, {"fractions": [1.0]}):
            given = {"epsilon": [[1.0, 1.0], [1.0, 1.0]], "sigma": [[1.0, 1.0], [1.0, 1.0]], **bad}
            with self.assertRaises(lanescape.InputError, msg=bad):
                lanescape.Model.mixture(["Ar", "Kr"], **given)
        for bad in (None, 1, "no such model"):
            with self.assertRaises((TypeError, lanescape.InputError)):
                lanescape.Model.named(bad)
        with self.assertRaises(lanescape.InputError):
            lanescape.Model.from_file("/nowhere/model.toml")
        with self.assertRaises(lanescape.InputError):
            lanescape.Model.from_toml("not a model")

    def test_species_are_found_by_name(self):
        model = lanescape.Model.named("kob-andersen")
        self.assertEqual(model.species, ("Ni", "P"))
        self.assertEqual(model.find_species("P"), 1)
        with self.assertRaises(lanescape.InputError):
            model.find_species("He")


class EnergyTest(unittest.TestCase):
    def test_gradient_is_the_difference_of_energies(self):
        potential_, positions = potential()
        gradient = potential_.energy_and_gradient(positions)[1]
        for particle, axis in ((0, 0), (50, 1), (107, 2)):
            step = np.zeros_like(positions)
            step[particle, axis] = 1e-5
            difference = (potential_.energy(positions + step) - potential_.energy(positions - step)) / 2e-5
            self.assertAlmostEqual(difference, gradient[particle, axis], delta=1e-6 * np.abs(gradient).max())

    def test_stress_is_the_difference_of_energies_in_strained_boxes(self):
        potential_, positions = potential()
        box = potential_.box
        found = potential_.evaluate(positions, stress=True)
        self.assertAlmostEqual(found.stress[:3].sum(), -found.virial / box.prod(), delta=1e-9 * abs(found.stress[0]))
        energies = []
        for strain in (1e-6, -1e-6):
            stretch = np.array([1.0 + strain, 1.0, 1.0])
            potential_.box = box * stretch
            energies.append(potential_.energy(positions * stretch))
        self.assertAlmostEqual((energies[0] - energies[1]) / 2e-6 / box.prod(), found.stress[0], delta=1e-5 * abs(found.stress[0]))

    def test_a_changed_box_gives_what_a_new_object_gives(self):
        potential_, positions = potential()
        model, species, _, box = fluid()
        potential_.energy(positions)
        potential_.box = box * 1.25
        expected = lanescape.Potential(model, species, box * 1.25).energy(positions)
        self.assertAlmostEqual(potential_.energy(positions), expected, delta=1e-12 * abs(expected))
        np.testing.assert_array_equal(potential_.box, box * 1.25)

    def test_what_is_not_asked_for_is_none(self):
        potential_, positions = potential()
        bare = potential_.evaluate(positions, forces=False)
        self.assertEqual((bare.forces, bare.stress, bare.energies, bare.virial), (None, None, None, None))
        self.assertEqual(bare.energy, potential_.energy(positions))

    def test_every_instruction_set_and_number_of_threads_gives_the_energy(self):
        expected, positions = potential()
        energy = expected.energy(positions)
        for name in lanescape.instruction_sets():
            self.assertAlmostEqual(potential(instruction_set=name)[0].energy(positions), energy, delta=1e-12 * abs(energy))
        self.assertEqual(potential(threads=2)[0].energy(positions), energy)
        self.assertAlmostEqual(potential(precision="mixed")[0].energy(positions), energy, delta=1e-5 * abs(energy))

    def test_excluded_pairs_do_not_interact(self):
        model = lanescape.Model.named("lennard-jones")
        pair = lanescape.Potential(model, None, [20.0, 20.0, 20.0], particles=2)
        positions = [[0.0, 0.0, 0.0], [1.1, 0.0, 0.0]]
        self.assertLess(pair.energy(positions), -0.9)
        pair.exclusions = [[0, 1]]
        self.assertEqual(pair.energy(positions), 0.0)
        self.assertEqual(pickle.loads(pickle.dumps(pair)).energy(positions), 0.0)
        for bad, error in (([[0, 2]], ValueError), ([[0, -1]], ValueError), ([0, 1], ValueError), ([[0.0, 1.0]], TypeError), (None, TypeError)):
            with self.assertRaises(error, msg=bad):
                pair.exclusions = bad
        pair.exclusions = []
        self.assertLess(pair.energy(positions), -0.9)

    def test_a_model_file_may_be_a_path(self):
        model = lanescape.Model.named("wahnstrom")
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "model.toml")
            file.write_text(model.to_toml())
            for same in (file, str(file), bytes(file)):
                self.assertEqual(lanescape.Model.from_file(same), model)
        for bad in (None, 3, ["a"]):
            with self.assertRaises(TypeError):
                lanescape.Model.from_file(bad)

    def test_sites_in_states_have_energies_and_probabilities(self):
        model, species, positions, box = fluid("ucg", density=0.5)
        system = lanescape.StateSystem(model, species, box)
        energy, gradient = system.energy_and_gradient(positions)
        self.assertEqual(system.probabilities().shape, (108, system.states))
        np.testing.assert_allclose(system.probabilities().sum(axis=1), 1.0, rtol=1e-12)
        self.assertEqual(system.order_parameters().shape, (108,))
        self.assertEqual(pickle.loads(pickle.dumps(system)).energy(positions), energy)
        self.assertEqual(lanescape.evaluate(model, positions, box, species).energy, energy)
        np.testing.assert_array_equal(system.energy_and_forces(positions)[1], -gradient)
        with self.assertRaises(lanescape.InputError):
            lanescape.Potential(model, species, box)
        with self.assertRaises(lanescape.InputError):
            lanescape.StateSystem(lanescape.Model.named("kob-andersen"), species, box)


if __name__ == "__main__":
    unittest.main()
