#!/usr/bin/python3
"""tools/compare_bench.py on made-up files: its verdicts, its exit status and its refusals."""

import json
import math
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[2] / "tools" / "compare_bench.py"
STEADY = (1.00, 1.01, 0.99, 1.005, 0.995)
NOISY = (1.0, 3.0, 0.4, 2.0, 0.6)


def runs(name, times, unit="ns", **more):
    return [{"name": name, "run_name": name, "run_type": "iteration", "repetition_index": k, "cpu_time": t, "real_time": t,
             "time_unit": unit, **more} for k, t in enumerate(times)]


def scaled(factor, times=STEADY):
    return [100.0 * factor * t for t in times]


class CompareBench(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.old, self.new = self.folder / "old.json", self.folder / "new.json"
        self.write(self.old, runs("force", scaled(1.0)))

    def write(self, file, entries):
        file.write_text(json.dumps({"context": {}, "benchmarks": entries}))

    def run_script(self, *arguments):
        return subprocess.run([sys.executable, str(SCRIPT), str(self.old), str(self.new), *arguments], capture_output=True, text=True,
                              check=False)

    def compare(self, new, *arguments):
        """Exit status and comparison; the run that prints a table must agree."""
        self.write(self.new, new)
        run, table = self.run_script("--json", *arguments), self.run_script(*arguments)
        self.assertEqual((run.stderr, table.stderr), ("", ""))
        self.assertEqual(run.returncode, table.returncode)
        comparison = json.loads(run.stdout)
        for row in comparison["benchmarks"]:
            line = next(line for line in table.stdout.splitlines() if f" {row['name']} " in line)
            self.assertTrue(line.endswith(row["verdict"]), line)
        return run.returncode, comparison

    def assert_verdict(self, new, verdict, status, *arguments):
        returned, comparison = self.compare(new, *arguments)
        self.assertEqual([row["verdict"] for row in comparison["benchmarks"]], [verdict])
        self.assertEqual(returned, status)
        return comparison["benchmarks"][0]

    def assert_refuses(self, named, *arguments):
        run = self.run_script(*arguments)
        self.assertEqual((run.returncode, run.stdout), (2, ""))
        self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
        self.assertIn(named, run.stderr)

    def test_equal_times_are_no_change(self):
        row = self.assert_verdict(runs("force", scaled(1.0)), "no change", 0)
        self.assertAlmostEqual(row["ratio"], 1.0, 12)
        self.assertTrue(row["interval"][0] < 1.0 < row["interval"][1])

    def test_a_fifth_slower_is_a_regression(self):
        row = self.assert_verdict(runs("force", scaled(1.2)), "slower", 1)
        self.assertAlmostEqual(row["ratio"], 1.2, 12)
        self.assertTrue(1.1 < row["interval"][0] < 1.2 < row["interval"][1] < 1.3)

    def test_a_fifth_faster_is_no_regression(self):
        self.assert_verdict(runs("force", scaled(0.8)), "faster", 0)

    def test_noise_hides_a_change(self):
        row = self.assert_verdict(runs("force", scaled(1.2, NOISY)), "no change", 0)
        self.assertGreater(row["ratio"], 1.05)

    def test_a_change_below_the_threshold_does_not_matter(self):
        row = self.assert_verdict(runs("force", scaled(1.03)), "no change", 0)
        self.assertGreater(row["interval"][0], 1.0)
        self.assert_verdict(runs("force", scaled(1.03)), "slower", 1, "--threshold", "0.01")

    def test_confidence_widens_the_interval(self):
        self.assert_verdict(runs("force", scaled(1.2)), "no change", 0, "--confidence", "0.99999999999999")

    def test_the_interval_is_welchs(self):
        # Means of the logarithms 0 and a, errors s/sqrt(2) each with s = sqrt(2) d: the error is sqrt(2) d with 2 degrees of freedom,
        # and t(0.975, 2) = 4.302652729911275.
        d, a = 0.01, 0.2
        self.write(self.old, runs("force", [math.exp(-d), math.exp(d)]))
        row = self.assert_verdict(runs("force", [math.exp(a - d), math.exp(a + d)]), "slower", 1)
        half = 4.302652729911275 * math.sqrt(2.0) * d
        for found, expected in zip(row["interval"], (a - half, a + half)):
            self.assertAlmostEqual(math.log(found), expected, 12)

    def test_times_without_scatter_can_be_compared(self):
        self.write(self.old, runs("force", [100.0, 100.0]))
        self.assert_verdict(runs("force", [100.0, 100.0]), "no change", 0)
        self.assert_verdict(runs("force", [120.0, 120.0]), "slower", 1)

    def test_units_of_time_are_converted(self):
        self.assert_verdict(runs("force", [t / 1000 for t in scaled(1.0)], "us"), "no change", 0)

    def test_one_regression_of_several_counts_and_single_benchmarks_are_named(self):
        self.write(self.old, runs("force", scaled(1.0)) + runs("step", scaled(1.0)) + runs("gone", scaled(1.0)))
        status, comparison = self.compare(runs("force", scaled(0.8)) + runs("step", scaled(1.2)) + runs("added", scaled(1.0)))
        self.assertEqual((status, comparison["slower"], comparison["faster"]), (1, 1, 1))
        self.assertEqual((comparison["only_in_baseline"], comparison["only_in_new"]), (["gone"], ["added"]))
        table = self.run_script().stdout
        self.assertIn(f"? gone: only in {self.old}", table)
        self.assertIn(f"? added: only in {self.new}", table)

    def test_a_counter_can_be_compared_and_a_rate_the_other_way_round(self):
        self.write(self.old, [entry for k, t in enumerate(scaled(1.0)) for entry in runs("force", [100.0], rate=t)])
        slower = [entry for t in scaled(0.8) for entry in runs("force", [100.0], rate=t)]
        self.assert_verdict(slower, "no change", 0)
        self.assert_verdict(slower, "faster", 0, "--metric", "rate")
        row = self.assert_verdict(slower, "slower", 1, "--metric", "rate", "--higher-is-better")
        self.assertAlmostEqual(row["ratio"], 1.25, 12)

    def test_aggregates_are_not_taken_for_repetitions(self):
        aggregate = {"name": "force_mean", "run_name": "force", "run_type": "aggregate", "cpu_time": 1e6, "time_unit": "ns"}
        self.assert_verdict(runs("force", scaled(1.0)) + [aggregate], "no change", 0)

    def test_only_aggregates_are_refused(self):
        self.write(self.new, [{"name": "force_mean", "run_name": "force", "run_type": "aggregate", "cpu_time": 1.0}])
        self.assert_refuses("only aggregates")

    def test_a_missing_file_is_refused(self):
        self.assert_refuses("new.json: No such file")

    def test_what_is_not_json_is_refused(self):
        for text in ("", "{", "benchmark,1\n"):
            self.new.write_text(text)
            self.assert_refuses("not JSON")
        self.new.write_bytes(b"\xff\xfe{}")
        self.assert_refuses("not JSON")

    def test_another_form_of_json_is_refused(self):
        for text in ("[]", "{}", '{"benchmarks": 1}', '{"benchmarks": [1]}', '{"benchmarks": [{}]}', "null"):
            self.new.write_text(text)
            self.assert_refuses("not Google Benchmark's")
        self.write(self.new, [])
        self.assert_refuses("no benchmark in it")

    def test_files_without_a_common_benchmark_are_refused(self):
        self.write(self.new, runs("other", scaled(1.0)))
        self.assert_refuses("no benchmark in common")

    def test_one_repetition_is_refused(self):
        self.write(self.new, runs("force", [100.0]))
        self.assert_refuses("1 repetition")

    def test_an_absent_metric_is_refused(self):
        self.write(self.new, runs("force", scaled(1.0)))
        self.assert_refuses("no flops", "--metric", "flops")

    def test_numbers_that_cannot_be_times_are_refused(self):
        for number in (math.nan, math.inf, 0.0, -1.0, "100", True):
            self.write(self.new, runs("force", [100.0, number]))
            self.assert_refuses("cpu_time")

    def test_a_failed_benchmark_is_refused(self):
        self.write(self.new, runs("force", [0.0, 0.0], error_occurred=True, error_message="wrong gradient"))
        self.assert_refuses("force failed: wrong gradient")

    def test_wrong_usage_is_refused(self):
        self.write(self.new, runs("force", scaled(1.0)))
        for arguments in (("--confidence", "1"), ("--confidence", "0"), ("--confidence", "nan"), ("--confidence", "high"),
                          ("--threshold", "-0.1"), ("--threshold", "inf"), ("--unknown",), ("third.json",)):
            self.assert_refuses(arguments[0], *arguments)


if __name__ == "__main__":
    unittest.main()
