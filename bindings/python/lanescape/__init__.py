"""Pair potentials, hard spheres and paths over potential-energy landscapes, by vector kernels.

Positions are arrays of shape (N, 3), boxes three edges. Units are the caller's, any consistent ones; k_B = 1. Arrays of float64 in C order
are taken without a copy, others are converted once; `out` takes results in the caller's memory. Indices are int64. The interpreter's lock
is released during work, and threads may share an object: their calls follow each other.
"""

from lanescape._core import (
    EventDrivenDynamics,
    HardSpheres,
    Inserter,
    Model,
    MolecularDynamics,
    NeighbourList,
    ParticleMoves,
    Potential,
    StateSystem,
    __version__,
    instruction_sets,
    make_end_points,
    make_start,
    model_names,
    pair_potentials,
    shorten_methods,
)
from lanescape.errors import Error, InputError, InterruptedRunError, RunError
from lanescape.functions import check_path, evaluate, find_path, insert, overlap, shorten_path
from lanescape.neighbours import neighbour_list
from lanescape.results import EndPoints, Evaluation, InsertedParticle, Overlaps, Path, PathCertificate, ShortPath, SitePairs, Start

__all__ = [
    "EndPoints", "Error", "Evaluation", "EventDrivenDynamics", "HardSpheres", "InputError", "InsertedParticle", "Inserter", "InterruptedRunError", "Model",
    "MolecularDynamics", "NeighbourList", "Overlaps", "ParticleMoves", "Path", "PathCertificate", "Potential", "RunError", "ShortPath", "SitePairs", "Start", "StateSystem", "__version__",
    "check_path", "evaluate", "find_path", "insert", "instruction_sets", "make_end_points", "make_start", "model_names", "neighbour_list", "overlap",
    "pair_potentials", "shorten_methods", "shorten_path",
]
