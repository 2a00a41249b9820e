#!/usr/bin/python3
"""bench/peers/openmm.py with stand-ins for OpenMM, lanescape and bench_lists; with the real OpenMM where it is installed: the energies."""

import importlib.util
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DRIVER = ROOT / "bench" / "peers" / "openmm.py"
LANESCAPE = None
sys.path.insert(0, str(ROOT / "tests" / "python"))

from peers_support import FAKE_BENCH, FAKE_LANESCAPE  # noqa: E402

# Particles anywhere, the energy of the stand-in for lanescape, and steps that take time.
STAND_IN = """
import os, time
from types import SimpleNamespace as Value
import numpy as np

__version__ = "0.1"
OpenMMException = type("OpenMMException", (Exception,), {})
Platform = Value(getPlatformByName=lambda name: name)

class System:
    particles, box = 0, None
    def setDefaultPeriodicBoxVectors(self, a, b, c): self.box = a[0]
    def addParticle(self, mass): self.particles += 1
    def addForce(self, force): assert force.cutoff == 2.5 and not force.tail and force.particles == self.particles
    def getNumParticles(self): return self.particles

class NonbondedForce:
    CutoffPeriodic, particles, tail = "periodic", 0, True
    def addParticle(self, charge, sigma, epsilon): self.particles += 1
    def setNonbondedMethod(self, method): assert method == "periodic"
    def setCutoffDistance(self, cutoff): self.cutoff = cutoff
    def setUseDispersionCorrection(self, tail): self.tail = tail

class Integrator:
    def __init__(self, *numbers): self.numbers = numbers
    def step(self, count): time.sleep(1e-5 * count)
    def setRandomNumberSeed(self, seed): pass
    def setTemperature(self, temperature): pass

VerletIntegrator = LangevinMiddleIntegrator = Integrator

class Context:
    def __init__(self, system, integrator, platform, properties):
        if os.environ.get("FAKE_BROKEN"): raise OpenMMException("no such platform")
        assert platform == "CPU" and int(properties["Threads"]) > 0
        self.system = system
    def setPositions(self, positions): assert len(positions) == self.system.particles
    def setVelocitiesToTemperature(self, temperature, seed): pass
    def getSystem(self): return self.system
    def getState(self, getEnergy=False, getPositions=False):
        energy = -1234.5 * (1 + float(os.environ.get("FAKE_ERROR", "0")))
        positions = np.random.default_rng(1).uniform(-1, 2 * self.system.box, (self.system.particles, 3))
        return Value(getPotentialEnergy=lambda: Value(_value=energy), getPositions=lambda asNumpy: Value(_value=positions))
"""


class OpenMMPeers(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.record, self.json = self.folder / "record", self.folder / "peers.json"
        for name, text in (("lanescape", FAKE_LANESCAPE), ("bench_lists", FAKE_BENCH)):
            (self.folder / name).write_text(text)
            (self.folder / name).chmod(0o755)

    def compare(self, *arguments, stand_in=STAND_IN, environment=None):
        modules = self.folder / "modules"
        modules.mkdir(exist_ok=True)
        (modules / "openmm.py").write_text(stand_in)
        command = [sys.executable, DRIVER, "--bench", self.folder / "bench_lists", "--lanescape", self.folder / "lanescape", "--folder",
                   self.folder / "files", "--json", self.json, "--sizes", 256, "--threads", 1, 2, "--repetitions", 2, "--work", 1e4, *arguments]
        return subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False,
                              env={**os.environ, "FAKE_RECORD": str(self.record), "FAKE_STEPS": "lennard-jones", "PYTHONPATH": str(modules),
                                   **(environment or {})})

    def rows(self):
        return {(row["code"], row["variant"], row["threads"]): row for row in json.loads(self.json.read_text())["results"]}

    def test_steps_are_compared_on_one_and_two_threads(self):
        done = self.compare()
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = self.rows()
        self.assertEqual(set(rows), {(code, variant, threads) for threads in (1, 2) for code, variant in
                                     (("lanescape", "avx2"), ("lanescape", "avx2, mixed"), ("OpenMM", "CPU"))})
        for threads in (1, 2):
            peer = rows["OpenMM", "CPU", threads]
            self.assertEqual((peer["case"], len(peer["samples"])), ("step", 2))
            self.assertGreater(peer["ns_per_particle"], 1e4 / 256)
            self.assertAlmostEqual(peer["ratio"], peer["ns_per_particle"] / 20.0)
        self.assertIn("energies agree to 0", done.stdout)

    def test_energies_that_disagree_end_the_run_before_timing(self):
        done = self.compare(environment={"FAKE_ERROR": "2e-6"})
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("energies disagree", done.stderr.splitlines()[-1])
        self.assertNotIn("timing", done.stderr)
        self.assertFalse(self.json.exists())
        self.assertEqual(self.compare(environment={"FAKE_ERROR": "0.5e-6"}).returncode, 0)

    def test_configurations_are_used_again(self):
        self.assertIn("melting", self.compare().stderr)
        self.assertNotIn("melting", self.compare().stderr)

    def test_a_missing_openmm_is_named(self):
        done = self.compare(stand_in="raise ImportError('nowhere to be found')")
        self.assertEqual(done.returncode, 1)
        self.assertIn("missing: OpenMM: nowhere to be found", done.stdout)
        self.assertEqual(json.loads(self.json.read_text())["missing"], [{"what": "OpenMM", "why": "nowhere to be found"}])

    def test_what_is_missing_of_ours_is_named(self):
        done = self.compare(environment={"FAKE_LACKS": "step/"})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("missing: bench_lists step, 2 threads", done.stdout)
        self.assertIsNone(self.rows()["OpenMM", "CPU", 1]["ratio"])

    def test_an_openmm_that_fails_is_named_in_one_line(self):
        done = self.compare(environment={"FAKE_BROKEN": "1"})
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("openmm.py: no such platform", done.stderr)

    def test_wrong_usage_is_refused(self):
        for arguments in (("--sizes", "100"), ("--threads", "0"), ("--repetitions", "0"), ("--work", "inf"), ("--bench", "/nowhere"),
                          ("--lanescape", "/nowhere"), ("--json", "/nowhere/at/all"), ("--unknown",)):
            done = self.compare(*arguments)
            self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1), done.stderr)
            self.assertIn(arguments[0], done.stderr)

    def test_the_real_openmm_agrees_with_lanescape(self):
        if not (importlib.util.find_spec("openmm") and LANESCAPE):
            self.skipTest("no OpenMM" if LANESCAPE else "the program is not built")
        done = self.compare("--lanescape", LANESCAPE, "--threads", 1, environment={"PYTHONPATH": ""})
        self.assertEqual(done.returncode, 0, done.stderr)
        for entry in json.loads(self.json.read_text())["energies"]:
            self.assertLess(entry["relative_difference"], 1e-6)
            self.assertLess(entry["energy"], -3.0 * entry["particles"])


if __name__ == "__main__":
    if len(sys.argv) > 1 and not sys.argv[1].startswith("-"):
        LANESCAPE = sys.argv.pop(1)
    unittest.main()
