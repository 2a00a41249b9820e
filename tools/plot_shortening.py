"""Figures of `lanescape shorten` for tools/plot.py: shortened.png, both paths side by side, and shortening.png, the trials."""

import numpy as np
from matplotlib.ticker import MaxNLocator

from plot_style import (BLUE, GREY, VERMILLION, Unusable, decade_ticks, legend_above, letter, particles_of, plt, read_table, running,
                        save, system_parts, title)

WINDOWS = 100  # of running statistics along a path, and bins of multipliers


def read_trials(folder):
    """The table of trials, or None if there is none."""
    file = folder / "path-0001-trials.csv"
    return read_table(file, ["trial", "distance_to_goal", "length", "accepted"]) if file.exists() else None


def draw_shortening(folder, trials, result):
    """The length that each trial found and the shortest so far; the same lengths against the place of the changed configuration."""
    figure, (left, right) = plt.subplots(1, 2, sharey=True, figsize=(10.0, 5.4), layout="constrained")
    number, length, kept = trials["trial"], trials["length"], trials["accepted"] == 1
    shortest = np.minimum.accumulate(np.concatenate([[result["length_before"]], np.where(kept, length, np.inf)]))
    left.step(np.concatenate([[0], number]), shortest, where="post", color=BLUE, label="shortest so far")
    for axes, x in ((left, number), (right, trials["distance_to_goal"])):
        axes.plot(x[~kept], length[~kept], "o", color=GREY, fillstyle="none", label="longer: dropped")
        axes.plot(x[kept], length[kept], "o", color=VERMILLION, label="shorter: kept")
    left.xaxis.set_major_locator(MaxNLocator(integer=True))
    left.set_xlabel("trial")
    left.set_ylabel(r"path length  $g/\sigma$")
    right.set_xlabel(r"distance to the goal of what was changed  $[\sigma]$")
    legend_above(left)
    change = 100.0 * (1.0 - result["length"] / result["length_before"])
    title(figure, system_parts(result, None, None) + [f"{change:.3g} % shorter after {len(number)} trials"])
    save(figure, folder / "shortening.png")


def read_shortened(folder, result):
    """The paths before and after, as (label, colour, table of nodes), and what result.json says of them; or None if there is none."""
    files = [folder / f"{name}-nodes.csv" for name in ("initial-0001", "path-0001")]
    if not all(file.exists() for file in files):
        return None
    tables = [read_table(file, ["length", "distance_to_goal", "multiplier", "participation_ratio"]) for file in files]
    for file, table in zip(files, tables):
        if "excess" not in table and "smallest_gap" not in table:
            raise Unusable(f"{file}: no column excess")
        if len(table["length"]) < 3:
            raise Unusable(f"{file}: fewer than 3 nodes")
    for key in ("length_before", "length", "distance"):
        if not isinstance(result.get(key), (int, float)):
            raise Unusable(f"{folder / 'result.json'}: {key} is not a number")
    lengths = [result["length_before"], result["length"]]
    for table, length in zip(tables, lengths):
        table["length"] *= length / table["length"][-1]  # the detours of steps between nodes, spread evenly
    return [(rf"{name}, $g={length:.4g}\,\sigma$", colour, table)
            for name, length, colour, table in zip(("greedy", "shortened"), lengths, (VERMILLION, BLUE), tables)]


def draw_room(axes, paths):
    """How far the nodes are from the boundary: E_L - V, or the smallest gap. Less than the floor is on the boundary."""
    hard = "smallest_gap" in paths[0][2]
    floor, unit = (1e-9, r"\sigma") if hard else (1e-5, r"\epsilon")
    for label, colour, nodes in paths:
        room = np.maximum(nodes["smallest_gap"] if hard else -nodes["excess"], floor)[1:-1]
        axes.plot(nodes["length"][1:-1], room, color=colour, alpha=0.25, linewidth=0.8)
        axes.plot(nodes["length"][1:-1], running(room, np.nanmedian, WINDOWS), color=colour, label=label)
    axes.set_yscale("log")
    decade_ticks(axes.yaxis, 7)
    axes.set_ylabel(rf"${'h' if hard else 'E_L-V'}\;\;[{unit}]$")
    letter(axes, "(a) smallest gap at nodes" if hard else "(a) room below $E_L$ at nodes")
    legend_above(axes)


def draw_distances(axes, paths, distance):
    """The distance that remains to the goal, and the straight line."""
    for _, colour, nodes in paths:
        axes.plot(nodes["length"], nodes["distance_to_goal"], color=colour)
    axes.plot([0.0, distance], [distance, 0.0], color=GREY, linestyle="--", label="straight line")
    axes.set_ylim(0.0, 1.05 * distance)
    axes.set_ylabel(r"$|R_f-R|\;\;[\sigma]$")
    letter(axes, "(b) distance to the goal")
    legend_above(axes)


def draw_multipliers(axes, paths):
    """Multipliers per length, in equal bins of the length: the curvature that the boundary forces on a path."""
    for _, colour, nodes in paths:
        edges = np.linspace(0.0, nodes["length"][-1], WINDOWS + 1)
        force = np.histogram(nodes["length"], edges, weights=nodes["multiplier"])[0] / (edges[1] - edges[0])
        axes.stairs(force, edges, color=colour, linewidth=1.8)
    axes.set_ylim(0.0, None)
    axes.set_ylabel(r"$\lambda\;\;[\sigma^{-1}]$")
    letter(axes, r"(c) multipliers per length: how hard the boundary bends the path")


def draw_participations(axes, paths):
    """The share of the particles that moves at a time: median and the range from 10 to 90 %."""
    for _, colour, nodes in paths:
        x, y = nodes["length"], nodes["participation_ratio"]
        low, high = (running(y, lambda v, axis, q=q: np.nanpercentile(v, q, axis=axis), WINDOWS) for q in (10, 90))
        axes.fill_between(x, low, high, color=colour, alpha=0.2, linewidth=0)
        axes.plot(x, running(y, np.nanmedian, WINDOWS), color=colour)
    axes.set_ylim(0.0, None)
    axes.set_ylabel("$n/N$")
    letter(axes, "(d) participation ratio between nodes")


def draw_shortened(folder, paths, result, temperature):
    """Four panels along both paths, into shortened.png."""
    figure, panels = plt.subplots(4, 1, sharex=True, figsize=(10.0, 11.0), gridspec_kw={"height_ratios": [3, 3, 2.3, 2.3], "hspace": 0.34})
    change = 100.0 * (1.0 - result["length"] / result["length_before"])
    before, after = ((result["distance"] / result[key]) ** 2 for key in ("length_before", "length"))
    title(figure, system_parts(result, temperature, particles_of(folder / "path-0001.extxyz"))
          + [rf"$\Delta R={result['distance']:.1f}\,\sigma$", f"{change:.3g} % shorter\n"
             rf"$(\Delta R/g)^2$ from {before:.3f} to {after:.3f}"], above=0.55)
    draw_room(panels[0], paths)
    draw_distances(panels[1], paths, result["distance"])
    draw_multipliers(panels[2], paths)
    draw_participations(panels[3], paths)
    panels[3].set_xlim(0.0, max(nodes["length"][-1] for _, _, nodes in paths))
    panels[3].set_xlabel(r"path length traversed $\ell\;\;[\sigma]$")
    figure.align_ylabels(panels)
    save(figure, folder / "shortened.png")
