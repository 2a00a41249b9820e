"""The runs of a campaign: with which options each is started, and from whose end points."""

from typing import NamedTuple

PAIRS_PER_RUN = 10  # of path runs; several runs of one setting are pooled by `lanescape analyze`


class Run(NamedTuple):
    arguments: str
    ends: str = ""  # the run whose pairs of end points this one takes
    pairs: tuple = ()  # numbers of these pairs, from 1


class Plan:
    """Runs by name, which is their folder below that of the campaign: chapter/run."""

    def __init__(self):
        self.runs = {}

    def __getitem__(self, name):
        return self.runs[name]

    def chapter(self, name):
        return [run for run in self.runs if run.startswith(name + "/")]

    def ends(self, name, options, pairs, seed=1):
        self._add(name, Run(f"endpoints {options} --pairs {pairs} --seed {seed}"))

    def paths(self, name, ends, options, pairs):
        for first in range(1, pairs + 1, PAIRS_PER_RUN):
            some = tuple(range(first, min(first + PAIRS_PER_RUN, pairs + 1)))
            suffix = f"-{first}" if pairs > PAIRS_PER_RUN else ""
            self._add(name + suffix, Run(f"path {options} --frames 0", ends, some))

    def shortened(self, name, ends, options, pairs):
        for pair in range(1, pairs + 1):
            self._add(f"{name}-{pair}", Run(f"shorten {options} --frames 0 --seed {pair}", ends, (pair,)))

    def diffusion(self, name, options, seed=2):
        self._add(name, Run(f"diffusion {options} --seed {seed}"))

    def arguments(self, name, out):
        run = self.runs[name]
        files = " ".join(f"{out}/{run.ends}/pair-{pair:04}.extxyz" for pair in run.pairs)
        return f"{run.arguments} --pair {files}" if run.ends else run.arguments

    def _add(self, name, run):
        assert name not in self.runs, name
        self.runs[name] = run
