#!/usr/bin/python3
"""bench/peers/neighbours.py against stand-ins for the other codes: tests/python/neighbour_peers_test.py NEIGHBOUR_TIMER"""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

DRIVER = Path(__file__).resolve().parents[2] / "bench/peers/neighbours.py"
TIMER = None

# vesin by ASE, which is slow: each list is made once. `lost` pairs are left out.
STAND_IN = """
from ase import Atoms
from ase.neighborlist import neighbor_list

known = {{}}

class NeighborList:
    def __init__(self, cutoff, full_list, sorted, n_threads, skin=0.0):
        self.cutoff = cutoff

    def compute(self, points, box, periodic, quantities, copy):
        if (points.tobytes(), quantities) not in known:
            arrays = neighbor_list(quantities, Atoms(positions=points, cell=box, pbc=periodic), self.cutoff)
            known[points.tobytes(), quantities] = [array[:len(array) - {lost}] for array in arrays]
        return known[points.tobytes(), quantities]
"""


def run(*arguments, lost=None):
    with tempfile.TemporaryDirectory() as folder:
        if lost is not None:
            (Path(folder) / "vesin.py").write_text(STAND_IN.format(lost=lost))
        return subprocess.run([sys.executable, DRIVER, "--timer", TIMER, *map(str, arguments)], capture_output=True, text=True,
                              env={**os.environ, "PYTHONPATH": folder})


class NeighbourPeers(unittest.TestCase):
    def test_every_mode_of_a_peer_is_compared_with_ours(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "results.json"
            done = run("--sizes", 256, "--cutoff", 1.2, "--repetitions", 1, "--peers", "vesin", "--json", file, lost=0)
            self.assertEqual(done.returncode, 0, done.stderr)
            rows = json.loads(file.read_text())["results"]
        self.assertEqual(len(rows), 2 * 18)
        self.assertEqual({row["order"] for row in rows}, {"ordered", "shuffled"})
        for row in rows:
            self.assertAlmostEqual(row["ratio"], row["ns_per_pair"] / row["ours_ns_per_pair"])
            self.assertGreater(row["ours_ns_per_pair"], 0.0)
        self.assertIn("sorted half ij fresh", done.stdout)

    def test_pairs_that_disagree_end_the_run_before_timing(self):
        done = run("--sizes", 256, "--cutoff", 1.2, "--peers", "vesin", lost=1)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"^neighbours.py: vesin: \d+ of \d+ pairs differ; nothing was timed\n$")
        self.assertEqual(done.stdout, "")

    def test_a_code_that_is_missing_is_named(self):
        done = run("--sizes", 256, "--cutoff", 1.2, "--peers", "vesin")
        self.assertEqual(done.returncode, 1)
        self.assertIn("missing: vesin: No module named", done.stdout)

    def test_wrong_usage_is_refused(self):
        for arguments, part in ((("--sizes", 10), "at least 256"), (("--repetitions", 0), "at least 1"), (("--isa", "avx9"), "avx9")):
            done = run(*arguments)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertIn(part, done.stderr)


if __name__ == "__main__":
    TIMER = Path(sys.argv.pop(1)).resolve()
    unittest.main()
