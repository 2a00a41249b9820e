#!/usr/bin/python3
"""Paths through LAMMPS: builds the engine for Debian's LAMMPS, and compares paths with those on the library's own landscape.

landscape_test.py PROGRAM SOURCE

77: skipped, with the reason: no LAMMPS or MPI to build with.
"""

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from lammps_support import OPENMPI, OPENMPI_AS_ROOT, TWO_SPECIES, skip

STEPS = 3000  # of a path: later, differences of rounding have grown
INTERRUPTED = 4


def input_of(pair, folder):
    """A LAMMPS input of the first frame of a pair of Kob and Andersen's mixture, and its data file."""
    lines = pair.read_text().splitlines()
    box = [float(word) for word in re.search(r'Lattice="([^"]+)"', lines[1]).group(1).split()][::4]
    atoms = [line.split() for line in lines[2: 2 + int(lines[0])]]
    data = [f"pair\n\n{len(atoms)} atoms\n2 atom types", *(f"0 {edge!r} {axis}lo {axis}hi" for edge, axis in zip(box, "xyz")), "\nAtoms\n"]
    for k, (species, *r) in enumerate(atoms):
        data.append(" ".join([str(k + 1), "1" if species == "Ni" else "2", *(repr(float(x) % edge) for x, edge in zip(r, box))]))
    (folder / "data.lmp").write_text("\n".join(data) + "\n")
    coefficients = [f"pair_coeff {a} {b} {e} {s} {c}" for (a, b), (e, s, c) in TWO_SPECIES.items()]
    return "\n".join(["units lj", "atom_style atomic", "read_data data.lmp", "mass * 1.0", "pair_style lj/cut 2.5", *coefficients,
                      "pair_modify shift yes", ""])


class Program:
    def __init__(self, program, folder, modules):
        self.program, self.folder, self.temporary = program, folder, folder / "tmp"
        self.temporary.mkdir()
        self.environment = {**os.environ, **OPENMPI_AS_ROOT, "OMP_NUM_THREADS": "1", "LANESCAPE_ENGINES": str(modules), "TMPDIR": str(self.temporary),
                            "OMPI_MCA_mpi_yield_when_idle": "1"}

    def command(self, *options, ranks=1):
        before = [] if ranks == 1 else [*OPENMPI, str(ranks)]
        return [*before, str(self.program), "path", "--quiet", *options]

    def run(self, *options, ranks=1):
        return subprocess.run(self.command(*options, ranks=ranks), cwd=self.folder, env=self.environment, capture_output=True, text=True, timeout=600)

    def path(self, *options, ranks=1):
        done, end = self.run(*options, ranks=ranks), time.monotonic() + 60
        # Processes of a killed mpirun live a moment longer, and keep others out of their folder.
        while "another run is at work" in done.stderr and time.monotonic() < end:
            time.sleep(0.5)
            done = self.run(*options, ranks=ranks)
        assert done.returncode in (0, 1), done.stderr[-1000:]
        return json.loads(done.stdout)["paths"][0]

    def refusal(self, *options):
        done = self.run(*options)
        lines = done.stderr.splitlines()
        assert done.returncode == 2 and len(lines) == 1, (done.returncode, done.stderr[-1000:])
        return lines[0]


def build(folder, source):
    for file, package in (("/usr/include/lammps/library.h", "liblammps-dev"), ("/usr/bin/mpicxx", "mpi-default-dev")):
        if not Path(file).exists():
            skip(f"{file} is not here (Debian: package {package})")
    modules = folder / "engine"
    subprocess.run(["cmake", "-G", "Ninja", "-S", source / "bindings/lammps/engine", "-B", modules, "-DCMAKE_BUILD_TYPE=Release",
                    f"-DLANESCAPE_HEADER_DIR={source / 'src/api'}"], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", modules], check=True, stdout=subprocess.DEVNULL)
    return modules


def check_same_path(program):
    pair = ("--pair", "pair.extxyz", "--max-steps", str(STEPS))
    own = program.path(*pair)
    for ranks in (1, 2):
        found = program.path(*pair, "--landscape", "lammps:in.lmp", ranks=ranks)
        assert found["steps"] == own["steps"] and sum(own["steps"].values()) == STEPS
        assert abs(found["length"] - own["length"]) < 1e-10, (found["length"], own["length"])
        assert abs(found["landscape_energy"] - own["landscape_energy"]) < 1e-10
        print(f"{ranks} ranks: length differs by {abs(found['length'] - own['length']):.1e}, "
              f"{1e6 * found['seconds'] / found['evaluations']:.0f} us per evaluation")
    adaptive = ("--pair", "pair.extxyz", "--adaptive", "--max-steps", "20")
    own, found = program.path(*adaptive), program.path(*adaptive, "--landscape", "lammps:in.lmp")
    assert found["steps"] == own["steps"] and abs(found["length"] - own["length"]) < 1e-9


def check_resumption(program, ranks):
    """The same bits after SIGTERM and SIGKILL."""
    options = ("--pair", "pair.extxyz", "--landscape", "lammps:in.lmp", "--max-steps", str(8 * STEPS))
    program.path(*options, "--out", "whole", ranks=ranks)
    for sent, after, start in ((signal.SIGTERM, 1.0, [*options, "--out", "parts"]), (signal.SIGKILL, 1.0, ["--resume", "parts"])):
        with subprocess.Popen(program.command(*start, ranks=ranks), cwd=program.folder, env=program.environment, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL, start_new_session=True) as running:
            time.sleep(after)
            if sent == signal.SIGKILL:
                os.killpg(running.pid, sent)
            else:
                running.send_signal(sent)
            running.wait()
        assert sent == signal.SIGKILL or ranks > 1 or running.returncode == INTERRUPTED, running.returncode
    program.path("--resume", "parts", ranks=ranks)
    whole, parts = (program.folder / name / "path-0001.extxyz" for name in ("whole", "parts"))
    assert whole.read_bytes() == parts.read_bytes()
    for name in ("whole", "parts"):
        shutil.rmtree(program.folder / name)


def check_refusals(program, text):
    def refusal(content, *options):
        (program.folder / "bad.lmp").write_text(content)
        return program.refusal("--pair", "pair.extxyz", "--landscape", "lammps:bad.lmp", *options)

    assert "Expected floating point" in refusal(text.replace("pair_coeff 1 2 1.5", "pair_coeff 1 2 much"))
    assert "109" in refusal(text + "create_atoms 1 single 0.1 0.1 0.1\n")
    assert "box" in refusal(text + "change_box all x scale 1.01\n")
    assert "times as heavy" in refusal(text.replace("mass * 1.0", "mass 1 1.0\nmass 2 2.0"))
    assert "has type" in refusal(text + "set atom 1 type 2\n")
    assert "periodic" in refusal(text + "change_box all boundary p p f\n")
    assert "--precision" in refusal(text, "--precision", "mixed")
    pair = ("--pair", "pair.extxyz", "--landscape")
    assert "no such file" in program.refusal(*pair, "lammps:missing.lmp")
    assert "lanescape-gromacs.so" in program.refusal(*pair, "gromacs:in")
    assert "an engine and its input" in program.refusal(*pair, "lammps")
    assert "--pair" in program.refusal("--landscape", "lammps:in.lmp")
    assert not list(program.temporary.glob("lanescape-lammps-*.log"))


def main():
    program, source = (Path(word).resolve() for word in sys.argv[1:])
    with tempfile.TemporaryDirectory(prefix="lanescape-landscape-") as name:
        folder = Path(name)
        program = Program(program, folder, build(folder, source))
        shutil.copy(source / "tests/data/ka108-T1-pair.extxyz", folder / "pair.extxyz")
        text = input_of(folder / "pair.extxyz", folder)
        (folder / "in.lmp").write_text(text)
        check_same_path(program)
        for ranks in (1, 2):
            check_resumption(program, ranks)
        check_refusals(program, text)


if __name__ == "__main__":
    main()
