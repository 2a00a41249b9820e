"""End points of soft models."""

import os
import pty
import subprocess
import unittest
from pathlib import Path

import numpy

from cli_support import PROGRAM, ARGON, SLOWER, TINY, WARM, ProgramTest, environment, frame, lanescape, one_object, with_options


class EndPoints(ProgramTest):
    def test_json_and_files_are_those_of_the_contract(self):
        out = self.folder / "run"
        run = lanescape("endpoints", *ARGON, *TINY, "--pairs", "2", "--out", out)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        result = one_object(run.stdout)
        self.assertLessEqual({"pairs", "temperature"}, set(result))
        self.assertEqual(result["outcome"], "done")
        self.assertEqual(result, one_object((out / "result.json").read_text()))
        self.assertEqual([Path(p["file"]).name for p in result["pairs"]], ["pair-0001.extxyz", "pair-0002.extxyz"])
        self.assertLess(result["pairs"][0]["distance"], 1.1)
        for pair in result["pairs"]:
            self.assertEqual(set(pair), {"file", "distance", "steps", "time", "seconds"})
            self.assertGreaterEqual(pair["distance"], 1.0)
            self.assertAlmostEqual(pair["time"], pair["steps"] * 1e-3, delta=1e-12)
            lines = Path(pair["file"]).read_text().splitlines()
            self.assertEqual((len(lines), lines[0], lines[10]), (20, "8", "8"))
            ends = [numpy.array([[float(x) for x in line.split()[1:]] for line in lines[k:k + 8]]) for k in (2, 12)]
            moved = ends[1] - ends[0]
            self.assertAlmostEqual(numpy.linalg.norm(moved - moved.mean(axis=0)), pair["distance"], delta=1e-12)

    def test_seconds_of_a_pair_are_without_equilibration(self):
        run = self.done("endpoints", *ARGON, *with_options(TINY, "--melt-steps", "300000"))
        self.assertGreater(run["pairs"][0]["seconds"], 0.0)
        self.assertLess(run["pairs"][0]["seconds"], 0.5 * run["seconds"])

    def test_without_out_pairs_have_no_file(self):
        self.assertEqual([p["file"] for p in self.done("endpoints", *ARGON, *TINY)["pairs"]], [None])

    def test_a_start_configuration_is_taken_from_a_file(self):
        start = self.file("start.xyz", frame(*[f"Ar {x} {y} {z}" for x in (0, 2) for y in (0, 2) for z in (0, 2)]))
        out = self.folder / "run"
        self.done("endpoints", *ARGON, *WARM, "--start", start, "--out", out)
        self.assertIn('Lattice="4 0 0 0 4 0 0 0 4"', (out / "pair-0001.extxyz").read_text())

    def test_a_distance_beyond_the_steps_allowed_is_a_goal_not_reached(self):
        result = self.done("endpoints", *ARGON, *with_options(TINY, "--distance", "50", "--max-pair-steps", "20"), status=1)
        self.assertEqual((result["pairs"], result["outcome"]), ([], "distance not reached"))
        result = self.done("path", *ARGON, *with_options(TINY, "--distance", "50", "--max-pair-steps", "20"), status=1)
        self.assertEqual((result["paths"], result["mean_ratio_squared"]), ([], None))

    def test_a_temperature_that_is_not_held_is_a_goal_not_reached(self):
        result = self.done("endpoints", *ARGON, *with_options(TINY, "--check-tolerance", "1e-9", "--max-checks", "2"), status=1)
        self.assertEqual((result["pairs"], result["outcome"]), ([], "temperature not held"))

    def test_stderr_has_a_progress_bar_on_a_terminal_only(self):
        arguments = ("endpoints", *ARGON, *with_options(TINY, "--melt-steps", "1500000"))
        self.assertEqual(lanescape(*arguments).stderr, "")
        for quiet in (False, True):
            master, terminal = pty.openpty()
            run = subprocess.run([PROGRAM, *arguments, *(["--quiet"] if quiet else [])], stdout=subprocess.PIPE, stderr=terminal,
                                 env=environment(), timeout=60 * SLOWER)
            os.close(terminal)
            os.set_blocking(master, False)
            try:
                shown = os.read(master, 65536).decode()
            except OSError:
                shown = ""
            os.close(master)
            self.assertEqual(run.returncode, 0)
            one_object(run.stdout)
            self.assertEqual("melting" in shown and "/s" in shown, not quiet, shown)


if __name__ == "__main__":
    unittest.main()
