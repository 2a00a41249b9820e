"""Paths of soft models."""

import csv
import math
import unittest
from pathlib import Path

import numpy

from cli_support import ARGON, FLUID, ProgramTest, contents, frame, lanescape, one_object, without_seconds


class Paths(ProgramTest):
    KEYS = {"outcome", "length", "distance", "ratio_squared", "participation_ratio", "steps", "evaluations", "seconds",
            "landscape_energy", "largest_violation"}

    def test_json_and_files_are_those_of_the_contract(self):
        pairs = self.make_pairs("ends", 2)
        for method in ("contour", "escape"):
            out = self.folder / method
            run = lanescape("path", *ARGON, "--pair", *pairs, "--method", method, "--frames", "5", "--out", out)
            self.assertEqual((run.returncode, run.stderr), (0, ""))
            result = one_object(run.stdout)
            self.assertLessEqual({"paths", "mean_ratio_squared", "standard_error"}, set(result))
            self.assertEqual(result, one_object((out / "result.json").read_text()))
            for path in result["paths"]:
                self.assertLessEqual(self.KEYS, set(path))
                self.assertEqual(path["outcome"], "reached")
                self.assertEqual(set(path["steps"]), {"direct", method})
                self.assertGreater(path["steps"][method], 100)
                self.assertEqual(set(path["lengths"]), {"direct", method})
                self.assertAlmostEqual(sum(path["lengths"].values()), path["length"], delta=1e-12 * path["length"])
                self.assertGreater(path["length"], path["distance"])
                self.assertAlmostEqual(path["ratio_squared"], (path["distance"] / path["length"]) ** 2, delta=1e-12)
                self.assertTrue(1 / 32 <= path["participation_ratio"] <= 1)
                self.assertLessEqual(path["largest_violation"], 0.0 if method == "contour" else 1e-4 * (1 + 1e-9))
            ratios = [path["ratio_squared"] for path in result["paths"]]
            self.assertAlmostEqual(result["mean_ratio_squared"], numpy.mean(ratios), delta=1e-12)
            self.assertAlmostEqual(result["standard_error"], numpy.std(ratios, ddof=1) / math.sqrt(2), delta=1e-12)
            rows = list(csv.DictReader((out / "paths.csv").read_text().splitlines()))
            self.assertEqual([float(row["length"]) for row in rows], [path["length"] for path in result["paths"]])
            for k, pair in enumerate(pairs, 1):
                lines = (out / f"path-{k:04}.extxyz").read_text().splitlines()
                self.assertEqual(len(lines), 7 * 34)
                ends = Path(pair).read_text().splitlines()
                self.assertEqual((lines[2:34], lines[-32:]), (ends[2:34], ends[-32:]))

    def test_adaptive_steps_find_the_faithful_path_in_fewer_steps(self):
        [pair] = self.make_pairs("ends")
        [faithful] = self.done("path", *ARGON, "--pair", pair, "--faithful")["paths"]
        [adaptive] = self.done("path", *ARGON, "--pair", pair, "--adaptive")["paths"]
        self.assertEqual(set(adaptive), set(faithful))
        self.assertLess(10 * adaptive["evaluations"], faithful["evaluations"])
        self.assertAlmostEqual(adaptive["length"], faithful["length"], delta=0.01 * faithful["length"])
        self.assertLessEqual(adaptive["largest_violation"], 1e-3)

    def test_escape_steps_end_within_the_given_tolerance(self):
        [pair] = self.make_pairs("ends")
        highest = {}
        for tolerance in (None, 1e-4, 1e-2):
            given = () if tolerance is None else ("--escape-tolerance", tolerance)
            [path] = self.done("path", *ARGON, "--pair", pair, "--method", "escape", *given)["paths"]
            highest[tolerance] = path["largest_violation"]
        self.assertEqual(highest[None], highest[1e-4])
        self.assertLessEqual(highest[1e-4], 1e-4 * (1 + 1e-9))
        self.assertGreater(highest[1e-2], 1e-3)
        self.assertLessEqual(highest[1e-2], 1e-2 * (1 + 1e-9))

    def stalled(self, *arguments):
        [path] = self.done("path", *arguments, status=1)["paths"]
        self.assertEqual(path["outcome"], "stalled")
        return path["reason"]

    def test_limits_of_trials_and_patience_stall_a_path_and_are_named(self):
        [pair] = self.make_pairs("ends")
        path = (*ARGON, "--pair", pair)
        self.assertIn("after 1 iterations of the descent", self.stalled(*path, "--method", "escape", "--escape-tolerance", "1e-9", "--max-trials", "1"))
        blocked = self.file("blocked.xyz", frame("Ar 1 1 1", "Ar 2.2 1 1") + frame("Ar 2.2 1 1", "Ar 1 1 1"))  # escape steps go back for ever
        for patience in ("50", "200"):
            self.assertIn(f"no progress over {patience} steps",
                          self.stalled(*ARGON, "--pair", blocked, "--method", "escape", "--patience", patience))
        for option, value, words in (("--max-trials", "0", "limit of trials must be at least 1"), ("--patience", "0", "patience 0"),
                                     ("--patience", "10000000000000000", "from 1 to")):
            self.refused_cleanly("path", *path, option, value, says=words)
        for value in ("0", "-1e-4", "nan", "inf"):
            self.refused_cleanly("path", *path, "--method", "escape", "--escape-tolerance", value, says="escape tolerance")

    def test_adaptive_steps_are_refused_where_there_are_none(self):
        [pair] = self.make_pairs("ends")
        self.refused("path", *ARGON, "--pair", pair, "--method", "escape", "--adaptive",
                     says="method escape has no adaptive steps: methods that have them are contour, avoidance")
        self.refused("path", *ARGON, "--pair", pair, "--faithful", "--adaptive", says="--faithful excludes --adaptive")

    def test_end_points_are_made_where_none_are_given(self):
        made = self.done("path", *ARGON, *FLUID, "--seed", "7", "--out", self.folder / "made")
        [pair] = self.make_pairs("ends")
        given = self.done("path", *ARGON, "--pair", pair)
        self.assertEqual(without_seconds(made["paths"]), without_seconds(given["paths"]))
        self.assertEqual((self.folder / "made" / "pair-0001.extxyz").read_bytes(), Path(pair).read_bytes())
        self.assertIsNone(given["standard_error"])

    def test_pairs_tell_the_temperature_of_their_liquid_and_copies_keep_it(self):
        [pair] = self.make_pairs("ends")
        told = f"temperature={FLUID[FLUID.index('--temperature') + 1]}"
        self.done("path", *ARGON, "--pair", pair, "--out", self.folder / "copied")
        for file in (Path(pair), self.folder / "copied" / "pair-0001.extxyz"):
            self.assertEqual([told in line for line in file.read_text().splitlines() if "Lattice" in line], [True, True])
        for other in ("temperature=hot", "temperature=-1", "temperature=nan", ""):
            foreign = self.file("foreign.extxyz", Path(pair).read_text().replace(told, other))
            self.done("path", *ARGON, "--pair", foreign)

    def test_wrapped_end_points_cause_one_line_of_warning(self):
        wrapped = self.file("wrapped.xyz", frame("Ar 0.2 0 0", "Ar 2 2 2") + frame("Ar 3.8 0 0", "Ar 2 2 2"))
        unwrapped = self.file("unwrapped.xyz", frame("Ar 0.2 0 0", "Ar 2 2 2") + frame("Ar -0.2 0 0", "Ar 2 2 2"))
        for file, distance, stderr in ((wrapped, 3.6, r"\A\S*wrapped.xyz: warning: [^\n]* look wrapped, [^\n]*unwrapped[^\n]*\n\Z"),
                                       (unwrapped, 0.4, r"\A\Z")):
            run = lanescape("path", *ARGON, "--pair", file)
            self.assertEqual(run.returncode, 0)
            self.assertAlmostEqual(one_object(run.stdout)["paths"][0]["distance"], distance)
            self.assertRegex(run.stderr, stderr)
        self.assertEqual(lanescape("path", *ARGON, "--pair", wrapped, "--quiet").stderr, "")
        self.refused_cleanly("path", *ARGON, "--pair", wrapped, "--max-steps", "0", says="limit")

    def test_results_do_not_depend_on_the_number_of_threads(self):
        arguments = ("path", *ARGON, *FLUID, "--pairs", "3", "--reverse")
        one, two = (self.done(*arguments, "--threads", n, "--out", self.folder / n) for n in ("1", "2"))
        self.assertEqual(without_seconds(one), without_seconds(two))
        self.assertEqual(len(one["paths"]), 3)
        files = [contents(self.folder / n) for n in ("1", "2")]
        for f in files:
            del f["run.toml"]
        self.assertEqual(files[0], files[1])

    def test_large_systems_do_not_depend_on_the_number_of_threads(self):
        arguments = ("path", "--particles", "300", "--temperature", "2", "--quick", "--distance", "12", "--step", "0.05",
                     "--melt-steps", "300", "--cooling-steps", "300", "--check-steps", "300", "--settle-steps", "100",
                     "--check-tolerance", "1", "--frames", "3")
        one, two = (self.done(*arguments, "--threads", n, "--out", self.folder / n) for n in ("1", "2"))
        for key in ("length", "distance", "steps", "evaluations", "landscape_energy"):
            self.assertEqual(one["paths"][0][key], two["paths"][0][key])
        first, second = ((self.folder / n / "path-0001.extxyz").read_text() for n in ("1", "2"))
        self.assertEqual(first, second)

    def test_reverse_keeps_the_shorter_of_both_ways(self):
        pairs = self.make_pairs("ends", 3)
        forward = self.done("path", *ARGON, "--pair", *pairs)
        both = self.done("path", *ARGON, "--pair", *pairs, "--reverse")
        swapped = []
        for k, pair in enumerate(pairs):
            lines = Path(pair).read_text().splitlines()
            swapped.append(self.file(f"swapped-{k}.xyz", "\n".join(lines[34:] + lines[:34]) + "\n"))
        backward = self.done("path", *ARGON, "--pair", *swapped)
        for shorter, f, b in zip(both["paths"], forward["paths"], backward["paths"]):
            self.assertEqual(shorter["length"], min(f["length"], b["length"]))
            self.assertEqual(shorter["reversed"], b["length"] < f["length"])

    def test_a_step_limit_is_a_goal_not_reached(self):
        [pair] = self.make_pairs("ends")
        out = self.folder / "run"
        result = self.done("path", *ARGON, "--pair", pair, "--max-steps", "50", "--out", out, status=1)
        [path] = result["paths"]
        self.assertEqual((path["outcome"], path["ratio_squared"], sum(path["steps"].values())), ("step_limit", None, 50))
        self.assertIsNone(result["mean_ratio_squared"])
        self.assertEqual(result, one_object((out / "result.json").read_text()))

    def test_a_head_on_obstacle_is_a_stalled_path(self):
        pair = self.file("head-on.xyz", frame("Ar 0 0 0", "Ar 1.2 0 0") + frame("Ar 1.2 0 0", "Ar 0 0 0"))
        for method in ("contour", "escape"):
            [path] = self.done("path", *ARGON, "--pair", pair, "--method", method, status=1)["paths"]
            self.assertEqual((path["outcome"], path["ratio_squared"]), ("stalled", None))
            self.assertTrue(path["reason"])

    def test_a_higher_landscape_energy_shortens_the_path(self):
        [pair] = self.make_pairs("ends")
        [low] = self.done("path", *ARGON, "--pair", pair)["paths"]
        [high] = self.done("path", *ARGON, "--pair", pair, "--landscape-energy", low["landscape_energy"] + 1e6)["paths"]
        self.assertAlmostEqual(high["length"], high["distance"], delta=1e-9)
        self.assertLess(high["length"], low["length"])


if __name__ == "__main__":
    unittest.main()
