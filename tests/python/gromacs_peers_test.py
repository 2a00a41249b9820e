#!/usr/bin/python3
"""bench/peers/gromacs.py with stand-ins for GROMACS, lanescape and bench_lists; with the real GROMACS where it is installed: the energies."""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DRIVER = ROOT / "bench" / "peers" / "gromacs.py"
LANESCAPE = None
sys.path.insert(0, str(ROOT / "tests" / "python"))

from peers_support import FAKE_BENCH, FAKE_LANESCAPE  # noqa: E402

# Particles anywhere, the energy of the stand-in for lanescape, and times of two seconds in all for 200 steps of 500 particles.
FAKE_GROMACS = """#!/usr/bin/python3
import os, random, sys
from pathlib import Path
word = dict(zip(sys.argv[2::1], sys.argv[3::1]))
if "--version" in sys.argv:
    print("GROMACS version:    2022.5\\nPrecision:          mixed\\nSIMD instructions:  AVX_512")
elif sys.argv[1] == "grompp":
    assert "vdw-modifier = potential-shift" in Path(word["-f"]).read_text()
    assert Path(word["-p"]).read_text().split()[-1] == Path(word["-c"]).read_text().split("\\n")[1]
    Path(word["-o"]).write_text(word["-c"])
else:
    if os.environ.get("FAKE_BROKEN"): sys.exit("no such thing")
    lines = Path(Path(word["-s"]).read_text()).read_text().splitlines()
    edge = float(lines[-1].split()[0])
    for k in range(2, len(lines) - 1):
        lines[k] = lines[k][:20] + "".join(f"{random.uniform(-edge, 2 * edge):8.3f}" for _ in range(3))
    Path(word["-deffnm"] + ".gro").write_text("\\n".join(lines))
    energy = -1234.5 * (1 + float(os.environ.get("FAKE_ERROR", "0")))
    Path(word["-deffnm"] + ".log").write_text(f\"\"\"
   Energies (kJ/mol)
        LJ (SR)   Coulomb (SR)      Potential    Kinetic En.   Total Energy
   {energy:12.6g}    0.00000e+00   -1.0e+05    1.0e+00   -1.0e+05
  outer list: updated every 50 steps, buffer 0.337 nm, rlist 2.837 nm
 Force evaluation time scaled
     R E A L   C Y C L E   A N D   T I M E   A C C O U N T I N G
 Neighbor search        1    1          4       0.500          1.316  33.6
 Force                  1    1        200       1.000          1.961  50.0
 Total                                          2.000          3.922 100.0
\"\"\")
"""


class GromacsPeers(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.json = self.folder / "peers.json"
        for name, text in (("lanescape", FAKE_LANESCAPE), ("bench_lists", FAKE_BENCH), ("gmx", FAKE_GROMACS)):
            (self.folder / name).write_text(text)
            (self.folder / name).chmod(0o755)

    def compare(self, *arguments, gromacs=True, environment=None):
        command = [sys.executable, DRIVER, "--bench", self.folder / "bench_lists", "--lanescape", self.folder / "lanescape", "--folder",
                   self.folder / "files", "--json", self.json, "--sizes", 500, "--threads", 1, 2, "--repetitions", 2,
                   *(("--gromacs", self.folder / "gmx") if gromacs else ()), *arguments]
        return subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False,
                              env={**os.environ, "FAKE_RECORD": str(self.folder / "record"), "FAKE_STEPS": "lennard-jones", **(environment or {})})

    def rows(self):
        return {(row["case"], row["code"], row["variant"], row["threads"]): row for row in json.loads(self.json.read_text())["results"]}

    def test_forces_and_steps_are_compared_on_one_and_two_threads(self):
        done = self.compare()
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = self.rows()
        for threads in (1, 2):
            step, force = rows["step", "GROMACS", "AVX_512", threads], rows["force", "GROMACS", "AVX_512", threads]
            self.assertAlmostEqual(step["ns_per_particle"], 2e9 / 200 / 500)
            self.assertAlmostEqual(force["ns_per_particle"], 1e9 / 200 / 500)
            self.assertAlmostEqual(step["ratio"], step["ns_per_particle"] / 20.0)
            self.assertIn(("step", "lanescape", "avx2, mixed", threads), rows)
            self.assertIn(("step", "lanescape", "avx2", threads), rows)
        self.assertIn("buffer 0.337 nm", done.stdout)

    def test_energies_that_disagree_end_the_run_before_timing(self):
        done = self.compare(environment={"FAKE_ERROR": "1e-4"})
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("energies disagree", done.stderr.splitlines()[-1])
        self.assertNotIn("timing", done.stderr)
        self.assertFalse(self.json.exists())

    def test_configurations_are_used_again(self):
        self.assertIn("melting", self.compare().stderr)
        self.assertNotIn("melting", self.compare().stderr)

    def test_a_missing_gromacs_is_named(self):
        done = self.compare(gromacs=False, environment={"PATH": str(self.folder / "nowhere")})
        self.assertEqual(done.returncode, 1)
        self.assertIn("missing: GROMACS: gmx is not on PATH", done.stdout)
        self.assertEqual(json.loads(self.json.read_text())["results"], [])

    def test_what_is_missing_of_ours_is_named(self):
        done = self.compare(environment={"FAKE_LACKS": "step-mixed/"})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("missing: bench_lists step-mixed, 2 threads", done.stdout)
        self.assertIsNone(self.rows()["step", "GROMACS", "AVX_512", 1]["ratio"])

    def test_a_gromacs_that_fails_is_named_in_one_line(self):
        done = self.compare(environment={"FAKE_BROKEN": "1"})
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("no such thing", done.stderr.splitlines()[-1])

    def test_wrong_usage_is_refused(self):
        for arguments in (("--sizes", "100"), ("--threads", "0"), ("--repetitions", "0"), ("--nstlist", "0"), ("--timestep", "1"),
                          ("--bench", "/nowhere"), ("--lanescape", "/nowhere"), ("--gromacs", "/nowhere"), ("--json", "/nowhere/at/all"),
                          ("--unknown",)):
            done = self.compare(*arguments)
            self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1), done.stderr)
            self.assertIn(arguments[0], done.stderr)

    def test_the_real_gromacs_agrees_with_lanescape(self):
        if not (shutil.which("gmx") and LANESCAPE):
            self.skipTest("no GROMACS" if LANESCAPE else "the program is not built")
        done = self.compare("--lanescape", LANESCAPE, "--threads", 1, "--sizes", 1372, "--steps", 40, "--repetitions", 1, gromacs=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        for entry in json.loads(self.json.read_text())["energies"]:
            self.assertLess(entry["relative_difference"], 2e-5)
            self.assertLess(entry["energy"], -3.0 * entry["particles"])


if __name__ == "__main__":
    if len(sys.argv) > 1 and not sys.argv[1].startswith("-"):
        LANESCAPE = sys.argv.pop(1)
    unittest.main()
