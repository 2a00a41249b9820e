#!/usr/bin/env python3
"""Writes energies, virials and forces that LAMMPS finds for pair potentials, to compare the scalar reference with.

Usage: /usr/bin/python3 tools/make_lammps_references.py [FOLDER]     (default: tests/data)

Needs numpy and the program lmp of Debian's package lammps. Reads configurations of FOLDER and writes FOLDER/lammps_pairs.json: for
each potential the reference's parameters, the LAMMPS commands, and the results. Units are `lj`; all periodic images within the
cutoff count.
"""

import argparse
import itertools
import json
import math
import pathlib
import re
import subprocess
import tempfile

import numpy as np

CONFIGURATIONS = ("ar_tiny_7", "ka_tiny_8", "ka_near_contact_33")
EPSILON = {(1, 1): 1.0, (1, 2): 1.5, (2, 2): 0.5}
SIGMA = {(1, 1): 1.0, (1, 2): 0.8, (2, 2): 0.88}
KAPPA = 1.7  # [1/sigma]
RADIUS = {1: 0.65, 2: 0.5}  # [sigma], of soft spheres
STIFFNESS = 20.0


def read_extxyz(path):
    """Edges of the box, types from 1, positions inside the box."""
    lines = path.read_text().splitlines()
    box = np.array([float(word) for word in lines[1].split('"')[1].split()])[[0, 4, 8]]
    rows = [line.split() for line in lines[2:]]
    types = [2 if row[0] == "P" else 1 for row in rows]
    positions = np.array([[float(word) for word in row[1:4]] for row in rows])
    return box, types, positions % box


def coefficients(style, text, epsilon, sigma, cutoff):
    """pair_coeff lines; `text` is an expression of e, s and c, one number per word."""
    lines = []
    for a, b in EPSILON:
        values = {"e": epsilon[a, b], "s": sigma[a, b], "c": cutoff[a, b], "exp": np.exp, "radius": RADIUS}
        numbers = " ".join(repr(float(eval(word, values))) for word in text.split())  # words of this file only
        lines.append(f"pair_coeff {a} {b} {style} {numbers}".replace("  ", " "))
    return lines


class Potential:
    """What the reference is told (form, truncation, parameters) and what LAMMPS is told."""

    def __init__(self, form, truncation, styles, cutoff=2.5, epsilon=EPSILON, sigma=SIGMA, **parameters):
        self.form, self.truncation, self.parameters = form, truncation, parameters
        self.epsilon, self.sigma = epsilon, sigma
        self.cutoff = {pair: cutoff * sigma[pair] for pair in sigma}
        longest = max(self.cutoff.values())
        names = [style.format(longest) for style, _ in styles]
        hybrid = "hybrid/overlay " if len(styles) > 1 else ""
        self.commands = [f"pair_style {hybrid}{' '.join(names)}"]
        for style, text in styles:
            name = style.split()[0] if hybrid else ""
            self.commands += coefficients(name, text, epsilon, sigma, self.cutoff)
        if truncation in ("shifted", "tail"):
            self.commands.append(f"pair_modify {'shift' if truncation == 'shifted' else 'tail'} yes")

    def description(self):
        pairs = [[self.epsilon[p], self.sigma[p], self.cutoff[p]] for p in ((1, 1), (1, 2), (2, 2))]
        return {"form": self.form, "truncation": self.truncation, **self.parameters, "pairs": pairs, "commands": self.commands}


class SoftSpheres(Potential):
    """Frictionless grains at rest: forces of harmonic or Hertzian spheres. LAMMPS has no energy for them."""

    def __init__(self, form, style):
        diameter = {(a, b): RADIUS[a] + RADIUS[b] for a, b in EPSILON}
        epsilon = {}
        for (a, b), s in diameter.items():
            reduced = np.sqrt(RADIUS[a] * RADIUS[b] / s)
            epsilon[a, b] = float(STIFFNESS * (s**2 if form == "harmonic" else s**2.5 * reduced))
        super().__init__(form, "plain", [], 1.0, epsilon, diameter)
        self.commands = [f"pair_style {style} {STIFFNESS} 0.0 0.0 0.0 0.0 0", "pair_coeff * *"]


LJ = ("lj/cut {}", "e s c")
MIE = ("mie/cut {}", "e s 14 8 c")
# A exp((sigma - r)/rho) - C/r^6 + D/r^8 with A = 0
BORN_SIX = ("born {}", "0 1 0 -e*s**6 0 c")
BORN_EIGHT = ("born {}", "0 1 0 0 e*s**8 c")
# A repulsion alone: the attraction of one style is cancelled by born.
LJ_QUARTER = ("lj/cut {}", "e/4 s c")
MIE_24_6 = ("mie/cut {}", "e/(24/18*4**(6/18)) s 24 6 c")
YUKAWA = (f"yukawa {KAPPA} {{}}", f"e*s*exp({KAPPA}*s) c")


def potentials():
    for truncation in ("plain", "shifted", "tail"):
        yield Potential("lennard_jones", truncation, [LJ])
        yield Potential("mie", truncation, [MIE], n=14, m=8)
    yield Potential("lennard_jones", "shifted", [LJ], cutoff=2 ** (1 / 6))
    yield Potential("lennard_jones", "shifted_force", [("lj/smooth/linear {}", "e s c")])
    yield Potential("yukawa", "plain", [YUKAWA], cutoff=3.0, kappa=KAPPA)
    yield Potential("yukawa", "shifted", [YUKAWA], cutoff=3.0, kappa=KAPPA)
    yield Potential("inverse_power", "plain", [BORN_SIX], n=6)
    yield Potential("inverse_power", "tail", [BORN_EIGHT], n=8)
    yield Potential("inverse_power", "shifted", [LJ_QUARTER, BORN_SIX], cutoff=1.8, n=12)
    yield Potential("inverse_power", "shifted", [MIE_24_6, BORN_SIX], cutoff=1.5, n=24)
    yield SoftSpheres("harmonic", "gran/hooke")
    yield SoftSpheres("hertzian", "gran/hertz/history")


PRESSURE = " ".join(f"$(c_virial[{k}]:%.17g)" for k in (1, 2, 3, 6, 5, 4))  # xx yy zz yz xz xy
RESULTS = f"""compute virial all pressure NULL virial
thermo_style custom step pe c_virial[1]
thermo_modify norm no
dump forces all custom 1 forces id fx fy fz
dump_modify forces sort id format float %.17g
run 0 post no
print "version $(version)"
print "energy $(pe:%.17g)"
print "pressure {PRESSURE}"
"""


def script(potential, box, types, positions):
    grains = isinstance(potential, SoftSpheres)
    lines = ["units lj", f"atom_style {'sphere' if grains else 'atomic'}"]
    if grains:
        lines += ["comm_modify vel yes", "newton off"]
    lines += ["region box block " + " ".join(f"0.0 {float(edge)!r}" for edge in box), "create_box 2 box"]
    lines += [f"create_atoms {t} single {x!r} {y!r} {z!r}" for t, (x, y, z) in zip(types, positions.tolist())]
    if grains:
        lines += [f"set type {t} diameter {2 * radius}" for t, radius in RADIUS.items()]
    else:
        lines.append("mass * 1.0")
    return "\n".join([*lines, *potential.commands, RESULTS])


def run(potential, box, types, positions):
    """LAMMPS's version and the results, the virial in the order xx yy zz yz xz xy."""
    with tempfile.TemporaryDirectory() as folder:
        output = subprocess.run(["lmp", "-log", "none"], input=script(potential, box, types, positions), cwd=folder, text=True,
                                stdout=subprocess.PIPE, check=True).stdout
        rows = (pathlib.Path(folder) / "forces").read_text().splitlines()[9:]
    numbers = {key: [float(word) for word in words.split()]
               for key, words in re.findall("^(version|energy|pressure) (.*)$", output, re.MULTILINE)}
    forces = [float(word) for row in rows for word in row.split()[1:]]
    if len(forces) != 3 * len(types):
        raise RuntimeError("LAMMPS has lost atoms")
    result = {"virial": [math.prod(box) * p for p in numbers["pressure"]], "forces": forces}
    if not isinstance(potential, SoftSpheres):
        result["energy"] = numbers["energy"][0]
    return int(numbers["version"][0]), result


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", nargs="?", type=pathlib.Path, default=pathlib.Path("tests/data"))
    folder = parser.parse_args().folder
    configurations = {name: read_extxyz(folder / f"{name}.extxyz") for name in CONFIGURATIONS}
    lines = []
    for potential, (name, configuration) in itertools.product(potentials(), configurations.items()):
        version, result = run(potential, *configuration)
        case = {**potential.description(), "configuration": f"{name}.extxyz", **result}
        lines.append(json.dumps(case, separators=(",", ":")))
    (folder / "lammps_pairs.json").write_text(f'{{"lammps":{version},"cases":[\n' + ",\n".join(lines) + "\n]}\n")


if __name__ == "__main__":
    main()
