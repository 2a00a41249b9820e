"""Shortening paths: the contract, given paths, and bad input."""

import csv
import math
import signal
import unittest
from pathlib import Path

from cli_support import ARGON, DATA, HEADER, SPHERE_HEADER, InterruptionTest, contents, frame, lanescape, one_object, without_seconds


def two_spheres(radii="0.5", turn=170.0):
    """Frames of two spheres 3 apart in the middle of a box, before and after a rotation."""
    frames = ""
    for angle in (0.0, math.radians(turn)):
        x, y = 1.5 * math.cos(angle), 1.5 * math.sin(angle)
        frames += frame(f"Ar {6 + x!r} {6 + y!r} 6 {radii}", f"Ar {6 - x!r} {6 - y!r} 6 {radii}",
                        header=SPHERE_HEADER.replace("4", "12"))
    return frames


class Shorten(InterruptionTest):
    KEYS = {"length_before", "length", "ratio_squared", "largest_violation", "kuhn_tucker_residual", "nodes", "seconds"}
    MONTE_CARLO = ("shorten", "--method", "montecarlo")
    SPHERES = (*MONTE_CARLO, "--model", "hard-sphere", "--step", "1e-3")

    def lines_of(self, file):
        return Path(file).read_text().splitlines()

    def test_json_and_files_are_those_of_the_contract(self):
        [pair] = self.make_pairs("ends")
        for method in ("contour", "escape"):
            out = self.folder / method
            run = lanescape(*self.MONTE_CARLO, *ARGON, "--pair", pair, "--path-method", method, "--frames", "5", "--out", out)
            self.assertEqual((run.returncode, run.stderr), (0, ""))
            result = one_object(run.stdout)
            self.assertEqual(result, one_object((out / "result.json").read_text()))
            self.assertLessEqual(self.KEYS, set(result))
            self.assertEqual(result["outcome"], "reached")
            [greedy] = self.done("path", *ARGON, "--pair", pair, "--method", method)["paths"]
            self.assertEqual(result["length_before"], greedy["length"])
            self.assertEqual(result["distance"], greedy["distance"])
            self.assertLessEqual(result["length"], result["length_before"])
            self.assertAlmostEqual(result["ratio_squared"], (result["distance"] / result["length"]) ** 2, delta=1e-12)
            self.assertLessEqual(result["largest_violation"], 0.0 if method == "contour" else 1e-4 * (1 + 1e-9))
            self.assertIsNone(result["kuhn_tucker_residual"])
            self.assertTrue(5 < result["nodes"] <= 1002)
            rows = list(csv.DictReader(self.lines_of(out / "path-0001-trials.csv")))
            self.assertEqual(len(rows), result["trials"])
            kept = [float(row["length"]) for row in rows if row["accepted"] == "1"]
            self.assertEqual(len(kept), result["accepted"])
            self.assertEqual(([result["length_before"]] + kept)[-1], result["length"])
            self.assert_nodes(out / "initial-0001-nodes.csv", result["distance"], result["length_before"])
            self.assert_nodes(out / "path-0001-nodes.csv", result["distance"], result["length"])
            lines, ends = self.lines_of(out / "path-0001.extxyz"), self.lines_of(pair)
            self.assertEqual(len(lines), 7 * 34)
            self.assertEqual((lines[2:34], lines[-32:]), (ends[2:34], ends[-32:]))

    def assert_nodes(self, file, distance, length):
        """Nodes of a path of this length, in the allowed region. Steps between them may be a detour."""
        rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(self.lines_of(file))]
        self.assertEqual((rows[0]["length"], rows[0]["distance_to_goal"], rows[-1]["distance_to_goal"]), (0.0, distance, 0.0))
        self.assertTrue(distance * (1 - 1e-12) <= rows[-1]["length"] <= length * (1 + 1e-12))
        for before, row in zip(rows, rows[1:]):
            self.assertGreater(row["length"], before["length"])
        for row in rows:
            self.assertTrue(1 / 32 <= row["participation_ratio"] <= 1.0)
            self.assertTrue(0.0 <= row["multiplier"] <= 2.0)
            self.assertLessEqual(row.get("excess", 0.0), 1e-4 * (1 + 1e-9))
            self.assertGreaterEqual(row.get("smallest_gap", 0.0), 0.0)

    def test_two_spheres_come_near_the_geodesic(self):
        pair = self.file("two.xyz", two_spheres())
        out = self.folder / "out"
        result = self.done(*self.SPHERES, "--pair", pair, "--starts", "20", "--out", out)
        for name in ("initial", "path"):
            self.assert_nodes(out / f"{name}-0001-nodes.csv", result["distance"], result["length" if name == "path" else "length_before"])
        self.assertEqual(len(result["start_lengths"]), 20)
        self.assertEqual(result["length"], min(result["start_lengths"]))
        geodesic = 6.1620 / math.sqrt(2)
        self.assertGreater(result["length_before"], 1.4 * geodesic)
        self.assertGreater(result["accepted"], 0)
        self.assertTrue(geodesic * (1 - 1e-5) < result["length"] < 1.01 * geodesic)
        self.assertEqual(result["largest_violation"], 0.0)
        other = self.done(*self.SPHERES, "--pair", pair, "--seed", "2")
        self.assertNotEqual(other["length"], result["start_lengths"][0])

    def test_results_do_not_depend_on_the_number_of_threads(self):
        pair = self.file("two.xyz", two_spheres())
        one, two = (self.done(*self.SPHERES, "--pair", pair, "--starts", "3", "--threads", n) for n in ("1", "2"))
        self.assertEqual(without_seconds(one), without_seconds(two))

    def test_adaptive_steps_take_fewer_evaluations(self):
        [pair] = self.make_pairs("ends")
        faithful, adaptive = (self.done(*self.MONTE_CARLO, *ARGON, "--pair", pair, steps) for steps in ("--faithful", "--adaptive"))
        self.assertLess(10 * adaptive["evaluations"], faithful["evaluations"])
        self.assertAlmostEqual(adaptive["length_before"], faithful["length_before"], delta=0.05 * faithful["length_before"])
        self.refused_cleanly(*self.MONTE_CARLO, *ARGON, "--pair", pair, "--path-method", "escape", "--adaptive", says="adaptive")

    def test_a_written_path_is_where_it_starts_from(self):
        [pair] = self.make_pairs("ends")
        for more in ((), ("--reverse",)):
            out = self.folder / f"path{len(more)}"
            [greedy] = self.done("path", *ARGON, "--pair", pair, "--frames", "50", *more, "--out", out)["paths"]
            result = self.done(*self.MONTE_CARLO, *ARGON, "--pair", pair, "--path", out / "path-0001.extxyz")
            self.assertAlmostEqual(result["length_before"], greedy["length"], delta=0.02 * greedy["length"])
            self.assertLessEqual(result["length"], result["length_before"])
        shorter = self.folder / "shorter"
        first = self.done(*self.MONTE_CARLO, *ARGON, "--pair", pair, "--frames", "1000", "--out", shorter)
        again = self.done(*self.MONTE_CARLO, *ARGON, "--pair", pair, "--path", shorter / "path-0001.extxyz")
        self.assertAlmostEqual(again["length_before"], first["length"], delta=0.02 * first["length"])

    def test_interrupted_and_killed_runs_resume_to_the_same_bits(self):
        [pair] = self.make_pairs("ends")
        given = self.folder / "given"
        self.done("path", *ARGON, "--pair", pair, "--frames", "10", "--out", given)
        arguments = (*self.MONTE_CARLO, *ARGON, "--pair", pair, "--path", given / "path-0001.extxyz", "--step", "1e-5", "--threads", "1")
        whole = self.folder / "whole"
        self.done(*arguments, "--out", whole)
        cut, killed = self.folder / "cut", self.folder / "killed"
        result = self.interrupt(*arguments, out=cut, after="checkpoint/shorten-0001.h5", with_signal=signal.SIGTERM)
        self.assertEqual(result["outcome"], "interrupted")
        process = self.start(*arguments, out=killed)
        self.wait_for(process, killed / "checkpoint" / "shorten-initial.h5")
        process.kill()
        process.wait()
        # The files may change or disappear after the start of the run, which keeps copies.
        Path(pair).unlink()
        (given / "path-0001.extxyz").unlink()
        self.assert_resumes_to(cut, whole, "shorten", times=2)
        self.assert_resumes_to(killed, whole, "shorten")

    def test_a_curve_is_stationary_and_its_file_proves_it(self):
        [pair] = self.make_pairs("ends")
        out = self.folder / "curve"
        result = self.done("shorten", *ARGON, "--pair", pair, "--method", "curve", "--adaptive", "--frames", "7", "--out", out)
        self.assertLessEqual(self.KEYS | {"length_change", "levels", "iterations"}, set(result))
        self.assertEqual(result["outcome"], "reached")
        self.assertLess(result["length"], result["length_before"])
        self.assertGreaterEqual(result["length"], result["distance"])
        self.assertLessEqual(result["kuhn_tucker_residual"], 1e-2)
        self.assertLessEqual(result["largest_violation"], 1e-3)
        self.assertLessEqual(result["length_change"], 1e-3)
        check = self.done("shorten", "--check", out / "path-0001.h5", "--pair", pair)
        for key in ("distance", "landscape_energy", "nodes"):
            self.assertEqual(check[key], result[key], key)
        for key in ("length", "largest_violation", "kuhn_tucker_residual"):
            self.assertAlmostEqual(check[key], result[key], delta=1e-9 * (1 + abs(result[key])), msg=key)
        self.assertEqual(len(self.lines_of(out / "path-0001.extxyz")), 9 * 34)
        again = self.done("shorten", *ARGON, "--pair", pair, "--method", "curve", "--path", out / "path-0001.h5")
        self.assertAlmostEqual(again["length"], result["length"], delta=1e-3 * result["length"])

    def test_a_curve_of_hard_spheres_is_stationary_and_its_file_proves_it(self):
        out = self.folder / "curve"
        pair = self.folder / "two.extxyz"
        pair.write_text(two_spheres())
        spheres = ("shorten", "--model", "hard-sphere", "--pair", pair, "--method", "curve", "--adaptive")
        result = self.done(*spheres, "--out", out)
        self.assertEqual(result["outcome"], "reached")
        self.assertAlmostEqual(result["length"], 6.1620 / math.sqrt(2), delta=1e-4 * result["length"])
        self.assertLessEqual(result["kuhn_tucker_residual"], 1e-2)
        self.assertLessEqual(result["largest_violation"], 1e-9)
        check = self.done("shorten", "--check", out / "path-0001.h5", "--pair", pair)
        for key in ("length", "largest_violation", "kuhn_tucker_residual"):
            self.assertAlmostEqual(check[key], result[key], delta=1e-9 * (1 + abs(result[key])), msg=key)
        two = self.done(*spheres, "--threads", "2", "--out", self.folder / "two")
        self.assertEqual(without_seconds(two), without_seconds(result))

    def test_starts_of_a_curve_differ_and_the_shortest_is_kept(self):
        [pair] = self.make_pairs("ends")
        run = ("shorten", *ARGON, "--pair", pair, "--method", "curve", "--adaptive", "--starts", "4", "--seed", "5")
        one, two = (self.done(*run, "--threads", str(threads)) for threads in (1, 2))
        self.assertEqual(without_seconds(one), without_seconds(two))
        self.assertEqual(len(one["start_lengths"]), 4)
        self.assertAlmostEqual(one["length"], min(one["start_lengths"]), delta=1e-9 * one["length"])

    def test_interrupted_curves_resume_to_the_same_bits(self):
        pair = DATA / "ka108-T1-pair.extxyz"
        arguments = ("shorten", "--pair", pair, "--method", "curve", "--adaptive", "--threads", "1")
        whole, cut = self.folder / "whole", self.folder / "cut"
        self.done(*arguments, "--out", whole)
        self.assertEqual(self.interrupt(*arguments, out=cut, after="checkpoint/shorten-0001.h5", seconds=1.0)["outcome"], "interrupted")
        self.assert_resumes_to(cut, whole, "shorten")

    def test_a_first_path_that_does_not_reach_its_goal_is_a_goal_not_reached(self):
        [pair] = self.make_pairs("ends")
        result = self.done(*self.MONTE_CARLO, *ARGON, "--pair", pair, "--max-steps", "50", "--out", self.folder / "limit", status=1)
        self.assertEqual((result["outcome"], result["length"], result["ratio_squared"], result["nodes"]), ("step_limit", None, None, 0))
        self.assertEqual(self.done("shorten", "--resume", self.folder / "limit", status=1), result)

    def test_bad_paths_are_refused_in_one_line(self):
        ends = (("Ar 0 0 0", "Ar 1.3 0 0"), ("Ar 0 0 0", "Ar 1.5 0.5 0"))
        pair = self.file("pair.xyz", "".join(frame(*end) for end in ends))
        run = (*self.MONTE_CARLO, *ARGON, "--pair", pair, "--path")
        between = ("Ar 0 0 0", "Ar 1.4 0.25 0")
        self.done(*run, self.file("good.xyz", "".join(frame(*node) for node in (ends[0], between, ends[1]))))
        for bad, says in (((ends[0], ends[1]), "2 frames"),
                          ((ends[0], between, between), "end points of the pair"),
                          ((("Ar 0 0 0", "Ar 1.3 0.1 0"), between, ends[1]), "end points of the pair"),
                          ((ends[0], ("Ar 0 0 0", "Ar 1.0 0.1 0"), ends[1]), "landscape energy"),
                          ((ends[0], (*between, "Ar 2 2 2"), ends[1]), "frame 2: its composition")):
            self.refused_cleanly(*run, self.file("bad.xyz", "".join(frame(*node) for node in bad)), says=("bad.xyz", says))
        larger = "".join(frame(*node, header=HEADER.replace("4", "5")) for node in (ends[0], between, ends[1]))
        self.refused_cleanly(*run, self.file("bad.xyz", larger), says=("bad.xyz", "box"))
        self.refused_cleanly(*run, self.folder / "missing.xyz", says="missing.xyz")

    def test_bad_paths_of_spheres_are_refused_in_one_line(self):
        pair = self.file("two.xyz", two_spheres())
        run = (*self.SPHERES, "--pair", pair, "--path")
        first, last = two_spheres(turn=0.0)[:len(two_spheres(turn=0.0)) // 2], two_spheres()
        middle = two_spheres(turn=40.0)
        path = self.file("path.xyz", middle + last[len(first):])
        result = self.done(*run, path)
        self.assertLessEqual(result["length"], result["length_before"])
        no_radii = "".join(frame(*p, header=HEADER.replace("4", "12")) for p in (("Ar 1 1 1", "Ar 2 1 1"),) * 3)
        self.refused_cleanly(*run, self.file("bad.xyz", no_radii), says=("bad.xyz", "radius"))
        self.refused_cleanly(*run, self.file("bad.xyz", two_spheres("0.4") + last[len(first):]), says=("bad.xyz", "radii"))
        overlap = first + frame("Ar 6 6 6 0.5", "Ar 6.5 6 6 0.5", header=SPHERE_HEADER.replace("4", "12")) + last[len(first):]
        self.refused_cleanly(*run, self.file("bad.xyz", overlap), says=("bad.xyz", "frame 2", "overlap"))

    def test_bad_options_are_refused_in_one_line(self):
        [pair] = self.make_pairs("ends")
        run = (*self.MONTE_CARLO, *ARGON, "--pair", pair)
        self.refused(*self.MONTE_CARLO, *ARGON, says="--pair")
        self.refused_cleanly("shorten", *ARGON, "--pair", pair, "--method", "walk", says=("walk", "montecarlo", "curve"))
        self.refused_cleanly(*run, "--path-method", "walk", says=("walk", "contour"))
        self.refused_cleanly(*run, "--path-method", "away", says="soft particles")
        self.refused_cleanly(*run, "--starts", "0", says="starts")
        self.refused_cleanly(*run, "--step", "0", says="step")
        self.refused_cleanly(*run, "--avoidance-step", "1e-4", says=("--avoidance-step", "method contour"))
        self.refused_cleanly(*run, "--landscape-energy", "-1e3", says="landscape energy")
        self.refused(*self.MONTE_CARLO, *ARGON, "--pair", pair, "--frames", "3", says=("--frames", "--out"))

    def test_a_finished_run_repeats_and_resumes_to_its_result(self):
        [pair] = self.make_pairs("ends")
        out, again = self.folder / "out", self.folder / "again"
        self.done(*self.MONTE_CARLO, *ARGON, "--pair", pair, "--out", out)
        before = contents(out)
        self.done("shorten", "--resume", out)
        self.assertEqual(contents(out), before)
        self.done("shorten", "--config", out / "run.toml", "--out", again)
        self.assertEqual(contents(again), before)


if __name__ == "__main__":
    unittest.main()
