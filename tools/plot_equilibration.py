"""The figure of how end points were made, for tools/plot.py: equilibration.png."""

import numpy as np
from matplotlib.ticker import MaxNLocator
from matplotlib.transforms import blended_transform_factory

from plot_style import BLUE, GREEN, GREY, PAIR_STYLES, VERMILLION, draw_series, plt, read_table, save, species_name, system_parts

FREE_PHASES = ("settling", "towards the far end point", "between pairs")
SHORT_PHASE = {"temperature check": "T check", "towards the far end point": "pairs", "between pairs": "pairs"}
SOFT_COLUMNS = ("time", "temperature", "potential_energy_per_particle", "energy_per_particle", "phase")


def read_equilibration(folder):
    """The trace of the run that made the end points, and its radial distribution functions. None if there is no trace."""
    file = folder / "endpoints-trace.csv"
    if not file.exists():
        return None
    trace = read_table(file, ["time", "phase"])
    if "compressibility" not in trace:
        trace = read_table(file, SOFT_COLUMNS)
    return trace, read_table(folder / "radial-distribution.csv", ["r"])


def phase_spans(trace):
    """(name, begin, end) of each phase in time. Neighbours with the same short name are merged."""
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
    """A grey background behind every second phase."""
    for k, (_, begin, finish) in enumerate(spans):
        if k % 2 == 0 and begin < end:
            axes.axvspan(begin, min(finish, end), color="#E8E8E8", linewidth=0, zorder=0)


def label_phases(axes, spans, end):
    """Phase names above the panel. A name that overlaps another moves up a line."""
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


def mark_phases(upper, lower, spans, end):
    """The background of both panels by phase, up to `end`, and the names of the phases above the upper one."""
    upper.set_xlim(0.0, end)
    for axes in (upper, lower):
        shade_phases(axes, spans, end)
    label_phases(upper, spans, end)


def draw_by_phase(axes, time, values, spans, colour, label=None):
    """The series with a running mean that stops at each change of phase."""
    for _, begin, finish in spans:
        inside = (time >= begin) & ((time < finish) | (finish == spans[-1][2]))
        if inside.any():
            windows = max(1, int(50 * np.count_nonzero(inside) / len(time)))
            draw_series(axes, time[inside], values[inside], colour, np.nanmean, label, windows)
            label = None


def draw_equilibration_series(upper, lower, trace, temperature):
    """Temperature and potential energy until shortly after the first pair begins."""
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
    mark_phases(upper, lower, spans, end)


def in_powers(value):
    """A number as mantissa and power of ten, in TeX."""
    mantissa, exponent = f"{value:.1e}".split("e")
    return rf"{mantissa}\times 10^{{{int(exponent)}}}"


def draw_drift(axes, trace):
    """Energy per particle without thermostat. Its scatter and slope show how well the time step conserves it."""
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


def pair_label(column, model):
    """g_Ni_P as the TeX symbol of that pair of species."""
    species = [species_name(name, model) for name in column.split("_")[1:]]
    return "$g_{\\mathrm{" + "".join(species) + "}}$"


def draw_radial_distribution(axes, table, model):
    """g(r) of all pairs of species."""
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


def series_panels(figure, place):
    """Two panels, one above the other, with one time axis."""
    series = place.subgridspec(2, 1, hspace=0.1)
    upper = figure.add_subplot(series[0])
    lower = figure.add_subplot(series[1], sharex=upper)
    upper.tick_params(labelbottom=False)
    return upper, lower


def draw_hard_spheres(folder, trace, radial, result, particles):
    """Compressibility and collision rate between resynchronisations, and radial distribution functions in equilibrium."""
    figure = plt.figure(figsize=(11.0, 9.0))
    grid = figure.add_gridspec(2, 1, height_ratios=[1.3, 1], hspace=0.3)
    upper, lower = series_panels(figure, grid[0])
    spans, end = phase_spans(trace), trace["time"][-1]
    draw_by_phase(upper, trace["time"], trace["compressibility"], spans, VERMILLION)
    draw_by_phase(lower, trace["time"], trace["collision_rate"], spans, BLUE)
    upper.set_ylabel(r"$Z=PV/Nk_\mathrm{B}T$")
    lower.set_ylabel("collision rate")
    lower.set_xlabel(r"time $t\;\;[\sigma\sqrt{m/k_\mathrm{B}T}\,]$")
    mark_phases(upper, lower, spans, end)
    draw_radial_distribution(figure.add_subplot(grid[1]), radial, result.get("model"))
    figure.suptitle(",  ".join([*system_parts(result, None, particles), "equilibration"]), y=0.96, fontsize=15)
    save(figure, folder / "equilibration.png")


def draw_soft_particles(folder, trace, radial, result, temperature, particles):
    """Temperature, potential energy, energy drift and radial distribution functions."""
    figure = plt.figure(figsize=(11.0, 11.0))
    grid = figure.add_gridspec(2, 1, height_ratios=[1.75, 1], hspace=0.3)
    below = grid[1].subgridspec(1, 2, wspace=0.28)
    upper, lower = series_panels(figure, grid[0])
    draw_equilibration_series(upper, lower, trace, temperature)
    drift = figure.add_subplot(below[0])
    draw_drift(drift, trace)
    draw_radial_distribution(figure.add_subplot(below[1]), radial, result.get("model"))
    figure.align_ylabels([upper, lower, drift])
    figure.suptitle(",  ".join([*system_parts(result, temperature, particles), "equilibration"]), y=0.945, fontsize=15)
    save(figure, folder / "equilibration.png")


def draw_equilibration(folder, trace, radial, result, temperature, particles):
    """The figure of the traced model. Nothing is drawn for a trace without rows."""
    if len(trace["time"]) == 0:
        return
    if "compressibility" in trace:
        draw_hard_spheres(folder, trace, radial, result, particles)
    else:
        draw_soft_particles(folder, trace, radial, result, temperature, particles)
