"""Configurations that the tests of the Python package share."""

import numpy as np

import lanescape


def fluid(name="kob-andersen", particles=108, density=1.2, seed=1, shake=0.05):
    """(model, species, positions, box) of a lattice whose particles are moved at random."""
    model = lanescape.Model.named(name)
    start = lanescape.make_start(model, particles, density, seed=seed)
    positions = start.positions + shake * np.random.default_rng(seed).normal(size=start.positions.shape)
    return model, start.species, positions, start.box


def potential(**options):
    """(Potential, positions) of the mixture of Kob and Andersen."""
    model, species, positions, box = fluid()
    return lanescape.Potential(model, species, box, **options), positions


def end_points(distance=4.0):
    """(model, start, pair): two configurations of one trajectory, a short way apart."""
    model = lanescape.Model.named("kob-andersen")
    start = lanescape.make_start(model, 108, 1.2)
    pair, = lanescape.make_end_points(model, start, quick=True, equilibration=300, distance=distance)
    return model, start, pair
