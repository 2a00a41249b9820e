"""Figures of paths for tools/plot.py: one figure along each path, and one that compares all paths."""

import numpy as np
from matplotlib.ticker import FuncFormatter, MaxNLocator

from plot_style import (BLUE, GREEN, GREY, PURPLE, VERMILLION, Unusable, decade_ticks, draw_series, legend_above, letter, particles_of,
                        plt, read_table, running, save, system_parts)

HISTOGRAM_FROM = 10  # paths


def read_paths(folder, result):
    """All paths that result.json lists, in its order."""
    return [read_path(folder, number, summary) for number, summary in enumerate(result.get("paths", []), 1)]


def read_path(folder, number, summary):
    """One path: its summary in result.json, its trace, and the number of particles (None if unknown)."""
    name = f"path-{number:04}"
    trace = read_table(folder / f"{name}-trace.csv",
                       ["length", "distance_to_goal", "direct_fraction", "participation_ratio"])
    hard = "moved_particles" in trace
    if not hard and "energy" not in trace:
        raise Unusable(f"{folder / (name + '-trace.csv')}: no column energy")
    for key in ("length", "distance") + (() if hard else ("landscape_energy",)):
        if not isinstance(summary.get(key), (int, float)):
            raise Unusable(f"{folder / 'result.json'}: {key} of path {number} is not a number")
    return {**summary, "name": name, "trace": trace, "particles": particles_of(folder / f"{name}.extxyz"), "hard": hard}


def path_title(path, result, temperature):
    """Two lines: the system and the method; the distance, the length and the outcome."""
    first = system_parts(result, temperature, path["particles"])
    first.append(f"{path_method(path)} method" + (", from $R_f$ to $R_i$" if path.get("reversed") else ""))
    second = [rf"$\Delta R={path['distance']:.1f}\,\sigma$", rf"$g={path['length']:.4g}\,\sigma$"]
    if path.get("ratio_squared") is not None:
        second.append(rf"$(\Delta R/g)^2={path['ratio_squared']:.4g}$")
    else:
        second.append(path.get("outcome", "ended").replace("_", " ") + " before the goal")
    return ",  ".join(first) + "\n" + ",  ".join(second)


def path_method(path):
    """The method of a path: the kind of those steps that are not direct."""
    return next((kind for kind in path.get("steps", {}) if kind != "direct"), "direct")


def draw_gap(axes, path, temperature):
    """The gap E_L - V along the path. The colour changes where most of the path lies above E_L, within the tolerance."""
    gap = path["landscape_energy"] - path["trace"]["energy"]
    x, size = path["trace"]["length"], np.where(gap == 0.0, np.nan, np.abs(gap))
    above = np.count_nonzero(gap < 0.0) > len(gap) / 2
    colour, label = (VERMILLION, "$V>E_L$") if above else (BLUE, "$V<E_L$")
    if np.isfinite(size).any():
        draw_series(axes, x, size, colour, label=label)
        axes.set_yscale("log")
        decade_ticks(axes.yaxis, 6)
    if temperature:
        axes.axhline(temperature, color=GREY, linestyle=":", label=r"$k_\mathrm{B}T$")
    axes.set_ylabel(r"$|E_L-V|\;\;[\epsilon]$" if above else r"$E_L-V\;\;[\epsilon]$")
    letter(axes, f"(a) gap to landscape energy $E_L=${path['landscape_energy']:.2f}".replace("-", "\u2212"))
    legend_above(axes)


def draw_moved(axes, path):
    """The fraction of particles that a step moves. A direct step moves all of them."""
    count = path["particles"] or path["trace"]["moved_particles"].max()
    draw_series(axes, path["trace"]["length"], path["trace"]["moved_particles"] / count, BLUE, label="running median")
    axes.set_ylim(0.0, 1.05)
    axes.set_ylabel("$c/N$")
    letter(axes, "(a) particles moved by a step")
    legend_above(axes)


def draw_distance(axes, path):
    """The distance that remains to the goal, and the straight line for comparison."""
    trace, straight = path["trace"], path["distance"]
    axes.plot(trace["length"], trace["distance_to_goal"], color=BLUE, marker="o" if len(trace["length"]) < 3 else None, label="path")
    axes.plot([0.0, straight], [straight, 0.0], color=GREY, linestyle="--", label=r"straight line, $\Delta R-\ell$")
    axes.set_ylim(0.0, 1.05 * straight)
    axes.set_ylabel(r"$|R_f-R|\;\;[\sigma]$" if not path.get("reversed") else r"$|R_i-R|\;\;[\sigma]$")
    letter(axes, "(b) distance to the goal")
    legend_above(axes)


def binned_mean(x, y, end, bins=70):
    """Means of y in equal bins of x over [0, end], 0 in empty bins; and the edges of the bins."""
    edges = np.linspace(0.0, end, min(bins, max(1, len(x))) + 1)
    count = np.histogram(x, edges)[0]
    return np.histogram(x, edges, weights=y)[0] / np.maximum(count, 1), edges


def draw_step_kinds(axes, path, end):
    """The share of direct steps along the path, on a logarithmic axis if there are any."""
    share, edges = binned_mean(path["trace"]["length"], path["trace"]["direct_fraction"], end)
    counts = ", ".join(f"{count:,} {kind}".replace(",", "\u2009") for kind, count in path.get("steps", {}).items())
    letter(axes, f"(c) share of direct steps  ({counts})")
    if share.max() > 0.0:
        floor = 10.0 ** np.floor(np.log10(share[share > 0.0].min()) - 0.01)
        axes.stairs(np.maximum(share, floor), edges, baseline=floor, fill=True, color=GREEN)
        axes.set_yscale("log")
        axes.set_ylim(floor, 1.3)
        decade_ticks(axes.yaxis, 4)
    else:
        axes.set_ylim(0.0, 1.0)
        axes.text(0.5, 0.45, "no direct steps recorded", transform=axes.transAxes, ha="center", color=GREY)
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{100.0 * value:g} %"))
    axes.set_ylabel("direct")


def draw_participation(axes, path):
    """The running median of the participation ratio, its 10 to 90 % band, and the mean over the path."""
    x, y = path["trace"]["length"], path["trace"]["participation_ratio"]
    low, high = (running(y, lambda v, axis, q=q: np.nanpercentile(v, q, axis=axis)) for q in (10, 90))
    axes.fill_between(x, low, high, color=PURPLE, alpha=0.3, linewidth=0, label="10\u201390 %")
    axes.plot(x, running(y, np.nanmedian), color=PURPLE, marker="o" if len(x) < 3 else None, label="running median")
    if path.get("participation_ratio") is not None:
        axes.axhline(path["participation_ratio"], color="black", linestyle="--", linewidth=1.5,
                     label=f"path mean {path['participation_ratio']:.3f}")
    axes.set_ylim(0.0, max(0.8, 1.05 * y.max()))
    axes.set_ylabel("$n/N$")
    letter(axes, "(d) participation ratio")
    legend_above(axes)


def draw_path(folder, path, result, temperature):
    """Four panels along one path, into path-NNNN.png."""
    figure, panels = plt.subplots(4, 1, sharex=True, figsize=(10.0, 10.5), gridspec_kw={"height_ratios": [3, 3, 1.7, 2.3], "hspace": 0.34})
    figure.suptitle(path_title(path, result, temperature), y=0.965, fontsize=15)
    if len(path["trace"]["length"]) == 0:
        panels[0].text(0.5, 0.5, "no step was recorded", transform=panels[0].transAxes, ha="center", color=GREY)
    else:
        end = max(path["length"], path["trace"]["length"][-1])
        draw_moved(panels[0], path) if path["hard"] else draw_gap(panels[0], path, temperature)
        draw_distance(panels[1], path)
        draw_step_kinds(panels[2], path, end)
        draw_participation(panels[3], path)
        panels[3].set_xlim(0.0, end)
    panels[3].set_xlabel(r"path length traversed $\ell\;\;[\sigma]$")
    figure.align_ylabels(panels)
    save(figure, folder / f"{path['name']}.png")


def draw_strip(axes, histogram, numbers, values, label, colour):
    """Values by path number, their mean and its standard error. `histogram` is the panel of their histogram, or None."""
    mean, error = values.mean(), values.std(ddof=1) / np.sqrt(len(values))
    axes.axhspan(mean - error, mean + error, color=colour, alpha=0.25, linewidth=0)
    axes.axhline(mean, color=colour)
    axes.plot(numbers, values, "o", color=colour, markersize=8, markeredgecolor="white")
    digits = max(0, 1 - int(np.floor(np.log10(error)))) if error > 0.0 else 4
    axes.set_title(rf"mean {mean:.{digits}f} $\pm$ {error:.{digits}f}", loc="left", fontsize=13)
    axes.set_ylabel(label)
    axes.margins(x=0.08, y=0.15)
    axes.xaxis.set_major_locator(MaxNLocator(nbins=8, integer=True))
    if histogram is not None:
        histogram.hist(values, bins=int(np.ceil(np.sqrt(len(values)))), orientation="horizontal", color=colour, alpha=0.6,
                       edgecolor="white")
        histogram.xaxis.set_major_locator(MaxNLocator(nbins=3, integer=True))
        histogram.tick_params(labelleft=False)


def draw_paths(folder, paths, result, temperature):
    """Ratios and participation ratios of the paths that reached their goal, into paths.png. Two such paths are needed."""
    reached = [(number, path) for number, path in enumerate(paths, 1) if path.get("ratio_squared") is not None]
    if len(reached) < 2:
        return
    numbers = [number for number, _ in reached]
    columns = 2 if len(reached) >= HISTOGRAM_FROM else 1
    figure, panels = plt.subplots(2, columns, squeeze=False, sharey="row", sharex="col", figsize=(9.0, 7.0),
                                  gridspec_kw={"width_ratios": [3.5, 1][:columns], "wspace": 0.06, "hspace": 0.25})
    parts = system_parts(result, temperature, paths[0]["particles"])
    parts += [f"{path_method(paths[0])} method\n{len(reached)} of {len(paths)} paths reached the goal"]
    figure.suptitle(",  ".join(parts), y=0.99, fontsize=15)
    rows = (("ratio_squared", r"$(\Delta R/g)^2$", BLUE), ("participation_ratio", "$n/N$", PURPLE))
    for (key, label, colour), row in zip(rows, panels):
        draw_strip(row[0], row[1] if columns == 2 else None, numbers, np.array([path[key] for _, path in reached]), label, colour)
    panels[1, 0].set_xlabel("path")
    if columns == 2:
        panels[1, 1].set_xlabel("count")
    figure.align_ylabels(panels[:, 0])
    save(figure, folder / "paths.png")
