#!/usr/bin/python3
"""Draw the figures of a run's folder: tools/plot.py DIR

Reads from DIR what `lanescape path`, `lanescape endpoints`, `lanescape diffusion`, `lanescape insert` and `lanescape slab`
write there:
  result.json               outcome, length, landscape energy, ... of each path (required)
  run.toml                  the target temperature; of insertion also the model and the number of particles (optional)
  path-0001-trace.csv ...   one per path in result.json
  path-0001.extxyz ...      only the first line, the number of particles (optional)
  path-0001-steps.csv, path-0001-particles.csv     histograms over steps, path lengths of particles (optional)
  endpoints-trace.csv, radial-distribution.csv     where end points were made
  diffusion.csv             correlations and displacements
  densification.csv         growth at constant energy
  profiles.csv              density and states of a slab
  scan.csv, holes.csv, errors.csv     cost of insertion, sizes of holes, how errors shrink

Writes into DIR:
  path-0001.png ...   energy, distance to the goal, share of direct steps and participation ratio along the path
  paths.png           (DeltaR/g)^2 and n/N of all paths with mean and standard error, from two paths that reached their goal on
  statistics.png      distributions over the steps of all paths, and how unequally particles share the way
  diffusion.png       velocity correlation, its integral and the mean squared displacement
  equilibration.png   temperature, potential energy, energy drift and radial distribution functions; of hard spheres
                      compressibility and collision rate
  densification.png   energy, pressure, temperature and excess energy against density; of the Lennard-Jones model with long-range
                      corrections three equations of state from the first row's density and temperature on, at their constant energy
  profiles.png        density and mean state probabilities along a slab
  insertion-cost.png       evaluations by method and tolerance against density, and against temperature where a density has several
                           (the three highest such densities)
  insertion-distance.png   mean and largest distance between start and place against density
  insertion-step.png       evaluations against the largest step, from three of them on
  insertion-holes.png      radii, anisotropy and eccentricity of regions of low energy against density
  insertion-errors.png     error at one evaluation and at the next
Of several temperatures at a density those figures, save for the panels against temperature and insertion-errors.png, show the one with
most densities; of several largest steps, save in insertion-step.png, the default or else the first.

Exit status 0, or 2 with one line on stderr when something is missing or cannot be read; then nothing is drawn.
Lengths are in sigma, energies in epsilon, temperatures in epsilon/k_B.
"""

import csv
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullLocator
from matplotlib.transforms import blended_transform_factory

import plot_insertion
import plot_slab
from plot_style import (BLUE, GREEN, GREY, PAIR_STYLES, PURPLE, VERMILLION, Unusable, legend_above, letter, read_result, read_run_file,
                        read_table, read_text, save, system_parts)

FREE_PHASES = ("settling", "towards the far end point", "between pairs")
SHORT_PHASE = {"temperature check": "T check", "towards the far end point": "pairs", "between pairs": "pairs"}
HISTOGRAM_FROM = 10  # paths


# ---- reading

def read_path(folder, number, summary):
    """The summary of a path in result.json with its trace and number of particles (None where unknown)."""
    name = f"path-{number:04}"
    trace = read_table(folder / f"{name}-trace.csv",
                       ["length", "distance_to_goal", "direct_fraction", "participation_ratio"])
    hard = "moved_particles" in trace
    if not hard and "energy" not in trace:
        raise Unusable(f"{folder / (name + '-trace.csv')}: no column energy")
    for key in ("length", "distance") + (() if hard else ("landscape_energy",)):
        if not isinstance(summary.get(key), (int, float)):
            raise Unusable(f"{folder / 'result.json'}: {key} of path {number} is not a number")
    particles = None
    if (folder / f"{name}.extxyz").exists():
        with open(folder / f"{name}.extxyz") as file:
            first = file.readline().strip()
        particles = int(first) if first.isdigit() else None
    return {**summary, "name": name, "trace": trace, "particles": particles, "hard": hard}


# ---- series

def running(values, statistic, windows=50):
    """A statistic over a sliding window of 1/windows of the series, cut short at both ends."""
    half = max(0, len(values) // (2 * windows))
    padded = np.pad(np.asarray(values, float), half, constant_values=np.nan)
    return statistic(np.lib.stride_tricks.sliding_window_view(padded, 2 * half + 1), axis=1)


def binned_mean(x, y, end, bins=70):
    """Means of y in equal bins of x over [0, end] (0 where a bin is empty) and the bins' edges."""
    edges = np.linspace(0.0, end, min(bins, max(1, len(x))) + 1)
    count = np.histogram(x, edges)[0]
    return np.histogram(x, edges, weights=y)[0] / np.maximum(count, 1), edges


def draw_series(axes, x, y, colour, statistic=np.nanmedian, label=None, windows=50):
    """The raw series as a light line and its running statistic; single points get a marker."""
    marker = "o" if len(x) < 3 else None
    axes.plot(x, y, color=colour, alpha=0.3, linewidth=0.8)
    axes.plot(x, running(y, statistic, windows), color=colour, marker=marker, label=label)


def species_name(symbol, model):
    """A species as its model's literature names it."""
    return {"kob-andersen": {"Ni": "A", "P": "B"}}.get(model, {}).get(symbol, symbol)


# ---- one path

def path_title(path, result, temperature):
    first = system_parts(result, temperature, path["particles"])
    first.append(f"{path_method(path)} method" + (", from $R_f$ to $R_i$" if path.get("reversed") else ""))
    second = [rf"$\Delta R={path['distance']:.1f}\,\sigma$", rf"$g={path['length']:.4g}\,\sigma$"]
    if path.get("ratio_squared") is not None:
        second.append(rf"$(\Delta R/g)^2={path['ratio_squared']:.4g}$")
    else:
        second.append(path.get("outcome", "ended").replace("_", " ") + " before the goal")
    return ",  ".join(first) + "\n" + ",  ".join(second)


def path_method(path):
    return next((kind for kind in path.get("steps", {}) if kind != "direct"), "direct")


def draw_gap(axes, path, temperature):
    """How far below the landscape energy the path runs; the little that a tolerance lets pass above it in another colour."""
    gap = path["landscape_energy"] - path["trace"]["energy"]
    x, size = path["trace"]["length"], np.where(gap == 0.0, np.nan, np.abs(gap))
    above = np.count_nonzero(gap < 0.0) > len(gap) / 2
    colour, label = (VERMILLION, "$V>E_L$") if above else (BLUE, "$V<E_L$")
    if np.isfinite(size).any():
        draw_series(axes, x, size, colour, label=label)
        axes.set_yscale("log")
        axes.yaxis.set_major_locator(LogLocator(numticks=6))
        axes.yaxis.set_minor_locator(NullLocator())
    if temperature:
        axes.axhline(temperature, color=GREY, linestyle=":", label=r"$k_\mathrm{B}T$")
    axes.set_ylabel(r"$|E_L-V|\;\;[\epsilon]$" if above else r"$E_L-V\;\;[\epsilon]$")
    letter(axes, f"(a) gap to landscape energy $E_L=${path['landscape_energy']:.2f}".replace("-", "\u2212"))
    legend_above(axes)


def draw_moved(axes, path):
    """How many particles a step moves: all of them in a direct one."""
    count = path["particles"] or path["trace"]["moved_particles"].max()
    draw_series(axes, path["trace"]["length"], path["trace"]["moved_particles"] / count, BLUE, label="running median")
    axes.set_ylim(0.0, 1.05)
    axes.set_ylabel("$c/N$")
    letter(axes, "(a) particles moved by a step")
    legend_above(axes)


def draw_distance(axes, path):
    trace, straight = path["trace"], path["distance"]
    axes.plot(trace["length"], trace["distance_to_goal"], color=BLUE, marker="o" if len(trace["length"]) < 3 else None, label="path")
    axes.plot([0.0, straight], [straight, 0.0], color=GREY, linestyle="--", label=r"straight line, $\Delta R-\ell$")
    axes.set_ylim(0.0, 1.05 * straight)
    axes.set_ylabel(r"$|R_f-R|\;\;[\sigma]$" if not path.get("reversed") else r"$|R_i-R|\;\;[\sigma]$")
    letter(axes, "(b) distance to the goal")
    legend_above(axes)


def draw_step_kinds(axes, path, end):
    share, edges = binned_mean(path["trace"]["length"], path["trace"]["direct_fraction"], end)
    counts = ", ".join(f"{count:,} {kind}".replace(",", "\u2009") for kind, count in path.get("steps", {}).items())
    letter(axes, f"(c) share of direct steps  ({counts})")
    if share.max() > 0.0:
        floor = 10.0 ** np.floor(np.log10(share[share > 0.0].min()) - 0.01)
        axes.stairs(np.maximum(share, floor), edges, baseline=floor, fill=True, color=GREEN)
        axes.set_yscale("log")
        axes.set_ylim(floor, 1.3)
        axes.yaxis.set_major_locator(LogLocator(numticks=4))
        axes.yaxis.set_minor_locator(NullLocator())
    else:
        axes.set_ylim(0.0, 1.0)
        axes.text(0.5, 0.45, "no direct steps recorded", transform=axes.transAxes, ha="center", color=GREY)
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{100.0 * value:g} %"))
    axes.set_ylabel("direct")


def draw_participation(axes, path):
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


# ---- all paths

def draw_strip(axes, histogram, numbers, values, label, colour):
    """Values by path number, their mean and its standard error; a histogram where there are panels for it."""
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


# ---- statistics over steps

STEP_PANELS = (  # quantity, label, whether the label is per particle
    ("participation_ratio", "$n/N$", False),
    ("alpha_2", r"$\alpha_2$", False),
    ("overlapping_partners", "overlapping partners $v$", False),
    ("moved_particles", "$c/N$", True),
    ("groups", "$m/N$", True),
)
GROUP_SIZES = (("group_size_few_groups", "few"), ("group_size_some_groups", "some"), ("group_size_many_groups", "many"))


def read_histograms(folder, paths):
    """Steps by quantity and value, all paths together."""
    sums = {}
    for path in paths:
        file = folder / f"{path['name']}-steps.csv"
        if not file.exists():
            return {}
        for row in csv.DictReader(read_text(file).splitlines()):
            by_value = sums.setdefault(row["quantity"], {})
            by_value[float(row["value"])] = by_value.get(float(row["value"]), 0) + int(row["steps"])
    return {quantity: (np.array(sorted(v)), np.array([v[x] for x in sorted(v)], float)) for quantity, v in sums.items()}


def read_particle_ratios(folder, paths):
    """log10 of g_j / DeltaR_j by species, all paths together."""
    ratios = {}
    for path in paths:
        file = folder / f"{path['name']}-particles.csv"
        if not file.exists():
            return {}
        for row in csv.DictReader(read_text(file).splitlines()):
            if float(row["displacement"]) > 0.0 and float(row["path_length"]) > 0.0:
                ratios.setdefault(row["species"], []).append(np.log10(float(row["path_length"]) / float(row["displacement"])))
    return ratios


def draw_histogram(axes, values, counts, scale, label, colour, name=None):
    share = counts / counts.sum()
    mean = (values * share).sum() * scale
    axes.plot(values * scale, share, color=colour, marker="o", markersize=3, linewidth=1.2, label=f"{name or 'mean'} {mean:.3g}")
    axes.set_yscale("log")
    axes.set_xlabel(label)
    legend_above(axes, handle=0.9, gap=0.7)


def draw_statistics(folder, paths, result, temperature):
    histograms, ratios = read_histograms(folder, paths), read_particle_ratios(folder, paths)
    if not histograms or not ratios:
        return
    shown = [panel for panel in STEP_PANELS if panel[0] in histograms and histograms[panel[0]][1].sum() > 0]
    sizes = [(quantity, name) for quantity, name in GROUP_SIZES if quantity in histograms and histograms[quantity][1].sum() > 0]
    count = len(shown) + bool(sizes) + 1
    rows = -(-count // 3)
    figure, panels = plt.subplots(rows, 3, figsize=(13.0, 4.0 * rows), squeeze=False, gridspec_kw={"hspace": 0.35, "wspace": 0.28})
    flat = list(panels.flat)
    for (quantity, label, per_particle), axes in zip(shown, flat):
        values, counts = histograms[quantity]
        draw_histogram(axes, values, counts, 1.0 / (paths[0]["particles"] or 1) if per_particle else 1.0, label, BLUE)
    used = len(shown)
    if sizes:
        for (quantity, name), (colour, _) in zip(sizes, PAIR_STYLES):
            draw_histogram(flat[used], *histograms[quantity], 1.0, "group size $s$", colour, name)
        used += 1
    for (species, values), (colour, _) in zip(ratios.items(), PAIR_STYLES):
        values = np.array(values)
        bins = np.arange(np.floor(values.min() / 0.05) * 0.05, values.max() + 0.05, 0.05)
        flat[used].hist(values, bins=bins, density=True, histtype="step", linewidth=2.0, color=colour,
                        label=f"{species_name(species, result.get('model'))} {values.std():.3f}")
    flat[used].set_xlabel(r"$\log_{10}(g_j/\Delta R_j)$, and its width")
    legend_above(flat[used])
    for axes in flat[used + 1:]:
        axes.set_visible(False)
    for row in panels:
        row[0].set_ylabel("share of steps")
    flat[used].set_ylabel("density")
    parts = [*system_parts(result, temperature, paths[0]["particles"]), f"{path_method(paths[0])} method", f"{len(paths)} path{'s' * (len(paths) > 1)}"]
    figure.suptitle(",  ".join(parts), y=0.95 if rows > 1 else 1.0, fontsize=15)
    save(figure, folder / "statistics.png")


# ---- diffusion

def draw_diffusion(folder, table, result, temperature):
    names = [name.removeprefix("velocity_correlation_") for name in table if name.startswith("velocity_correlation_")]
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(15.0, 4.8), gridspec_kw={"wspace": 0.3})
    time = table["time"]
    for name, (colour, style) in zip(names, PAIR_STYLES):
        correlation = table[f"velocity_correlation_{name}"]
        left.plot(time, correlation / correlation[0], color=colour, linestyle=style, label=name)
        middle.plot(time, table[f"diffusion_integral_{name}"], color=colour, linestyle=style, label=f"{name}, integral")
        right.plot(time[1:], table[f"squared_displacement_{name}"][1:], color=colour, linestyle=style, label=name)
        species = result.get("species", {}).get(name, {})
        if "diffusion_msd" in species:
            middle.axhline(species["diffusion_msd"], color=colour, linewidth=1.0, alpha=0.6,
                           label=rf"$\langle r^2\rangle$: {species['diffusion_msd']:.4g}")
    left.axhline(0.0, color=GREY, linewidth=1.0)
    left.set_ylabel(r"$\langle v(t)\cdot v(0)\rangle/\langle v^2\rangle$")
    middle.set_ylabel("$D(t)$")
    right.set_ylabel(r"$\langle|\Delta r|^2\rangle\;\;[\sigma^2]$")
    right.set_xscale("log")
    right.set_yscale("log")
    for axes in (left, middle, right):
        axes.set_xlabel("$t$")
        axes.legend()
    figure.suptitle(",  ".join([*system_parts(result, temperature, result.get("particles")), "diffusion"]), fontsize=15)
    save(figure, folder / "diffusion.png")


# ---- equilibration

def phase_spans(trace):
    """(name, begin, end) of each phase in time, neighbours of one short name merged."""
    names = [SHORT_PHASE.get(name, name) for name in trace["phase"]]
    spans = []
    for name, time in zip(names, trace["time"]):
        if spans and spans[-1][0] == name:
            spans[-1][2] = time
        else:
            if spans:
                spans[-1][2] = time
            spans.append([name, time, time])
    return spans


def shade_phases(axes, spans, end):
    for k, (_, begin, finish) in enumerate(spans):
        if k % 2 == 0 and begin < end:
            axes.axvspan(begin, min(finish, end), color="#E8E8E8", linewidth=0, zorder=0)


def label_phases(axes, spans, end):
    """Phase names above the panel; a name too wide for its place moves up a line."""
    renderer = axes.figure.canvas.get_renderer()
    right, place = [], blended_transform_factory(axes.transData, axes.transAxes)
    for name, begin, finish in spans:
        if begin >= end:
            continue
        text = axes.text((begin + min(finish, end)) / 2.0, 1.02, name, transform=place, ha="center", va="bottom", fontsize=12, color=GREY)
        box = text.get_window_extent(renderer)
        level = next((k for k, edge in enumerate(right) if box.x0 > edge + 6.0), len(right))
        right[level:level + 1] = [box.x1]
        text.set_y(1.02 + level * 1.15 * box.height / axes.bbox.height)


def draw_by_phase(axes, time, values, spans, colour, label=None):
    """The series with a running mean that does not reach across a change of phase."""
    for _, begin, finish in spans:
        inside = (time >= begin) & ((time < finish) | (finish == spans[-1][2]))
        if inside.any():
            windows = max(1, int(50 * np.count_nonzero(inside) / len(time)))
            draw_series(axes, time[inside], values[inside], colour, np.nanmean, label, windows)
            label = None


def draw_equilibration_series(upper, lower, trace, temperature):
    """Temperature and potential energy until a while after the first pair was begun."""
    spans = phase_spans(trace)
    pairs_begin = next((begin for name, begin, _ in spans if name == "pairs"), np.inf)
    end = min(max(trace["time"][-1], 1e-9), 1.2 * pairs_begin)
    shown = trace["time"] <= end
    time, measured = trace["time"][shown], np.isin(trace["phase"], FREE_PHASES)
    mean = rf", $\langle T\rangle={trace['temperature'][measured].mean():.3f}$ once settling" if measured.any() else ""
    draw_by_phase(upper, time, trace["temperature"][shown], spans, VERMILLION, "running mean" + mean)
    if temperature is not None:
        melted = max([0.0] + [finish for name, _, finish in spans if name == "melting" and finish < end])
        upper.plot([melted, end], [temperature, temperature], color="black", linestyle="--", linewidth=1.5,
                   label=f"target $T={temperature:g}$")
    upper.set_ylabel(r"$T\;\;[\epsilon/k_\mathrm{B}]$")
    low, high = upper.get_ylim()
    upper.set_ylim(low, high + 0.25 * (high - low))
    upper.legend(loc="upper right", ncol=2, columnspacing=1.4)
    draw_by_phase(lower, time, trace["potential_energy_per_particle"][shown], spans, BLUE)
    lower.set_ylabel(r"$V/N\;\;[\epsilon]$")
    lower.set_xlabel(r"time $t\;\;[\sigma\sqrt{m/\epsilon}\,]$")
    upper.set_xlim(0.0, end)
    for axes in (upper, lower):
        shade_phases(axes, spans, end)
    label_phases(upper, spans, end)


def draw_drift(axes, trace):
    """Energy per particle without thermostat: its scatter and slope say how well the time step conserves it."""
    free = np.isin(trace["phase"], FREE_PHASES)
    axes.set_title("energy without thermostat", loc="left", fontsize=13)
    axes.set_xlabel(r"time $t\;\;[\sigma\sqrt{m/\epsilon}\,]$")
    axes.set_ylabel(r"$(E-\langle E\rangle)/N\;\;[10^{-4}\,\epsilon]$")
    if not free.any():
        axes.text(0.5, 0.5, "not reached", transform=axes.transAxes, ha="center", color=GREY)
        return
    time, energy = trace["time"][free], trace["energy_per_particle"][free]
    deviation = 1e4 * (energy - energy.mean())
    draw_series(axes, time, deviation, GREEN, np.nanmean)
    span = max(np.abs(deviation).max(), 0.1)
    axes.set_ylim(-1.2 * span, 1.9 * span)
    axes.xaxis.set_major_locator(MaxNLocator(nbins=5))
    if len(time) > 2:
        drift = np.polyfit(time - time[0], energy, 1)[0] * (time[-1] - time[0])
        scatter = trace["potential_energy_per_particle"][free].std()
        axes.text(0.98, 0.97, f"drift over the run ${in_powers(drift)}\\,\\epsilon$\nrms of $V/N$ is ${in_powers(scatter)}\\,\\epsilon$",
                  transform=axes.transAxes, ha="right", va="top", fontsize=12)


def in_powers(value):
    mantissa, exponent = f"{value:.1e}".split("e")
    return rf"{mantissa}\times 10^{{{int(exponent)}}}"


def pair_label(column, model):
    species = [species_name(name, model) for name in column.split("_")[1:]]
    return "$g_{\\mathrm{" + "".join(species) + "}}$"


def draw_radial_distribution(axes, table, model):
    pairs = [name for name in table if name.startswith("g_")]
    for k, name in enumerate(pairs):
        colour, style = PAIR_STYLES[k % len(PAIR_STYLES)]
        axes.plot(table["r"], table[name], color=colour, linestyle=style, label=pair_label(name, model))
    axes.axhline(1.0, color=GREY, linewidth=1.0, zorder=0)
    axes.set_title("radial distribution functions", loc="left", fontsize=13)
    axes.set_xlabel(r"$r\;\;[\sigma]$")
    axes.set_ylabel(r"$g_{\alpha\beta}(r)$")
    axes.set_ylim(bottom=0.0)
    if len(table["r"]):
        axes.set_xlim(0.0, table["r"][-1])
    axes.legend(loc="upper right")


def draw_hard_equilibration(folder, trace, radial, result, particles):
    """Compressibility and collision rate between resynchronisations, and the radial distribution functions since equilibrium."""
    figure = plt.figure(figsize=(11.0, 9.0))
    grid = figure.add_gridspec(2, 1, height_ratios=[1.3, 1], hspace=0.3)
    series = grid[0].subgridspec(2, 1, hspace=0.1)
    upper = figure.add_subplot(series[0])
    lower = figure.add_subplot(series[1], sharex=upper)
    upper.tick_params(labelbottom=False)
    spans, end = phase_spans(trace), trace["time"][-1]
    draw_by_phase(upper, trace["time"], trace["compressibility"], spans, VERMILLION)
    draw_by_phase(lower, trace["time"], trace["collision_rate"], spans, BLUE)
    upper.set_ylabel(r"$Z=PV/Nk_\mathrm{B}T$")
    lower.set_ylabel("collision rate")
    lower.set_xlabel(r"time $t\;\;[\sigma\sqrt{m/k_\mathrm{B}T}\,]$")
    upper.set_xlim(0.0, end)
    for axes in (upper, lower):
        shade_phases(axes, spans, end)
    label_phases(upper, spans, end)
    draw_radial_distribution(figure.add_subplot(grid[1]), radial, result.get("model"))
    figure.suptitle(",  ".join([*system_parts(result, None, particles), "equilibration"]), y=0.96, fontsize=15)
    save(figure, folder / "equilibration.png")


def draw_equilibration(folder, trace, radial, result, temperature, particles):
    figure = plt.figure(figsize=(11.0, 11.0))
    grid = figure.add_gridspec(2, 1, height_ratios=[1.75, 1], hspace=0.3)
    series = grid[0].subgridspec(2, 1, hspace=0.1)
    below = grid[1].subgridspec(1, 2, wspace=0.28)
    upper = figure.add_subplot(series[0])
    lower = figure.add_subplot(series[1], sharex=upper)
    upper.tick_params(labelbottom=False)
    draw_equilibration_series(upper, lower, trace, temperature)
    drift = figure.add_subplot(below[0])
    draw_drift(drift, trace)
    draw_radial_distribution(figure.add_subplot(below[1]), radial, result.get("model"))
    figure.align_ylabels([upper, lower, drift])
    figure.suptitle(",  ".join([*system_parts(result, temperature, particles), "equilibration"]), y=0.945, fontsize=15)
    save(figure, folder / "equilibration.png")


# ---- program

def target_temperature(run):
    value = run.get("temperature")
    return float(value) if isinstance(value, (int, float)) else None


def draw_folder(folder):
    """Read everything, then draw: a folder that lacks a file gets no figure."""
    result, run = read_result(folder), read_run_file(folder)
    paths = [read_path(folder, number, summary) for number, summary in enumerate(result.get("paths", []), 1)]
    equilibration = None
    if (folder / "endpoints-trace.csv").exists():
        trace = read_table(folder / "endpoints-trace.csv", ["time", "phase"])
        if "compressibility" not in trace:
            trace = read_table(folder / "endpoints-trace.csv",
                               ["time", "temperature", "potential_energy_per_particle", "energy_per_particle", "phase"])
        equilibration = trace, read_table(folder / "radial-distribution.csv", ["r"])
    diffusion = read_table(folder / "diffusion.csv", ["time"]) if (folder / "diffusion.csv").exists() else None
    insertion = plot_insertion.read_insertion(folder)
    slab = read_table(folder / "profiles.csv", ["z", "density", "sites"]) if (folder / "profiles.csv").exists() else None
    if not paths and equilibration is None and diffusion is None and slab is None and not insertion:
        raise Unusable(
            f"{folder}: neither paths in result.json nor a table of end points, diffusion, insertion or a slab: nothing to draw")
    made = {**result, "model": result.get("model") or run.get("model", "")}
    temperature = target_temperature(run)
    for path in paths:
        draw_path(folder, path, made, temperature)
    draw_paths(folder, paths, made, temperature)
    if paths:
        draw_statistics(folder, paths, made, temperature)
    if diffusion is not None:
        draw_diffusion(folder, diffusion, made, temperature)
    plot_insertion.draw_insertion(folder, insertion, made, run)
    if slab is not None:
        plot_slab.draw_slab(folder, slab)
    if equilibration is not None and "compressibility" in equilibration[0]:
        if len(equilibration[0]["time"]) > 0:
            draw_hard_equilibration(folder, *equilibration, made, paths[0]["particles"] if paths else None)
    elif equilibration is not None and len(equilibration[0]["time"]) > 0:
        draw_equilibration(folder, *equilibration, made, temperature, paths[0]["particles"] if paths else None)


def main(arguments):
    if len(arguments) != 1 or arguments[0].startswith("-"):
        wanted_help = arguments in (["-h"], ["--help"])
        text = __doc__ if wanted_help else "plot.py: needs one argument, the folder of a run"
        print(text, file=sys.stdout if wanted_help else sys.stderr)
        return 0 if wanted_help else 2
    try:
        draw_folder(Path(arguments[0]))
    except Unusable as error:
        print(f"plot.py: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
