"""What functions return. All pickle; arrays are of float64 or int64."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy

__all__ = ["EndPoints", "Evaluation", "InsertedParticle", "Overlaps", "Path", "PathCertificate", "ShortPath", "SitePairs", "Start"]


class Evaluation(NamedTuple):
    """An energy and what was asked for besides; None where it was not."""

    energy: float
    forces: "numpy.ndarray | None"  # -dV/dR, (N, 3)
    virial: "float | None"  # sum over pairs of r.f; with forces or stress
    stress: "numpy.ndarray | None"  # xx yy zz yz xz xy, (6,): minus sum r_a f_b over the volume
    energies: "numpy.ndarray | None"  # of each particle, (N,): half of each of its pairs


class Overlaps(NamedTuple):
    """Overlapping pairs of hard spheres."""

    pairs: numpy.ndarray  # (K, 2), int64, i < j in rising order
    gaps: numpy.ndarray  # (K,): r_ij - s_ij < 0
    smallest_gap: float  # of all pairs, those that do not overlap too


class SitePairs(NamedTuple):
    """All P pairs of sites within reach, once from each end, for an order parameter; views that are valid during its call."""

    first: numpy.ndarray  # sites, (P,), int64
    second: numpy.ndarray  # (P,), int64
    separation: numpy.ndarray  # r_first - r_second, an image of it, (P, 3)


@dataclass(frozen=True, eq=False)
class InsertedParticle:
    """One search for a position of a given energy."""

    found: bool  # the error is within the tolerance
    position: numpy.ndarray  # (3,), in the box
    energy: float  # by which the fluid's rises
    error: float  # U - U0, or (U - U0) / |U0| where the measure is relative
    evaluations: int
    trials: int


@dataclass(frozen=True, eq=False)
class Start:
    """A configuration that the library made."""

    species: numpy.ndarray  # indices, (N,), int64
    positions: numpy.ndarray  # (N, 3)
    box: numpy.ndarray  # edges, (3,)
    diameters: "numpy.ndarray | None"  # (N,), where particles have them or are hard spheres


@dataclass(frozen=True, eq=False)
class EndPoints:
    """Two configurations of one trajectory, unwrapped."""

    start: numpy.ndarray  # (N, 3)
    finish: numpy.ndarray  # (N, 3)
    distance: float  # in 3N space, the motion of the centre of mass removed
    steps: int  # from start to finish; collisions of hard spheres
    time: float


@dataclass(frozen=True, eq=False)
class Path:
    """A path that never leaves the allowed region V(R) <= E_L, or overlaps."""

    outcome: str  # reached, step_limit, stalled, interrupted
    reason: str  # why it ended where it did not reach its goal
    length: float  # in 3N space, of mass-weighted coordinates where masses differ
    distance: float  # of its ends, likewise
    ratio_squared: float  # (distance / length)^2, 0 for a path that did not move
    participation_ratio: float  # share of the particles that move at a time
    direct_steps: int
    detour_steps: int
    evaluations: int
    landscape_energy: float  # E_L of soft models
    largest_violation: float  # largest V - E_L of an accepted point, or deepest overlap; at least 0
    reversed: bool  # frames run from the finish to the start
    seconds: float
    frames: numpy.ndarray  # (F, N, 3), ends included

    @property
    def reached(self) -> bool:
        return self.outcome == "reached"


@dataclass(frozen=True, eq=False)
class ShortPath:
    """A path in the allowed region, as short as a method made it."""

    outcome: str  # reached where the method ended by its own rule; else step_limit, stalled, interrupted
    reason: str  # why it is not reached
    length_before: float  # in 3N space, of mass-weighted coordinates where masses differ
    length: float  # of the shortest path, 0 where there was none to start from
    distance: float  # of its ends
    ratio_squared: float  # (distance / length)^2, 0 without a path
    landscape_energy: float  # E_L of soft models
    largest_violation: float  # largest V - E_L along it, or deepest overlap; at least 0
    kuhn_tucker_residual: "float | None"  # as in PathCertificate; None where the frames are only some points of the path
    multipliers: "numpy.ndarray | None"  # likewise, of each frame, (F,)
    start_lengths: numpy.ndarray  # of the path that each start found
    evaluations: int  # that found the path, not those of trials that failed
    seconds: float
    frames: numpy.ndarray  # (F, N, 3), from start to finish

    @property
    def reached(self) -> bool:
        return self.outcome == "reached"


@dataclass(frozen=True, eq=False)
class PathCertificate:
    """How far a path leaves the allowed region, and how far it is from the Kuhn-Tucker condition of a shortest one.

    A small residual shows that it is stationary, not that no other is shorter.
    """

    length: float  # in 3N space, of mass-weighted coordinates where masses differ
    distance: float  # of its ends, likewise
    ratio_squared: float  # (distance / length)^2
    landscape_energy: float  # E_L of soft models
    largest_violation: float  # of V - E_L, or of overlaps, over frames and segments; at least 0
    kuhn_tucker_residual: float  # max |tau - lambda n| / max |tau| over the bends tau of the path; 0 for a straight one
    multipliers: numpy.ndarray  # lambda >= 0 of each frame, (F,); of hard spheres the sum over contacts
    excess: numpy.ndarray  # of each frame, (F,): V - E_L; of hard spheres the smallest gap
    segment_violation: numpy.ndarray  # of each segment, (F - 1,): the largest V - E_L; of hard spheres minus the smallest gap
