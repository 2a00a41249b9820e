"""Runs on a disk that is full and in too little memory: one line, nothing half-written, and the run goes on when there is room.

Usage: shortage_test.py PROGRAM DATA_DIR [unittest arguments]. 77: skipped, with the reason: a small disk needs the right to mount one.
"""

import os
import resource
import subprocess
import sys
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent / "cli"), str(HERE.parent / "support")]
from environments import skip  # noqa: E402

INSIDE = "LANESCAPE_IN_OWN_MOUNTS"
if INSIDE not in os.environ:
    for options in (["-m"], ["-r", "-m"]):
        if subprocess.run(["unshare", *options, "mount", "-t", "tmpfs", "tmpfs", "/mnt"], capture_output=True).returncode == 0:
            os.environ[INSIDE] = "1"
            os.execvp("unshare", ["unshare", *options, sys.executable, *sys.argv])
    skip("mounting a file system is not allowed here, with and without a namespace of users")

from cli_support import ARGON, FLUID, PROGRAM, TINY, ProgramTest, contents, environment, one_object, with_options, without_seconds  # noqa: E402

RUNS = {
    "endpoints": ("endpoints", *ARGON, *with_options(TINY, "--melt-steps", "500000", "--pairs", "40")),
    "path": ("path", *ARGON, *with_options(FLUID, "--pairs", "3")),
    "diffusion": ("diffusion", "--model", "hard-sphere", "--particles", "32", "--packing-fraction", "0.3", "--equilibration-collisions", "20000", "--interval", "0.01",
                  "--lags", "500", "--records", "5000", "--trajectories", "3", "--between", "1000"),
    "flow": ("flow", "--velocity", "0.3", "--length", "20", "--width", "6", "--equilibration-steps", "300", "--resting-steps", "300", "--flow-steps", "600",
             "--sampling-steps", "300", "--row-steps", "100"),
}


class Shortage(ProgramTest):
    def disk(self, kibibytes, *, again=False):
        subprocess.run(["mount", "-t", "tmpfs", "-o", ("remount," if again else "") + f"size={kibibytes}k", "tmpfs", self.mount], check=True)

    def test_a_full_disk_gives_one_line_and_the_run_goes_on_with_room(self):
        self.mount = self.folder / "disk"
        self.mount.mkdir()
        for name, line in RUNS.items():
            whole = self.folder / name
            self.done(*line, "--out", whole)
            size = sum(file.stat().st_size for file in whole.rglob("*") if file.is_file()) // 1024
            refused = 0
            for share in (0.05, 0.2, 0.5, 0.8, 0.95):
                self.disk(max(8, int(size * share)))
                out = self.mount / name
                run = self.run_once(*line, "--resume-or-start", out)
                refused += run.returncode == 2
                if run.returncode != 0:
                    self.assertEqual((run.returncode, run.stdout), (2, ""), f"{name}, {share}: {run.stderr}")
                    self.assertRegex(run.stderr, r"\Alanescape: [^\n]*(No space left on device|cannot write)[^\n]*\n\Z")
                    self.assertEqual(list(self.mount.rglob(".lanescape-*")), [])
                self.disk(16 * size + 1024, again=True)
                self.done(*line, "--resume-or-start", out)
                self.assertEqual(contents_but_options(out), contents_but_options(whole))
                subprocess.run(["umount", self.mount], check=True)
            self.assertGreaterEqual(refused, 3, name)

    def run_once(self, *arguments, **options):
        return subprocess.run([PROGRAM, *map(str, arguments)], stdin=subprocess.DEVNULL, capture_output=True, text=True, env=environment(), timeout=120, **options)

    def test_too_little_memory_gives_one_line(self):
        """Limits of the address space from too little to start with to enough."""
        failures = 0
        for name, line in RUNS.items():
            expected = without_seconds(self.done(*line))
            for mebibytes in (40, 60, 70, 80, 90, 100, 120, 160, 250, 1000):
                limit = mebibytes << 20
                run = self.run_once(*line, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
                if run.returncode == 127:  # the loader has no room for libraries
                    continue
                if run.returncode == 0:
                    self.assertEqual(without_seconds(one_object(run.stdout)), expected)
                    continue
                failures += 1
                self.assertEqual((run.returncode, run.stdout), (3, ""), f"{name}, {mebibytes} MiB: {run.stderr}")
                self.assertEqual(len(run.stderr.splitlines()), 1, run.stderr)
        self.assertGreater(failures, 0)


def contents_but_options(folder):
    return {name: content for name, content in contents(folder).items() if name != "run.toml"}


if __name__ == "__main__":
    unittest.main()
