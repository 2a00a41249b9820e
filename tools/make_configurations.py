#!/usr/bin/env python3
"""Writes the test corpus: extended XYZ configurations and ASE's own Lennard-Jones results for them.

Usage: /usr/bin/python3 tools/make_configurations.py [FOLDER]     (default: tests/data; needs ASE and numpy)

Reduced units throughout, masses 1. One-component Lennard-Jones is Ar; Kob-Andersen A is Ni and B is P. Every number is
written with round-trip digits. Seeds are fixed: the same ASE and numpy give the same files.
"""

import argparse
import json
import pathlib

import numpy as np
from ase import Atoms, units
from ase.build import bulk
from ase.calculators.calculator import Calculator, all_changes
from ase.calculators.lj import LennardJones
from ase.md.velocitydistribution import MaxwellBoltzmannDistribution, Stationary
from ase.md.verlet import VelocityVerlet

CUTOFF = 2.5  # [sigma]; in the mixture times sigma_ab


class KobAndersen(Calculator):
    """Cut and shifted Kob-Andersen mixture, Ni = A and P = B, good enough to melt a lattice."""

    implemented_properties = ["energy", "forces"]
    epsilon = np.array([[1.0, 1.5], [1.5, 0.5]])
    sigma = np.array([[1.0, 0.8], [0.8, 0.88]])

    def calculate(self, atoms=None, properties=("energy",), system_changes=all_changes):
        super().calculate(atoms, properties, system_changes)
        box = self.atoms.cell.lengths()
        nearest = self.atoms.positions[:, None] - self.atoms.positions[None, :]
        nearest -= box * np.round(nearest / box)
        species = (self.atoms.numbers == 15).astype(int)
        epsilon, sigma = self.epsilon[species[:, None], species], self.sigma[species[:, None], species]
        self.results = {"energy": 0.0, "forces": np.zeros((len(self.atoms), 3))}
        for image in np.ndindex(3, 3, 3):  # enough while no edge is shorter than 5/3, so that 3/2 of it reach 2.5
            vector = nearest + (np.array(image) - 1) * box
            squared = (vector**2).sum(axis=2)
            inside = (squared > 0.0) & (squared < (CUTOFF * sigma)**2)
            power = np.divide(sigma**6, squared**3, out=np.zeros_like(squared), where=inside)
            energies = 4 * epsilon * (power**2 - power - inside * (CUTOFF**-12 - CUTOFF**-6))
            over_r = 24 * epsilon * np.divide(2 * power**2 - power, squared, out=np.zeros_like(squared), where=inside)
            self.results["energy"] += 0.5 * energies.sum()  # each pair is met from both sides
            self.results["forces"] += (over_r[:, :, None] * vector).sum(axis=1)


def fcc(symbol, cells, density):
    return bulk(symbol, "fcc", a=(4.0 / density) ** (1.0 / 3.0), cubic=True) * cells


def kob_andersen(cells, density, rng):
    """An fcc lattice with N_B = floor(N/5) B particles at random sites."""
    atoms = fcc("Ni", cells, density)
    atoms.numbers[rng.choice(len(atoms), len(atoms) // 5, replace=False)] = 15
    return atoms


def rattled(atoms, amplitude, rng):
    atoms.positions += rng.uniform(-amplitude, amplitude, atoms.positions.shape)
    return atoms


def melted(atoms, calculator, temperature, steps, rng):
    """Newtonian motion from the lattice at twice the temperature, which equipartition about halves."""
    atoms.set_masses(np.ones(len(atoms)))
    atoms.calc = calculator
    MaxwellBoltzmannDistribution(atoms, temperature_K=2.0 * temperature / units.kB, rng=rng)
    Stationary(atoms)
    VelocityVerlet(atoms, timestep=0.004).run(steps)
    atoms.calc = None
    return atoms


def without(atoms, count, rng):
    """Vacancies, for particle numbers that fill no vector."""
    del atoms[rng.choice(len(atoms), count, replace=False)]
    return atoms


def dilute(symbol, count, box, closest, rng):
    """Random sequential insertion with no two particles nearer than `closest`."""
    atoms = Atoms(cell=box, pbc=True)
    while len(atoms) < count:
        trial = Atoms(symbol, positions=[rng.uniform(0.0, 1.0, 3) * box])
        if not len(atoms) or Atoms(atoms + trial).get_distances(-1, range(len(atoms)), mic=True).min() > closest:
            atoms += trial
    return atoms


def dilute_mixture(count, box, rng):
    atoms = dilute("Ni", count, box, 0.9, rng)
    atoms.numbers[rng.choice(count, count // 5, replace=False)] = 15
    return atoms


def near_contact(atoms, distance, rng):
    """Moves particle 1 to `distance` from particle 0, in a random direction away from the others' cores."""
    best = None
    for direction in rng.normal(size=(200, 3)):
        trial = atoms.copy()
        trial.positions[1] = trial.positions[0] + distance * direction / np.linalg.norm(direction)
        others = trial.get_distances(1, range(2, len(trial)), mic=True).min()
        if best is None or others > best[0]:
            best = (others, trial)
    return best[1]


def unwrapped(atoms, rng):
    """The same configuration with every particle some whole boxes away, as along a path."""
    atoms.positions += rng.integers(-3, 4, atoms.positions.shape) * atoms.cell.lengths()
    return atoms


def corpus():
    rng = np.random.default_rng
    lj = dict(sigma=1.0, epsilon=1.0, rc=CUTOFF, smooth=False)
    yield "ar_fcc_108", fcc("Ar", (3, 3, 3), 0.8442)
    yield "ar_rattled_96", rattled(fcc("Ar", (4, 3, 2), 0.9), 0.1, rng(1))
    yield "ar_melted_107", melted(without(fcc("Ar", (3, 3, 3), 0.8), 1, rng(2)), LennardJones(**lj), 2.0, 250, rng(3))
    yield "ar_unwrapped_61", unwrapped(without(rattled(fcc("Ar", (4, 2, 2), 0.8), 0.15, rng(4)), 3, rng(5)), rng(6))
    yield "ar_dense_72", rattled(fcc("Ar", (3, 3, 2), 1.25), 0.08, rng(7))
    yield "ar_dilute_63", dilute("Ar", 63, np.array([12.0, 10.0, 9.0]), 0.95, rng(8))
    yield "ar_near_contact_31", near_contact(dilute("Ar", 31, np.array([6.0, 5.5, 7.0]), 0.9, rng(9)), 0.8, rng(10))
    yield "ar_tiny_4", rattled(fcc("Ar", (1, 1, 1), 1.0), 0.08, rng(11))
    yield "ar_tiny_7", without(rattled(fcc("Ar", (2, 1, 1), 1.05), 0.08, rng(12)), 1, rng(13))
    yield "ka_fcc_108", kob_andersen((3, 3, 3), 1.2, rng(20))
    yield "ka_rattled_256", rattled(kob_andersen((4, 4, 4), 1.2, rng(21)), 0.08, rng(22))
    yield "ka_melted_108", melted(kob_andersen((3, 3, 3), 1.2, rng(23)), KobAndersen(), 2.0, 500, rng(24))
    yield "ka_melted_144", melted(kob_andersen((4, 3, 3), 1.2, rng(25)), KobAndersen(), 1.0, 500, rng(26))
    yield "ka_unwrapped_45", unwrapped(without(rattled(kob_andersen((3, 2, 2), 1.2, rng(27)), 0.08, rng(28)), 3,
                                               rng(29)), rng(30))
    yield "ka_dilute_50", dilute_mixture(50, np.array([8.0, 11.0, 7.0]), rng(31))
    yield "ka_near_contact_33", near_contact(dilute_mixture(33, np.array([6.0, 6.5, 5.0]), rng(32)), 0.8, rng(33))
    yield "ka_tiny_8", rattled(kob_andersen((1, 2, 1), 1.2, rng(34)), 0.06, rng(35))


def write_extxyz(path, atoms):
    """ASE writes eight decimals; repr of a float reads back to the same bits."""
    lx, ly, lz = (repr(float(edge)) for edge in atoms.cell.lengths())
    lines = [str(len(atoms)),
             f'Lattice="{lx} 0.0 0.0 0.0 {ly} 0.0 0.0 0.0 {lz}" Properties=species:S:1:pos:R:3 pbc="T T T"']
    for symbol, position in zip(atoms.get_chemical_symbols(), atoms.positions):
        lines.append(" ".join([symbol, *(repr(float(x)) for x in position)]))
    path.write_text("\n".join(lines) + "\n")


def ase_results(atoms):
    """Shifted at the cutoff, every image within it. The virial is sum r_a f_b in Voigt order, -V times the stress."""
    atoms = atoms.copy()
    atoms.calc = LennardJones(sigma=1.0, epsilon=1.0, rc=CUTOFF, ro=0.66 * CUTOFF, smooth=False)
    return {"energy": float(atoms.get_potential_energy()),
            "virial": (-atoms.get_volume() * atoms.get_stress(voigt=True)).tolist(),
            "forces": atoms.get_forces().tolist()}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", nargs="?", type=pathlib.Path, default=pathlib.Path("tests/data"))
    folder = parser.parse_args().folder
    folder.mkdir(parents=True, exist_ok=True)
    results = {}
    for name, atoms in corpus():
        write_extxyz(folder / f"{name}.extxyz", atoms)
        if name.startswith("ar_"):
            results[f"{name}.extxyz"] = ase_results(atoms)
    (folder / "ase_lennard_jones.json").write_text(json.dumps(results, indent=None, separators=(",", ":")) + "\n")


if __name__ == "__main__":
    main()
