"""Figures of `lanescape insert --scan` and `lanescape insert --densify` for tools/plot.py, which lists them."""

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

import plot_insertion_map
from plot_densification import draw_densification
from plot_style import (BLUE, DENSITY, GREEN, GREY, PAIR_STYLES, PURPLE, SKY_BLUE, VERMILLION, decade_ticks, legend_beside, letter,
                        logarithmic, plt, read_table, save, shades, system_parts, title)
from unusable import Unusable

COLUMNS = {
    "densification": ("density", "temperature", "pressure", "excess_energy", "energy"),
    "scan": ("density", "temperature", "method", "tolerance", "largest_step", "evaluations", "evaluations_error", "distance",
             "largest_distance"),
    "holes": ("density", "temperature", "iso_energy", "holes", "mean_radius", "semi_minor", "semi_major", "anisotropy", "eccentricity"),
    "errors": ("density", "error", "next_error"),
    "map": plot_insertion_map.COLUMNS,
}
TEXT = ("method", "largest_step")  # largest_step may be "default"
METHOD_COLOURS = {"usher": BLUE, "usher-indirect": SKY_BLUE, "usher-near": PURPLE, "screened": GREEN, "descent": VERMILLION}
LINES, MARKERS = ("-", "--", "-.", ":", (0, (1, 3))), ("o", "s", "^", "D", "v", "P", "X")
EVALUATIONS = "evaluations $n_f$"
LOG_FROM = 20.0  # largest over smallest value: above it the axis is logarithmic
LARGEST_STEPS_FROM = 3  # fewer largest steps get no figure
TEMPERATURE_PANELS = 3  # at most
# Column of holes.csv, name, marker and line.
HOLE_SIZES = (("mean_radius", "mean radius", "o", "-"), ("semi_minor", "semi-minor axis", "v", "--"),
              ("semi_major", "semi-major axis", "^", ":"))


def read_insertion(folder):
    """The tables that the folder has, by name. Values that are not finite are nan."""
    tables = {}
    for name, columns in COLUMNS.items():
        file = folder / f"{name}.csv"
        if not file.exists():
            continue
        table = read_table(file, columns, TEXT)
        for key in ("density", "temperature"):
            values = table.get(key, np.ones(0))
            if not (np.isfinite(values) & (values > 0.0)).all():
                raise Unusable(f"{file}: {key} must be above 0")
        tables[name] = {key: values if key in TEXT else np.where(np.isfinite(values), values, np.nan) for key, values in table.items()}
        for step in tables[name].get("largest_step", ()):
            step_size(step, 1.0, file)
    if "map" in tables:
        tables["map"] = plot_insertion_map.read_maps(tables["map"], folder / "map.csv")
    return tables


def step_size(text, density, file="largest step"):
    """The largest step [sigma] that a word of the table stands for; the default depends on the density."""
    try:
        step = 0.1 * density**-1.5 if text == "default" else float(text)
    except ValueError:
        step = np.nan
    if not 0.0 < step < np.inf:
        raise Unusable(f"{file}: {text}: largest_step must be above 0, or default")
    return step


def rows_where(table, chosen):
    """The rows that a mask or an array of indices selects."""
    return {name: values[chosen] for name, values in table.items()}


def spread(axis, values):
    """A logarithmic axis if the values span more than a factor LOG_FROM; otherwise a linear one from 0."""
    values = np.concatenate([np.ravel(v) for v in values])
    values = values[values > 0.0]
    if len(values) and values.max() > LOG_FROM * values.min():
        logarithmic(axis, values.max() / values.min() < 1e3)
        return
    axis.axes.set_ylim(bottom=0.0)


def few_ticks(axis):
    axis.set_major_locator(MaxNLocator(nbins=6, steps=[1, 2, 5, 10]))


def above_zero(values):
    """The values, with nan where a logarithmic axis has no place for them."""
    return np.where(values > 0.0, values, np.nan)


def common(label, values):
    """A part of a title: the value that all rows share; empty if they differ."""
    return [f"${label}={values[0]:g}$"] if len(set(values)) == 1 else []


def one_per_density(table):
    """A mask that keeps one temperature at each density: the one that occurs at most densities."""
    densities, of = {}, {}
    for density, temperature in zip(table["density"], table["temperature"]):
        densities.setdefault(temperature, set()).add(density)
        of.setdefault(density, []).append(temperature)
    chosen = {density: max(temperatures, key=lambda t: len(densities[t])) for density, temperatures in of.items()}
    return np.array([chosen[d] == t for d, t in zip(table["density"], table["temperature"])], bool)


def with_one_step(table):
    """The rows with the default largest step, or else with the first one in the table; and a part of a title that names it."""
    steps = table["largest_step"]
    step = "default" if "default" in steps else steps[0]
    return rows_where(table, steps == step), [] if step == "default" else [rf"$\Delta s_\mathrm{{max}}={float(step):g}\,\sigma$"]


class Combinations:
    """The methods and tolerances of a scan: colours by method, lines and markers by tolerance."""

    def __init__(self, table):
        self.methods, self.tolerances = list(dict.fromkeys(table["method"])), sorted(set(table["tolerance"]), reverse=True)

    def style(self, method, tolerance):
        k = self.tolerances.index(tolerance)
        return {"color": METHOD_COLOURS.get(method, GREY), "linestyle": LINES[k % len(LINES)], "marker": MARKERS[k % len(MARKERS)],
                "markersize": 6}

    def title(self):
        return [f"tolerance {self.tolerances[0]:g}"] if len(self.tolerances) == 1 else []

    def handles(self, methods=True):
        handles = [Line2D([], [], color=METHOD_COLOURS.get(method, GREY), marker=None if len(self.tolerances) > 1 else "o", label=method)
                   for method in (self.methods if methods else ())]
        if len(self.tolerances) > 1:
            handles += [Line2D([], [], **{**self.style("", tolerance), "color": GREY}, label=f"tolerance {tolerance:g}")
                        for tolerance in self.tolerances]
        return handles

    def lines(self, table, along):
        """(style, rows sorted by the column `along`) of each combination that has rows."""
        for method in self.methods:
            for tolerance in self.tolerances:
                rows = rows_where(table, (table["method"] == method) & (table["tolerance"] == tolerance))
                order = np.argsort(rows[along], kind="stable")
                if len(order):
                    yield self.style(method, tolerance), rows_where(rows, order)


def evaluation_panels(count, hspace, **shared):
    """A figure with `count` panels on one axis of evaluations, at most two side by side."""
    columns = min(2, count)
    rows = -(-count // columns)
    figure, panels = plt.subplots(rows, columns, squeeze=False, sharey=True, figsize=((8.0, 12.0)[columns - 1], 1.0 + 4.5 * rows),
                                  gridspec_kw={"wspace": 0.1, "hspace": hspace}, **shared)
    for axes in list(panels.flat)[count:]:
        axes.set_visible(False)
    for row in panels:
        row[0].set_ylabel(EVALUATIONS)
    return figure, panels


def draw_evaluations(axes, combinations, table, along):
    """Evaluations with their errors against a column, a line for each combination."""
    for style, rows in combinations.lines(table, along):
        axes.errorbar(rows[along], above_zero(rows["evaluations"]), rows["evaluations_error"], capsize=3, **style)
    axes.margins(x=0.08)
    few_ticks(axes.xaxis)


def draw_cost(folder, table, system):
    """Evaluations against density, and against temperature where a density has several, into insertion-cost.png."""
    table, step = with_one_step(table)
    combinations, chosen = Combinations(table), rows_where(table, one_per_density(table))
    several = [density for density in sorted(set(table["density"])) if len(set(table["temperature"][table["density"] == density])) > 1]
    several = several[-TEMPERATURE_PANELS:]
    figure, panels = evaluation_panels(1 + len(several), 0.38)
    flat = list(panels.flat)
    draw_evaluations(flat[0], combinations, chosen, "density")
    flat[0].set_xlabel(DENSITY)
    if several:
        letter(flat[0], ",  ".join(["(a) against density", *common("T", chosen["temperature"])]))
    for axes, name, density in zip(flat[1:], "bcd", several):
        draw_evaluations(axes, combinations, rows_where(table, table["density"] == density), "temperature")
        axes.set_xlabel(r"temperature $T\;\;[\epsilon/k_\mathrm{B}]$")
        letter(axes, rf"({name}) against temperature, $\rho={density:g}$")
    spread(flat[0].yaxis, [table["evaluations"]])
    legend_beside(panels[0, -1], combinations.handles())
    title(figure, [*system, *([] if several else common("T", chosen["temperature"])), *step, *combinations.title()],
          0.42 if several else 0.2)
    save(figure, folder / "insertion-cost.png")


def draw_distances(folder, table, system):
    """Mean and largest distance between the start of a search and its result, into insertion-distance.png."""
    table, step = with_one_step(rows_where(table, one_per_density(table)))
    if not (above_zero(table["distance"]) > 0.0).any():
        return
    combinations = Combinations(table)
    figure, panels = plt.subplots(1, 2, sharey=True, figsize=(12.0, 5.5), gridspec_kw={"wspace": 0.1})
    for axes, key, text in zip(panels, ("distance", "largest_distance"), ("(a) mean", "(b) largest")):
        for style, rows in combinations.lines(table, "density"):
            axes.plot(rows["density"], above_zero(rows[key]), **style)
        axes.set_xlabel(DENSITY)
        axes.margins(x=0.08)
        few_ticks(axes.xaxis)
        letter(axes, text)
    logarithmic(panels[0].yaxis)
    panels[0].set_ylabel(r"distance from start to place $[\sigma]$")
    legend_beside(panels[1], combinations.handles())
    title(figure, [*system, *common("T", table["temperature"]), *step, *combinations.title()])
    save(figure, folder / "insertion-distance.png")


def draw_steps_of_method(axes, combinations, table, states):
    """Evaluations against the largest step, a colour for each state. Circles mark the default step."""
    for colour, (density, temperature) in zip(shades(len(states)), states):
        rows = rows_where(table, (table["density"] == density) & (table["temperature"] == temperature))
        for style, line in combinations.lines(rows, "step"):
            axes.errorbar(line["step"], above_zero(line["evaluations"]), line["evaluations_error"], capsize=3,
                          **{**style, "color": colour, "markersize": 5})
            own = line["largest_step"] == "default"
            axes.plot(line["step"][own], above_zero(line["evaluations"][own]), "o", color=colour, markersize=13, markerfacecolor="none")


def state_handles(table, states):
    """Legend entries of the states' colours, and of the circles if the table has the default step."""
    one_temperature = len({temperature for _, temperature in states}) == 1
    handles = [Line2D([], [], color=colour, label=rf"$\rho={density:g}$" + ("" if one_temperature else f", $T={temperature:g}$"))
               for colour, (density, temperature) in zip(shades(len(states)), states)]
    if "default" in table["largest_step"]:
        handles.append(Line2D([], [], color=GREY, linestyle="", marker="o", markersize=13, markerfacecolor="none",
                              label=r"default, $0.1\,\rho^{-3/2}$"))
    return handles


def draw_steps(folder, table, system):
    """Evaluations against the largest step, a panel for each method, into insertion-step.png."""
    if len(set(table["largest_step"])) < LARGEST_STEPS_FROM:
        return
    table = rows_where(table, one_per_density(table))
    table["step"] = np.array([step_size(step, density) for step, density in zip(table["largest_step"], table["density"])])
    states, combinations = sorted(set(zip(table["density"], table["temperature"]))), Combinations(table)
    count = len(combinations.methods)
    figure, panels = evaluation_panels(count, 0.25, sharex=True)
    for axes, name, method in zip(panels.flat, "abcdefgh", combinations.methods):
        draw_steps_of_method(axes, combinations, rows_where(table, table["method"] == method), states)
        letter(axes, f"({name}) {method}" if count > 1 else method)
    spread(panels[0, 0].yaxis, [table["evaluations"]])
    if table["step"].max() > 5.0 * table["step"].min():
        logarithmic(panels[0, 0].xaxis)
    for k in range(panels.shape[1]):
        last = panels[(count - 1 - k) // panels.shape[1], k]
        last.set_xlabel(r"largest step $\Delta s_\mathrm{max}\;\;[\sigma]$")
        last.tick_params(labelbottom=True)
    legend_beside(panels[0, -1], state_handles(table, states) + combinations.handles(methods=False))
    title(figure, [*system, *common("T", table["temperature"]), *combinations.title()])
    save(figure, folder / "insertion-step.png")


def draw_hole_lines(panels, table, energies, colours):
    """Sizes and shapes of holes against density, a colour for each energy of the surface."""
    (radii, major), (anisotropy, eccentricity) = panels
    for colour, energy in zip(colours, energies):
        rows = rows_where(table, table["iso_energy"] == energy)
        rows = rows_where(rows, np.argsort(rows["density"], kind="stable"))
        for axes, (key, _, marker, style) in zip((radii, radii, major), HOLE_SIZES):
            axes.plot(rows["density"], rows[key], color=colour, marker=marker, linestyle=style)
        for axes, key in ((anisotropy, "anisotropy"), (eccentricity, "eccentricity")):
            axes.plot(rows["density"], rows[key], color=colour, marker="o", linestyle="-")


def draw_best_steps(axes, scan):
    """The step of `descent` with the fewest evaluations at each density, as squares. Returns their legend entry."""
    if scan is None:
        return []
    scan = rows_where(scan, one_per_density(scan) & (scan["method"] == "descent") & np.isfinite(scan["evaluations"]))
    if len(set(scan["largest_step"])) < LARGEST_STEPS_FROM:
        return []
    style = {"color": METHOD_COLOURS["descent"], "linestyle": "", "marker": "s", "markersize": 11, "markerfacecolor": "none"}
    for density in sorted(set(scan["density"])):
        rows = rows_where(scan, scan["density"] == density)
        axes.plot(density, step_size(rows["largest_step"][np.argmin(rows["evaluations"])], density), **style)
    return [Line2D([], [], label="best step of descent", **style)]


def draw_guides(axes, densities):
    """The default largest step and the mean free path for comparison, as wide light lines. Returns their legend entries."""
    low, high = densities.min(), densities.max()
    guide = np.linspace(low, high, 60) if low < high else np.array([0.95, 1.05]) * low
    guides = ((0.1 * guide**-1.5, "black", r"$0.1\,\rho^{-3/2}$"), (0.225 / guide, "#B0A000", r"mean free path, $0.225/\rho$"))
    for values, colour, _ in guides:
        axes.plot(guide, values, color=colour, linewidth=6.0, alpha=0.25, zorder=0, solid_capstyle="butt")
    return [Line2D([], [], color=colour, linewidth=6.0, alpha=0.25, label=text) for _, colour, text in guides]


def label_holes(panels, table):
    """Titles, labels and ranges of the panels."""
    (radii, major), (anisotropy, eccentricity) = panels
    radii.set_ylim(bottom=0.0)
    spread(major.yaxis, [table["semi_major"]])
    anisotropy.set_ylim(bottom=0.0)
    for axes, text, label in ((radii, "(a) mean radius and semi-minor axis", r"$\langle R\rangle$, $a\;\;[\sigma]$"),
                              (major, "(b) semi-major axis", r"$b\;\;[\sigma]$"),
                              (anisotropy, "(c) anisotropy", r"$\langle R^2\rangle/\langle R\rangle^2-1$"),
                              (eccentricity, "(d) eccentricity of the ellipsoid", "eccentricity")):
        letter(axes, text)
        axes.set_ylabel(label)
        few_ticks(axes.xaxis)
    eccentricity.ticklabel_format(axis="y", useOffset=False)
    for axes in panels[1]:
        axes.set_xlabel(DENSITY)


def draw_holes(folder, table, system, scan=None):
    """Regions of low energy against density, into insertion-holes.png. Nothing is drawn if none were found.
    The best steps of the reference scheme in a scan are squares among their sizes, as in [U]'s figure 7."""
    table = rows_where(table, table["holes"] > 0)
    table = rows_where(table, one_per_density(table))
    if len(table["density"]) == 0:
        return
    figure, panels = plt.subplots(2, 2, sharex=True, figsize=(12.0, 8.0), gridspec_kw={"wspace": 0.27, "hspace": 0.22})
    energies = sorted(set(table["iso_energy"]))
    colours = [colour for colour, _ in PAIR_STYLES] if len(energies) <= len(PAIR_STYLES) else shades(len(energies))
    draw_hole_lines(panels, table, energies, colours)
    guides = draw_guides(panels[0, 0], table["density"]) + draw_best_steps(panels[0, 0], scan)
    label_holes(panels, table)
    figure.align_ylabels(panels)
    handles = [Line2D([], [], color=colour, label=rf"surface at ${energy:g}\,\epsilon$") for colour, energy in zip(colours, energies)]
    handles += [Line2D([], [], color=GREY, marker=marker, linestyle=style, label=text) for _, text, marker, style in HOLE_SIZES]
    legend_beside(panels[0, 1], handles + guides)
    title(figure, [*system, *common("T", table["temperature"]), "regions of low energy"])
    save(figure, folder / "insertion-holes.png")


def draw_errors(folder, table, system):
    """The error at an evaluation and at the next one, into insertion-errors.png. Slope 2 means quadratic convergence."""
    table = rows_where(table, (table["error"] > 0.0) & (table["next_error"] > 0.0))
    if len(table["density"]) == 0:
        return
    figure, axes = plt.subplots(figsize=(9.0, 7.5))
    densities = sorted(set(table["density"]))
    colours = np.array(shades(len(densities)))[np.searchsorted(densities, table["density"])]
    mixed = np.random.default_rng(1).permutation(len(colours))  # otherwise points of the last density hide the others
    axes.scatter(table["error"][mixed], table["next_error"][mixed], s=9.0, c=colours[mixed], alpha=0.5, linewidths=0)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.autoscale_view()
    axes.autoscale(False)
    x = np.geomspace(*axes.get_xlim(), 200)
    axes.plot(x, x, color="black", linestyle="--", linewidth=1.5)
    axes.plot(x, x**2, color="black", linestyle="-", linewidth=1.5)
    axes.set_xlabel(r"error $|\xi|$ at an evaluation")
    axes.set_ylabel(r"$|\xi|$ at the next")
    for axis in (axes.xaxis, axes.yaxis):
        decade_ticks(axis, 9)
    handles = [Line2D([], [], color=colour, marker="o", linestyle="", label=rf"$\rho={density:g}$")
               for colour, density in zip(shades(len(densities)), densities)]
    handles += [Line2D([], [], color="black", linestyle="--", linewidth=1.5, label="slope 1, equal"),
                Line2D([], [], color="black", linewidth=1.5, label="slope 2, squared")]
    legend_beside(axes, handles)
    title(figure, [*system, "errors of successive evaluations"], 0.2)
    save(figure, folder / "insertion-errors.png")


def draw_insertion(folder, tables, result, run):
    """The figures of all tables that have rows."""
    if "densification" in tables:
        draw_densification(folder, tables["densification"], system_parts(result, None, None), run)
    system = system_parts(result, None, run.get("particles"))
    if "scan" in tables and len(tables["scan"]["density"]) > 0:
        for draw in (draw_cost, draw_distances, draw_steps):
            draw(folder, tables["scan"], system)
    if "holes" in tables:
        draw_holes(folder, tables["holes"], system, tables.get("scan"))
    if "errors" in tables:
        draw_errors(folder, tables["errors"], system)
    if tables.get("map"):
        plot_insertion_map.draw_maps(folder, tables["map"], system)
