"""Checks a host's own kernel, written in Python or called from it, against the scalar reference of the program `lanescape`.

    def kernel(positions, box, species, parameters):
        if parameters["form"] != "lennard-jones":
            return None  # declined
        ...
        return energy, forces, virial

    lanescape.verification.verify(kernel)

docs/HOST_KERNELS.md describes the cases. The program is the one that the environment variable LANESCAPE_PROGRAM names, else the one on PATH.
"""

import json
import math
import os
import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy

__all__ = ["Case", "read_cases", "verify"]


@dataclass(frozen=True)
class Case:
    """One configuration and the potential to evaluate it by, in reduced units.

    parameters: form (str), numbers (dict of the form's own numbers), epsilon, sigma and cutoff (S x S arrays, the cutoff a length),
    truncation ("shifted", "plain", "tail", "shifted-force", "smooth"), images ("all", "minimum"); of the form "polydisperse" also
    diameters (N), whose cutoff is in units of sigma_ij.
    """

    name: str
    positions: numpy.ndarray  # N x 3, in or outside the box
    box: numpy.ndarray  # 3 edges
    species: numpy.ndarray  # N, from 0, int64
    parameters: dict


def verify(kernel, *, precision="double", program=None):
    """Calls kernel(positions, box, species, parameters) in every case and compares what it returns with the reference.

    kernel returns (energy, forces) or (energy, forces, virial): a number, N x 3 numbers and the sum of r.F over pairs; None in place of
    a quantity that it does not compute; None alone for a case that it declines. The arguments are those of `Case`.
    precision: "double", or "single" for kernels in single precision.
    program: path of the program `lanescape`, found as the module describes if it is not given.

    Returns the report of `lanescape check` as a dict: cases, compared, declined, quantities, ...
    Raises AssertionError naming the worst case if one is wrong, or if all are declined; ValueError for results of the wrong shape;
    FileNotFoundError without the program. What the kernel raises passes through, with the name of the case as a note.
    """
    __tracebackhide__ = True  # pytest then shows the caller's line
    program = _find_program(program)
    with tempfile.TemporaryDirectory(prefix="lanescape-cases-") as folder:
        _run(program, "cases", "--out", folder, "--quiet")
        results = {case.name: _result_of(kernel, case) for case in read_cases(folder)}
        Path(folder, "host_results.json").write_text(json.dumps(results, allow_nan=False))
        report = _run(program, "check", folder, "--precision", precision, "--quiet")
    if not report["passed"]:
        raise AssertionError(report["summary"])
    return report


def read_cases(folder):
    """The cases in a folder that `lanescape cases --out folder` has written: a list of Case."""
    cases = json.loads(Path(folder, "cases.json").read_text())["cases"]
    frames = _frames(Path(folder, "cases.extxyz").read_text().splitlines())
    return [_case(entry, [] if entry["frame"] is None else next(frames)) for entry in cases]


def _frames(lines):
    """The rows of each frame of an extended XYZ file, as lists of words."""
    start = 0
    while start < len(lines):
        count = int(lines[start])
        yield [line.split() for line in lines[start + 2:start + 2 + count]]
        start += 2 + count


def _case(entry, rows):
    parameters = {key: entry[key] for key in ("form", "numbers", "truncation", "images")}
    parameters.update({key: numpy.array(entry[key]) for key in ("epsilon", "sigma", "cutoff")})
    if entry["form"] == "polydisperse":
        parameters["diameters"] = numpy.array([float(row[4]) for row in rows])
    species = numpy.array([entry["species"].index(row[0]) for row in rows], dtype=numpy.int64)
    positions = numpy.array([[float(x) for x in row[1:4]] for row in rows]).reshape(-1, 3)
    return Case(entry["name"], positions, numpy.array(entry["box"]), species, parameters)


def _result_of(kernel, case):
    """What the kernel says of a case, as host_results.json has it."""
    try:
        answer = kernel(case.positions.copy(), case.box.copy(), case.species.copy(), dict(case.parameters))
    except Exception as error:
        error.add_note(f"in the case '{case.name}'")
        raise
    if answer is None:
        return None
    if not isinstance(answer, (tuple, list)) or len(answer) not in (2, 3):
        raise ValueError(f"case '{case.name}': the kernel returned {type(answer).__name__}: (energy, forces) or (energy, forces, virial) is needed")
    energy, forces, virial = (*answer, None)[:3]
    result = {key: _number(value) for key, value in (("energy", energy), ("virial", virial)) if value is not None}
    if forces is not None:
        forces = numpy.asarray(forces, dtype=float)
        if forces.shape != case.positions.shape:
            raise ValueError(f"case '{case.name}': forces have the shape {forces.shape}: {case.positions.shape} is needed")
        result["forces"] = [[_number(component) for component in row] for row in forces.tolist()]
    return result


def _number(value):
    """A float; None, which check takes for NaN, if it is not finite: JSON has no word for it."""
    value = float(value)
    return value if math.isfinite(value) else None


def _find_program(program):
    program = program or os.environ.get("LANESCAPE_PROGRAM")
    found = shutil.which(program or "lanescape")
    if found is None:
        raise FileNotFoundError(f"there is no program {program or 'lanescape on PATH'}: set LANESCAPE_PROGRAM to its path")
    return found


def _run(program, *arguments):
    """The JSON result of the program. Raises ValueError with its message where it refuses its input."""
    run = subprocess.run([program, *arguments], stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    if run.returncode not in (0, 1) or not run.stdout:
        raise ValueError(run.stderr.strip() or f"{program} ended with status {run.returncode}")
    return json.loads(run.stdout)
