#!/usr/bin/python3
"""Runs that began on this processor and are continued on an emulated one without its instruction sets.

Usage: resume_test.py PROGRAM DATA_DIR QEMU [unittest arguments]. Exit status 77 if qemu-user is not installed.
"""

import subprocess
import sys
import unittest
from pathlib import Path

QEMU = sys.argv.pop(3)
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "cli"))
from cli_support import ARGON, PROGRAM, TINY, InterruptionTest, contents, environment, with_options  # noqa: E402

RUN = ("endpoints", *ARGON, *with_options(TINY, "--melt-steps", "600000", "--pairs", "2"))
EMULATED = {"Nehalem": "sse2", "Haswell": "avx2"}  # processors and their best instruction sets


class ResumingElsewhere(InterruptionTest):
    def resume(self, cpu, out):
        return subprocess.run([QEMU, "-cpu", cpu, PROGRAM, "endpoints", "--resume", out, "--quiet"], stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, timeout=600, env=environment())

    def interrupted(self, name, *options):
        out = self.folder / name
        self.interrupt(*RUN, *options, out=out, after="checkpoint/endpoints.h5", seconds=0.0)
        return out

    def test_a_run_with_an_instruction_set_of_both_processors_gets_the_same_bits(self):
        for cpu, isa in EMULATED.items():
            with self.subTest(cpu):
                whole = self.folder / f"whole-{isa}"
                self.done(*RUN, "--isa", isa, "--out", whole)
                out = self.interrupted(f"cut-{isa}", "--isa", isa)
                resumed = self.resume(cpu, out)
                self.assertEqual(resumed.returncode, 0, resumed.stderr)
                self.assertEqual(contents(out), contents(whole))

    def test_a_run_with_an_instruction_set_that_is_not_there_is_refused_and_stays_as_it_is(self):
        best = self.done("info")["isa"]
        for cpu, isa in EMULATED.items():
            if best in ("generic", "sse2", isa):
                continue  # the emulated processor has it too
            with self.subTest(cpu):
                out = self.interrupted(f"cut-{cpu}")
                before = {file: file.read_bytes() for file in out.rglob("*") if file.is_file()}
                refused = self.resume(cpu, out)
                self.assertEqual((refused.returncode, refused.stdout), (2, ""))
                said = "".join(line for line in refused.stderr.splitlines(True) if not line.startswith("qemu-"))  # its own warnings
                self.assertRegex(said, rf"\Alanescape: [^\n]*run\.toml: [^\n]*{best}[^\n]*\n\Z")
                self.assertEqual({file: file.read_bytes() for file in out.rglob("*") if file.is_file()}, before)
                self.done("endpoints", "--resume", out)


if __name__ == "__main__":
    if not Path(QEMU).is_file():
        print("skipped: qemu-x86_64 is not installed (Debian: qemu-user)")
        sys.exit(77)
    unittest.main()
