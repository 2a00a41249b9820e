#!/usr/bin/python3
"""tools/check_instructions.py with a fake valgrind that reports given counts: what passes, what fails and what is refused."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "tools" / "check_instructions.py"

PROGRAM = """#!{python}
import json, pathlib, sys
if sys.argv[1] == "--list":
    for case in json.loads(pathlib.Path("{folder}/counts.json").read_text())["sse2"]:
        print(case, 10)
else:
    assert sys.argv[1] == "--compiler"
    print("GNU 12.2.0")
"""
# 5000 instructions for the start of the program, plus the count in counts.json per round.
VALGRIND = """#!{python}
import json, pathlib, sys
if sys.argv[1] == "--version":
    print("valgrind-3.19.0")
    sys.exit(0)
tool, out, program, case, isa, rounds = sys.argv[1:]
assert tool == "--tool=callgrind" and out.startswith("--callgrind-out-file="), sys.argv
count = json.loads(pathlib.Path("{folder}/counts.json").read_text())[isa][case]
if count is None:
    print("instruction set", isa, "is not available here", file=sys.stderr)
    sys.exit(77)
pathlib.Path(out.split("=")[1]).write_text(f"events: Ir\\nfn=(1) main\\n1 5\\nsummary: {{5000 + int(rounds) * count}}\\n")
"""


class CheckInstructions(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.baseline = self.folder / "baseline.json"
        for name, text in (("program", PROGRAM), ("bin/valgrind", VALGRIND)):
            file = self.folder / name
            file.parent.mkdir(exist_ok=True)
            file.write_text(text.format(folder=self.folder, python=sys.executable))
            file.chmod(0o755)
        self.set_counts(dot=1000, axpy=200)
        self.check("--update")

    def set_counts(self, avx2=None, **counts):
        (self.folder / "counts.json").write_text(json.dumps({"sse2": counts, "avx2": {**counts, **(avx2 or {})}}))

    def set_baseline(self, **changed):
        self.baseline.write_text(json.dumps({**json.loads(self.baseline.read_text()), **changed}))

    def check(self, *arguments, path=None):
        environment = {**os.environ, "PATH": path or f"{self.folder / 'bin'}:{os.environ['PATH']}"}
        return subprocess.run([sys.executable, str(SCRIPT), str(self.folder / "program"), *arguments, "--baseline", str(self.baseline)],
                              capture_output=True, text=True, check=False, env=environment)

    def assert_status(self, status, *words, arguments=(), path=None):
        run = self.check(*arguments, path=path)
        self.assertEqual(run.returncode, status, run.stdout + run.stderr)
        for word in words:
            self.assertIn(word, run.stdout)
        return run

    def assert_refused(self, *words, arguments=()):
        run = self.check(*arguments)
        self.assertEqual((run.returncode, run.stdout), (2, ""), run.stderr)
        self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
        for word in words:
            self.assertIn(word, run.stderr)

    def test_the_start_of_the_program_is_not_counted(self):
        self.assertEqual(json.loads(self.baseline.read_text()),
                         {"compiler": "GNU 12.2.0", "valgrind": "valgrind-3.19.0",
                          "instructions": {isa: {"dot": 1000.0, "axpy": 200.0} for isa in ("sse2", "avx2")}})

    def test_the_baseline_itself_passes(self):
        run = self.assert_status(0)
        self.assertEqual(len(run.stdout.splitlines()), 4, run.stdout)

    def test_six_per_cent_more_fail(self):
        self.set_counts(dot=1000, axpy=200, avx2={"dot": 1060})
        self.assert_status(1, "+6.0%", "more instructions than the baseline: dot on avx2")

    def test_four_per_cent_more_pass(self):
        self.set_counts(dot=1040, axpy=208)
        self.assert_status(0, "+4.0%")

    def test_six_per_cent_less_ask_for_a_new_baseline(self):
        self.set_counts(dot=940, axpy=200)
        self.assert_status(0, "-6.0%", "renew the baseline with --update")

    def test_a_case_without_baseline_is_refused(self):
        self.set_counts(dot=1000, axpy=200, norm=3)
        self.assert_refused("no baseline for norm on sse2", "--update")

    def test_a_baseline_without_case_is_refused(self):
        self.set_counts(dot=1000)
        self.assert_refused("axpy", "the program has not")

    def test_a_missing_baseline_is_refused(self):
        self.baseline.unlink()
        self.assert_refused("baseline.json")

    def test_an_unknown_case_is_refused(self):
        self.assert_refused("unknown case norm", "dot, axpy", arguments=["norm"])

    def test_single_cases_are_counted_and_renewed_alone(self):
        self.set_counts(dot=2000, axpy=300, norm=3)
        self.check("norm", "--update")
        counts = json.loads(self.baseline.read_text())["instructions"]["avx2"]
        self.assertEqual(counts, {"dot": 1000.0, "axpy": 200.0, "norm": 3.0})
        self.assert_status(0, "norm", arguments=["norm"])
        self.assert_status(1, "dot", arguments=["dot", "norm"])

    def test_another_major_version_of_the_compiler_is_skipped(self):
        self.set_baseline(compiler="GNU 13.1.0")
        self.assert_status(77, "skipped: this is GNU 12.2.0, the baseline is of GNU 13.1.0")
        self.set_baseline(compiler="GNU 12.3.0")
        self.assert_status(0)

    def test_without_valgrind_it_is_skipped(self):
        self.assert_status(77, "skipped: valgrind is not installed", path=str(self.folder))

    def test_an_instruction_set_that_is_not_here_is_skipped_and_the_other_counted(self):
        self.set_counts(dot=1000, axpy=200, avx2={"dot": None, "axpy": None})
        self.assert_status(77, "avx2  skipped: instruction set avx2 is not available here", "sse2  dot")
        self.set_counts(dot=1100, axpy=200, avx2={"dot": None, "axpy": None})
        self.assert_status(1, "dot on sse2")


if __name__ == "__main__":
    unittest.main()
