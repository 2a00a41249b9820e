"""The liquids for comparisons of codes, and files of their configurations. Reduced units, masses 1."""

import dataclasses
import math
from pathlib import Path

import numpy as np

from ours import Failed

CUTOFF = 2.5  # [sigma_ab]
LATTICE_ORDER_LIMIT = 0.3  # a lattice at these temperatures has more than 0.7, a liquid of 256 particles about 0.1


@dataclasses.dataclass(frozen=True)
class Liquid:
    model: str
    density: float
    temperature: float
    melting_temperature: float  # a lattice melts within two time units
    species: tuple  # names in files
    pairs: dict  # (a, b) with a <= b: epsilon, sigma
    fraction_of_last: float  # of the particles, of the last species


LIQUIDS = {liquid.model: liquid for liquid in (
    Liquid("kob-andersen", 1.2, 1.0, 5.0, ("Ni", "P"), {(0, 0): (1.0, 1.0), (0, 1): (1.5, 0.8), (1, 1): (0.5, 0.88)}, 0.2),
    # Near the triple point. LAMMPS's benchmark `melt` and MD-Bench reach this state from a lattice at T = 1.44.
    Liquid("lennard-jones", 0.8442, 0.722, 3.0, ("Ar",), {(0, 0): (1.0, 1.0)}, 0.0))}


@dataclasses.dataclass
class Configuration:
    liquid: Liquid
    edge: float  # [sigma]
    species: np.ndarray  # index into liquid.species
    positions: np.ndarray  # N x 3, within [0, edge)

    def __len__(self):
        return len(self.species)


def lattice_constant(liquid, particles):
    """The edge of the cubic box [sigma], and the smallest number of fcc cells along it with enough sites."""
    return (particles / liquid.density) ** (1.0 / 3.0), math.ceil(round((particles / 4) ** (1.0 / 3.0), 9))


def lattice(liquid, particles, seed):
    """An fcc lattice with the species at random sites. It has vacancies unless the number of particles is 4 n^3."""
    rng = np.random.default_rng(seed)
    edge, cells = lattice_constant(liquid, particles)
    corners = np.stack(np.meshgrid(*[np.arange(cells)] * 3, indexing="ij"), axis=-1).reshape(-1, 1, 3)
    sites = (corners + [[0.25, 0.25, 0.25], [0.75, 0.75, 0.25], [0.75, 0.25, 0.75], [0.25, 0.75, 0.75]]).reshape(-1, 3)
    sites = sites[np.sort(rng.permutation(len(sites))[:particles])]
    species = np.zeros(particles, int)
    species[rng.permutation(particles)[:math.floor(liquid.fraction_of_last * particles)]] = len(liquid.species) - 1
    return Configuration(liquid, edge, species, sites * (edge / cells))


def wrapped(positions, edge):
    """The positions in the box [0, edge)."""
    inside = positions - edge * np.floor(positions / edge)
    inside[inside >= edge] = 0.0  # a tiny negative number plus edge rounds to edge
    return inside


def lattice_order(configuration):
    """|rho(k)|/N at the shortest reciprocal vectors of the lattice: 1 for the lattice, about sqrt(S(k)/N) for a liquid."""
    cells = lattice_constant(configuration.liquid, len(configuration))[1]
    k = 2.0 * np.pi * cells / configuration.edge * np.array([[1, 1, 1], [-1, 1, 1], [1, -1, 1], [1, 1, -1]])
    return float(np.abs(np.exp(1j * configuration.positions @ k.T).mean(axis=0)).mean())


def write_extended_xyz(file, configuration):
    """Extended XYZ with the shortest digits that read back as the same bits."""
    edge, names = repr(float(configuration.edge)), configuration.liquid.species
    lines = [str(len(configuration)),
             f'Lattice="{edge} 0 0 0 {edge} 0 0 0 {edge}" Properties=species:S:1:pos:R:3 pbc="T T T"']
    lines += [f"{names[s]} {x!r} {y!r} {z!r}" for s, (x, y, z) in zip(configuration.species.tolist(), configuration.positions.tolist())]
    Path(file).write_text("\n".join(lines) + "\n")


def read_extended_xyz(file, liquid):
    """The configuration in a file of write_extended_xyz."""
    count, comment, *rows = Path(file).read_text().splitlines()
    if len(rows) != int(count):
        raise ValueError(f"{count} particles announced, {len(rows)} found")
    fields = [row.split() for row in rows]
    return Configuration(liquid, float(comment.split('"')[1].split()[0]), np.array([liquid.species.index(f[0]) for f in fields]),
                         np.array([[float(x) for x in f[1:4]] for f in fields]))


def check_melted(configuration, particles, source):
    """Raises Failed if what a code has melted has other particles or is still a lattice."""
    order = lattice_order(configuration)
    if len(configuration) != particles or not order < LATTICE_ORDER_LIMIT:
        raise Failed(f"{source}: not a liquid of {particles} particles: {len(configuration)} with lattice order {order:.2f}")


def kept_configuration(folder, liquid, particles, seed, make):
    """The file of a melted liquid and the liquid: what an earlier run or another driver has left, else what make() gives."""
    file = folder / f"{liquid.model}-{particles}-seed{seed}.extxyz"
    if not file.exists():
        made = make()
        write_extended_xyz(file, made)
        return file, made
    try:
        return file, read_extended_xyz(file, liquid)
    except (ValueError, IndexError) as error:
        raise Failed(f"{file}: {error}; remove it to have it made again") from error
