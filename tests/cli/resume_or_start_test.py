"""--resume-or-start: the same line starts a run, continues it, and leaves a finished one alone."""

import os
import signal
import subprocess
import time
import unittest

from cli_support import DATA, ARGON, FLUID, GROWTH, SCAN, SLOWER, TAIL, TINY, InterruptionTest, contents, one_object, with_options, without_seconds

LONG_ENDS = ("endpoints", *ARGON, *with_options(TINY, "--melt-steps", "3000000", "--pairs", "2"))
INTO = "--resume-or-start"


class ResumeOrStart(InterruptionTest):
    def whole(self, *arguments):
        folder = self.folder / "whole"
        self.done(*arguments, "--out", folder)
        return folder

    def test_one_line_starts_continues_and_then_leaves_alone(self):
        whole, out = self.whole(*LONG_ENDS), self.folder / "a" / "run"
        result = self.interrupt(*LONG_ENDS, out=out, into=INTO)
        self.assertEqual(result["outcome"], "interrupted")
        finished = self.done(*LONG_ENDS, INTO, out)
        self.assertEqual(without_seconds(finished), without_seconds(one_object((whole / "result.json").read_text())))
        self.assertEqual(contents(out), contents(whole))
        before = {file: file.stat().st_mtime_ns for file in out.rglob("*")}
        self.assertEqual(self.done(*LONG_ENDS, INTO, out), finished)
        self.assertEqual(self.done("endpoints", INTO, out), finished)
        self.assertEqual({file: file.stat().st_mtime_ns for file in out.rglob("*")}, before)

    def test_a_killed_run_continues_with_whole_checkpoints(self):
        """As a batch system ends a job: SIGTERM, and SIGKILL while the result is being written or before."""
        whole, out = self.whole(*LONG_ENDS), self.folder / "run"
        for delay in (0.0, 0.001, 0.01):
            process = self.start(*LONG_ENDS, out=out, into=INTO)
            self.wait_for(process, out / "checkpoint" / "endpoints.h5")
            time.sleep(0.1)
            process.send_signal(signal.SIGTERM)
            time.sleep(delay)
            process.kill()
            self.assertIn(process.wait(), (-signal.SIGKILL, -signal.SIGTERM, 4))  # SIGTERM: it had not begun to listen
        for folder in (out, out / "checkpoint"):  # being written when it was killed
            (folder / ".lanescape-1-0.tmp").write_text("half")
        self.done(*LONG_ENDS, INTO, out)
        self.assertEqual(contents(out), contents(whole))
        self.assertLessEqual({file.name for file in (out / "checkpoint").iterdir()}, {"endpoints.h5", "endpoints.h5.previous"})

    def test_a_folder_with_no_run_starts_one(self):
        for prepare in (lambda folder: None, lambda folder: folder.mkdir(), lambda folder: (folder / "checkpoint").mkdir(parents=True)):
            out = self.folder / "run"
            prepare(out)
            self.done("endpoints", *ARGON, *TINY, f"{INTO}={out}")
            self.assertTrue((out / "result.json").exists())
            subprocess.run(["rm", "-r", out], check=True)

    def test_a_finished_run_keeps_its_status(self):
        [pair] = self.make_pairs("ends")
        line = ("path", *ARGON, "--pair", pair, "--max-steps", "50", INTO, self.folder / "limit")
        first = self.done(*line, status=1)
        self.assertEqual(first["exit_status"], 1)
        self.assertEqual(self.done(*line, status=1), first)

    def test_a_finished_run_needs_none_of_its_input(self):
        [pair] = self.make_pairs("ends")
        line = ("path", *ARGON, "--pair", pair, INTO, self.folder / "run")
        first = self.done(*line)
        os.remove(pair)
        self.assertEqual(self.done(*line), first)

    def test_a_result_that_is_lost_or_damaged_is_made_again(self):
        out = self.folder / "run"
        first = self.done("endpoints", *ARGON, *TINY, INTO, out)
        for damage in (lambda file: file.unlink(), lambda file: file.write_text(file.read_text()[:30]), lambda file: file.write_text("[]")):
            damage(out / "result.json")
            self.assertEqual(self.done("endpoints", *ARGON, *TINY, INTO, out), first)

    def test_every_subcommand_takes_it(self):
        for arguments in (("info",), ("energy", DATA / "ka_tiny_8.extxyz", "--forces"), ("overlap", self.spheres()),
                          ("path", *ARGON, *FLUID, "--max-steps", "5000000"), SCAN, GROWTH,
                          ("insert", DATA / "ar_dilute_63.extxyz", *TAIL, "--energy", "mean", "--count", "2")):
            out = self.folder / f"run-{len(list(self.folder.iterdir()))}"
            first = self.done(*arguments, INTO, out)
            before = contents(out)
            self.assertEqual(without_seconds(self.done(*arguments, INTO, out)), without_seconds(first))
            self.assertEqual(contents(out), before)

    def spheres(self):
        text = '2\nLattice="5 0 0 0 5 0 0 0 5" Properties=species:S:1:pos:R:3:radius:R:1 pbc="T T T"\nXe 0 0 0 0.5\nXe 2 2 2 0.5\n'
        return self.file("spheres.xyz", text)

    def test_options_that_contradict_the_run_are_refused(self):
        out = self.folder / "run"
        self.done("endpoints", *ARGON, *TINY, INTO, out)
        before = contents(out)
        for option, value, own in (("--seed", "2", "1"), ("--temperature", "2.5", "2:"), ("--model", "wca", "lennard-jones"),
                                   ("--images", "all", "minimum"), ("--isa", "generic", self.done("info")["isa"]), ("--pairs", "2", "none")):
            line = ("endpoints", *with_options((*ARGON, *TINY), option, value), INTO, out)
            self.refused(*line, says=(f"{option} {value} contradicts {out}/run.toml", f"has {own}"))
        self.refused("endpoints", *ARGON, *TINY, "--quick", INTO, out, says="--quick true contradicts")
        config = self.file("other.toml", "seed = 3\n")
        self.refused("endpoints", *ARGON, *TINY, "--config", config, INTO, out, says="--seed 3 contradicts")
        self.refused("path", *ARGON, *TINY, INTO, out, says=("run.toml", "endpoints", "path"))
        self.assertEqual(contents(out), before)

    def test_options_that_say_the_same_otherwise_are_not(self):
        out = self.folder / "run"
        first = self.done("endpoints", *ARGON, *TINY, INTO, out)
        config = self.file("same.toml", f'seed = 1\nmodel = "lennard-jones"\nout = "{self.folder / "elsewhere"}"\n')
        for same in (("--temperature", "2.0"), ("--temperature", "2e0"), ("--threads", "2"), ("--isa", "auto")):
            self.assertEqual(self.done("endpoints", *with_options((*ARGON, *TINY), *same), INTO, out), first)
        self.assertEqual(self.done("endpoints", "--quiet", "--config", config, INTO, out), first)
        self.assertFalse((self.folder / "elsewhere").exists())

    def test_a_named_default_contradicts_its_opposite(self):
        [pair] = self.make_pairs("ends")
        out = self.folder / "run"
        self.done("path", *ARGON, "--pair", pair, "--faithful", INTO, out)
        self.done("path", *ARGON, "--pair", pair, "--faithful", INTO, out)
        self.refused("path", *ARGON, "--pair", pair, "--adaptive", INTO, out, says=("--adaptive", "contradicts"))

    def test_other_folders_besides_it_are_refused(self):
        for other in ("--out", "--resume"):
            self.refused("info", other, self.folder / "x", INTO, self.folder / "y", says=(INTO, other))
        self.refused("info", INTO, "", says=INTO)
        self.refused("info", INTO, self.file("file", ""), says="file")
        self.refused("info", "--config", self.file("bad.toml", "resume-or-start = 'x'\n"), says="resume-or-start")

    def test_two_runs_at_once_on_one_folder_are_refused(self):
        out = self.folder / "run"
        process = self.start(*LONG_ENDS, out=out, into=INTO)
        self.wait_for(process, out / "checkpoint" / "endpoints.h5")
        for line in ((*LONG_ENDS, INTO, out), ("endpoints", INTO, out), ("endpoints", "--resume", out)):
            self.refused(*line, says=(str(out), "another run is at work"))
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(timeout=30 * SLOWER), 4)
        self.done(*LONG_ENDS, INTO, out)


class Interrupted(InterruptionTest):
    """What has no checkpoint ends with status 4 too."""

    def test_insertion_into_a_file(self):
        result = self.interrupt("insert", DATA / "ar_dilute_63.extxyz", *TAIL, "--energy", "mean", "--count", "10000000", "--tolerance", "1e-6",
                                out=self.folder / "run", seconds=0.3)
        self.assertEqual(result["outcome"], "interrupted")

    def test_a_start_that_is_being_made_says_so_in_one_line(self):
        process = self.start("endpoints", "--model", "hard-sphere", "--particles", "4000", "--packing-fraction", "0.62", "--start-method",
                             "contraction", out=self.folder / "run")
        time.sleep(1.0)
        process.send_signal(signal.SIGTERM)
        stdout, stderr = process.communicate(timeout=60 * SLOWER)
        self.assertEqual((process.returncode, stdout), (4, ""))
        self.assertRegex(stderr, r"\Alanescape: interrupted[^\n]*\n\Z")
        self.assertFalse((self.folder / "run").exists())


if __name__ == "__main__":
    unittest.main()
