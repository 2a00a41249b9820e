"""matscipy's function for pairs of particles; NeighbourList keeps its memory for the next call."""

from typing import Any

import numpy
from numpy.typing import ArrayLike

from lanescape import _core

__all__ = ["neighbour_list"]


def neighbour_list(quantities: str, atoms: Any = None, cutoff: "float | None" = None, positions: "ArrayLike | None" = None,
                   cell: "ArrayLike | None" = None, pbc: "ArrayLike | None" = None) -> Any:
    """Pairs of particles within a cutoff, sorted by i, j and S, with ASE's conventions: one array for each letter, a single one bare.

    quantities: of i, j (P,) and S (P, 3), int64; D (P, 3) and d (P,), r_j - r_i + S . cell and its length < cutoff. A particle's own
    images are among its neighbours. atoms: an ase.Atoms, or None with positions (N, 3), cell, edges (3,) or a matrix (3, 3), and pbc, a
    bool or three (True if it is not given). cutoff: in the unit of the positions.

    Raises InputError for cells that are not orthorhombic and for what else is not allowed.
    """
    if cutoff is None:
        raise TypeError("cutoff: a number is needed")
    if atoms is not None:
        if positions is not None or cell is not None or pbc is not None:
            raise TypeError("positions, cell and pbc are those of atoms: they are needed where atoms is None")
        positions, cell, pbc = atoms.positions, atoms.cell.array, atoms.pbc
    elif positions is None or cell is None:
        raise TypeError("positions and cell are needed where atoms is None")
    pairs = _core.NeighbourList(cutoff, sorted=True)
    arrays = pairs.compute(positions, cell, True if pbc is None else pbc, quantities)
    arrays = tuple(a.astype(numpy.int64) if a.dtype == numpy.int32 else a for a in arrays)
    return arrays[0] if len(arrays) == 1 else arrays
