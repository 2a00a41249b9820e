"""Random Lennard-Jones configurations of one and two components in random boxes against ASE's own calculator, and random neighbour lists.

A few seconds, or as many as LANESCAPE_RANDOM_SECONDS says, or as many configurations as LANESCAPE_RANDOM_CONFIGURATIONS says, from the number
LANESCAPE_RANDOM_FIRST on (0). A failure names the number from which a configuration follows.
"""

import os
import time
import unittest

import numpy as np
from ase import Atoms
from ase.calculators.calculator import CalculatorSetupError
from ase.calculators.lj import LennardJones as AseLennardJones
from ase.neighborlist import neighbor_list

import lanescape
from lanescape.ase import LennardJones

SYMBOLS = ["Ar", "Kr"]
LEAST = 0.7  # distance of any two particles [unit]
PERIODIC = [True, True, True]


def numbers(usual_seconds):
    """Numbers of the configurations that a test takes."""
    first = int(os.environ.get("LANESCAPE_RANDOM_FIRST", 0))
    count = int(os.environ.get("LANESCAPE_RANDOM_CONFIGURATIONS", 0))
    end = time.monotonic() + float(os.environ.get("LANESCAPE_RANDOM_SECONDS", usual_seconds))
    number = first
    while number < first + count if count else time.monotonic() < end:
        yield number
        number += 1
    print(f"random configurations {first} to {number - 1}")


def random_box(rng, cutoff, unit):
    """Edges from half a cutoff to 30 units, beyond which ASE takes long, up to 1:20; some are multiples of half a cutoff, or next to one."""
    base = cutoff * rng.uniform(0.5, 3.0) if rng.random() < 0.5 else unit * 10.0 ** rng.uniform(0.3, 1.4)
    box = np.full(3, base)
    if rng.random() < 0.6:
        box = np.minimum(base * 20.0 ** rng.random(3), 30.0 * unit)
    if rng.random() < 0.2:
        box = 0.5 * cutoff * rng.integers(1, 8, 3)
        box = np.nextafter(box, box * rng.integers(0, 3, 3))
    return box


def random_positions(rng, box, wanted, unit):
    """Positions in a box, no two nearer than LEAST; some are boxes away or on a face."""
    spread = np.minimum(box, unit * wanted ** (1 / 3) * rng.uniform(0.6, 1.5)) if rng.random() < 0.7 else box
    corner = box * rng.random(3)
    positions = np.empty((0, 3))
    for _ in range(20 * wanted):
        at = corner + spread * rng.random(3)
        at = np.where(rng.random(3) < 0.02, box, at)
        apart = positions - at
        apart -= box * np.round(apart / box)
        if len(positions) < wanted and np.all(np.linalg.norm(apart, axis=1) >= LEAST * unit):
            positions = np.vstack([positions, at])
    away = np.where(rng.random(positions.shape) < 0.05, rng.integers(-4, 5, positions.shape), 0)
    return positions + away * box


class System:
    """Atoms with the matrices of a model."""

    def __init__(self, number, components):
        rng = np.random.default_rng([number, components])
        unit = 10.0 ** rng.uniform(0.5, 3.0)  # ASE's cells have edges of 3 or more, so that smaller boxes take it for ever
        half = np.triu(rng.uniform(0.3, 2.0, (components, components)))
        self.epsilon = half + np.triu(half, 1).T
        half = np.triu(unit * rng.uniform(0.8, 1.0, (components, components)))
        self.sigma = half + np.triu(half, 1).T
        self.cutoff = rng.uniform(1.1, 3.0)
        box = random_box(rng, self.cutoff * self.sigma[0, 0], unit)
        positions = random_positions(rng, box, int(rng.integers(1, 40) if rng.random() < 0.8 else rng.integers(200, 300)), unit)
        self.species = rng.integers(0, components, len(positions))
        self.atoms = Atoms([SYMBOLS[s] for s in self.species], positions=positions, cell=box, pbc=True)
        # Rounding of coordinates, amplified thirteen times by r^-13, beside that of sums.
        largest = max(np.abs(positions).max(), box.max()) / unit
        self.tolerance = 1e-12 + 13.0 * 8.0 * 2.0**-53 * largest / LEAST

    def parts(self):
        """(sign, particles, a, b) of which ASE's calculator, which has one component, makes up the mixture: pairs of a and b are those among
        both less those among each."""
        count = len(self.sigma)
        for a in range(count):
            yield 1.0, self.species == a, a, a
        if count == 2:
            yield 1.0, self.species >= 0, 0, 1
            yield -1.0, self.species == 0, 0, 1
            yield -1.0, self.species == 1, 0, 1

    def by_ase(self):
        """Energy, forces, virial tensor, and what rounding of each scales with."""
        energy, scale, forces, virial = 0.0, 0.0, np.zeros((len(self.atoms), 3)), np.zeros(6)
        force_scale, virial_scale = np.zeros(len(self.atoms)), 0.0
        for sign, chosen, a, b in self.parts():
            if not chosen.any():
                continue
            atoms = self.atoms[chosen]
            reach = self.cutoff * self.sigma[a, b]
            atoms.calc = AseLennardJones(sigma=self.sigma[a, b], epsilon=self.epsilon[a, b], rc=reach, ro=reach, smooth=False)
            energy += sign * atoms.get_potential_energy()
            forces[chosen] += sign * atoms.get_forces()
            virial += sign * atoms.get_stress() * atoms.get_volume()
            first, distance = neighbor_list("id", atoms, reach)
            s6 = (self.sigma[a, b] / distance) ** 6
            terms = 4.0 * self.epsilon[a, b] * (12.0 * s6 * s6 + 6.0 * s6)
            scale += terms.sum()
            virial_scale += terms.sum()
            force_scale[chosen] += np.bincount(first, terms / distance, len(atoms))
        return (energy, forces, virial), (scale, force_scale, virial_scale)

    def has_pair_at_cutoff(self):
        for a in range(len(self.sigma)):
            for b in range(a, len(self.sigma)):
                reach = self.cutoff * self.sigma[a, b]
                i, j, distance = neighbor_list("ijd", self.atoms, reach * 1.001)
                near = np.abs(distance - reach) < self.tolerance * reach
                if np.any(near & (np.minimum(self.species[i], self.species[j]) == a) & (np.maximum(self.species[i], self.species[j]) == b)):
                    return True
        return False


class RandomConfigurationsTest(unittest.TestCase):
    def compare(self, number, components):
        system = System(number, components)
        if system.has_pair_at_cutoff():
            return "decided by rounding"
        (energy, forces, virial), (scale, force_scale, virial_scale) = system.by_ase()
        atoms = system.atoms
        atoms.calc = LennardJones(SYMBOLS[:components], system.epsilon, system.sigma, cutoff=system.cutoff)
        potential = lanescape.Potential(atoms.calc.model, system.species, atoms.cell.lengths())
        with self.subTest(number=number, components=components, particles=len(atoms)):
            found = potential.evaluate(atoms.positions, stress=True)
            for e, f, stress in ((atoms.get_potential_energy(), atoms.get_forces(), atoms.get_stress()), (found.energy, found.forces, found.stress)):
                self.assertLessEqual(abs(e - energy), system.tolerance * scale)
                self.assertTrue(np.all(np.abs(f - forces).max(axis=1) <= system.tolerance * force_scale), np.abs(f - forces).max())
                self.assertLessEqual(np.abs(stress * atoms.get_volume() - virial).max(), system.tolerance * virial_scale)
            return "right"
        return "wrong"

    def test_lennard_jones_and_mixtures_are_those_of_ase(self):
        counts = {"right": 0, "decided by rounding": 0, "wrong": 0}
        for number in numbers(1.5):
            for components in (1, 2):
                counts[self.compare(number, components)] += 1
        print("Lennard-Jones as ASE's:", counts)
        self.assertGreater(counts["right"], 2 * counts["decided by rounding"])

    def test_open_axes_are_refused(self):
        for number in range(20):
            atoms = System(number, 1).atoms
            atoms.pbc = np.random.default_rng(number).permutation([True, False, number % 2 == 0])
            atoms.calc = LennardJones()
            with self.assertRaises(CalculatorSetupError):
                atoms.get_potential_energy()

    def test_neighbours_with_open_axes_are_those_of_ase(self):
        for number in numbers(0.7):
            rng = np.random.default_rng([number, 3])
            system = System(number, 1)
            atoms, reach = system.atoms, system.cutoff * system.sigma[0, 0]
            atoms.pbc = rng.random(3) < 0.5
            theirs = neighbor_list("ijSd", atoms, reach * (1.0 + 1e-3))
            if np.any(np.abs(theirs[3] - reach) < system.tolerance * reach):
                continue
            inside = theirs[3] < reach
            expected = sorted(zip(theirs[0][inside], theirs[1][inside], map(tuple, theirs[2][inside])))
            i, j, shifts = lanescape.neighbour_list("ijS", atoms, reach)
            with self.subTest(number=number, pbc=atoms.pbc.tolist()):
                self.assertEqual(sorted(zip(i, j, map(tuple, shifts))), expected)


if __name__ == "__main__":
    unittest.main()
