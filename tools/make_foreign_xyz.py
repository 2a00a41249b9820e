#!/usr/bin/env python3
"""Writes tests/data/foreign: one small system in extended XYZ as other programs write it.

Usage: PYTHON tools/make_foreign_xyz.py [FOLDER]     (default: tests/data/foreign)

Writes a file for each of ASE and libAtoms' extxyz that PYTHON has, named after package and version, and the files of OVITO's and
LAMMPS's conventions. The committed files come from two calls: /usr/bin/python3 (Debian 12: ASE 3.22.1) and a virtual environment
with ASE 3.29.0 and extxyz 0.4.6 from PyPI. OVITO's and LAMMPS's files are not written by these programs: they follow the sources of
their writers, OVITO's XYZExporter of 2023 and LAMMPS's `dump extxyz` of 2024.

All numbers are short binary fractions, so each writer keeps them exactly. tests/unit/io/foreign_xyz_test.cpp has the same system.
"""

import argparse
import pathlib

import numpy as np

EDGES = (4.0, 5.0, 6.0)
SPECIES = ("Ni", "P", "Ni", "Ni")
POSITIONS = np.array([[0.0, 1.0, 2.0], [-3.5, 0.25, 17.0], [1.5, 4.75, 0.125], [3.0, 2.5, 5.0]])
FORCES = np.array([[0.5, -1.0, 0.0], [0.0, 0.25, -2.0], [-0.5, 0.75, 1.0], [0.0, 0.0, 1.0]])
VELOCITIES = FORCES[::-1] / 4.0
SECOND = POSITIONS + 0.25  # of the second frame


def write_ase(folder):
    import ase
    from ase import Atoms
    from ase.calculators.singlepoint import SinglePointCalculator
    from ase.constraints import FixAtoms
    from ase.io import write

    frames = []
    for positions in (POSITIONS, SECOND):
        atoms = Atoms(SPECIES, positions=positions, cell=EDGES, pbc=True)
        atoms.set_tags([0, 1, 2, 3])
        atoms.set_velocities(VELOCITIES)
        atoms.set_constraint(FixAtoms(indices=[1]))
        atoms.info.update(
            title='a "quoted" text = [1, 2', flag=True, none=None, weights=np.array([0.5, 1.5]), several=["a", "b]"], empty=""
        )
        atoms.calc = SinglePointCalculator(atoms, energy=-1.5, forces=FORCES, stress=np.arange(6.0))
        frames.append(atoms)
    write(folder / f"ase-{ase.__version__}.extxyz", frames, format="extxyz")
    # An empty text has no quotes: config_type= pbc="T T T".
    plain = Atoms(SPECIES, positions=POSITIONS, cell=EDGES, pbc=True, info={"config_type": ""})
    write(folder / f"ase-{ase.__version__}-empty.extxyz", plain, format="extxyz", columns=["numbers", "symbols", "positions"])


def write_extxyz(folder):
    import extxyz

    frames = []
    for positions in (POSITIONS, SECOND):
        arrays = {"species": np.array(SPECIES), "pos": positions, "forces": FORCES, "id": np.arange(4)}
        info = {"energy": -1.5, "title": 'a "quoted" text', "flags": np.array([True, False]), "matrix": np.eye(2), "label": "x,y"}
        frames.append(extxyz.Frame(4, np.diag(EDGES), np.array([True] * 3), info, arrays))
    for writer, compiled in (("c", True), ("python", False)):
        extxyz.write_dicts(folder / f"extxyz-{extxyz.__version__}-{writer}.extxyz", frames, use_cextxyz=compiled)


def table(*columns):
    """Lines of columns with printf's %g, separated by blanks."""
    rows = np.column_stack([np.asarray(c, dtype=object).reshape(4, -1) for c in columns])
    return "".join(" ".join(x if isinstance(x, str) else f"{x:g}" for x in row) + "\n" for row in rows)


def write_conventions(folder):
    ids = np.arange(1, 5)
    lattice = 'Lattice="4 0 0 0 5 0 0 0 6"'
    ovito = f'4\n{lattice} Origin="-2 -2.5 -3" Properties=id:I:1:species:S:1:pos:R:3:radius:R:1:map_shift:I:3\n'
    columns = (ids, SPECIES, POSITIONS, np.full(4, 0.5), np.zeros((4, 3)))
    (folder / "ovito-convention.extxyz").write_text(ovito + table(*columns) + ovito + table(ids, SPECIES, SECOND, *columns[3:]))
    with_flags = f'4\n{lattice} Properties=species:S:1:pos:R:3:selection:I:1 pbc="1 1 1" Timestep=0\n'
    (folder / "ovito-numeric-pbc.extxyz").write_text(with_flags + table(SPECIES, POSITIONS, np.zeros(4)))
    text = ""
    for step, positions in ((0, POSITIONS), (100, SECOND)):
        text += f'4\nTimestep={step} Time={step * 0.005:.6f} pbc="T T T" {lattice} Potential_energy=-1.5 Temperature=1.25 '
        text += 'Stress="1 0 0 0 1 0 0 0 1" Properties=species:S:1:pos:R:3:vel:R:3:forces:R:3\n'
        text += table(SPECIES, positions, VELOCITIES, FORCES)
    (folder / "lammps-convention.extxyz").write_text(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    default = pathlib.Path(__file__).resolve().parent.parent / "tests" / "data" / "foreign"
    parser.add_argument("folder", nargs="?", type=pathlib.Path, default=default)
    folder = parser.parse_args().folder
    folder.mkdir(parents=True, exist_ok=True)
    for writer in (write_ase, write_extxyz):
        try:
            writer(folder)
        except ModuleNotFoundError as missing:
            print(f"{writer.__name__}: skipped, {missing}")
    write_conventions(folder)


if __name__ == "__main__":
    main()
