#!/usr/bin/env python3
"""What Python adds to the library, and ASE's own code beside it, in one run: bench/python_package.py BUILD

BUILD is the release build; the interpreter has the package `lanescape` and ASE. Each pair of times is measured alternately and the best of
each is taken. Prints one JSON object: a name, both times in seconds and their ratio.
"""

import json
import subprocess
import sys
import time
from pathlib import Path

import ase.io
import numpy as np
from ase import Atoms
from ase.build import bulk
from ase.calculators.lj import LennardJones as AseLennardJones
from ase.neighborlist import neighbor_list

import lanescape
from lanescape.ase import LennardJones

ROUNDS = 7
PAIR = Path(__file__).resolve().parents[1] / "tests/data/ka108-T1-pair.extxyz"


def seconds(work, at_least=0.05):
    """Of one call, over as many as take the least time."""
    times = 1
    while True:
        start = time.perf_counter()
        for _ in range(times):
            work()
        taken = time.perf_counter() - start
        if taken >= at_least:
            return taken / times
        times = max(2 * times, int(times * at_least / max(taken, 1e-9)) + 1)


def best(first, second, rounds=ROUNDS):
    """The best time of each of two measurements that take turns."""
    measured = [(first(), second()) for _ in range(rounds)]
    return tuple(min(column) for column in zip(*measured))


def row(name, times):
    return {"what": name, "seconds": times[0], "beside": times[1], "ratio": times[0] / times[1]}


def bare_kernel(build):
    command = [build / "bench/bench_facade", "--benchmark_filter=^bare_kernel$", "--benchmark_min_time=0.05", "--benchmark_format=json"]
    found = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
    return 1e-6 * found["benchmarks"][0]["real_time"]


def gradient(build):
    model = lanescape.Model.named("kob-andersen")
    frames = ase.io.read(PAIR, ":")
    species, box = frames[0].get_chemical_symbols(), frames[0].cell.lengths()
    potential, out = lanescape.Potential(model, species, box), np.empty((108, 3))
    positions = frames[0].positions.copy()
    return row("V + gradient, N = 108, over the bare kernel",
               best(lambda: seconds(lambda: potential.energy_and_gradient(positions, out)), lambda: bare_kernel(build)))


def calculator(repeat):
    rng = np.random.default_rng(1)
    atoms = bulk("Ar", "fcc", a=1.7, cubic=True).repeat(repeat)
    theirs = atoms.copy()
    atoms.calc, theirs.calc = LennardJones(), AseLennardJones(sigma=1.0, epsilon=1.0, rc=2.5, ro=2.5, smooth=False)

    def step(one):
        def work():
            one.positions += 1e-3 * rng.normal(size=one.positions.shape)
            one.get_potential_energy()
            one.get_forces()
        return work

    few = 3 if len(atoms) > 1000 else ROUNDS
    return row(f"energy and forces by ASE's LennardJones over the calculator, N = {len(atoms)}",
               best(lambda: seconds(step(theirs)), lambda: seconds(step(atoms)), few))


def finder(build):
    model, frames = lanescape.Model.named("kob-andersen"), ase.io.read(PAIR, ":")
    species, box = frames[0].get_chemical_symbols(), frames[0].cell.lengths()
    potential = lanescape.Potential(model, species, box)
    ends = [frame.positions.copy() for frame in frames]

    def program():
        command = [build / "lanescape", "path", "--pair", PAIR, "--threads", "1", "--quiet", "--max-steps", "20000"]
        found = subprocess.run(command, capture_output=True, text=True, check=False).stdout
        return json.loads(found)["paths"][0]["seconds"]

    return [row("the finder on a model, over the program",
                best(lambda: lanescape.find_path(model, *ends, species=species, box=box, max_steps=20000).seconds, program)),
            row("the finder on a Potential, over the program",
                best(lambda: lanescape.find_path(potential, *ends, max_steps=20000).seconds, program)),
            row("the finder on a function in Python, over the program",
                best(lambda: lanescape.find_path(potential.energy_and_gradient, *ends, max_steps=20000).seconds, program))]


def neighbours(particles):
    edge = (particles / 1.2) ** (1 / 3)
    atoms = Atoms(f"Ar{particles}", positions=np.random.default_rng(1).uniform(0.0, edge, size=(particles, 3)), cell=[edge] * 3, pbc=True)
    few = 3 if particles > 1000 else ROUNDS
    return row(f"ASE's neighbor_list over neighbour_list, N = {particles}",
               best(lambda: seconds(lambda: neighbor_list("ijSDd", atoms, 2.5)),
                    lambda: seconds(lambda: lanescape.neighbour_list("ijSDd", atoms, 2.5)), few))


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    build = Path(sys.argv[1]).resolve()
    rows = [gradient(build), calculator(3), calculator(10), *finder(build), neighbours(1000), neighbours(10000)]
    print(json.dumps({"version": lanescape.__version__, "isa": lanescape.instruction_sets()[-1], "rows": rows}, indent=1))


if __name__ == "__main__":
    main()
