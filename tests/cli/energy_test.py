"""Energies, forces and stress of a file of soft particles."""

import itertools
import json
import re
import shutil
import unittest

import numpy

from cli_support import DATA, EXAMPLES, ARGON, TINY, FLUID, HEADER, PROPERTIES, TWO, TWO_MOVED, ProgramTest, frame, lanescape


class Energy(ProgramTest):
    def test_energy_forces_and_stress_are_those_of_ase(self):
        ase = json.loads((DATA / "ase_lennard_jones.json").read_text())
        self.assertGreaterEqual(len(ase), 9)
        for name, expected in ase.items():
            with self.subTest(name):
                result = self.done("energy", DATA / name, "--model", "lennard-jones", "--forces")
                self.assertAlmostEqual(result["energy"] / expected["energy"], 1.0, delta=1e-10)
                forces = numpy.array(expected["forces"])
                numpy.testing.assert_allclose(result["forces"], forces, rtol=0, atol=1e-10 * abs(forces).max() + 2e-12)
                lattice = [float(x) for x in re.search('Lattice="([^"]*)"', (DATA / name).read_text()).group(1).split()]
                volume = lattice[0] * lattice[4] * lattice[8]
                virial = numpy.array(expected["virial"])
                numpy.testing.assert_allclose(result["stress"], -virial / volume, rtol=0, atol=1e-10 * abs(virial).max() / volume)

    def test_keys_are_those_of_the_contract(self):
        keys = {"energy", "energy_per_particle", "virial", "stress", "particles", "model", "isa", "images", "precision"}
        file = DATA / "ka_melted_108.extxyz"
        result = self.done("energy", file)
        self.assertEqual(set(result), keys)
        self.assertEqual(set(self.done("energy", file, "--forces")), keys | {"forces"})
        self.assertEqual((result["particles"], result["model"], result["images"]), (108, "kob-andersen", "all"))
        self.assertEqual(result["energy_per_particle"], result["energy"] / 108)
        self.assertEqual(len(result["stress"]), 6)

    def test_files_of_other_programs_are_read(self):
        own = frame("Ni 0 1 2", "P -3.5 0.25 17", "Ni 1.5 4.75 0.125", "Ni 3 2.5 5", header=f'Lattice="4 0 0 0 5 0 0 0 6" {PROPERTIES}')
        expected = self.done("energy", self.file("own.xyz", own), "--forces")
        for file in sorted((DATA / "foreign").iterdir()):
            with self.subTest(file.name):
                self.assertEqual(self.done("energy", file, "--forces"), expected)

    def test_slabs_and_clusters_are_periodic_boxes_with_a_gap(self):
        particles = ("Ar 0.3 1 1", "Ar 3.4 1.3 1", "Ar -1 1.2 2", "Ar 4.9 1.1 2.4", "Ar 2 3.9 0.1")
        for pbc, edges in (("F T T", "12 4 4"), ("[0, 1, 1]", "12 4 4"), ("T F T", "4 12 4"), ("F F T", "12 12 4"), ("F", "12 12 12")):
            value = pbc if pbc.startswith("[") else f'"{pbc}"'
            cell = "Lattice=\"{} 0 0 0 {} 0 0 0 {}\" " + PROPERTIES
            opened = self.file("open.xyz", frame(*particles, header=cell.format(4, 4, 4) + f" pbc={value}"))
            gap = self.file("gap.xyz", frame(*particles, header=cell.format(*edges.split())))
            expected = self.done("energy", gap, "--model", "lennard-jones", "--forces")
            for more in ((), ("--backend", "reference"), ("--precision", "mixed")):
                with self.subTest(f"{pbc} {more}"):
                    run = self.done("energy", opened, "--model", "lennard-jones", "--forces", *more)
                    tolerance = 1e-5 if "mixed" in more else 1e-12
                    self.assertAlmostEqual(run["energy"], expected["energy"], delta=tolerance)
                    self.assertAlmostEqual(run["virial"], expected["virial"], delta=10 * tolerance)
                    numpy.testing.assert_allclose(run["forces"], expected["forces"], rtol=0, atol=20 * tolerance)

    def test_open_axes_are_refused_where_they_make_no_sense(self):
        slab = self.file("slab.xyz", frame(*TWO, header=HEADER.replace("T T T", "T F T")))
        self.refused("energy", slab, "--model", "lennard-jones", "--truncation", "tail", says="open along y")
        self.refused("energy", slab, *ARGON, says="which open axes need")
        ucg = self.file("ucg.xyz", frame("Ar 0 0 0", "Ar 1.5 0 0", header=HEADER.replace("T T T", "T F T")))
        for more in ((), ("--backend", "reference")):
            self.refused("energy", ucg, "--model-file", EXAMPLES / "liquid_vapour.toml", *more, says="open along y")

    def test_frames_that_are_not_used_need_not_be_whole(self):
        expected = self.done("energy", self.file("whole.xyz", frame(*TWO)), *ARGON)
        for more in (frame(*TWO)[:-6], "2\n", "2\nno box\nAr"):
            with self.subTest(more):
                self.assertEqual(self.done("energy", self.file("cut.xyz", frame(*TWO) + more), *ARGON), expected)

    def test_no_zero_is_negative(self):
        far = self.file("far.xyz", frame("Ar 0 0 0", "Ar 6 6 6", header=f'Lattice="12 0 0 0 12 0 0 0 12" {PROPERTIES}'))
        for name in (far, self.file("two.xyz", frame(*TWO))):
            for backend in ("simd", "reference"):
                run = lanescape("energy", name, *ARGON, "--forces", "--backend", backend, "--out", self.folder / f"{name.name}{backend}")
                self.assertEqual(run.returncode, 0)
                self.assertNotRegex(run.stdout, r"-0\.0\b")
                self.assertEqual((self.folder / f"{name.name}{backend}" / "result.json").read_text(), run.stdout)

    def test_boxes_beyond_the_range_of_numbers_are_refused(self):
        for edge in ("1e160", "1e307"):
            header = f'Lattice="{edge} 0 0 0 {edge} 0 0 0 {edge}" {PROPERTIES}'
            file = self.file("huge.xyz", frame("Ar 0 0 0", "Ar 1.25 0 0", header=header))
            self.refused_cleanly("energy", file, *ARGON, says="box edge 1e+")

    def test_mixed_precision_agrees_with_double_to_its_stated_error(self):
        for name in ("ka_tiny_8", "ka_melted_108", "ka_rattled_256"):
            arguments = ("energy", DATA / f"{name}.extxyz", "--forces")
            double, mixed = self.done(*arguments), self.done(*arguments, "--precision", "mixed")
            self.assertEqual((double["precision"], mixed["precision"]), ("double", "mixed"))
            self.assertNotEqual(double["energy"], mixed["energy"])
            self.assertAlmostEqual(mixed["energy"] / double["energy"], 1.0, delta=1e-6)
            expected = numpy.array(double["forces"])
            numpy.testing.assert_allclose(mixed["forces"], expected, rtol=0, atol=3e-6 * abs(expected).max())
            numpy.testing.assert_allclose(mixed["stress"], double["stress"], rtol=1e-9)

    def test_a_path_in_mixed_precision_reaches_its_goal_and_says_so(self):
        arguments = ("path", "--model", "lennard-jones", *FLUID, "--precision", "mixed", "--out", self.folder / "run")
        result = self.done(*arguments)
        self.assertEqual((result["precision"], result["paths"][0]["outcome"]), ("mixed", "reached"))
        self.assertIn('precision = "mixed"', re.sub("'", '"', (self.folder / "run" / "run.toml").read_text()))

    def test_the_reference_backend_agrees_with_the_kernels(self):
        for name, images, truncation in itertools.product(("ka_melted_108", "ka_tiny_8", "ka_rattled_256"), ("all", "minimum"),
                                                          ("shifted", "plain", "tail")):
            with self.subTest(f"{name} {images} {truncation}"):
                arguments = ("energy", DATA / f"{name}.extxyz", "--forces", "--images", images, "--truncation", truncation)
                simd, reference = self.done(*arguments), self.done(*arguments, "--backend", "reference")
                self.assertEqual(reference["isa"], "reference")
                for key in ("energy", "virial"):
                    self.assertAlmostEqual(simd[key] / reference[key], 1.0, delta=1e-12)
                for key in ("stress", "forces"):
                    expected = numpy.array(reference[key])
                    numpy.testing.assert_allclose(simd[key], expected, rtol=0, atol=1e-12 * abs(expected).max())

    def test_stress_is_minus_virial_over_volume(self):
        result = self.done("energy", DATA / "ka_melted_108.extxyz")
        volume = 108 / 1.2
        self.assertAlmostEqual(-sum(result["stress"][:3]) * volume / result["virial"], 1.0, delta=1e-9)

    def test_stress_is_the_strain_derivative_of_the_energy(self):
        lines = (DATA / "ka_melted_108.extxyz").read_text().splitlines()
        lattice = [float(x) for x in re.search('Lattice="([^"]*)"', lines[1]).group(1).split()]

        def energy(strain):
            cell = [lattice[0] * (1 + strain), 0, 0, 0, lattice[4], 0, 0, 0, lattice[8]]
            particles = []
            for line in lines[2:]:
                symbol, x, y, z = line.split()[:4]
                particles.append(f"{symbol} {float(x) * (1 + strain)!r} {y} {z}")
            header = f'Lattice="{" ".join(map(repr, cell))}" {PROPERTIES}'
            return self.done("energy", self.file("strained.xyz", frame(*particles, header=header)))["energy"]

        slope = (energy(1e-6) - energy(-1e-6)) / 2e-6
        stress = self.done("energy", DATA / "ka_melted_108.extxyz")["stress"][0]
        self.assertAlmostEqual(slope / (stress * lattice[0] * lattice[4] * lattice[8]), 1.0, delta=1e-5)

    def test_the_image_rules_differ_where_the_cutoff_exceeds_half_the_box_and_only_there(self):
        small, large = DATA / "ka_melted_108.extxyz", DATA / "ka_rattled_256.extxyz"
        both = [[self.done("energy", file, "--images", rule, "--cutoff", cutoff) for rule in ("all", "minimum")]
                for file, cutoff in ((small, 2.5), (small, 2.2), (large, 2.5))]
        self.assertEqual([r["images"] for r in both[0]], ["all", "minimum"])
        self.assertGreater(abs(both[0][0]["energy"] - both[0][1]["energy"]), 1e-3)
        for every, nearest in both[1:]:
            self.assertEqual(every["energy"], nearest["energy"])

    def test_of_several_frames_the_first_is_used(self):
        first, second = frame(*TWO), frame(*TWO_MOVED)
        energies = [self.done("energy", self.file("f.xyz", text), *ARGON)["energy"] for text in (first + second, first, second)]
        self.assertEqual(energies[0], energies[1])
        self.assertNotEqual(energies[0], energies[2])

    def test_a_model_file_replaces_the_named_model(self):
        file, data = DATA / "ka_melted_108.extxyz", self.file("ka.toml", """
            kind = "lennard-jones"
            name = "mixture"
            [[species]]
            name = "Ni"
            fraction = 0.8
            [[species]]
            name = "P"
            fraction = 0.2
            [[pair]]
            species = ["Ni", "Ni"]
            epsilon = 1.0
            sigma = 1.0
            [[pair]]
            species = ["Ni", "P"]
            epsilon = 1.5
            sigma = 0.8
            [[pair]]
            species = ["P", "P"]
            epsilon = 0.5
            sigma = 0.88
        """)
        result = self.done("energy", file, "--model-file", data)
        self.assertEqual((result["model"], result["energy"]), ("mixture", self.done("energy", file)["energy"]))

    def test_nothing_is_written_without_out(self):
        shutil.copy(DATA / "ka_tiny_8.extxyz", self.folder)
        self.done("energy", "ka_tiny_8.extxyz", cwd=self.folder)
        self.done("path", *ARGON, *TINY, cwd=self.folder)
        self.assertEqual([f.name for f in self.folder.iterdir()], ["ka_tiny_8.extxyz"])


if __name__ == "__main__":
    unittest.main()
