"""Strange arguments end in Python's exceptions, never in a crash or a wait without end."""

import faulthandler
import itertools
import unittest

import numpy as np
from support import fluid

import lanescape

STRANGE = (None, -1, 0, 2.5, float("nan"), float("inf"), 1e308, "", "x", b"x", [], [[]], (), {}, object(), np.zeros((0, 3)), np.zeros(3), np.eye(3),
           np.array(1.0), np.zeros((2, 3), complex), True, lambda *given: given, 2**70)


class StrangeArgumentsTest(unittest.TestCase):
    def setUp(self):
        faulthandler.dump_traceback_later(60, exit=True)
        self.addCleanup(faulthandler.cancel_dump_traceback_later)

    def calls(self, function, good, names=()):
        """Calls a function with each of its arguments replaced by each strange value; counts refusals."""
        refusals = 0
        for place, strange in itertools.product([*range(len(good)), *names], STRANGE):
            arguments, keywords = list(good), {}
            if isinstance(place, int):
                arguments[place] = strange
            else:
                keywords[place] = strange
            try:
                function(*arguments, **keywords)
            except Exception as refusal:
                self.assertNotIn("bad_cast", str(refusal), (place, strange))
                refusals += 1
        self.assertGreater(refusals, len(STRANGE) // 2)

    def test_makers(self):
        self.calls(lanescape.Model.named, ["kob-andersen"], ["cutoff", "truncation", "images"])
        self.calls(lanescape.Model.mixture, [["Ar"], 1.0, 1.0], ["form", "numbers", "cutoff", "truncation", "images", "masses", "fractions", "name"])
        self.calls(lanescape.Model.hard_spheres, [["Ar"], [1.0]], ["masses", "fractions", "name"])
        self.calls(lanescape.Model.from_file, ["/nowhere"])
        self.calls(lanescape.Model.from_toml, ["nothing"])
        model, species, positions, box = fluid()
        self.calls(lanescape.Potential, [model, species, box], ["particles", "threads", "precision", "instruction_set", "diameters"])
        self.calls(lanescape.HardSpheres, [[0.5], [3.0] * 3], ["instruction_set", "skin"])
        self.calls(lanescape.Inserter, [model, species, positions, box, ], ["probe", "diameter", "diameters", "instruction_set"])
        self.calls(lanescape.EventDrivenDynamics, [[0.5], [[0.0] * 3], [3.0] * 3], ["masses", "instruction_set"])
        self.calls(lanescape.NeighbourList, [1.0], ["full_list", "sorted", "threads", "instruction_set"])
        self.calls(lanescape.make_start, [model, 20, 1.0], ["seed"])

    def test_particles(self):
        model = lanescape.Model.named("lennard-jones")
        for bad in (-1, 2.5, "3", 2**70, 2**40, [], np.zeros(3)):
            with self.assertRaisesRegex(lanescape.InputError, "particles: ", msg=bad):
                lanescape.Potential(model, None, [5.0] * 3, particles=bad)
        self.assertEqual(lanescape.Potential(model, None, [5.0] * 3, particles=np.int64(2)).particles, 2)

    def test_functions_for_a_single_use(self):
        model, species, positions, box = fluid()
        self.calls(lanescape.evaluate, [model, positions, box, species], ["threads", "precision", "instruction_set", "diameters"])
        for bad in ((None, positions, box), ("kob-andersen", positions, box)):
            with self.assertRaisesRegex(TypeError, "model: "):
                lanescape.evaluate(*bad)
        with self.assertRaises(TypeError):
            lanescape.evaluate(lanescape.Model.named("lennard-jones"), positions, box, particles=3)
        with self.assertRaisesRegex(TypeError, "None is not allowed|incompatible"):
            lanescape.evaluate(lanescape.Model.named("lennard-jones"), None, box)

    def test_states_of_pickles(self):
        model, species, positions, box = fluid()
        potential = lanescape.Potential(model, species, box)
        spheres = lanescape.Model.named("hard-sphere")
        start = lanescape.make_start(spheres, 108, 0.3)
        for whole in (potential, lanescape.HardSpheres([0.5] * 2, [3.0] * 3), lanescape.NeighbourList(1.0),
                      lanescape.MolecularDynamics(potential, positions, 0.001),
                      lanescape.EventDrivenDynamics(start.diameters / 2, start.positions, start.box)):
            kept = whole.__getstate__()
            for state in ((), (1, 2), kept[:-1], kept + (1,), (None,) * len(kept), (object(),) * len(kept), None, 3):
                with self.assertRaises((TypeError, ValueError), msg=(whole, state)):
                    type(whole).__new__(type(whole)).__setstate__(state)

    def test_methods(self):
        model, species, positions, box = fluid()
        potential = lanescape.Potential(model, species, box)
        for method in (potential.energy, potential.energy_and_gradient, potential.energy_and_forces, potential.evaluate):
            self.calls(method, [positions])
        self.calls(potential.energy_and_gradient, [positions, np.empty((108, 3))])
        self.calls(potential.evaluate, [positions], ["forces", "stress", "energies"])
        for name in ("box", "exclusions"):
            self.calls(lambda value: setattr(potential, name, value), [box])
        spheres = lanescape.HardSpheres([0.5] * 2, [3.0] * 3)
        for method in (spheres.any_overlap, spheres.overlaps, spheres.smallest_gap):
            self.calls(method, [[[0.0] * 3, [1.5] * 3]])
        inserter = lanescape.Inserter(model, species, positions, box, probe="Ni")
        self.calls(inserter.find, [-4.0, 1], ["tolerance", "measure", "method", "largest_step", "region", "threads", "most_trials"])
        for method in (inserter.energy, inserter.energy_and_force, inserter.energies, inserter.add, inserter.remove):
            self.calls(method, [[0.0] * 3])
        pairs = lanescape.NeighbourList(1.0)
        self.calls(pairs.compute, [positions, box, True, "ijSDd"], ["species"])
        self.calls(lanescape.neighbour_list, ["ij", None, 1.0, positions, box, True])

    def test_runs(self):
        model, species, positions, box = fluid()
        potential = lanescape.Potential(model, species, box)

        def path(landscape, start, finish, **options):
            lanescape.find_path(landscape, start, finish, **{"max_steps": 20, **options})

        self.calls(path, [potential, positions, positions + 0.01],
                   ["masses", "method", "adaptive", "step", "avoidance_step", "fictitious", "landscape_energy", "reverse", "patience", "frames", "threads",
                    "precision", "instruction_set", "progress", "species", "box"])

        def short_path(landscape, start, finish, path=None, **options):
            lanescape.shorten_path(landscape, start, finish, path, **{"max_steps": 20, **options})

        line = np.array([positions, positions + 0.01, positions + 0.02])
        self.calls(short_path, [potential, positions, positions + 0.01],
                   ["masses", "method", "starts", "seed", "path_method", "adaptive", "step", "landscape_energy", "patience", "threads", "precision",
                    "instruction_set", "progress", "species", "box", "path"])
        self.calls(lanescape.check_path, [potential, line], ["masses", "landscape_energy", "threads", "instruction_set", "species", "box"])
        self.calls(lambda species, box: lanescape.check_path(model, line, species=species, box=box), [species, box])
        self.calls(lanescape.MolecularDynamics, [potential, positions, 0.001], ["masses"])
        dynamics = lanescape.MolecularDynamics(potential, positions, 0.001)
        self.calls(dynamics.draw_velocities, [1.0, 1])
        self.calls(lambda velocities: setattr(dynamics, "velocities", velocities), [positions])
        self.calls(lambda steps: dynamics.run(steps), [1])
        with self.assertRaises((TypeError, ValueError)):
            lanescape.make_end_points(model, None)
        with self.assertRaises((TypeError, ValueError, AttributeError)):
            lanescape.make_end_points(model, positions, quick=True)


if __name__ == "__main__":
    unittest.main()
