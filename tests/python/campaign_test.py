"""The campaign of docs/VALIDATION.md in its size `smoke`, with a run that is interrupted, and what is kept of it.

Usage: campaign_test.py PROGRAM [unittest arguments]. 77: skipped, with the reason. LANESCAPE_SNAKEMAKE may name Snakemake; else it is that on PATH, or that of
PyPI in an environment of its own.
"""

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(PROJECT / "tests" / "support"), str(PROJECT / "campaigns")]
import keep  # noqa: E402
from data import Chapter  # noqa: E402
from environments import snakemake  # noqa: E402

if len(sys.argv) < 2:
    sys.exit(__doc__)
PROGRAM = Path(sys.argv.pop(1)).resolve()
CHAPTERS = ("soft", "hard", "diffusion")


class Campaign(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="lanescape-campaign-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.command = [SNAKEMAKE, "-s", PROJECT / "campaigns" / "Snakefile", "--cores", "2"]

    def config(self, size="smoke"):
        return ["--config", f"size={size}", f"program={PROGRAM}", f"out={self.folder}/out"]

    def run_campaign(self, *arguments, size="smoke"):
        run = subprocess.run([*self.command, *arguments, *self.config(size)], cwd=self.folder, capture_output=True, text=True, timeout=600)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        return run.stdout + run.stderr

    def stop_early(self):
        """Kills a campaign as soon as some of its runs have ended."""
        running = subprocess.Popen([*self.command, *self.config()], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        while running.poll() is None and len(list(self.folder.glob("out/*/*/result.json"))) < 5:
            time.sleep(0.05)
        os.killpg(running.pid, signal.SIGKILL)
        running.wait()
        return {file: file.stat().st_mtime_ns for file in self.folder.glob("out/*/*/result.json")}

    def test_it_goes_on_where_it_was_and_every_chapter_is_analysed_and_kept(self):
        before = self.stop_early()
        self.assertGreaterEqual(len(before), 5)
        self.run_campaign("--unlock")
        self.run_campaign("--rerun-incomplete")
        self.assertIn("Nothing to be done", self.run_campaign())
        kept_before = sum(file.stat().st_mtime_ns == changed for file, changed in before.items())
        self.assertGreaterEqual(kept_before, len(before) - 2)  # two jobs may have been about to end

        keep.KEPT = self.folder / "kept"
        for name in CHAPTERS:
            keep.keep(str(PROGRAM), self.folder / "out", name, "smoke")
            self.check(Chapter(name, keep.KEPT))

    def check(self, chapter):
        self.assertGreater(len(chapter.groups), 2)
        runs = json.loads((self.folder / "out" / chapter.name / "analysis" / "result.json").read_text(encoding="utf-8"))["groups"]
        self.assertEqual([group["group"] for group in runs], [group["group"] for group in chapter.groups])
        for group in chapter.groups:
            self.assertEqual(group["reached"], group["paths"], group["group"])
            if group["kind"] in ("path", "shorten"):
                mean = float(chapter.means[group["group"], "ratio_squared"]["mean"])
                self.assertTrue(0.0 < mean <= 1.0, group["group"])
        self.assertLessEqual({"command", "version", "isa", "cpu", "date", "core_hours"}, set(chapter.provenance))

    def test_every_size_has_its_runs_with_the_profile_of_this_machine(self):
        profile = PROJECT / "campaigns" / "profiles" / "local"
        for size, at_least in (("smoke", 40), ("committed", 300), ("full", 600)):
            listed = self.run_campaign("--dry-run", "--profile", profile, size=size)
            self.assertGreater(int(re.search(r"\nrun +(\d+)", listed).group(1)), at_least)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory(prefix="lanescape-snakemake-") as name:
        SNAKEMAKE = snakemake(Path(name))
        unittest.main()
