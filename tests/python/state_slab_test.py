#!/usr/bin/python3
"""A short slab by state_slab, drawn by tools/plot_slab.py, and how both refuse.

Usage: state_slab_test.py STATE_SLAB
"""

import csv
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PLOT = ROOT / "tools" / "plot_slab.py"
PROGRAM = None
SHORT = ("--particles", "200", "--width", "6", "--length", "18", "--equilibration-steps", "100", "--sampling-steps", "100", "--bins", "18")


def run(*arguments):
    return subprocess.run([str(a) for a in arguments], stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=60)


class Slab(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="lanescape-slab-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_profiles_are_written_and_drawn(self):
        done = run(PROGRAM, "--model-file", ROOT / "docs" / "examples" / "liquid_vapour.toml", "--out", self.folder / "slab", *SHORT)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        rows = list(csv.DictReader((self.folder / "slab" / "profiles.csv").read_text().splitlines()))
        self.assertEqual(list(rows[0]), ["z", "density", "local_density", "probability_0", "probability_1", "sites"])
        self.assertEqual(len(rows), 18)
        self.assertAlmostEqual(sum(float(row["density"]) for row in rows) * 36.0, 200.0, delta=1e-9)
        self.assertEqual(run(PLOT, self.folder / "slab").returncode, 0)
        self.assertEqual((self.folder / "slab" / "profiles.png").read_bytes()[:4], b"\x89PNG")

    def test_bad_input_is_refused_in_one_line(self):
        for arguments in (("--temperature", "-1"), ("--model-file", "missing.toml"), ("--particles", "100000")):
            refused = run(PROGRAM, "--out", self.folder / "none", *SHORT, *arguments)
            self.assertEqual((refused.returncode, refused.stdout), (2, ""), arguments)
            self.assertRegex(refused.stderr, r"\Astate_slab: [^\n]+\n\Z")
            self.assertFalse((self.folder / "none").exists())
        refused = run(PLOT, self.folder)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("profiles.csv", refused.stderr)


if __name__ == "__main__":
    PROGRAM = Path(sys.argv.pop(1)).resolve()
    unittest.main()
