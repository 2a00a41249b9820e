"""Figures: where the program looks for plot.py, and what it says where they cannot be drawn."""

import shutil
import unittest
from pathlib import Path
from unittest import mock

import cli_support
from cli_support import ARGON, TINY, ProgramTest, lanescape, one_object

TOOLS = Path(__file__).resolve().parents[2] / "tools"
RUN = ("path", *ARGON, *TINY, "--max-steps", "100000", "--threads", "1", "--plot")


class Plots(ProgramTest):
    def setUp(self):
        super().setUp()
        self.prefix = self.folder / "prefix"
        self.script = self.prefix / "share" / "lanescape" / "plot.py"
        (self.prefix / "bin").mkdir(parents=True)
        program = shutil.copy(cli_support.PROGRAM, self.prefix / "bin" / "lanescape")
        patch = mock.patch.object(cli_support, "PROGRAM", program)
        patch.start()
        self.addCleanup(patch.stop)

    def write_script(self, text):
        self.script.parent.mkdir(parents=True)
        self.script.write_text(text)

    def refused_before_the_run(self, says):
        out = self.folder / "new" / "out"
        self.refused(*RUN, "--out", out, says=says)
        self.assertFalse(out.parent.exists())

    def test_a_moved_program_draws_with_the_scripts_of_its_prefix(self):
        shutil.copytree(TOOLS, self.script.parent, ignore=shutil.ignore_patterns("lanescape"))
        out = self.folder / "out"
        self.assertEqual(lanescape(*RUN, "--out", out).stderr, "")
        self.assertEqual((out / "path-0001.png").read_bytes()[:4], b"\x89PNG")

    def test_without_the_script_nothing_is_run(self):
        self.refused_before_the_run(("--plot", str(self.script), "is missing"))

    def test_a_python_without_its_modules_is_found_out_before_the_run(self):
        self.write_script("import a_module_that_nobody_has\n")
        self.refused_before_the_run(("--plot", str(self.script), "numpy and matplotlib"))

    def test_figures_that_fail_after_the_run_are_an_error_and_leave_its_results(self):
        self.write_script("import sys\nprint('a traceback')\nsys.exit(sys.argv[1] != '--help')\n")
        for more in ((), ("--quiet",)):
            out = self.folder / f"out{len(more)}"
            run = lanescape(*RUN, *more, "--out", out)
            self.assertEqual(run.returncode, 1, run.stderr)
            self.assertRegex(run.stderr, r"\Alanescape: --plot: no figures in [^\n]+\n\Z")
            self.assertEqual(one_object(run.stdout)["paths"][0]["outcome"], "reached")
            self.assertTrue((out / "result.json").exists())


if __name__ == "__main__":
    unittest.main()
