"""Shared by the tests of the program, which see it as a user's script does: exit status, streams, files and JSON keys.

Usage of every test file here: <subject>_test.py PROGRAM DATA_DIR [unittest arguments]
"""

import csv
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

if len(sys.argv) < 3:
    sys.exit(__doc__)
PROGRAM, DATA = str(Path(sys.argv.pop(1)).resolve()), Path(sys.argv.pop(1)).resolve()
SLOWER = float(os.environ.get("LANESCAPE_SLOWER", "1"))  # how many times as long programs may take: sanitizers slow them down
EXAMPLES = Path(__file__).resolve().parents[2] / "docs" / "examples"

SUBCOMMANDS = ("info", "energy", "overlap", "endpoints", "path", "shorten", "diffusion", "insert", "flow", "slab", "analyze", "verify", "cases", "check")
COMMON_OPTIONS = ("--help", "--seed", "--threads", "--isa", "--quiet", "--config", "--out", "--resume", "--resume-or-start")

# A liquid small and short enough for a test. Eight particles with the nearest image take 10^6 steps in half a second.
PROTOCOL = ("--melt-steps", "500", "--cooling-steps", "500", "--check-steps", "500", "--check-tolerance", "50",
            "--settle-steps", "200", "--between-steps", "100")
ARGON = ("--model", "lennard-jones", "--images", "minimum")
WARM = ("--temperature", "2", "--distance", "1") + PROTOCOL
TINY = ("--particles", "8", "--density", "0.8") + WARM
FLUID = ("--particles", "32", "--density", "0.8", "--temperature", "1", "--distance", "5") + PROTOCOL

# Insertion: a short scan of its cost, and a short densification.
TAIL = ("--model", "lennard-jones", "--truncation", "tail")
SCAN = ("insert", "--scan", *TAIL, "--states", "0.4:2.5,0.5:2", "--particles", "64", "--configurations", "2", "--count", "20",
        "--methods", "usher,screened,descent", "--tolerances", "0.2,0.01", "--equilibration-steps", "200", "--between-steps", "100",
        "--widom-probes", "500", "--holes", "2", "--iso-energies", "0,5", "--traced-searches", "5", "--map-points", "3", "--threads", "1")
GROWTH = ("insert", "--densify", "0.5", *TAIL, "--particles", "64", "--rows", "4", "--rate", "0.1", "--equilibration-steps", "200",
          "--threads", "1")

LATTICE = 'Lattice="4 0 0 0 4 0 0 0 4"'
PROPERTIES = "Properties=species:S:1:pos:R:3"
HEADER = f'{LATTICE} {PROPERTIES} pbc="T T T"'
SPHERE_HEADER = 'Lattice="4 0 0 0 4 0 0 0 4" Properties=species:S:1:pos:R:3:radius:R:1 pbc="T T T"'


def with_options(arguments, *changes):
    """The arguments with some options changed or added; the program accepts each option only once."""
    arguments = list(arguments)
    for option, value in zip(changes[::2], changes[1::2]):
        if option in arguments:
            arguments[arguments.index(option) + 1] = value
        else:
            arguments += [option, value]
    return arguments


def frame(*particles, header=HEADER, count=None):
    return "\n".join([str(len(particles) if count is None else count), header, *particles]) + "\n"


TWO = ("Ar 0 0 0", "Ar 1.1 0 0")
TWO_MOVED = ("Ar 0 0 0.5", "Ar 1.2 0.3 0")
OVERLAP = ("Ar 1 1 1", "Ar 0 0 0", "Ar 2 2 2", "Ar 0.2 0.1 3.9")  # 1 and 3, across the wall


def environment(**changes):
    result = {k: v for k, v in os.environ.items() if k not in ("LANESCAPE_ISA", "OMP_NUM_THREADS")}
    result.update(changes)
    return result


def lanescape(*arguments, cwd=None, timeout=120 * SLOWER, **variables):
    return subprocess.run([PROGRAM, *map(str, arguments)], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          cwd=cwd, timeout=timeout, env=environment(**variables))


def one_object(text):
    """The JSON object in the text, which must contain nothing else."""
    def refuse_duplicates(pairs):
        keys = [key for key, _ in pairs]
        assert len(keys) == len(set(keys)), keys
        return dict(pairs)
    result = json.loads(text, object_pairs_hook=refuse_duplicates)
    assert isinstance(result, dict), text
    return result


def without_seconds(result):
    """The part of a result that depends only on the seed: without times and without folders in file names."""
    if isinstance(result, dict):
        return {k: Path(v).name if k == "file" and v else without_seconds(v) for k, v in result.items() if k != "seconds"}
    return [without_seconds(v) for v in result] if isinstance(result, list) else result


def contents(folder):
    """The content of every file of a run by name, without times and binary checkpoints."""
    files = {}
    for file in sorted(Path(folder).iterdir()):
        if file.name == "result.json":
            files[file.name] = without_seconds(one_object(file.read_text()))
        elif file.name in ("paths.csv", "scan.csv"):
            files[file.name] = [{k: v for k, v in row.items() if k != "seconds"} for row in csv.DictReader(file.read_text().splitlines())]
        elif file.is_file():
            files[file.name] = file.read_bytes()
    return files


class ProgramTest(unittest.TestCase):
    maxDiff = 2000

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="lanescape-cli-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def file(self, name, content):
        path = self.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    def done(self, *arguments, status=0, **options):
        run = lanescape(*arguments, **options)
        self.assertEqual(run.returncode, status, f"{arguments}: {run.stderr}")
        return one_object(run.stdout)

    def refused(self, *arguments, says=(), **options):
        """Exit status 2, nothing on stdout and one line on stderr that contains all of `says`."""
        run = lanescape(*arguments, **options)
        self.assertEqual((run.returncode, run.stdout), (2, ""), f"{arguments}: {run.stderr}")
        self.assertRegex(run.stderr, r"\Alanescape: [^\n\r]+\n\Z")
        for part in (says,) if isinstance(says, str) else says:
            self.assertIn(part, run.stderr)
        return run.stderr

    def refused_cleanly(self, *arguments, **options):
        """Refused; a new folder for --out and its parents are not created, and an empty one is not changed."""
        self.refused(*arguments, **options)
        before = sorted(self.folder.rglob("*"))
        self.refused(*arguments, "--out", self.folder / "new" / "nested", **options)
        self.assertEqual(sorted(self.folder.rglob("*")), before, f"{arguments} left a folder behind")
        (self.folder / "there").mkdir()
        self.refused(*arguments, "--out", self.folder / "there", **options)
        self.assertEqual(list((self.folder / "there").iterdir()), [], f"{arguments} left files behind")
        (self.folder / "there").rmdir()

    def make_pairs(self, name, count=1, *, seed=7):
        run = self.done("endpoints", *ARGON, *FLUID, "--pairs", count, "--seed", seed, "--out", self.folder / name)
        return [pair["file"] for pair in run["pairs"]]


class InterruptionTest(ProgramTest):
    def start(self, *arguments, out, into="--out"):
        process = subprocess.Popen([PROGRAM, *map(str, arguments), into, str(out)], stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment())
        self.addCleanup(lambda: (process.poll() is None and process.kill(), process.communicate()))
        return process

    def wait_for(self, process, file):
        for _ in range(3000):
            if file.exists():
                return
            self.assertIsNone(process.poll(), "the run ended before it could be interrupted")
            time.sleep(0.005)
        self.fail(f"{file} never came")

    def interrupt(self, *arguments, out, into="--out", after="run.toml", with_signal=signal.SIGTERM, seconds=0.1):
        """Interrupts a run the given number of seconds after it has created a file in its folder."""
        process = self.start(*arguments, out=out, into=into)
        self.wait_for(process, out / after)
        time.sleep(seconds)
        process.send_signal(with_signal)
        stdout, stderr = process.communicate(timeout=30 * SLOWER)
        self.assertEqual((process.returncode, stderr), (4, ""))
        result = one_object(stdout)
        self.assertEqual(result["exit_status"], 4)
        self.assertEqual(result, one_object((out / "result.json").read_text()))
        return result

    def assert_resumes_to(self, out, whole, subcommand, times=1):
        for _ in range(times):
            resumed = self.done(subcommand, "--resume", out)
        self.assertEqual(without_seconds(resumed), without_seconds(one_object((whole / "result.json").read_text())))
        self.assertEqual(contents(out), contents(whole))

    def assert_survives_interruption_and_kill(self, *arguments, checkpoint):
        """Ends the run early by a signal, and by a kill once it has a checkpoint: both resume to what it is as a whole."""
        whole, cut, killed = (self.folder / name for name in ("whole", "cut", "killed"))
        self.done(*arguments, "--out", whole)
        result = self.interrupt(*arguments, out=cut, after=checkpoint, with_signal=signal.SIGTERM, seconds=0.0)
        self.assertEqual(result["outcome"], "interrupted")
        self.assert_resumes_to(cut, whole, arguments[0], times=2)
        process = self.start(*arguments, out=killed)
        self.wait_for(process, killed / checkpoint)
        process.kill()
        process.wait()
        self.assert_resumes_to(killed, whole, arguments[0])
