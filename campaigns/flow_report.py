#!/usr/bin/python3
"""Open flows against the equation of state, as a table: flow_report.py DIR, DIR filled by flow.smk.

The front: mass fluxes of all fronts of a density, those from the outlet mirrored, are fitted by any smooth function of t - x/c; c is where the rest is least, and its
error that of a jackknife over fronts. The wave from the inlet is one of compression, that from the outlet one of rarefaction: what the amplitude does to their
speeds cancels to first order.
"""

import json
import sys
from pathlib import Path

import numpy as np
from scipy.interpolate import BSpline

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tools"))
import equation_of_state  # noqa: E402
from plot_flow import by_rows  # noqa: E402
from plot_style import read_table  # noqa: E402

DENSITIES, TEMPERATURE, CUTOFF, SEEDS = (0.5, 0.7), 2.5, 3.0, tuple(range(1, 17))
KNOTS, NEAREST, FARTHEST = 10, 6.0, 44.0  # x of a slab of 100 in which fronts are looked at, beyond the buffer and before they meet


def best_speed(times, x, flux, near):
    """The speed at which a function of t - x/speed fits best."""
    time, place = np.meshgrid(times, x, indexing="ij")
    speeds, rests = np.linspace(0.75 * near, 1.35 * near, 121), []
    for speed in speeds:
        arrival = (time - place / speed).ravel()
        knots = np.linspace(arrival.min(), arrival.max(), KNOTS)
        padded = np.r_[[knots[0]] * 3, knots, [knots[-1]] * 3]
        inside = np.clip(arrival, knots[0] + 1e-9, knots[-1] - 1e-9)
        basis = BSpline.design_matrix(inside, padded, 3).toarray()
        weights = np.linalg.lstsq(basis, flux.ravel(), rcond=None)[0]
        rests.append(np.sum((flux.ravel() - basis @ weights)**2))
    return speeds[np.argmin(rests)]


def front_speed(folders, near):
    """Speed of the front and its standard error."""
    fluxes = []
    for folder in folders:
        times, x, values = by_rows(read_table(folder / "flow.csv", ["time", "x", "mass_flux"]))
        middles = times - 0.5 * (times[1] - times[0])
        rows, slices = (middles > 0.3) & (middles < 0.5 * (x[-1] + x[0]) / near), (x > NEAREST) & (x < FARTHEST)
        fluxes += [values["mass_flux"][np.ix_(rows, slices)], values["mass_flux"][:, ::-1][np.ix_(rows, slices)]]
    speed = best_speed(middles[rows], x[slices], np.mean(fluxes, axis=0), near)
    without = [best_speed(middles[rows], x[slices], np.mean(fluxes[:k] + fluxes[k + 1:], axis=0), near) for k in range(len(fluxes))]
    return speed, np.sqrt((len(fluxes) - 1) * np.var(without))


def main(folder):
    equation = equation_of_state.load("thol", CUTOFF)
    print("| density | front | sound velocity | mean velocity | density | its slope | slope of the velocity | evaluations | energy error |")
    print("|---|---|---|---|---|---|---|---|---|")
    for density in DENSITIES:
        expected = float(equation.sound_velocity(TEMPERATURE, density))
        speed, error = front_speed([folder / f"front-{density}-{seed}" for seed in SEEDS], expected)
        long = json.loads((folder / f"long-{density}" / "result.json").read_text())
        rho, v = long["density"], long["velocity"]
        print(f"| {density} | {speed:.3f} ± {error:.3f} | {expected:.3f} | {v['mean']:.4f} ± {v['error']:.4f} | {rho['mean']:.4f} ± {rho['error']:.4f} "
              f"| {rho['slope']:.1e} ± {rho['slope_error']:.1e} | {v['slope']:.1e} ± {v['slope_error']:.1e} | {long['mean_evaluations']:.1f} "
              f"| {long['balance']['energy_error']:.1e} |")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
