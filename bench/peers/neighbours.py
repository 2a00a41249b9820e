#!/usr/bin/env python3
"""Neighbour pairs by NeighbourFinder, vesin, matscipy and freud side by side: bench/peers/neighbours.py [--json FILE]

A liquid's density, a lattice with random displacements, particles in the order of the lattice and shuffled. First the sets of pairs are
compared: i, j and S of vesin and matscipy must equal ours, else nothing is timed (exit status 1). freud works in single precision: the
number of its pairs that differ is reported. Then each mode of a peer and the same mode of ours are called in turn, --repetitions times, on
one thread, and the shortest times are compared:
  reused  an object that has seen the particles before; its arrays are written again
  fresh   a new object for each call
Times are those of the processor, page faults included: other programs on the machine change them less than those of the clock. Python
peers run in this process, ours in neighbour_timer beside it; the interpreter costs microseconds per call.

It needs Python with numpy and those of vesin, matscipy and freud-analysis that are to be compared; what is missing is reported.
Exit status: 0; 1 if pairs disagree or a program fails; 2 for wrong usage.
"""

import dataclasses
import datetime
import json
import os
import subprocess
import sys
import tempfile
import time
from functools import partial
from pathlib import Path

os.environ["OMP_NUM_THREADS"] = "1"  # before the peers are imported

import numpy as np  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))

from benchmark_results import ISAS, Arguments  # noqa: E402
from ours import Failed  # noqa: E402
from systems import LIQUIDS, lattice, wrapped  # noqa: E402


@dataclasses.dataclass(frozen=True)
class Mode:
    """A way to call a peer, and the same mode of ours: order, members, quantities, age."""

    code: str
    name: str
    make: object  # makes a call without arguments; what that returns is dropped after the clock has stopped
    ours: tuple


class Ours:
    """neighbour_timer on one configuration."""

    def __init__(self, program, file, isa):
        self.process = subprocess.Popen([program, file, isa], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def ask(self, *words):
        try:
            print(*words, file=self.process.stdin, flush=True)
            answer = self.process.stdout.readline().split()
        except BrokenPipeError:
            answer = []
        if not answer:
            raise Failed(f"neighbour_timer: no answer to {' '.join(map(str, words))}")
        return answer

    def close(self):
        self.process.stdin.close()
        self.process.wait()


def imported(name, missing):
    try:
        return __import__(name, fromlist=["_"])
    except ImportError as error:
        missing.append({"what": name, "why": str(error)})
        return None


def keys_of(i, j, shifts, particles):
    """A number for each pair, in rising order; shifts are below 64."""
    keys = np.asarray(i, np.int64) * particles + np.asarray(j, np.int64)
    for axis in range(3):
        keys = 128 * keys + (np.asarray(shifts[:, axis], np.int64) + 64)
    return np.sort(keys)


def differing(keys, expected):
    return int((keys != expected).sum()) if len(keys) == len(expected) else len(np.setxor1d(keys, expected))


class Vesin:
    def __init__(self, module, positions, edge, cutoff):
        self.module, self.positions, self.box, self.cutoff = module, positions, np.diag([edge] * 3), cutoff

    def calculator(self, **options):
        return self.module.NeighborList(**{"cutoff": self.cutoff, "full_list": True, "sorted": False, "n_threads": 1, **options})

    def compute(self, calculator, quantities):
        return calculator.compute(self.positions, self.box, True, quantities, copy=False)

    def differing(self, expected):
        calculator = self.calculator()  # it owns the arrays
        return differing(keys_of(*self.compute(calculator, "ijS"), len(self.positions)), keys_of(*expected, len(self.positions)))

    def reused(self, quantities, **options):
        calculator = self.calculator(**options)
        return lambda: self.compute(calculator, quantities)

    def fresh(self, quantities, **options):
        return lambda: (calculator := self.calculator(**options), self.compute(calculator, quantities))

    def modes(self):
        for order in ("any", "sorted"):
            for members in ("full", "half"):
                options = {"sorted": order == "sorted", "full_list": members == "full"}
                for quantities in ("ijSDd", "ij"):
                    for age, make in (("reused", self.reused), ("fresh", self.fresh)):
                        yield Mode("vesin", f"{order} {members} {quantities} {age}", partial(make, quantities, **options),
                                   (order, members, quantities, age))
            # The particles do not move: vesin keeps its list, and only the distances are computed again.
            yield Mode("vesin", f"{order} full ijSDd, list of skin 0.3 kept", partial(self.reused, "ijSDd", sorted=order == "sorted", skin=0.3),
                       (order, "full", "ijSDd", "reused"))


class Matscipy:
    def __init__(self, module, positions, edge, cutoff):
        self.particles = len(positions)
        self.list = lambda quantities: module.neighbour_list(quantities, positions=positions, cell=np.diag([edge] * 3), pbc=[True] * 3, cutoff=cutoff)

    def differing(self, expected):
        return differing(keys_of(*self.list("ijS"), self.particles), keys_of(*expected, self.particles))

    def modes(self):
        for quantities in ("ijSDd", "ij"):
            yield Mode("matscipy", f"sorted full {quantities} fresh", lambda q=quantities: partial(self.list, q),
                       ("sorted", "full", quantities, "fresh"))


class Freud:
    def __init__(self, module, positions, edge, cutoff):
        module.parallel.set_num_threads(1)
        self.module, self.box, self.cutoff = module.locality, module.box.Box.cube(edge), cutoff
        self.points = self.box.wrap(positions - 0.5 * edge)

    def query(self):
        return self.module.AABBQuery(self.box, self.points)

    def list(self, query):
        return query.query(self.points, {"r_max": self.cutoff, "exclude_ii": True}).toNeighborList()

    def differing(self, expected):
        pairs, none = np.asarray(self.list(self.query())[:]), np.zeros((1, 3), np.int64)
        particles = len(self.points)  # an image cannot be told from another: boxes are wider than two cutoffs
        return len(np.setxor1d(keys_of(pairs[:, 0], pairs[:, 1], none, particles), keys_of(expected[0], expected[1], none, particles)))

    def modes(self):
        yield Mode("freud", "sorted full ijDd reused", lambda: partial(self.list, self.query()), ("sorted", "full", "ijDd", "reused"))
        yield Mode("freud", "sorted full ijDd fresh", lambda: lambda: self.list(self.query()), ("sorted", "full", "ijDd", "fresh"))


PEERS = {"vesin": ("vesin", Vesin), "matscipy": ("matscipy.neighbours", Matscipy), "freud": ("freud", Freud)}
SINGLE_PRECISION = {"freud"}


def configuration(particles, order, seed):
    """A lattice at density 1.2 with random displacements, in the order of the lattice or shuffled, and its box."""
    rng, sites = np.random.default_rng(seed), lattice(LIQUIDS["kob-andersen"], particles, seed)
    positions = wrapped(sites.positions + rng.normal(0.0, 0.08, (particles, 3)), sites.edge)
    return np.ascontiguousarray(positions[rng.permutation(particles)] if order == "shuffled" else positions), float(sites.edge)


def check(ours, peers, folder):
    """How many pairs of each peer differ from ours. Raises Failed where they must not."""
    file = folder / "pairs"
    ours.ask("pairs", file)
    rows = np.fromfile(file, dtype=np.int64).reshape(-1, 5)
    expected = rows[:, 0], rows[:, 1], rows[:, 2:]
    counts = {}
    for name, peer in peers.items():
        counts[name] = peer.differing(expected)
        if counts[name] and name not in SINGLE_PRECISION:
            raise Failed(f"{name}: {counts[name]} of {len(rows)} pairs differ; nothing was timed")
    return len(rows), counts


def compare(ours, mode, repetitions):
    """The shortest times [s] of a mode, theirs and ours, called in turn. The first call of an object is not timed: it makes its memory."""
    call = mode.make()
    theirs, own = [], []
    for _ in range(repetitions + 1):
        begin = time.process_time()
        result = call()
        theirs.append(time.process_time() - begin)
        del result
        own.append(float(ours.ask("time", *mode.ours)[1]))
    return min(theirs[1:]), min(own[1:])


def run(options, missing):
    modules = {name: imported(PEERS[name][0], missing) for name in options.peers}
    results = []
    with tempfile.TemporaryDirectory() as folder:
        for particles in options.sizes:
            for order in ("ordered", "shuffled"):
                positions, edge = configuration(particles, order, options.seed)
                file = Path(folder) / "configuration"
                np.concatenate([[edge, options.cutoff], positions.ravel()]).tofile(file)
                ours = Ours(options.timer, file, options.isa)
                peers = {name: PEERS[name][1](module, positions, edge, options.cutoff) for name, module in modules.items() if module}
                pairs, counts = check(ours, peers, Path(folder))
                for mode in (mode for peer in peers.values() for mode in peer.modes()):
                    print(f"N = {particles}, {order}: {mode.code} {mode.name}", file=sys.stderr)
                    theirs, own = compare(ours, mode, options.repetitions)
                    each = pairs / 2 if mode.ours[1] == "half" else pairs
                    results.append({"particles": particles, "order": order, "code": mode.code, "mode": mode.name, "pairs": pairs,
                                    "differing": counts[mode.code], "ns_per_pair": 1e9 * theirs / each,
                                    "ours_ns_per_pair": 1e9 * own / each, "ratio": theirs / own})
                ours.close()
    return results


def print_table(results, missing):
    print("Nanoseconds of the processor per pair, shortest of all calls, one thread: theirs, ours; ratio: peer/lanescape")
    group = None
    for row in results:
        if group != (row["particles"], row["order"]):
            group = row["particles"], row["order"]
            print(f"\nN = {row['particles']}, {row['order']}, {row['pairs']} pairs")
        remark = f"  {row['differing']} pairs differ" if row["differing"] else ""
        print(f"  {row['code']:9} {row['mode']:42} {row['ns_per_pair']:8.2f} {row['ours_ns_per_pair']:8.2f} {row['ratio']:7.2f}{remark}")
    for entry in missing:
        print(f"missing: {entry['what']}: {entry['why']}")


def main(arguments):
    parser = Arguments(prog="neighbours.py", description="Neighbour pairs by other codes beside ours; the head of this file describes the comparison.")
    parser.add_argument("--timer", type=Path, default=ROOT / "build/release/bench/neighbour_timer", help="[build/release/bench/neighbour_timer]")
    parser.add_argument("--isa", choices=(*ISAS, "auto"), default="auto", help="instruction set of ours [auto]")
    parser.add_argument("--peers", nargs="+", choices=tuple(PEERS), default=tuple(PEERS), help="[all]")
    parser.add_argument("--sizes", nargs="+", type=int, default=(1000, 10000, 100000), metavar="N", help="particles [1000 10000 100000]")
    parser.add_argument("--cutoff", type=float, default=2.5, help="[2.5]")
    parser.add_argument("--repetitions", type=int, default=7, help="[7]")
    parser.add_argument("--seed", type=int, default=1, help="[1]")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the results there")
    options = parser.parse_args(arguments)
    for name, least in (("repetitions", 1), ("seed", 1), ("cutoff", 1e-3)):
        if not getattr(options, name) >= least:
            parser.error(f"--{name} {getattr(options, name)}: must be at least {least}")
    for size in options.sizes:
        if size < 256:
            parser.error(f"--sizes {size}: must be at least 256")
    if not os.access(options.timer, os.X_OK):
        parser.error(f"--timer {options.timer}: no such program; is it built?")
    missing = []
    try:
        results = run(options, missing)
        if options.json:
            context = {"date": datetime.datetime.now().astimezone().isoformat(timespec="seconds"), "load_average": os.getloadavg()[0],
                       "cutoff": options.cutoff, "isa": options.isa, "repetitions": options.repetitions}
            options.json.write_text(json.dumps({"context": context, "missing": missing, "results": results}, indent=2) + "\n")
    except (Failed, OSError) as error:
        print(f"neighbours.py: {error}", file=sys.stderr)
        return 1
    print_table(results, missing)
    return 0 if results else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
