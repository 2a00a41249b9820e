"""Models of kind ucg."""

import unittest

import numpy

from cli_support import DATA, EXAMPLES, ARGON, FLUID, PROTOCOL, ProgramTest, frame


class States(ProgramTest):
    """Models of kind ucg."""

    def melt(self, symbol):
        return self.file(f"{symbol}.extxyz", (DATA / "ar_melted_107.extxyz").read_text().replace("\nAr ", f"\n{symbol} "))

    def test_both_examples_agree_with_the_reference(self):
        # The reference uses tanh, the kernels use a spline of it.
        for model, symbol in (("liquid_vapour", "Ar"), ("methanol", "C")):
            with self.subTest(model):
                arguments = ("energy", self.melt(symbol), "--model", "ucg", "--model-file", EXAMPLES / f"{model}.toml", "--forces", "--states")
                simd, reference = self.done(*arguments), self.done(*arguments, "--backend", "reference")
                self.assertEqual(reference["isa"], "reference")
                for key in ("energy", "one_body_energy", "virial"):
                    self.assertAlmostEqual(simd[key], reference[key], delta=1e-8 * abs(reference["energy"]))
                for key in ("forces", "densities", "probabilities"):
                    expected = numpy.array(reference[key])
                    numpy.testing.assert_allclose(simd[key], expected, rtol=0, atol=4e-7 * abs(expected).max())
                self.assertEqual(numpy.array(simd["probabilities"]).shape, (107, 2))
                numpy.testing.assert_allclose(numpy.sum(simd["probabilities"], axis=1), 1.0, rtol=0, atol=1e-15)

    def test_the_named_model_is_the_example(self):
        file = self.melt("Ar")
        named = self.done("energy", file, "--model", "ucg", "--forces")
        from_file = self.done("energy", file, "--model-file", EXAMPLES / "liquid_vapour.toml", "--forces")
        self.assertEqual((named.pop("model"), from_file.pop("model")), ("ucg", "liquid-vapour"))
        self.assertEqual(named, from_file)

    def test_keys_are_those_of_the_contract(self):
        keys = {"energy", "energy_per_particle", "one_body_energy", "virial", "stress", "particles", "model", "isa", "images", "precision"}
        file = self.melt("Ar")
        self.assertEqual(set(self.done("energy", file, "--model", "ucg")), keys)
        self.assertEqual(set(self.done("energy", file, "--model", "ucg", "--states")), keys | {"densities", "probabilities"})

    def test_forces_do_not_depend_on_threads_and_hardly_on_the_instruction_set(self):
        arguments = ("energy", self.melt("Ar"), "--model", "ucg", "--forces")
        one = self.done(*arguments, "--threads", 1)
        self.assertEqual(one, self.done(*arguments, "--threads", 2))
        sse2 = self.done(*arguments, "--isa", "sse2")
        numpy.testing.assert_allclose(sse2["forces"], one["forces"], rtol=0, atol=1e-11 * abs(numpy.array(one["forces"])).max())

    def test_a_path_reaches_its_goal_by_either_method(self):
        ends = self.done("endpoints", "--model", "ucg", *FLUID, "--seed", 3, "--out", self.folder / "ends")
        for method in ("contour", "escape"):
            result = self.done("path", "--model", "ucg", "--pair", ends["pairs"][0]["file"], "--method", method)
            self.assertEqual((result["paths"][0]["outcome"], result["model"], result["images"]), ("reached", "ucg", "all"))
            self.assertLess(result["paths"][0]["largest_violation"], 2e-4)

    def test_model_files_that_do_not_fit_are_refused(self):
        good = (EXAMPLES / "liquid_vapour.toml").read_text()
        tables = (EXAMPLES / "methanol.toml").read_text()
        argon, carbon = self.melt("Ar"), self.melt("C")
        for content, file, *says in (
            (good.replace("states = [0, 1]", "states = [0, 2]"), argon, "whole number from 0 to 1"),
            (good.replace("states = [0, 1]", "states = [1, 1]"), argon, "given twice"),
            (good.replace("states = [0, 1]\n", ""), argon, "'states' is missing"),
            (good[:good.rindex("[[pair]]")], argon, "states 1 and 1, is missing"),
            (good.replace("threshold = 4.0\n", ""), argon, "'threshold' is missing"),
            (good.replace("# 1: dilute\n", "\nthreshold = 2.0\n"), argon, "last state"),
            (good.replace("cutoff = 2.5\n\n[[species.state]]", "cutoff = 1.2\n\n[[species.state]]"), argon, "below its cutoff"),
            (good.replace("width = 1.5", "width = 0"), argon, "width = 0 is not allowed"),
            (good.replace("[species.density]", "[species.densty]"), argon, "unknown key 'densty'"),
            (good.replace("epsilon = 0.8", "epsilon = nan"), argon, "epsilon = nan"),
            (good + '[[filter]]\nof = "Ar"\ncounts = "Kr"\nweight = 1.0\n', argon, "unknown species 'Kr'"),
            (good + '[[filter]]\nof = "Ar"\ncounts = "Ar"\nweight = -1.0\n', argon, "weight = -1 is not allowed"),
            (tables.replace("last = 2.3", "last = 2.4", 1), carbon, "different distances"),
            (tables.replace("0.0,\n]", "0.1,\n]", 1), carbon, "must be 0"),
            (tables.replace("values = [", "values = [ 'a',", 1), carbon, "values is no number"),
        ):
            with self.subTest(says=says):
                self.assertNotIn(content, (good, tables))
                bad = self.file("bad.toml", content)
                self.refused_cleanly("energy", file, "--model-file", bad, says=("bad.toml:", *says))

    def test_sites_in_states_diffuse(self):
        result = self.done("diffusion", "--model", "ucg", "--particles", "32", "--density", "0.5", "--temperature", "1", *PROTOCOL[:-2],
                           "--lags", "50", "--records", "200", "--trajectories", "2", "--between", "10")
        argon = result["species"]["Ar"]
        self.assertAlmostEqual(argon["diffusion_vacf"], argon["diffusion_msd"], delta=0.2 * argon["diffusion_msd"])
        self.assertEqual(argon["wave_number"], 7.25)
        self.assertIn("pressure", result)
        self.assertNotIn("precision", result)

    def test_options_that_do_not_fit_are_refused(self):
        file = self.melt("Ar")
        for arguments, *says in ((("--images", "minimum"), "--images", "all images"), (("--truncation", "tail"), "--truncation"),
                                 (("--precision", "mixed"), "--precision", "double"), (("--cutoff", "-1"), "cutoff -1")):
            with self.subTest(arguments):
                self.refused_cleanly("energy", file, "--model", "ucg", *arguments, says=says)
        lennard_jones = self.file("lj.toml", 'kind = "lennard-jones"\n[[species]]\nname = "Ar"\n'
                                             '[[pair]]\nspecies = ["Ar", "Ar"]\nepsilon = 1.0\nsigma = 1.0\n')
        self.refused_cleanly("energy", file, "--model", "ucg", "--model-file", lennard_jones, says=("ucg", "another kind"))
        self.refused_cleanly("energy", file, *ARGON, "--states", says=("--states", "ucg"))
        self.refused_cleanly("verify", file, "--model", "ucg", says=("verify", "sites with states"))
        self.refused_cleanly("diffusion", "--model", "ucg", "--precision", "mixed", says=("--precision", "double"))
        self.refused_cleanly("energy", self.file("close.extxyz", frame("Ar 0 0 0", "Ar 0.2 0 0")), "--model", "ucg", says=("close.extxyz", "overlap"))


if __name__ == "__main__":
    unittest.main()
