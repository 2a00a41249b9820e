"""Functions for a single use; objects keep their memory for the next one."""

from collections.abc import Callable
from typing import Any

import numpy
from numpy.typing import ArrayLike

from lanescape import _core
from lanescape.results import Evaluation, InsertedParticle, Overlaps, Path, PathCertificate, ShortPath

__all__ = ["check_path", "evaluate", "find_path", "insert", "overlap", "shorten_path"]


def evaluate(model: _core.Model, positions: ArrayLike, box: ArrayLike, species: "ArrayLike | None" = None, *, forces: bool = True,
             stress: bool = False, energies: bool = False, threads: int = 1, precision: str = "double", instruction_set: str = "auto",
             diameters: "ArrayLike | None" = None) -> Evaluation:
    """The energy of one configuration, and what else is asked for: an Evaluation.

    positions: (N, 3), wrapped or not. box: edges, (3,). species: names or indices, (N,); None for a model of one species. threads,
    precision, instruction_set, diameters: as for Potential; a model with states has double precision and no diameters. Many
    configurations of the same particles are faster with a Potential or a StateSystem.

    Raises InputError.
    """
    if not isinstance(model, _core.Model):
        raise TypeError(f"model: a lanescape.Model is needed, not {type(model).__name__}")
    options: dict[str, Any] = {"threads": threads, "instruction_set": instruction_set}
    if model.has_states:
        if precision != "double" or diameters is not None:
            raise TypeError(f"precision and diameters are not allowed: model {model.name} has states")
        return _core.StateSystem(model, species, box, **options).evaluate(positions, forces=forces, stress=stress, energies=energies)
    if species is None:
        options["particles"] = len(positions) if numpy.ndim(positions) else 0
    potential = _core.Potential(model, species, box, precision=precision, diameters=diameters, **options)
    return potential.evaluate(positions, forces=forces, stress=stress, energies=energies)


def overlap(positions: ArrayLike, radii: ArrayLike, box: ArrayLike, *, instruction_set: str = "auto") -> Overlaps:
    """All overlaps of hard spheres: Overlaps. positions: (N, 3). radii: (N,). box: edges, (3,). instruction_set: as for HardSpheres.

    Raises InputError.
    """
    spheres = _core.HardSpheres(radii, box, instruction_set=instruction_set)
    pairs, gaps = spheres.overlaps(positions)
    return Overlaps(pairs, gaps, spheres.smallest_gap(positions))


def insert(model: _core.Model, species: "ArrayLike | None", positions: ArrayLike, box: ArrayLike, energy: float, count: int = 1, *,
           probe: "str | int | None" = None, diameter: float = 1.0, diameters: "ArrayLike | None" = None, tolerance: float = 0.01,
           measure: str = "relative", method: str = "usher", largest_step: float = 0.0, most_trials: int = 10000,
           region: "ArrayLike | None" = None, seed: int = 1, threads: int = 1, instruction_set: str = "auto") -> list[InsertedParticle]:
    """Inserts `count` particles at positions where the energy rises by `energy`, one after the other: a list of InsertedParticle.

    The arguments are those of Inserter and of its method insert. Raises InputError.
    """
    inserter = _core.Inserter(model, species, positions, box, probe=probe, diameter=diameter, diameters=diameters, instruction_set=instruction_set)
    return inserter.insert(energy, count, tolerance=tolerance, measure=measure, method=method, largest_step=largest_step,
                           most_trials=most_trials, region=region, seed=seed, threads=threads)


def find_path(landscape: Any, start: ArrayLike, finish: ArrayLike, *, species: "ArrayLike | None" = None, box: "ArrayLike | None" = None,
              diameters: "ArrayLike | None" = None, masses: "ArrayLike | None" = None, method: "str | None" = None, adaptive: bool = False,
              step: "float | None" = None, avoidance_step: "float | None" = None, fictitious: str = "harmonic", landscape_energy: "float | None" = None,
              reverse: bool = False, max_steps: int = 1_000_000_000, patience: int = 1000, frames: int = 100, threads: int = 1,
              precision: str = "double", instruction_set: str = "auto",
              progress: "Callable[[float], bool | None] | None" = None) -> Path:
    """A path from start to finish that never leaves the allowed region: a Path.

    landscape: a Model, with `species` and `box` and, where particles have them, `diameters`; or any landscape: a Potential, a
    StateSystem, an object with energy(R) and energy_and_gradient(R), or a function of R, (N, 3), that returns (energy, gradient).
    start, finish: (N, 3), unwrapped, in the landscape's unit of length.
    species: names or indices, (N,); None for a model of one species. box: edges, (3,). diameters: (N,).
    masses: of a landscape's particles, (N,), None for equal ones; a model has its own.

    method: contour or escape for energies, avoidance or away for hard spheres; None: the first of the family.
    adaptive: for contour: steps as long as an estimate of their error allows, the limit of short steps in fewer evaluations; for avoidance: slides
        along contacts in long steps, shorter paths.
    step: length of a direct step in 3N space, where steps are not adaptive; avoidance_step: of each sphere in an avoidance step; in units
    of length. None: the method's own, in the unit of length of the model or of the potential.
    fictitious: force between overlapping spheres in an avoidance step, harmonic, linear or cubic.
    landscape_energy: E_L, in units of energy; None: the higher of the two ends.
    reverse: search from the far end too and keep the shorter path.
    max_steps, patience: steps, and steps without progress, after which the search ends.
    frames: configurations kept between the ends.
    threads, precision (double or mixed), instruction_set: as for Potential, of a Model only.
    progress: called now and then with the part done, from 0 to 1; False ends the search.

    Raises InputError for ends that differ, coincide, overlap or lie above E_L. Exceptions of a landscape pass through.
    """
    options = _given({"method": method, "adaptive": adaptive, "step": step, "avoidance_step": avoidance_step, "fictitious": fictitious,
                      "landscape_energy": landscape_energy, "reverse": reverse, "max_steps": max_steps, "patience": patience, "frames": frames,
                      "threads": threads, "precision": precision, "instruction_set": instruction_set, "progress": progress})
    if _is_model(landscape, species, box, diameters, masses, threads, precision, instruction_set):
        return _core.path_of_model(landscape, start, finish, species, box, diameters, options)
    return _core.path_on_landscape(landscape, start, finish, masses, options)


def shorten_path(landscape: Any, start: ArrayLike, finish: ArrayLike, path: "ArrayLike | None" = None, *, species: "ArrayLike | None" = None,
                 box: "ArrayLike | None" = None, diameters: "ArrayLike | None" = None, masses: "ArrayLike | None" = None, method: "str | None" = None,
                 starts: int = 1, seed: int = 1, path_method: "str | None" = None, adaptive: bool = False, step: "float | None" = None,
                 avoidance_step: "float | None" = None, fictitious: str = "harmonic", landscape_energy: "float | None" = None,
                 max_steps: int = 1_000_000_000, patience: int = 1000, threads: int = 1, precision: str = "double", instruction_set: str = "auto",
                 progress: "Callable[[float], bool | None] | None" = None) -> ShortPath:
    """A path from start to finish in the allowed region, as short as the method makes it: a ShortPath.

    landscape, start, finish, species, box, diameters, masses: as for find_path.
    path: the path to shorten, (F, N, 3), at least three frames that begin and end at the two ends, in either order, and are allowed, such as
    the frames of a Path; None: the one that the path method finds.

    method: a word of shorten_methods(); None: the first.
    starts, seed: independent runs with other random numbers, of which the shortest path is kept.
    path_method, adaptive, step, avoidance_step, fictitious, landscape_energy, max_steps, patience: how the path to start from and those in
    between are found; find_path has them, and their units.
    threads, precision, instruction_set: as for Potential, of a Model only; several starts run at once. On a landscape there is one thread.
    progress: called now and then with the number of iterations or trials made so far, 0 while the path to start from is found; False ends
    the work.

    Raises InputError for what find_path refuses, and for a path with fewer frames, of another shape, with other ends or outside the allowed
    region. Exceptions of a landscape pass through.
    """
    options = _given({"method": method, "starts": starts, "seed": seed, "path_method": path_method, "adaptive": adaptive, "step": step,
                      "avoidance_step": avoidance_step, "fictitious": fictitious, "landscape_energy": landscape_energy, "max_steps": max_steps,
                      "patience": patience, "threads": threads, "precision": precision, "instruction_set": instruction_set, "progress": progress})
    if _is_model(landscape, species, box, diameters, masses, threads, precision, instruction_set):
        return _core.short_path_of_model(landscape, start, finish, path, species, box, diameters, options)
    return _core.short_path_on_landscape(landscape, start, finish, path, masses, options)


def check_path(landscape: Any, path: ArrayLike, *, species: "ArrayLike | None" = None, box: "ArrayLike | None" = None,
               diameters: "ArrayLike | None" = None, masses: "ArrayLike | None" = None, landscape_energy: "float | None" = None, threads: int = 1,
               instruction_set: str = "auto") -> PathCertificate:
    """How far a path of straight segments leaves the allowed region, and how far it is from a shortest one: a PathCertificate.

    landscape, species, box, diameters, masses: as for find_path. path: (F, N, 3), at least three frames, unwrapped.
    landscape_energy: E_L, in units of energy, not for hard spheres; None: the higher of the two ends.
    threads, instruction_set: as for Potential, of a Model only.

    Raises InputError for fewer frames, another shape, coordinates or energies that are not finite, and neighbouring frames that coincide.
    Exceptions of a landscape pass through.
    """
    options = _given({"landscape_energy": landscape_energy, "threads": threads, "instruction_set": instruction_set})
    if _is_model(landscape, species, box, diameters, masses, threads, "double", instruction_set):
        return _core.certificate_of_model(landscape, path, species, box, diameters, options)
    return _core.certificate_on_landscape(landscape, path, masses, options)


def _given(options: dict[str, Any]) -> dict[str, Any]:
    """Without the options that are None for the library's own choice. None for any other is left, and refused."""
    return {name: value for name, value in options.items() if value is not None or name not in _MAY_BE_NONE}


_MAY_BE_NONE = {"method", "path_method", "step", "avoidance_step", "landscape_energy", "progress"}


def _is_model(landscape: Any, species: Any, box: Any, diameters: Any, masses: Any, threads: int, precision: str, instruction_set: str) -> bool:
    """Whether paths are those of a model. TypeError for arguments that do not belong to it, or to a landscape."""
    if isinstance(landscape, _core.Model):
        if masses is not None:
            raise TypeError("masses: those of a model hold; None is needed")
        if box is None:
            raise TypeError("box: the edges are needed with a model")
        return True
    if species is not None or box is not None or diameters is not None:
        raise TypeError("species, box and diameters belong to a model: a landscape has its own")
    if (threads, precision, instruction_set) != (1, "double", "auto"):
        raise TypeError("threads, precision and instruction_set belong to a model: a landscape has its own")
    return False
