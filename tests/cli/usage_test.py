"""Usage: subcommands, help, messages, threads and instruction sets."""

import os
import re
import subprocess
import unittest

import numpy

from cli_support import (PROGRAM, DATA, SUBCOMMANDS, COMMON_OPTIONS, ARGON, TINY, TWO, ProgramTest, environment, frame,
                         lanescape, one_object, without_seconds)


class Usage(ProgramTest):
    def test_every_subcommand_has_help_with_the_common_options(self):
        for subcommand in SUBCOMMANDS:
            run = lanescape(subcommand, "--help")
            self.assertEqual((run.returncode, run.stderr), (0, ""))
            for option in COMMON_OPTIONS:
                self.assertRegex(run.stdout, rf"{option}\b", subcommand)

    def test_help_lists_the_subcommands_there_are_and_no_others(self):
        run = lanescape("--help")
        self.assertEqual(run.returncode, 0)
        listed = re.findall(r"^  ([a-z]+) ", run.stdout.split("Subcommands:")[1], re.MULTILINE)
        self.assertEqual(tuple(listed), SUBCOMMANDS)

    def test_what_nobody_has_asked_for_yet_is_absent(self):
        for subcommand in SUBCOMMANDS:
            text = lanescape(subcommand, "--help").stdout
            self.assertNotIn("swap", text, subcommand)
        self.refused("energy", self.file("two.xyz", frame(*TWO)), "--model", "water", says=("water", "kob-andersen", "ucg"))

    def test_version_is_printed(self):
        run = lanescape("--version")
        self.assertEqual(run.returncode, 0)
        self.assertEqual(run.stdout.strip(), self.done("info")["version"])

    def test_usage_errors_are_one_line_on_stderr(self):
        self.refused()
        self.refused("nonsense", says="nonsense")
        self.refused("info", "--nonsense", says="--nonsense")
        self.refused("info", "superfluous", says="superfluous")
        self.refused("info", "--seed", says="--seed")
        self.refused("energy", says="FILE")
        for bad in ("-1", "1.5", "x", "", "99999999999999999999"):
            self.refused("info", "--seed", bad, says="--seed")

    def test_thread_counts_below_one_are_refused(self):
        for bad in ("0", "-1", "100000", "x"):
            for subcommand in ("info", "endpoints", "verify", "cases"):
                self.refused(subcommand, "--threads", bad, says="--threads")

    def test_threads_come_from_the_flag_or_else_the_environment(self):
        self.assertEqual(self.done("info", OMP_NUM_THREADS="3")["threads"], 3)
        self.assertEqual(self.done("info", "--threads", "2", OMP_NUM_THREADS="3")["threads"], 2)

    def test_threads_are_those_of_the_affinity_mask_by_default(self):
        processor = min(os.sched_getaffinity(0))
        run = subprocess.run(["taskset", "-c", str(processor), PROGRAM, "info"], capture_output=True, text=True, env=environment())
        self.assertEqual(one_object(run.stdout)["threads"], 1)

    def test_stdout_that_cannot_be_written_is_an_internal_error(self):
        with open("/dev/full", "w") as full:
            run = subprocess.run([PROGRAM, "info"], stdout=full, stderr=subprocess.PIPE, text=True, env=environment())
        self.assertEqual(run.returncode, 3)
        self.assertIn("stdout", run.stderr)


class Info(ProgramTest):
    def test_info_has_the_keys_of_the_contract(self):
        result = self.done("info")
        self.assertLessEqual({"version", "compiler", "cpu", "isas", "isa", "threads"}, set(result))
        self.assertRegex(result["version"], r"^\d+\.\d+\.\d+$")
        self.assertIn(result["isa"], result["isas"])
        self.assertGreaterEqual(result["threads"], 1)


class InstructionSets(ProgramTest):
    def setUp(self):
        super().setUp()
        self.isas = self.done("info")["isas"]

    def test_every_available_one_runs_is_reported_and_agrees(self):
        energies = []
        for isa in self.isas:
            self.assertEqual(self.done("info", "--isa", isa)["isa"], isa)
            result = self.done("energy", DATA / "ka_melted_108.extxyz", "--isa", isa)
            self.assertEqual(result["isa"], isa)
            energies.append(result["energy"])
        numpy.testing.assert_allclose(energies, energies[0], rtol=1e-13)

    def test_the_best_one_is_the_default(self):
        self.assertEqual(self.done("info")["isa"], self.isas[-1])
        self.assertEqual(self.done("info", "--isa", "auto")["isa"], self.isas[-1])

    def test_the_environment_chooses_and_the_flag_wins_over_it(self):
        for isa in self.isas:
            self.assertEqual(self.done("info", LANESCAPE_ISA=isa)["isa"], isa)
            self.assertEqual(self.done("info", "--isa", isa, LANESCAPE_ISA=self.isas[0])["isa"], isa)

    def test_an_unknown_one_is_refused_by_every_subcommand(self):
        two = self.file("two.xyz", frame(*TWO))
        for arguments in (("info",), ("energy", two, *ARGON), ("endpoints", *ARGON, *TINY), ("path", *ARGON, *TINY), ("verify",),
                          ("cases", "--out", self.folder / "cases"), ("check", self.folder)):
            self.refused(*arguments, "--isa", "neon512", says=("neon512", "avx2"))
            self.refused(*arguments, LANESCAPE_ISA="neon512", says=("neon512", "avx2"))

    def test_one_seed_gives_the_same_end_points_twice_on_each(self):
        for isa in self.isas:
            first, second = (without_seconds(self.done("endpoints", *ARGON, *TINY, "--isa", isa)) for _ in range(2))
            self.assertEqual(first, second)
        self.assertNotEqual(first, without_seconds(self.done("endpoints", *ARGON, *TINY, "--isa", isa, "--seed", "2")))


if __name__ == "__main__":
    unittest.main()
