"""Functions for a single use; objects keep their memory for the next one."""

from typing import Any

from numpy.typing import ArrayLike

from lanescape import _core
from lanescape.results import Evaluation, InsertedParticle, Overlaps, Path

__all__ = ["evaluate", "find_path", "insert", "overlap"]


def evaluate(model: _core.Model, positions: ArrayLike, box: ArrayLike, species: "ArrayLike | None" = None, *, forces: bool = True,
             stress: bool = False, energies: bool = False, **options: Any) -> Evaluation:
    """The energy of one configuration, and what else is asked for: an Evaluation.

    positions: (N, 3), wrapped or not. box: edges, (3,). species: names or indices, (N,); None for a model of one species. options: those
    of Potential. Many configurations of the same particles are faster with a Potential.

    Raises InputError.
    """
    kind = _core.StateSystem if model.has_states else _core.Potential
    if species is None and kind is _core.Potential:
        options["particles"] = len(positions)
    return kind(model, species, box, **options).evaluate(positions, forces=forces, stress=stress, energies=energies)


def overlap(positions: ArrayLike, radii: ArrayLike, box: ArrayLike, **options: Any) -> Overlaps:
    """All overlaps of hard spheres: Overlaps. positions: (N, 3). radii: (N,). box: edges, (3,). options: those of HardSpheres.

    Raises InputError.
    """
    spheres = _core.HardSpheres(radii, box, **options)
    pairs, gaps = spheres.overlaps(positions)
    return Overlaps(pairs, gaps, spheres.smallest_gap(positions))


def insert(model: _core.Model, species: "ArrayLike | None", positions: ArrayLike, box: ArrayLike, energy: float, count: int = 1, *,
           probe: "str | int | None" = None, diameter: float = 1.0, diameters: "ArrayLike | None" = None,
           **options: Any) -> list[InsertedParticle]:
    """Inserts `count` particles at positions where the energy rises by `energy`, one after the other: a list of InsertedParticle.

    The arguments are those of Inserter and of its method insert. Raises InputError.
    """
    inserter = _core.Inserter(model, species, positions, box, probe=probe, diameter=diameter, diameters=diameters)
    return inserter.insert(energy, count, **options)


def find_path(landscape: Any, start: ArrayLike, finish: ArrayLike, *, species: "ArrayLike | None" = None, box: "ArrayLike | None" = None,
              diameters: "ArrayLike | None" = None, masses: "ArrayLike | None" = None, **options: Any) -> Path:
    """A path from start to finish that never leaves the allowed region: a Path.

    landscape: a Model, with `species` and `box` and, where particles have them, `diameters`; or any landscape: a Potential, a
    StateSystem, an object with energy(R) and energy_and_gradient(R), or a function of R, (N, 3), that returns (energy, gradient).
    start, finish: (N, 3), unwrapped. masses: of a landscape's particles, (N,), None for equal ones.

    Options:
    method: contour or escape for energies, avoidance or away for hard spheres; the first of the family if it is not given.
    step: length of a direct step in 3N space; avoidance_step: of each sphere in an avoidance step; in units of length.
    fictitious: force between overlapping spheres in an avoidance step, harmonic, linear or cubic.
    landscape_energy: E_L; the higher of the two ends if it is not given.
    reverse: search from the far end too and keep the shorter path.
    max_steps, patience: steps, and steps without progress, after which the search ends.
    frames: configurations kept between the ends. threads, precision, instruction_set: as for Potential, of a Model only.
    progress: called now and then with the part done; False ends the search.

    Raises InputError for ends that differ, coincide, overlap or lie above E_L. Exceptions of a landscape pass through.
    """
    if isinstance(landscape, _core.Model):
        if masses is not None:
            raise TypeError("masses: those of a model hold; None is needed")
        if box is None:
            raise TypeError("box: the edges are needed with a model")
        return _core.path_of_model(landscape, start, finish, species, box, diameters, _checked(options))
    if species is not None or box is not None or diameters is not None:
        raise TypeError("species, box and diameters belong to a model: a landscape has its own")
    return _core.path_on_landscape(landscape, start, finish, masses, _checked(options))


_OPTIONS = ("method", "step", "avoidance_step", "fictitious", "landscape_energy", "reverse", "max_steps", "patience", "frames", "threads",
            "precision", "instruction_set", "progress")


def _checked(options):
    for name in options:
        if name not in _OPTIONS:
            raise TypeError(f"find_path() has no option '{name}': it has {', '.join(_OPTIONS)}")
    return options
