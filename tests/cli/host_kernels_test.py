"""Kernels of a host in a shared library (host/right_kernel.c and host/wrong_kernels.c), checked by verify.

Usage: host_kernels_test.py PROGRAM DATA_DIR FOLDER_OF_LIBRARIES [unittest arguments]
"""

import os
import signal
import subprocess
import sys
import time
import unittest
import xml.etree.ElementTree
from pathlib import Path

from cli_support import DATA, PROGRAM, SLOWER, ProgramTest, lanescape

LIBRARIES = Path(sys.argv.pop(1))
DOUBLE, SINGLE = LIBRARIES / "host_kernels.so", LIBRARIES / "host_kernels_single.so"
QUANTITIES = ["energy", "forces", "virial"]


class HostTest(ProgramTest):
    def verify(self, symbol, *options, library=DOUBLE, status=0):
        return self.done("verify", "--library", library, "--symbol", symbol, *options, status=status)

    def wrong(self, symbol, *options, says, **more):
        """A failed check whose summary, and whose line on stderr, contain all of `says`."""
        result = self.verify(symbol, *options, status=1, **more)
        self.assertIs(result["passed"], False)
        for part in says:
            self.assertIn(part, result["summary"])
        return result


class RightKernels(HostTest):
    def test_a_right_kernel_passes_in_all_cases_within_ten_seconds(self):
        start = time.monotonic()
        result = self.verify("right_kernel")
        self.assertLess(time.monotonic() - start, 10)
        self.assertIs(result["passed"], True)
        self.assertGreater(result["cases"], 900)
        self.assertEqual([result[key] for key in ("compared", "failed", "declined", "missing", "left_out")], [result["cases"], 0, 0, 0, 0])
        self.assertEqual([q["quantity"] for q in result["quantities"]], QUANTITIES)
        for quantity in result["quantities"]:
            self.assertEqual(quantity["cases"], result["cases"])
            self.assertLess(quantity["worst"], quantity["tolerance"] / 5)

    def test_a_kernel_in_single_precision_passes_as_such_and_fails_as_double(self):
        self.wrong("right_kernel", library=SINGLE, says=("the cutoff", "energy: expected -0.0163"))
        result = self.verify("right_kernel", "--precision", "single", library=SINGLE)
        self.assertEqual(result["precision"], "single")
        self.assertEqual(result["compared"] + result["left_out"], result["cases"])
        self.assertGreaterEqual(result["left_out"], 10)
        self.assertLess(result["left_out"], 30)
        for quantity in result["quantities"]:
            self.assertLess(1e-7, quantity["worst"])

    def test_files_of_the_user_are_further_cases(self):
        cases = self.verify("right_kernel")["cases"]
        more = self.verify("right_kernel", DATA / "ka_melted_108.extxyz", "--truncation", "smooth")
        self.assertEqual((more["cases"], more["failed"]), (cases + 2, 0))

    def test_a_quantity_that_is_not_computed_is_not_compared(self):
        result = self.verify("has_no_virial")
        self.assertEqual([q["cases"] for q in result["quantities"]], [result["cases"], result["cases"], 0])

    def test_declined_cases_are_counted_and_the_others_compared(self):
        result = self.verify("declines_all_but_one")
        self.assertEqual((result["compared"], result["declined"]), (1, result["cases"] - 1))

    def test_children_of_a_kernel_do_not_go_on_with_the_cases(self):
        self.assertEqual(self.verify("leaves_a_child")["failed"], 0)

    def test_what_a_kernel_prints_does_not_mix_with_the_result(self):
        run = lanescape("verify", "--library", DOUBLE, "--symbol", "chats")
        self.assertTrue(run.stdout.startswith("{"))
        self.assertNotIn("case pair out of range (box)", run.stdout)
        self.assertIn("case pair out of range (box)", run.stderr)


class WrongKernels(HostTest):
    def test_missing_own_images_are_found(self):
        result = self.wrong("without_own_images", says=("N=1 all", "energy: expected", "got 0", "virial"))
        self.assertEqual([q["passed"] for q in result["quantities"]], [False, True, False])
        self.assertEqual([f for f in result["failures"] if "minimum" in f["case"]], [])

    def test_a_shift_that_is_wrong_by_a_millionth_is_found(self):
        result = self.wrong("with_a_wrong_shift", says=("energy: expected",))
        self.assertEqual([q["passed"] for q in result["quantities"]], [False, True, True])

    def test_a_kernel_that_declines_every_case_fails(self):
        result = self.wrong("declines_everything", says=("no case", "declined"))
        self.assertEqual((result["compared"], result["declined"]), (0, result["cases"]))

    def test_a_crash_is_the_fault_of_its_case_alone(self):
        result = self.wrong("crashes_in_one_case", says=("1 of", "'pair across a corner (box)'", "SIGABRT"))
        self.assertEqual([f["case"] for f in result["failures"]], ["pair across a corner (box)"])

    def test_a_kernel_that_ends_the_process_is_named_with_its_case(self):
        result = self.wrong("ends_the_process", says=("'slab kob-andersen all tail'", "exit status 0"))
        self.assertEqual(result["failed"], 1)

    def test_a_kernel_that_never_returns_is_given_up_after_three_cases(self):
        start = time.monotonic()
        messages = [f["message"] for f in self.wrong("never_returns", says=("did not return within",))["failures"]]
        self.assertLess(time.monotonic() - start, 20)
        self.assertEqual([sum(words in m for m in messages) for words in ("did not return within", "was not called")], [3, len(messages) - 3])

    def test_an_interruption_prints_no_result(self):
        process = subprocess.Popen([PROGRAM, "verify", "--library", str(DOUBLE), "--symbol", "never_returns"], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True, start_new_session=True)
        time.sleep(1.0)
        os.killpg(process.pid, signal.SIGINT)  # as a terminal does
        stdout, stderr = process.communicate(timeout=20 * SLOWER)
        self.assertEqual((process.returncode, stdout, stderr), (4, "", "lanescape: interrupted: no result is printed\n"))

    def test_nan_is_a_failure_that_names_particle_and_component(self):
        result = self.wrong("gives_nan", says=("force on particle 5 (from 0), y", "got nan"))
        forces = result["quantities"][1]
        self.assertEqual((forces["particle"], forces["component"], forces["got"], forces["worst"]), (5, "y", None, None))
        self.assertEqual([q["passed"] for q in result["quantities"]], [True, False, True])

    def test_a_quantity_that_is_announced_and_not_written_is_found(self):
        self.wrong("forgets_the_virial", says=("virial", "got nan"))

    def test_other_faults_are_named(self):
        self.wrong("computes_nothing", says=("neither energy nor forces nor virial",))
        self.wrong("writes_beyond_its_forces", says=("wrote beyond",))
        self.wrong("returns_seven", says=("returned 7", "0 (done) and 1 (declined)"))


class Reports(HostTest):
    def junit(self, symbol, *options, **more):
        file = self.folder / f"{symbol}.xml"
        result = self.verify(symbol, "--junit", file, *options, **more)
        return result, xml.etree.ElementTree.parse(file).getroot()

    def test_junit_has_a_test_case_for_each_case(self):
        result, root = self.junit("right_kernel")
        names = [case.get("name") for case in root.iter("testcase")]
        self.assertEqual((len(names), len(set(names))), (result["cases"], result["cases"]))
        self.assertEqual(list(root.iter("failure")), [])

    def test_junit_names_failures_and_what_was_not_compared(self):
        result, root = self.junit("crashes_in_one_case", "--precision", "single", status=1)
        [failure] = root.iter("failure")
        self.assertIn("SIGABRT", failure.get("message"))
        self.assertEqual(len(list(root.iter("skipped"))), result["left_out"])

    def test_junit_of_a_kernel_that_declines_everything_has_a_failure(self):
        result, root = self.junit("declines_everything", status=1)
        self.assertEqual(len(list(root.iter("skipped"))), result["cases"])
        self.assertEqual(len(list(root.iter("failure"))), 1)

    def test_a_failure_is_one_line_on_stderr(self):
        run = lanescape("verify", "--library", DOUBLE, "--symbol", "without_own_images")
        self.assertRegex(run.stderr, r"\A\d+ of \d+ cases are wrong, the worst is [^\n]+\n\Z")


class Refusals(HostTest):
    def test_libraries_and_functions_that_are_not_there_are_refused(self):
        self.refused_cleanly("verify", "--library", self.folder / "none.so", "--symbol", "f", says=("none.so", "no such file"))
        self.refused_cleanly("verify", "--library", self.file("text.so", "text"), "--symbol", "f", says=("text.so", "shared library"))
        self.refused_cleanly("verify", "--library", self.folder, "--symbol", "f", says=(str(self.folder), "shared library"))
        self.refused_cleanly("verify", "--library", DOUBLE, "--symbol", "nobody", says=("host_kernels.so", "'nobody'"))

    def test_options_that_do_not_go_together_are_refused(self):
        self.refused_cleanly("verify", "--library", DOUBLE, says=("--library", "--symbol"))
        self.refused_cleanly("verify", "--symbol", "f", says=("--symbol", "--library"))
        self.refused_cleanly("verify", "--precision", "single", says=("--precision", "--library"))
        self.refused_cleanly("verify", "--library", DOUBLE, "--symbol", "right_kernel", "--isa", "sse2", says=("--isa", "--library"))
        self.refused_cleanly("verify", "--library", DOUBLE, "--symbol", "right_kernel", "--precision", "mixed", says=("mixed", "double, single"))

    def test_a_check_that_is_resumed_repeats_its_result(self):
        first = self.verify("has_no_virial", "--precision", "single", "--out", self.folder / "run")
        self.assertEqual(self.done("verify", "--resume", self.folder / "run"), first)


if __name__ == "__main__":
    unittest.main()
