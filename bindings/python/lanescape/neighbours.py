"""matscipy's function for pairs of particles; NeighbourList keeps its memory for the next call."""

from typing import Any

import numpy
from numpy.typing import ArrayLike

from lanescape import _core
from lanescape.errors import InputError

__all__ = ["neighbour_list"]


def neighbour_list(quantities: str, atoms: Any = None, cutoff: "float | dict | None" = None, positions: "ArrayLike | None" = None,
                   cell: "ArrayLike | None" = None, pbc: "ArrayLike | None" = None, numbers: "ArrayLike | None" = None) -> Any:
    """Pairs of particles within a cutoff, sorted by i, j and S, with ASE's conventions: one array for each letter, a single one bare.

    quantities: of i, j (P,) and S (P, 3), int64; D (P, 3) and d (P,), r_j - r_i + S . cell and its length < cutoff. A particle's own
    images are among its neighbours. atoms: an ase.Atoms, or None with positions (N, 3), cell, edges (3,) or a matrix (3, 3), and pbc, a
    bool or three (True if it is not given). cutoff: in the unit of the positions; or one for each pair of
    species that is to be listed, {("Ar", "Kr"): 3.0, ...}, by symbols or atomic numbers. numbers: of the particles, (N,), where atoms is
    None and cutoff names species: atomic numbers, or what else the keys name.

    Raises InputError for cells that are not orthorhombic and for what else is not allowed.
    """
    if cutoff is None:
        raise TypeError("cutoff: a number, or one for each pair of species is needed")
    if atoms is not None:
        if not all(given is None for given in (positions, cell, pbc, numbers)):
            raise TypeError("positions, cell, pbc and numbers are those of atoms: they are needed where atoms is None")
        positions, cell, pbc, numbers = atoms.positions, atoms.cell.array, atoms.pbc, atoms.numbers
    elif positions is None or cell is None:
        raise TypeError("positions and cell are needed where atoms is None")
    species = None
    if isinstance(cutoff, dict):
        cutoff, species = _of_species(cutoff, numbers)
    pairs = _core.NeighbourList(cutoff, sorted=True)
    arrays = pairs.compute(positions, cell, True if pbc is None else pbc, quantities, species)
    arrays = tuple(a.astype(numpy.int64) if a.dtype == numpy.int32 else a for a in arrays)
    return arrays[0] if len(arrays) == 1 else arrays


def _of_species(cutoffs, numbers):
    """The matrix of cutoffs and the row of each particle in it; species that no particle has are rows too."""
    if numbers is None:
        raise TypeError("numbers: those of the particles are needed where cutoff names species")
    numbers = numpy.asarray(numbers)
    if numbers.ndim != 1:
        raise InputError(f"numbers: shape {numbers.shape} is not allowed: (N,) is needed")
    named = {}
    for pair, one in cutoffs.items():
        if not isinstance(pair, tuple) or len(pair) != 2:
            raise TypeError(f"cutoff: {pair!r} is no pair of species")
        named[tuple(_number_of(kind, numbers) for kind in pair)] = one
    kinds = sorted({kind for pair in named for kind in pair} | set(numbers.tolist()))
    row = {kind: k for k, kind in enumerate(kinds)}
    matrix = numpy.zeros((len(kinds), len(kinds)))
    for (a, b), one in named.items():
        if named.get((b, a), one) != one:
            raise InputError(f"cutoff: {a!r} and {b!r} have two cutoffs, {one} and {named[b, a]}")
        matrix[row[a], row[b]] = matrix[row[b], row[a]] = one
    return matrix, [row[number] for number in numbers.tolist()]


def _number_of(kind, numbers):
    if not isinstance(kind, str) or numbers.dtype.kind == "U":
        return kind
    from ase.data import atomic_numbers
    if kind not in atomic_numbers:
        raise InputError(f"cutoff: {kind!r} is no chemical symbol")
    return atomic_numbers[kind]
