"""Every kind of run, killed at random moments by random signals, in another folder and with other numbers of threads: it resumes to the same bits.

Usage: kill_test.py PROGRAM DATA_DIR [unittest arguments]. LANESCAPE_KILLS: kills of each kind (20); LANESCAPE_KILL_SEED: the first random number, which is printed.
"""

import os
import random
import signal
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "cli"))
from cli_support import ARGON, FLUID, GROWTH, SCAN, TINY, InterruptionTest, contents, with_options  # noqa: E402

KILLS = int(os.environ.get("LANESCAPE_KILLS", "20"))
SEED = int(os.environ.get("LANESCAPE_KILL_SEED", str(random.SystemRandom().randrange(10**6))))
BINARY = ("--model", "hard-sphere-binary")
SPHERES = (*BINARY, "--particles", "32", "--packing-fraction", "0.4", "--start-method", "growth")
PAIR = object()  # stands for --pair and a file of end points that is made first

# Each takes about a second, and saves its state several times in it.
KINDS = {
    "endpoints": ("endpoints", *ARGON, *with_options(TINY, "--melt-steps", "2000000", "--pairs", "2")),
    "endpoints of hard spheres": ("endpoints", *SPHERES, "--distance", "40", "--pairs", "3", "--equilibration-collisions", "1500000"),
    "path that makes its end points": ("path", *ARGON, *with_options(FLUID, "--melt-steps", "300000", "--pairs", "2")),
    "path, contour": ("path", *ARGON, "--step", "2e-5", PAIR),
    "path, escape": ("path", *ARGON, "--method", "escape", "--step", "1e-4", PAIR),
    "path, adaptive, reversed": ("path", *ARGON, "--adaptive", "--reverse", PAIR),
    "path, avoidance": ("path", *BINARY, "--step", "0.001", PAIR),
    "path, slide": ("path", *BINARY, "--adaptive", PAIR),
    "path, away": ("path", *BINARY, "--method", "away", PAIR),
    "shorten, montecarlo": ("shorten", *ARGON, "--method", "montecarlo", "--adaptive", "--starts", "2", PAIR),
    "shorten, curve": ("shorten", *ARGON, "--method", "curve", "--adaptive", "--starts", "2", PAIR),
    "shorten of hard spheres, curve": ("shorten", *BINARY, "--method", "curve", "--adaptive", PAIR),
    "shorten of hard spheres, montecarlo": ("shorten", *BINARY, "--method", "montecarlo", PAIR),
    "diffusion": ("diffusion", *ARGON, *TINY[:4], "--temperature", "2", *FLUID[-12:-2], "--lags", "100", "--records", "8000", "--trajectories", "3", "--between", "1000"),
    "diffusion of hard spheres": ("diffusion", *SPHERES, "--equilibration-collisions", "20000", "--interval", "0.01", "--lags", "500", "--records", "20000",
                                  "--trajectories", "3", "--between", "1000"),
    "insert --scan": with_options(SCAN, "--equilibration-steps", "100000"),
    "insert --densify": with_options(GROWTH, "--particles", "256", "--rows", "20", "--rate", "0.002"),
    "slab": ("slab", "--temperature", "0.8", "--equilibration-steps", "150", "--sampling-steps", "150", "--interval", "10"),
    "flow": ("flow", "--velocity", "0.3", "--length", "20", "--width", "6", "--equilibration-steps", "500", "--resting-steps", "500", "--flow-steps", "2000",
             "--sampling-steps", "1000", "--row-steps", "100"),
    "flow, continuum": ("flow", "--outside", "continuum", "--length", "20", "--width", "6", "--equilibration-steps", "500", "--resting-steps", "500", "--flow-steps",
                        "2000", "--sampling-steps", "1000", "--row-steps", "100"),
}


def results(folder):
    """What a run leaves behind; its options name a number of threads."""
    return {name: content for name, content in contents(folder).items() if name != "run.toml"}


class Kills(InterruptionTest):
    def arguments(self, kind):
        """The command line of a kind, with the file of its end points."""
        line = KINDS[kind]
        if PAIR not in line:
            return line
        makes = ("endpoints", *(ARGON + FLUID if "lennard-jones" in line else (*SPHERES[:2], "--particles", "32", "--packing-fraction", "0.2", "--quick",
                                                                                  "--distance", "20")))
        [pair] = [made["file"] for made in self.done(*makes, "--out", self.folder / "ends")["pairs"]]
        return tuple(line[:-1]) + ("--pair", pair)

    def kill(self, chance, line, out, after):
        """Starts or continues a run and ends it after some seconds, if it has not ended by itself. Returns whether it was ended."""
        process = self.start(*line, out=out, into="--resume-or-start")
        time.sleep(after)
        signals = chance.choice(((signal.SIGKILL,), (signal.SIGTERM,), (signal.SIGINT,), (signal.SIGTERM, signal.SIGKILL), (signal.SIGINT, signal.SIGINT)))
        ended = process.poll() is None
        for which in signals:
            process.send_signal(which)
            time.sleep(chance.choice((0.0, 0.001, 0.02)))
        stderr = process.communicate(timeout=60)[1]
        self.assertIn(process.returncode, (0, 4, *(-which for which in signals)), stderr)
        self.assertLessEqual(len(stderr.splitlines()), 1, stderr)
        return ended

    def survive(self, kind):
        chance = random.Random(f"{SEED} {kind}")
        line = self.arguments(kind)
        whole = self.folder / "whole"
        began = time.monotonic()
        self.done(*with_options(line, "--threads", "2"), "--out", whole)
        seconds = time.monotonic() - began
        kills = runs = 0
        while kills < KILLS:
            runs += 1
            self.assertLess(runs, 40 * KILLS, "it ends before it can be killed")
            out = self.folder / f"run-{runs}"
            for _ in range(chance.randrange(1, 5)):
                with_threads = with_options(line, "--threads", chance.choice(("1", "2")))
                kills += self.kill(chance, with_threads, out, chance.uniform(0.0, 0.8 * seconds))
                if out.exists() and chance.random() < 0.3:
                    out = out.rename(self.folder / f"moved-{kills}-{runs}")
            self.done(*line, "--resume-or-start", out)
            for name, content in results(whole).items():
                self.assertEqual(results(out)[name], content, f"{kind}, {name}: LANESCAPE_KILL_SEED={SEED}")
            self.assertEqual([file for file in out.rglob(".lanescape-*")], [])
        return kills


def add(kind):
    def test(self):
        print(f"{kind}: {self.survive(kind)} kills, LANESCAPE_KILL_SEED={SEED}", flush=True)
    setattr(Kills, "test_" + "".join(c if c.isalnum() else "_" for c in kind), test)


for name in KINDS:
    add(name)

if __name__ == "__main__":
    unittest.main()
