"""Hard spheres: overlaps, end points, paths and diffusion."""

import csv
import unittest

from cli_support import (DATA, PROTOCOL, ARGON, HEADER, SPHERE_HEADER, InterruptionTest, ProgramTest, frame, with_options,
                         without_seconds)


SPHERES = ("--model", "hard-sphere-binary", "--particles", "32")
QUICK_SPHERES = ("--equilibration-collisions", "20000", "--between-collisions", "2000", "--distance", "6")


class Overlap(ProgramTest):
    def file(self, *particles, header=SPHERE_HEADER):
        path = self.folder / "spheres.extxyz"
        path.write_text(frame(*particles, header=header))
        return path

    def test_overlapping_pairs_are_named_with_their_gaps(self):
        result = self.done("overlap", self.file("Xe 0.1 0 0 0.7", "Ar 3.9 0 0 0.5", "Kr 2 2 2 0.6", "Ar 1.3 0 0 0.4"))
        self.assertEqual(result["overlaps"], 1)
        (first, second, gap), = result["pairs"]
        self.assertEqual((first, second), (0, 1))  # across the wall
        self.assertAlmostEqual(gap, 0.2 - 1.2, places=14)
        self.assertAlmostEqual(result["smallest_gap"], -1.0, places=14)

    def test_touching_spheres_do_not_overlap(self):
        result = self.done("overlap", self.file("Ar 0 0 0 0.5", "Ar 1 0 0 0.5"))
        self.assertEqual((result["overlaps"], result["pairs"], result["smallest_gap"]), (0, [], 0.0))

    def test_a_single_sphere_has_no_gap(self):
        self.assertIsNone(self.done("overlap", self.file("Ar 0 0 0 0.5"))["smallest_gap"])

    def test_radii_must_be_there_and_positive(self):
        self.refused("overlap", self.file("Ar 0 0 0 0", "Ar 1 0 0 0.5"), says="radius")
        self.refused("overlap", self.file("Ar 0 0 0 -1"), says="radius")
        self.refused("overlap", self.file("Ar 0 0 0", header=HEADER), says="radius")

    def test_a_box_below_two_diameters_is_refused(self):
        self.refused("overlap", self.file("Ar 0 0 0 1.1"), says="box edge")


class HardSpheres(InterruptionTest):
    def ends(self, out, *more):
        return self.done("endpoints", *SPHERES, "--packing-fraction", "0.45", *QUICK_SPHERES, *more, "--out", out)

    def test_end_points_are_apart_and_free_of_overlaps(self):
        out = self.folder / "ends"
        result = self.ends(out, "--pairs", "2")
        self.assertEqual((len(result["pairs"]), result["outcome"]), (2, "done"))
        self.assertAlmostEqual(result["packing_fraction"], 0.45, places=12)
        for pair in result["pairs"]:
            self.assertGreaterEqual(pair["distance"], 6.0)
            self.assertEqual(pair["collisions"] % 20, 0)
            self.assertGreater(pair["time"], 0.0)
            self.assertEqual(self.done("overlap", pair["file"])["overlaps"], 0)

    def test_a_path_reaches_its_goal_with_all_its_files(self):
        ends, out = self.folder / "ends", self.folder / "path"
        pair = self.ends(ends)["pairs"][0]
        result = self.done("path", "--model", "hard-sphere-binary", "--pair", pair["file"], "--frames", "5", "--out", out)
        path, = result["paths"]
        self.assertEqual(path["outcome"], "reached")
        self.assertEqual(path["largest_violation"], 0.0)
        self.assertIsNone(path["landscape_energy"])
        self.assertEqual(set(path["steps"]), {"direct", "avoidance"})
        self.assertGreater(path["length"], path["distance"])
        self.assertAlmostEqual(path["ratio_squared"], (path["distance"] / path["length"]) ** 2, places=12)
        names = {file.name for file in out.iterdir()}
        self.assertLessEqual({"paths.csv", "path-0001.extxyz", "path-0001-trace.csv", "path-0001-steps.csv", "path-0001-particles.csv"}, names)
        rows = list(csv.DictReader((out / "path-0001-particles.csv").read_text().splitlines()))
        self.assertEqual(len(rows), 32)
        self.assertTrue(all(float(r["path_length"]) >= float(r["displacement"]) - 1e-9 for r in rows))
        steps = list(csv.DictReader((out / "path-0001-steps.csv").read_text().splitlines()))
        whole = sum(int(r["steps"]) for r in steps if r["quantity"] == "participation_ratio")
        self.assertEqual(whole, sum(path["steps"].values()))

    def test_adaptive_steps_find_a_shorter_path_with_no_overlap_along_it(self):
        pair = self.ends(self.folder / "ends")["pairs"][0]
        arguments = ("path", "--model", "hard-sphere-binary", "--pair", pair["file"])
        [faithful] = self.done(*arguments, "--faithful")["paths"]
        [adaptive] = self.done(*arguments, "--adaptive")["paths"]
        self.assertEqual(set(adaptive), set(faithful))
        self.assertEqual(adaptive["outcome"], "reached")
        self.assertLess(adaptive["length"], faithful["length"])
        self.assertLess(100 * adaptive["evaluations"], faithful["evaluations"])
        self.assertLessEqual(adaptive["largest_violation"], 1e-12)
        self.assertAlmostEqual(sum(adaptive["lengths"].values()), adaptive["length"], places=10)

    def test_an_interrupted_adaptive_path_resumes_to_the_same_bits(self):
        pair = self.done("endpoints", *with_options(SPHERES, "--particles", "108"), "--packing-fraction", "0.55",
                         *with_options(QUICK_SPHERES, "--distance", "108"), "--out", self.folder / "ends")["pairs"][0]
        arguments = ("path", "--model", "hard-sphere-binary", "--pair", pair["file"], "--adaptive")
        whole, out = self.folder / "whole", self.folder / "cut"
        self.done(*arguments, "--out", whole)
        result = self.interrupt(*arguments, out=out, seconds=0.1)
        self.assertEqual(result["paths"][0]["outcome"], "interrupted")
        self.assert_resumes_to(out, whole, "path")

    def test_limits_of_avoidance_and_away_steps_stall_a_path_and_are_named(self):
        pair = self.ends(self.folder / "ends")["pairs"][0]["file"]
        for given, words in ((("--method", "avoidance", "--max-trials", "1"), "after 1 trials of 0.0001"),
                             (("--method", "away", "--max-depth", "1"), "over 1 in a row"),
                             (("--method", "away", "--max-trials", "1"), "over 1 moves of spheres")):
            [path] = self.done("path", *SPHERES[:2], "--pair", pair, *given, status=1)["paths"]
            self.assertEqual(path["outcome"], "stalled")
            self.assertIn(words, path["reason"])
        self.refused_cleanly("path", *SPHERES[:2], "--pair", pair, "--method", "away", "--max-depth", "0", says="depth of the away method")

    def test_an_interrupted_path_resumes_to_the_same_bits(self):
        ends = self.folder / "ends"
        pair = self.done("endpoints", *SPHERES, "--packing-fraction", "0.55",
                         *with_options(QUICK_SPHERES, "--distance", "30"), "--out", ends)["pairs"][0]
        arguments = ("path", "--model", "hard-sphere-binary", "--pair", pair["file"])
        whole, out = self.folder / "whole", self.folder / "cut"
        self.done(*arguments, "--out", whole)
        result = self.interrupt(*arguments, out=out, seconds=0.15)
        self.assertEqual(result["paths"][0]["outcome"], "interrupted")
        self.assert_resumes_to(out, whole, "path")

    def assert_resumes_from_an_interruption(self, *arguments, after):
        """A run interrupted the given number of seconds after its folder exists resumes to the bits of an uninterrupted one."""
        whole, out = self.folder / "whole", self.folder / "cut"
        self.done(*arguments, "--out", whole)
        result = self.interrupt(*arguments, out=out, seconds=after)
        self.assertEqual(result["outcome"], "interrupted")
        self.assert_resumes_to(out, whole, arguments[0])

    def test_interrupted_end_points_resume_to_the_same_bits(self):
        self.assert_resumes_from_an_interruption("endpoints", *SPHERES, "--packing-fraction", "0.5", *with_options(
            QUICK_SPHERES, "--equilibration-collisions", "3000000"), after=0.3)

    def test_diffusion_interrupted_in_equilibration_resumes_to_the_same_bits(self):
        self.assert_resumes_from_an_interruption(
            "diffusion", *SPHERES, "--packing-fraction", "0.5", "--equilibration-collisions", "3000000", "--interval", "0.01",
            "--lags", "100", "--records", "500", "--trajectories", "2", "--between", "1000", after=0.3)

    def test_diffusion_interrupted_in_a_trajectory_resumes_to_the_same_bits(self):
        self.assert_resumes_from_an_interruption(
            "diffusion", *SPHERES, "--packing-fraction", "0.5", "--equilibration-collisions", "1000", "--interval", "0.002",
            "--lags", "500", "--records", "100000", "--trajectories", "4", "--between", "1000", after=0.4)

    def test_diffusion_gives_both_estimates_and_the_compressibility(self):
        result = self.done("diffusion", "--model", "hard-sphere", "--particles", "32", "--packing-fraction", "0.2", "--quick",
                           "--interval", "0.01", "--lags", "400", "--records", "4000", "--trajectories", "3", "--between", "1000")
        argon = result["species"]["Ar"]
        self.assertAlmostEqual(argon["diffusion_vacf"], argon["diffusion_msd"], delta=0.2 * argon["diffusion_msd"])
        self.assertGreater(argon["diffusion_vacf_error"], 0.0)
        self.assertAlmostEqual(result["compressibility"], 2.41, delta=0.1)
        self.assertEqual(result["trajectories"], 3)

    def test_soft_models_diffuse_too(self):
        result = self.done("diffusion", *ARGON, "--particles", "32", "--density", "0.8", "--temperature", "1", *PROTOCOL[:-2],
                           "--lags", "50", "--records", "200", "--trajectories", "2", "--between", "10")
        self.assertIn("pressure", result)
        self.assertGreater(result["species"]["Ar"]["diffusion_vacf"], 0.0)

    def test_bad_input_is_refused(self):
        endpoints = ("endpoints", *SPHERES, *QUICK_SPHERES)
        for packing in ("0", "-0.1", "0.75", "nan"):
            self.refused(*endpoints, "--packing-fraction", packing, says="packing fraction")
        self.refused(*endpoints, "--packing-fraction", "0.6", "--start-method", "lattice", says="lattice")
        self.refused(*endpoints, "--start-method", "magic", says="allowed are auto, lattice, contraction, growth")
        self.refused(*endpoints, "--temperature", "1", says="--temperature is not allowed")
        self.refused(*endpoints, "--density", "1", says="--density is not allowed")
        self.refused("endpoints", "--packing-fraction", "0.4", says="--packing-fraction is not allowed")
        self.refused("path", *SPHERES, *QUICK_SPHERES, "--method", "contour", says="contour")
        self.refused("path", "--method", "avoidance", says="avoidance")
        self.refused("path", *SPHERES, *QUICK_SPHERES, "--fictitious", "soft", says="harmonic, linear, cubic")
        self.refused("energy", DATA / "ar_tiny_4.extxyz", "--model", "hard-sphere", says="hard spheres")

    def test_overlaps_beyond_rounding_are_refused_and_rounding_is_scaled_away(self):
        file = self.folder / "pair.extxyz"
        def write(gap):
            file.write_text("".join(frame("Ar 0 0 0 0.5", f"Ar {1 + gap} {y} 0 0.5", header=SPHERE_HEADER) for y in (0, 0.5)))
        write(-1e-3)
        self.refused("path", "--model", "hard-sphere", "--pair", file, says="overlap")
        write(-1e-8)
        result = self.done("path", "--model", "hard-sphere", "--pair", file, "--out", self.folder / "path")
        self.assertLess(result["radius_factor"], 1.0)
        self.assertGreater(result["radius_factor"], 1.0 - 1e-7)
        resumed = self.done("path", "--resume", self.folder / "path")
        self.assertEqual(without_seconds(resumed), without_seconds(result))
        single = self.folder / "single.extxyz"
        single.write_text(frame("Ar 0 0 0 0.5", "Ar 0.99999999 0 0 0.5", header=SPHERE_HEADER))
        ends = self.done("endpoints", "--model", "hard-sphere", "--start", single, *with_options(QUICK_SPHERES, "--distance", "1"))
        self.assertEqual(ends["radius_factor"], result["radius_factor"])

    def test_the_away_method_reaches_its_goal_in_a_dilute_fluid(self):
        pair = self.done("endpoints", *SPHERES, "--packing-fraction", "0.1", *QUICK_SPHERES, "--out", self.folder / "ends")["pairs"][0]
        path, = self.done("path", "--model", "hard-sphere-binary", "--method", "away", "--pair", pair["file"])["paths"]
        self.assertEqual(path["outcome"], "reached")
        self.assertEqual(set(path["steps"]), {"direct", "away"})
        self.assertLess(path["largest_violation"], 1e-9)
        self.assertEqual(set(path["heterogeneity"]), {"Xe", "Ar"})
        self.refused("path", *SPHERES, "--method", "away", "--step", "0.1", says="--step is not allowed")


if __name__ == "__main__":
    unittest.main()
