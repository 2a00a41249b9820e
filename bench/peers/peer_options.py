"""Options that the drivers of peers share."""

import shutil
from pathlib import Path

from benchmark_results import ISAS
from ours import core_counts

ROOT = Path(__file__).resolve().parents[2]


def add_options(parser, repetitions, threads="[1, 2, 4, ... as many as there are cores]"):
    """What concerns our side, the configurations and the results."""
    parser.add_argument("--bench", type=Path, default=ROOT / "build/release/bench/bench_lists", help="[build/release/bench/bench_lists]")
    parser.add_argument("--lanescape", type=Path, default=ROOT / "build/release/lanescape", help="[build/release/lanescape]")
    parser.add_argument("--isa", choices=ISAS, help="instruction set of bench_lists [the widest]")
    parser.add_argument("--threads", nargs="+", type=int, default=core_counts(), metavar="T", help=threads)
    parser.add_argument("--repetitions", type=int, default=repetitions, help=f"[{repetitions}]")
    parser.add_argument("--seed", type=int, default=1, help="[1]")
    parser.add_argument("--folder", type=Path, default=ROOT / "build/peers", help="for configurations, which later runs use again, and logs [build/peers]")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the results there")


def check_options(parser, options, least_size, counts=(), programs=()):
    """Refuses what is out of range: of these options, `--sizes`, further numbers that count, further programs that may be named."""
    for name, least in (("sizes", least_size), ("threads", 1)):
        for number in getattr(options, name):
            if number < least:
                parser.error(f"--{name} {number}: must be at least {least}")
    for name in ("repetitions", *counts, "seed"):
        if getattr(options, name) < 1:
            parser.error(f"--{name} {getattr(options, name)}: must be at least 1")
    for name in programs:
        if getattr(options, name) and not shutil.which(getattr(options, name)):
            parser.error(f"--{name} {getattr(options, name)}: no such program")
    for name in ("bench", "lanescape"):
        if not shutil.which(getattr(options, name)):
            parser.error(f"--{name} {getattr(options, name)}: no such program; is it built?")
    if options.json and not options.json.absolute().parent.is_dir():
        parser.error(f"--json {options.json}: no such folder")


def check_work(parser, options):
    if not 1.0 <= options.work <= 1e12:
        parser.error(f"--work {options.work}: must be from 1 to 1e12")


def check_timestep(parser, options):
    if not 0.0 < options.timestep <= 0.02:
        parser.error(f"--timestep {options.timestep}: must be above 0 and at most 0.02")
