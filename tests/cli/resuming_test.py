"""Interrupted and killed runs resume to the same bits."""

import signal
import unittest
from pathlib import Path

from cli_support import DATA, ARGON, TINY, FLUID, GROWTH, SCAN, InterruptionTest, contents, lanescape, with_options, without_seconds


class Resuming(InterruptionTest):
    LONG_ENDS = ("endpoints", *ARGON, *with_options(TINY, "--melt-steps", "3000000", "--pairs", "2"))

    def test_interrupted_end_points_resume_to_the_same_bits(self):
        whole = self.folder / "whole"
        self.done(*self.LONG_ENDS, "--out", whole)
        for which in (signal.SIGTERM, signal.SIGINT):
            out = self.folder / which.name
            result = self.interrupt(*self.LONG_ENDS, out=out, after="run.toml", with_signal=which)
            self.assertEqual((result["outcome"], result["pairs"]), ("interrupted", []))
            self.assert_resumes_to(out, whole, "endpoints", times=2)  # the second time it is finished already

    def test_killed_end_points_resume_to_the_same_bits(self):
        whole, out = self.folder / "whole", self.folder / "killed"
        self.done(*self.LONG_ENDS, "--out", whole)
        process = self.start(*self.LONG_ENDS, out=out)
        self.wait_for(process, out / "checkpoint" / "endpoints.h5")
        process.kill()
        self.assertEqual(process.wait(), -signal.SIGKILL)
        self.assertFalse((out / "result.json").exists())
        self.assert_resumes_to(out, whole, "endpoints")

    def test_interrupted_scans_and_growth_resume_to_the_same_bits(self):
        for name, arguments, checkpoint in (
                ("scan", with_options(SCAN, "--states", "0.4:2.5,0.5:2,0.6:2", "--equilibration-steps", "300000"), "scan.h5"),
                ("growth", with_options(GROWTH, "--particles", "256", "--rows", "40", "--rate", "0.001"), "densification.h5")):
            whole, out, killed = (self.folder / f"{name}-{which}" for which in ("whole", "cut", "killed"))
            self.done(*arguments, "--out", whole)
            result = self.interrupt(*arguments, out=out, after=f"checkpoint/{checkpoint}", with_signal=signal.SIGTERM)
            self.assertEqual(result["outcome"], "interrupted")
            self.assert_resumes_to(out, whole, "insert", times=2)
            process = self.start(*arguments, out=killed)
            self.wait_for(process, killed / "checkpoint" / checkpoint)
            process.kill()
            process.wait()
            self.assert_resumes_to(killed, whole, "insert")

    def test_interrupted_and_killed_paths_resume_to_the_same_bits(self):
        for method in ("contour", "escape"):
            pairs = self.make_pairs(f"ends-{method}", 2)
            arguments = ("path", *ARGON, "--pair", *pairs, "--method", method, "--step", "1e-5", "--threads", "1")
            whole = self.folder / f"whole-{method}"
            self.done(*arguments, "--out", whole)
            # The files may change or disappear after the start of the run, which keeps copies.
            copies = [(Path(p), Path(p).read_bytes()) for p in pairs]
            runs = {which: self.folder / f"{method}-{which.name}" for which in (signal.SIGTERM, signal.SIGINT, signal.SIGKILL)}
            for which, out in runs.items():
                if which == signal.SIGKILL:
                    process = self.start(*arguments, out=out)
                    self.wait_for(process, out / "checkpoint" / "path-0001.h5")
                    process.kill()
                    process.wait()
                else:
                    result = self.interrupt(*arguments, out=out, after="run.toml", with_signal=which)
                    self.assertIn("interrupted", [path["outcome"] for path in result["paths"]])
                    self.assertEqual(len(result["paths"]), 2)
            for path, _ in copies:
                path.unlink()
            for out in runs.values():
                self.assert_resumes_to(out, whole, "path", times=2)

    def test_a_path_run_interrupted_while_end_points_are_made_resumes_to_the_same_bits(self):
        arguments = ("path", *ARGON, *with_options(FLUID, "--melt-steps", "1500000"))
        whole, out = self.folder / "whole", self.folder / "cut"
        self.done(*arguments, "--out", whole)
        result = self.interrupt(*arguments, out=out, after="run.toml", with_signal=signal.SIGTERM)
        self.assertEqual((result["endpoints"]["outcome"], result["paths"]), ("interrupted", []))
        self.assert_resumes_to(out, whole, "path")

    def test_an_interrupted_run_may_go_on_with_another_number_of_threads(self):
        arguments = ("path", *ARGON, *with_options(FLUID, "--melt-steps", "1500000", "--pairs", "2"), "--threads")
        whole, out = self.folder / "whole", self.folder / "cut"
        complete = self.done(*arguments, "1", "--out", whole)
        self.interrupt(*arguments, "1", out=out, after="run.toml", with_signal=signal.SIGTERM)
        self.assertEqual(without_seconds(self.done("path", "--resume", out, "--threads", "2", "--quiet")), without_seconds(complete))

    def test_every_finished_run_resumes_to_its_result(self):
        for arguments in (("info",), ("energy", DATA / "ka_tiny_8.extxyz", "--forces"), ("endpoints", *ARGON, *TINY),
                          ("path", *ARGON, *FLUID, "--max-steps", "5000000"), ("verify", "--isa", self.done("info")["isas"][0])):
            out = self.folder / arguments[0]
            self.done(*arguments, "--out", out)
            before = contents(out)
            self.done(arguments[0], "--resume", out)
            self.assertEqual(contents(out), before)

    def test_a_run_that_missed_its_goal_resumes_to_the_same_status(self):
        [pair] = self.make_pairs("ends")
        out = self.folder / "limit"
        first = self.done("path", *ARGON, "--pair", pair, "--max-steps", "50", "--out", out, status=1)
        self.assertEqual(self.done("path", "--resume", out, status=1), first)

    def test_other_flags_besides_resume_are_refused(self):
        out = self.folder / "run"
        self.done("endpoints", *ARGON, *TINY, "--out", out)
        before = contents(out)
        for flags in (("--seed", "2"), ("--seed=1",), ("--isa", "auto"), ("--out", out), ("--config", out / "run.toml"),
                      ("--distance", "2"), ("--quick",)):
            self.refused("endpoints", "--resume", out, *flags, says=(str(flags[0]).split("=")[0], "--resume"))
        self.refused("energy", "--resume", out, DATA / "ka_tiny_8.extxyz", says=("FILE", "--resume"))
        self.assertEqual(contents(out), before)

    def test_a_folder_without_a_run_is_refused(self):
        empty = self.folder / "empty"
        empty.mkdir()
        for bad in (self.folder / "missing", empty, self.file("file", "")):
            for subcommand in ("info", "energy", "endpoints", "path", "verify"):
                self.refused(subcommand, "--resume", bad, says=(str(bad), "no run to resume"))
        self.assertEqual(list(empty.iterdir()), [])

    def test_a_damaged_checkpoint_is_refused_and_kept(self):
        out = self.folder / "run"
        self.done("endpoints", *ARGON, *TINY, "--out", out)
        checkpoint = out / "checkpoint" / "endpoints.h5"
        older = out / "checkpoint" / "endpoints.h5.previous"
        older.unlink(missing_ok=True)
        before, whole = contents(out), checkpoint.read_bytes()
        for damaged in (b"", whole[:5000], whole[:-1], whole + b"x", whole[:9000] + b"?" + whole[9001:], whole[:-32]):
            checkpoint.write_bytes(damaged)
            self.refused("endpoints", "--resume", out, says="endpoints.h5")
            self.assertEqual(checkpoint.read_bytes(), damaged)
        older.write_bytes(whole)
        done = lanescape("endpoints", "--resume", out)
        self.assertEqual(done.returncode, 0)
        self.assertIn("endpoints.h5: it does not end with a checksum", done.stderr)
        self.assertIn("; the state saved before it is used\n", done.stderr)
        self.assertEqual(contents(out), before)


if __name__ == "__main__":
    unittest.main()
