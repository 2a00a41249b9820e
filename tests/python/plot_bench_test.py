#!/usr/bin/python3
"""tools/plot_bench.py on made-up results: the figures that it writes, their content, and its refusals."""

import json
import math
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOOLS = Path(__file__).resolve().parents[2] / "tools"
SCRIPT = TOOLS / "plot_bench.py"
sys.path.insert(0, str(TOOLS))

import plot_bench  # noqa: E402
import plot_threads  # noqa: E402


def entries(name, nanoseconds, **counters):
    return [{"name": name, "run_name": name, "run_type": "iteration", "repetition_index": k, "cpu_time": 1.0, "real_time": 1.0,
             "time_unit": "ns", "ns_per_particle": t, **counters} for k, t in enumerate(nanoseconds)]


def bench(prefix="", sizes=(256, 4000, 32000), **counters):
    return [entry for case in ("force", "force+energy+virial", "step") for n in sizes for threads in (1, 2) for isa in ("sse2", "avx2")
            for entry in entries(f"{prefix}{case}/N:{n}/threads:{threads}/{isa}", (30.0, 31.0, 33.0), **counters)]


def peer(**changed):
    return {"model": "kob-andersen", "particles": 4000, "case": "force", "threads": 1, "code": "LAMMPS", "variant": "lj/cut",
            "samples": [150.0, 160.0], "ratio": 5.0, **changed}


class PlotBench(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.bench, self.peers, self.out = self.folder / "bench.json", self.folder / "peers.json", self.folder / "figures"
        self.write_bench(bench())

    def write_bench(self, benchmarks, **context):
        self.bench.write_text(json.dumps({"context": context, "benchmarks": benchmarks}))

    def write_peers(self, rows):
        self.peers.write_text(json.dumps({"context": {}, "missing": [], "energies": [], "results": rows}))

    def plot(self, *arguments):
        peers = ["--peers", str(self.peers)] if self.peers.exists() else []
        return subprocess.run([sys.executable, str(SCRIPT), str(self.bench), "--out", str(self.out), *peers, *arguments],
                              capture_output=True, text=True, check=False)

    def figures(self):
        return sorted(file.name for file in self.out.glob("*")) if self.out.exists() else []

    def assert_draws(self, *names):
        run = self.plot()
        self.assertEqual((run.returncode, run.stdout, run.stderr), (0, "", ""))
        self.assertEqual(self.figures(), sorted(names))
        for name in names:
            data = (self.out / name).read_bytes()
            self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
            width, height = struct.unpack(">II", data[16:24])
            self.assertTrue(900 <= width <= 2500 and 500 <= height <= 3000, f"{name}: {width} x {height}")
            self.assertGreater(len(data), 15_000, name)

    def assert_refuses(self, named, *arguments):
        run = self.plot(*arguments)
        self.assertEqual((run.returncode, run.stdout), (2, ""))
        self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
        self.assertIn(named, run.stderr)
        self.assertEqual(self.figures(), [])

    def test_times_alone_give_the_scaling(self):
        self.assert_draws("scaling.png", "threads.png")

    def test_one_size_and_one_thread_can_be_drawn(self):
        self.write_bench(entries("force/N:256/threads:1/avx2", [30.0]))
        self.assert_draws("scaling.png")

    def test_several_liquids_get_a_panel_each(self):
        self.write_bench(bench("kob-andersen/") + bench("lennard-jones/"))
        self.assert_draws("scaling.png", "threads.png")
        _, points, _ = plot_bench.read_bench(self.bench)
        self.assertEqual(len(plot_bench.panels_of(points)), 6)

    def test_the_share_of_the_peak_gives_the_roofline(self):
        self.write_bench(bench(fraction_of_peak=0.2))
        self.assert_draws("scaling.png", "threads.png", "roofline.png")

    def test_the_roofline_can_be_drawn_with_and_without_a_peak_and_a_slope(self):
        for context in ({}, {"memory_gb_per_second": "18.2"}, {"peak_gflops": "45.2", "memory_gb_per_second": "18.2"}, {"peak_gflops": "45.2"}, {"peak_gflops": 45.2}, {"peak avx2": "45.2 GFLOP/s"}, {"peak_gflops": "fast"}):
            self.write_bench(bench(flops_per_byte=2.0, gflops=10.0), **context)
            self.assert_draws("scaling.png", "threads.png", "roofline.png")

    def test_the_peak_is_found_in_either_form(self):
        self.assertEqual(plot_bench.peak_of({"peak_gflops": "45.2"}, "avx2"), 45.2)
        self.assertEqual(plot_bench.peak_of({"peak sse2": "10 GFLOP/s", "peak avx2": "45.2 GFLOP/s"}, "avx2"), 45.2)
        self.assertIsNone(plot_bench.peak_of({"peak sse2": "10 GFLOP/s"}, "avx2"))

    def test_a_bandwidth_is_a_positive_number(self):
        self.assertEqual(plot_bench.bandwidth_of({"memory_gb_per_second": "18.2"}), 18.2)
        for context in ({}, {"memory_gb_per_second": "fast"}, {"memory_gb_per_second": None}, {"memory_gb_per_second": "0"}):
            self.assertIsNone(plot_bench.bandwidth_of(context))

    def test_speed_ups_are_relative_to_one_thread(self):
        self.write_bench([entry for n, times in ((256, (30.0, 40.0)), (4000, (40.0, 20.0, 11.0))) for k, t in enumerate(times)
                          for entry in entries(f"force/N:{n}/threads:{2**k}/avx2", [t])] + entries("force/N:500/threads:2/avx2", [9.0]))
        _, points, isa = plot_bench.read_bench(self.bench)
        self.assertEqual(plot_threads.thread_series(points, [], isa), [("Lanescape avx2, N = 256", [1, 2], [30.0, 40.0]),
                                                                       ("Lanescape avx2, N = 4000", [1, 2, 4], [40.0, 20.0, 11.0])])

    def test_the_fastest_variant_of_a_peer_near_32000_particles_stands_for_it(self):
        rows = [peer(particles=n, threads=t, variant=v, samples=[time / t]) for n in (256, 32000) for t in (1, 2)
                for v, time in (("lj/cut", 300.0), ("lj/cut/opt", 200.0))] + [peer(code="Other", threads=2)]
        chosen = plot_threads.fastest_peers(rows)
        self.assertEqual(list(chosen), ["LAMMPS lj/cut/opt, N = 32k"])
        self.assertEqual([row["samples"] for row in chosen["LAMMPS lj/cut/opt, N = 32k"]], [[200.0], [100.0]])

    def test_the_widest_instruction_set_is_drawn(self):
        self.write_bench(entries("force/N:256/threads:1/sse2", [90.0]) + entries("force/N:256/threads:1/avx2", [30.0, 31.0]))
        _, points, isa = plot_bench.read_bench(self.bench)
        self.assertEqual((isa, [point["samples"] for point in points]), ("avx2", [[30.0, 31.0]]))

    def test_how_a_benchmark_was_timed_is_no_part_of_its_case(self):
        self.write_bench(entries("force/N:256/threads:2/avx2/real_time", [30.0]))
        _, points, _ = plot_bench.read_bench(self.bench)
        self.assertEqual([(p["case"], p["particles"], p["threads"], p["isa"]) for p in points], [("force", 256, 2, "avx2")])

    def test_peers_are_drawn_beside(self):
        self.write_peers([peer(particles=n, threads=t, case=c, variant=v) for n in (4000, 32000) for t in (1, 2)
                          for c in ("force", "step") for v in ("lj/cut", "lj/cut/opt")] + [peer(code="lanescape", variant="avx2")])
        self.assert_draws("scaling.png", "threads.png", "peers.png")

    def test_peers_without_ratios_are_no_bars(self):
        self.write_peers([peer(ratio=None)])
        self.assert_draws("scaling.png", "threads.png")

    def test_peers_of_whom_none_could_be_run_are_no_points(self):
        self.write_peers([peer(code="lanescape")])
        self.assert_draws("scaling.png", "threads.png")

    def test_bad_results_are_refused(self):
        for text, named in (("", "not JSON"), ("[]", "not Google Benchmark's"), ('{"benchmarks": []}', "no benchmark")):
            self.bench.write_text(text)
            self.assert_refuses(named)
        self.write_bench(entries("force/threads:1/avx2", [30.0]))
        self.assert_refuses("no number of particles")
        self.write_bench(entries("force/N:256/threads:1/avx2", [math.nan]))
        self.assert_refuses("ns_per_particle")
        self.write_bench([{"name": "force/N:256/threads:1/avx2", "cpu_time": 1.0}])
        self.assert_refuses("no ns_per_particle")
        self.bench.unlink()
        self.assert_refuses("No such file")

    def test_bad_peers_are_refused(self):
        for row, named in (({}, "without case"), (peer(samples=[]), "finite"), (peer(samples=[0.0]), "finite"), (peer(ratio=-1), "ratio"),
                           (peer(particles="many"), "without particles")):
            self.write_peers([row])
            self.assert_refuses(named)
        self.write_peers([])
        self.assert_refuses("results")
        self.peers.write_text("{")
        self.assert_refuses("not JSON")

    def test_a_folder_that_cannot_be_made_is_refused(self):
        self.out.write_text("")
        run = self.plot()
        self.assertEqual((run.returncode, run.stderr.count("\n")), (2, 1))
        self.assertIn("figures", run.stderr)

    def test_wrong_usage_is_refused(self):
        self.assert_refuses("--unknown", "--unknown")
        run = subprocess.run([sys.executable, str(SCRIPT), str(self.bench)], capture_output=True, text=True, check=False)
        self.assertEqual((run.returncode, run.stderr.count("\n")), (2, 1))


if __name__ == "__main__":
    unittest.main()
