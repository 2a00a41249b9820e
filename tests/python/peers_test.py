#!/usr/bin/python3
"""bench/peers/lammps.py with fake programs for LAMMPS, mpirun, lanescape and bench_lists; and, for the energies, with the real
LAMMPS if it is installed: tests/python/peers_test.py [LANESCAPE]"""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "bench" / "peers" / "lammps.py"
LANESCAPE = None
sys.path[:0] = [str(ROOT / "tests" / "python"), str(ROOT / "bench" / "peers"), str(ROOT / "tools")]

from lammps_runs import release_of  # noqa: E402
from peers_support import FAKE_BENCH, FAKE_LANESCAPE  # noqa: E402
from systems import LIQUIDS, lattice, lattice_order, read_extended_xyz, wrapped, write_extended_xyz  # noqa: E402

# Answers scripts like LAMMPS: 50 ns per particle and step in pairs, 80 ns in total; one process is twice as slow as two.
FAKE_LAMMPS = """#!/usr/bin/python3
import os, random, re, sys
if sys.argv[1] == "-h":
    print(f"Massively Parallel Simulator - {os.environ.get('FAKE_RELEASE', '1 Jan 2000')}\\n\\nCompiler: none\\n")
    print(f"* Pair styles:\\n\\nlj/cut lj/cut/opt {os.environ.get('FAKE_STYLES', '')}\\n\\n* Bond styles:\\n")
    sys.exit()
script, log = sys.argv[2], open(sys.argv[4], "w")
lines = open(script).read().splitlines()
data = open(next(line.split()[1] for line in lines if line.startswith("read_data"))).read().splitlines()
particles, edge, style = int(data[2].split()[0]), float(data[5].split()[1]), next(l.split()[1] for l in lines if l.startswith("pair_style"))
count = int(os.environ.get("FAKE_PROCESSES", "1"))
open(os.environ["FAKE_RECORD"], "a").write(script + "\\n")
if os.environ.get("FAKE_BROKEN") == style:
    print("ERROR: out of luck", file=log)
    sys.exit(1)
for line in lines:
    words = line.split()
    if words[0] == "write_dump":
        types = {int(row.split()[0]): int(row.split()[1]) for row in data[data.index("Atoms # atomic") + 2:]}
        with open(words[3], "w") as dump:
            dump.write("head\\n" * 9)
            for i in range(1, particles + 1):
                dump.write(f"{i} {types[i]} {random.uniform(-1, edge)!r} {random.uniform(0, edge + 1)!r} {random.uniform(0, edge)!r}\\n")
    if words[0] != "run":
        continue
    steps = int(words[1])
    if steps == 0:
        energy = -1234.5 * (1 + float(os.environ.get("FAKE_ERROR", "0")))
        print("Step PotEng Press Volume \\n 0", repr(energy), repr(600.0 / (3 * edge**3)), repr(edge**3), file=log)
    pair, loop = (t * 1e-9 * steps * particles * (3 - count) for t in (50, 80))
    print(f"Loop time of {loop} on {os.environ.get('FAKE_RANKS', count)} procs for {steps} steps with {particles} atoms\\n", file=log)
    print(f"99.0% CPU use\\nPair    | {0.5 * pair} | {0.7 * pair} | {pair} | 0 | 50", file=log)
    builds = 7 if any("nve" in l for l in lines[:lines.index(line)]) else int(os.environ.get("FAKE_REBUILDS", "0"))
    print(f"Neighbor list builds = {builds}\\nDangerous builds = 0", file=log)
"""

FAKE_MPIRUN = """#!/bin/sh
while [ "$1" != -np ]; do shift; done
export FAKE_PROCESSES="$2"
shift 2
exec "$@"
"""


class Systems(unittest.TestCase):
    def test_a_lattice_has_its_particles_its_density_and_its_order(self):
        for particles in (256, 300):
            liquid = LIQUIDS["kob-andersen"]
            made = lattice(liquid, particles, 1)
            self.assertEqual((len(made), int((made.species == 1).sum())), (particles, particles // 5))
            self.assertAlmostEqual(particles / made.edge**3, 1.2, 12)
            self.assertTrue((made.positions >= 0).all() and (made.positions < made.edge).all())
            self.assertGreater(lattice_order(made), 0.7)
            distances = made.positions[:, None] - made.positions[None]
            distances -= made.edge * np.round(distances / made.edge)
            squared = (distances**2).sum(axis=2) + 10 * np.eye(particles)
            cells = 4 if particles == 256 else 5
            self.assertAlmostEqual(squared.min(), 0.5 * (made.edge / cells)**2, 10)
            made.positions = np.random.default_rng(1).uniform(0, made.edge, made.positions.shape)
            self.assertLess(lattice_order(made), 0.2)

    def test_wrapped_positions_lie_in_the_box(self):
        edge = 1.7
        inside = wrapped(np.array([-1e-30, 0.0, edge, np.nextafter(edge, 0), -0.5, 4.0]), edge)
        self.assertTrue(((inside >= 0) & (inside < edge)).all())
        np.testing.assert_allclose(inside, [0.0, 0.0, 0.0, edge, 1.2, 0.6], atol=1e-15)

    def test_files_keep_every_bit(self):
        made = lattice(LIQUIDS["kob-andersen"], 256, 1)
        made.positions = np.random.default_rng(1).uniform(0, made.edge, made.positions.shape)
        with tempfile.TemporaryDirectory() as folder:
            write_extended_xyz(Path(folder) / "file", made)
            read = read_extended_xyz(Path(folder) / "file", made.liquid)
        self.assertEqual(read.edge, made.edge)
        self.assertTrue((read.positions == made.positions).all() and (read.species == made.species).all())


class Comparison(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.record, self.json = self.folder / "record", self.folder / "peers.json"
        for name, text in (("lmp", FAKE_LAMMPS), ("mpirun", FAKE_MPIRUN), ("lanescape", FAKE_LANESCAPE), ("bench_lists", FAKE_BENCH)):
            (self.folder / name).write_text(text)
            (self.folder / name).chmod(0o755)

    def compare(self, *arguments, lammps="lmp", environment=None):
        command = [sys.executable, SCRIPT, "--bench", self.folder / "bench_lists", "--lanescape", self.folder / "lanescape",
                   "--mpirun", self.folder / "mpirun", "--folder", self.folder / "files", "--json", self.json, "--sizes", 256,
                   "--step-size", 256, "--threads", 1, 2, "--repetitions", 2, "--work", 1e4, "--steps", 20]
        command += ["--lammps", self.folder / lammps] if lammps else []
        return subprocess.run([str(word) for word in (*command, *arguments)], capture_output=True, text=True, check=False,
                              env={**os.environ, "FAKE_RECORD": str(self.record), **(environment or {})})

    def assert_fails(self, done, status, named):
        self.assertEqual((done.returncode, done.stdout), (status, ""), done.stderr)
        self.assertIn(named, done.stderr.splitlines()[-1])
        self.assertFalse(self.json.exists())

    def report(self):
        return json.loads(self.json.read_text())

    def missing(self):
        return {entry["what"]: entry["why"] for entry in self.report()["missing"]}

    def test_every_case_is_compared_on_one_and_two_processes(self):
        done = self.compare()
        self.assertEqual(done.returncode, 0, done.stderr)
        found = {(row["model"], row["case"], row["threads"], row["variant"]): row for row in self.report()["results"]}
        for model in ("kob-andersen", "lennard-jones"):
            for case in ("force", "force+energy+virial", "step"):
                for threads in (1, 2):
                    self.assertEqual(found.pop((model, case, threads, "avx2"))["ns_per_particle"], 20.0)
                    for style in ("lj/cut", "lj/cut/opt"):
                        row = found.pop((model, case, threads, style))
                        expected = (80.0 if case == "step" else 50.0) * (3 - threads)
                        self.assertAlmostEqual(row["ns_per_particle"], expected, 6)
                        self.assertAlmostEqual(row["ratio"], expected / 20.0, 6)
                        self.assertEqual((len(row["samples"]), row["list_builds"]), (2, 7 if case == "step" else 0))
        self.assertEqual(found, {})
        self.assertEqual(done.stdout.count("7 lists in 20 steps"), 8)

    def test_what_is_missing_is_named(self):
        done = self.compare(environment={"FAKE_LACKS": "step", "FAKE_BROKEN": "lj/cut/opt"})
        self.assertEqual(done.returncode, 0, done.stderr)
        missing = self.missing()
        self.assertEqual(set(missing), {"LAMMPS lj/cut/omp", "LAMMPS lj/cut/intel", "LAMMPS lj/cut/opt, 1 process", "LAMMPS lj/cut/opt, 2 processes",
                                        "bench_lists step, 1 threads", "bench_lists step, 2 threads"})
        self.assertIn("out of luck", missing["LAMMPS lj/cut/opt, 1 process"])
        for what in missing:
            self.assertIn(f"missing: {what}: ", done.stdout)

    def test_a_missing_lammps_is_named(self):
        done = self.compare(lammps=None, environment={"PATH": str(self.folder / "nowhere")})
        self.assertEqual(done.returncode, 1)
        self.assertIn("missing: LAMMPS: none of", done.stdout)
        self.assertEqual(set(self.missing()), {"LAMMPS"})

    def test_the_newest_lammps_on_the_path_is_used(self):
        folders = []
        for name, release in (("old", "29 Sep 2021"), ("new", "22 Jul 2025 - Update 4"), ("older", "22 Jul 2025 - Update 1")):
            folders.append(self.folder / name)
            folders[-1].mkdir()
            (folders[-1] / "lmp").write_text(f"#!/bin/sh\nFAKE_RELEASE='{release}' exec {self.folder / 'lmp'} \"$@\"\n")
            (folders[-1] / "lmp").chmod(0o755)
        broken = self.folder / "broken"
        broken.mkdir()
        (broken / "lammps").write_text("#!/bin/sh\necho no library >&2\nexit 127\n")
        (broken / "lammps").chmod(0o755)
        path = os.pathsep.join(map(str, (broken, *folders, "/usr/bin", "/bin")))
        done = self.compare("--models", "lennard-jones", "--threads", 1, "--lammps", folders[0] / "lmp")
        self.assertIn("LAMMPS 29 Sep 2021;", done.stdout)
        done = self.compare("--models", "lennard-jones", "--threads", 1, lammps=None, environment={"PATH": path})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("LAMMPS 22 Jul 2025 - Update 4;", done.stdout)
        self.assertIn("no library", self.missing()[f"LAMMPS {broken / 'lammps'}"])

    def test_releases_are_in_the_order_of_their_dates(self):
        versions = ["a version", "29 Sep 2021", "2 Aug 2023", "22 Jul 2025", "22 Jul 2025 - Update 4"]
        self.assertEqual(sorted(versions[::-1], key=release_of), versions)

    def test_the_intel_style_runs_in_double_precision_on_processes(self):
        done = self.compare("--models", "lennard-jones", environment={"FAKE_STYLES": "lj/cut/intel"})
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = [row for row in self.report()["results"] if row["variant"] == "lj/cut/intel"]
        self.assertEqual({row["threads"] for row in rows}, {1, 2})
        script = (self.folder / "files" / "lennard-jones-256-seed1-energy.in").read_text()
        self.assertTrue(script.startswith("package intel 0 omp 1 mode double\n"), script)

    def test_an_mpirun_of_another_mpi_is_noticed(self):
        done = self.compare(environment={"FAKE_RANKS": "1"})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("ran on 1 instead of 2", self.missing()["LAMMPS lj/cut, 2 processes"])
        self.assertEqual({row["threads"] for row in self.report()["results"] if row["code"] == "LAMMPS"}, {1})

    def test_energies_that_disagree_end_the_run_before_timing(self):
        self.assert_fails(self.compare(environment={"FAKE_ERROR": "2e-10"}), 1, "energies disagree")
        self.assertNotIn("timing", self.record.read_text())
        self.assertFalse([line for line in self.record.read_text().splitlines() if line.endswith("seed1.in")])
        self.assertEqual(self.compare(environment={"FAKE_ERROR": "0.5e-10"}).returncode, 0)
        scripts = self.record.read_text().splitlines()
        self.assertTrue([line for line in scripts if line.endswith("seed1.in")])

    def test_a_list_rebuilt_in_a_run_of_forces_is_noticed(self):
        self.assert_fails(self.compare(environment={"FAKE_REBUILDS": "1"}), 1, "rebuilt 1 times")

    def test_a_benchmark_that_fails_its_check_is_noticed(self):
        self.assert_fails(self.compare(environment={"FAKE_WRONG": "1"}), 1, "wrong gradient")

    def test_configurations_are_used_again(self):
        self.compare()
        self.assertEqual(self.compare().returncode, 0)
        self.assertEqual(self.record.read_text().count("-melt.in"), 2)  # once per liquid

    def test_wrong_usage_is_refused(self):
        for arguments in (("--sizes", "100"), ("--sizes", "many"), ("--threads", "0"), ("--repetitions", "0"), ("--timestep", "nan"),
                          ("--work", "inf"), ("--models", "water"), ("--lammps", "/nowhere"), ("--bench", "/nowhere"),
                          ("--lanescape", "/nowhere"), ("--json", "/nowhere/at/all"), ("--unknown",)):
            done = self.compare(*arguments)
            self.assert_fails(done, 2, arguments[0])
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)

    def test_the_real_lammps_agrees_with_lanescape(self):
        lammps = next(filter(None, map(shutil.which, ("lmp", "lmp_mpi", "lammps"))), None)
        if not (lammps and LANESCAPE):
            self.skipTest("no LAMMPS on PATH" if LANESCAPE else "the program is not built")
        done = self.compare("--lanescape", LANESCAPE, "--threads", 1, "--repetitions", 1, lammps=lammps)
        self.assertEqual(done.returncode, 0, done.stderr)
        energies = self.report()["energies"]
        self.assertGreaterEqual(len(energies), 2)
        for entry in energies:
            self.assertLess(entry["relative_difference"], 1e-12)
            self.assertLess(entry["energy"], -3.0 * entry["particles"])
        step = [row for row in self.report()["results"] if row["case"] == "step" and row["code"] == "LAMMPS"]
        self.assertTrue(all(row["list_builds"] > 0 for row in step) and step)


if __name__ == "__main__":
    if len(sys.argv) > 1 and not sys.argv[1].startswith("-"):
        LANESCAPE = sys.argv.pop(1)
    unittest.main()
