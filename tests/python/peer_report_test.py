#!/usr/bin/python3
"""bench/peers/report.py with stand-ins for the drivers."""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[2] / "bench" / "peers" / "report.py"

DRIVER = """
import json, sys
arguments = sys.argv[1:]
file = arguments[arguments.index("--json") + 1]
if "--fail" in arguments:
    print("driver.py: energies disagree", file=sys.stderr)
    sys.exit(1)
json.dump({report}, open(file, "w"))
sys.exit({status})
"""


def row(code, variant, threads, nanoseconds, ratio):
    return {"model": "lennard-jones", "particles": 32000, "case": "step", "threads": threads, "code": code, "variant": variant,
            "ns_per_particle": nanoseconds, "ratio": ratio, "samples": [nanoseconds]}


LAMMPS = {"context": {"lammps": "today"}, "missing": [{"what": "LAMMPS lj/cut/intel", "why": "not in it"}],
          "energies": [{"model": "lennard-jones", "particles": 32000, "relative_difference": 1e-14}],
          "results": [row("lanescape", "avx512", 1, 100.0, 1.0), row("LAMMPS", "lj/cut", 1, 400.0, 4.0),
                      row("LAMMPS", "lj/cut/opt", 1, 300.0, 3.0), row("lanescape", "avx512", 2, 50.0, 1.0), row("LAMMPS", "lj/cut", 2, 210.0, 4.2)]}
NEIGHBOURS = {"context": {}, "missing": [], "results": [{"code": "vesin", "ratio": ratio, "particles": 1000} for ratio in (1.5, 2.5)]}


class PeerReport(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.json = self.folder / "report.json"
        self.driver("lammps", LAMMPS)
        self.driver("neighbours", NEIGHBOURS)

    def driver(self, name, report, status=0):
        (self.folder / f"{name}.py").write_text(DRIVER.format(report=repr(report), status=status))

    def run_report(self, *arguments):
        command = [sys.executable, SCRIPT, "--drivers", self.folder, "--json", self.json, *arguments]
        return subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)

    def missing(self):
        return {entry["what"]: entry["why"] for entry in json.loads(self.json.read_text())["missing"]}

    def test_what_all_drivers_found_is_in_one_file(self):
        done = self.run_report()
        self.assertEqual(done.returncode, 0, done.stderr)
        report = json.loads(self.json.read_text())
        self.assertEqual(report["context"]["drivers"], {"lammps": {"lammps": "today"}, "neighbours": {}})
        self.assertEqual(report["results"], [{"driver": "lammps", **entry} for entry in LAMMPS["results"]])
        self.assertEqual([entry["ratio"] for entry in report["pairs"]], [1.5, 2.5])
        self.assertEqual(len(report["energies"]), 1)

    def test_the_table_has_the_fastest_variant_of_each_code(self):
        lines = self.run_report().stdout.splitlines()
        found = [" ".join(line.split()) for line in lines]
        self.assertIn("Lennard-Jones, N = 32000, step", found)
        self.assertIn("1 core LAMMPS lj/cut/opt 300.00 ns 3.00 times ours", found)
        self.assertIn("2 cores LAMMPS lj/cut 210.00 ns 4.20 times ours", found)
        self.assertIn("1 core lanescape avx512 100.00 ns", found)
        self.assertNotIn("1 core LAMMPS lj/cut 400.00 ns 4.00 times ours", found)
        self.assertIn("vesin 1.50 to 2.50 times ours, 2 modes, sizes and orders", found)

    def test_what_is_missing_has_a_line_each(self):
        self.driver("openmm", {"context": {}, "missing": [{"what": "OpenMM", "why": "No module"}], "energies": [], "results": []}, status=1)
        done = self.run_report("--for", "lammps --fail")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.missing(), {"lammps": "driver.py: energies disagree", "gromacs": "no driver gromacs.py", "OpenMM": "No module"})
        for what, why in self.missing().items():
            self.assertIn(f"missing: {what}: {why}\n", done.stdout)

    def test_no_peer_at_all_is_a_failure(self):
        done = self.run_report("--only", "gromacs", "openmm")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(set(self.missing()), {"gromacs", "openmm"})

    def test_wrong_usage_is_refused(self):
        for arguments in (("--only", "abacus"), ("--for", "abacus --sizes 9"), ("--for", ""), ("--for", "lammps '"), ("--python", "/nowhere"), ("--unknown",),
                          ("--json", "/nowhere/at/all")):
            done = self.run_report(*arguments)
            self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1), done.stderr)


if __name__ == "__main__":
    unittest.main()
