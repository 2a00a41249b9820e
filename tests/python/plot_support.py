"""Shared by the tests of tools/plot.py: a folder of a run, its figures, and the message of a refusal."""

import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[2] / "tools" / "plot.py"


class PlotTest(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def plot(self):
        return subprocess.run([sys.executable, str(SCRIPT), str(self.folder)], capture_output=True, text=True, check=False)

    def figures(self):
        return sorted(file.name for file in self.folder.glob("*.png"))

    def assert_draws(self, *names):
        run = self.plot()
        self.assertEqual((run.returncode, run.stdout, run.stderr), (0, "", ""))
        self.assertEqual(self.figures(), sorted(names))
        for name in names:
            data = (self.folder / name).read_bytes()
            self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
            width, height = struct.unpack(">II", data[16:24])
            self.assertTrue(900 <= width <= 2500 and 700 <= height <= 2500, f"{name}: {width} x {height}")
            self.assertGreater(len(data), 20_000, name)

    def assert_refuses(self, named):
        run = self.plot()
        self.assertEqual((run.returncode, run.stdout), (2, ""))
        self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
        self.assertIn(named, run.stderr)
        self.assertEqual(self.figures(), [])
