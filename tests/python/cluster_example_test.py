"""docs/examples/cluster: end points, paths and their table by Snakemake on this machine, with a run that is interrupted.

Usage: cluster_example_test.py PROGRAM [unittest arguments]. 77: skipped, with the reason. LANESCAPE_SNAKEMAKE may name Snakemake; else it is
that on PATH, or that of PyPI in an environment of its own.
"""

import csv
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from environments import snakemake  # noqa: E402

if len(sys.argv) < 2:
    sys.exit(__doc__)
PROGRAM = Path(sys.argv.pop(1)).resolve()
EXAMPLE = Path(__file__).resolve().parents[2] / "docs" / "examples" / "cluster"

# Ends its first run of end points as a cluster does, and keeps the status of every run.
INTERRUPTING = """#!/bin/sh
if [ "$1" = endpoints ] && mkdir first 2> /dev/null; then
  timeout --preserve-status --signal=TERM 0.1 "{program}" "$@"
else
  "{program}" "$@"
fi
status=$?
echo $status >> statuses
exit $status
"""


class ClusterExample(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="lanescape-cluster-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def snakemake(self, *arguments, program=PROGRAM, status=0):
        run = subprocess.run([SNAKEMAKE, "-s", EXAMPLE / "Snakefile", "--cores", "2", *arguments, "--config", f"program={program}", "quick=True",
                              "temperatures=2", "pairs=2"], cwd=self.folder, capture_output=True, text=True, timeout=300)
        self.assertEqual(run.returncode, status, run.stdout + run.stderr)
        return run.stdout + run.stderr

    def rows(self):
        with open(self.folder / "campaign" / "paths.csv", encoding="utf-8") as file:
            return [{name: value for name, value in row.items() if name != "seconds"} for row in csv.DictReader(file)]

    def test_a_dry_run_lists_the_jobs_and_runs_none(self):
        jobs = self.snakemake("--dry-run")
        self.assertRegex(jobs, r"endpoints +1\s")
        self.assertRegex(jobs, r"path +2\s")
        self.assertFalse((self.folder / "campaign" / "paths.csv").exists())

    def test_paths_come_into_one_table_interrupted_or_not(self):
        self.snakemake()
        whole = self.rows()
        self.assertEqual([(row["temperature"], row["pair"], row["outcome"]) for row in whole], [("2", "1", "reached"), ("2", "2", "reached")])
        self.assertIn("Nothing to be done", self.snakemake())
        shutil.rmtree(self.folder / "campaign")

        program = self.folder / "interrupting.sh"
        program.write_text(INTERRUPTING.format(program=PROGRAM))
        program.chmod(0o755)
        self.snakemake("--retries", "2", program=program)
        self.assertEqual((self.folder / "statuses").read_text().split(), ["4", "0", "0", "0"])
        self.assertEqual(self.rows(), whole)

    def test_bad_input_fails_after_its_tries(self):
        self.snakemake("--until", "endpoints", program="/bin/false", status=1)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory(prefix="lanescape-snakemake-") as name:
        SNAKEMAKE = snakemake(Path(name))
        unittest.main()
