"""The figures of what `lanescape insert --scan` and `lanescape insert --densify` write; tools/plot.py says which."""

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter, NullLocator

import equation_of_state
from plot_style import BLUE, GREEN, GREY, PAIR_STYLES, PURPLE, VERMILLION, Unusable, letter, plt, read_table, save, system_parts

COLUMNS = {
    "densification": ("density", "temperature", "pressure", "excess_energy", "energy"),
    "scan": ("density", "temperature", "method", "tolerance", "largest_step", "evaluations", "evaluations_error", "distance",
             "largest_distance"),
    "holes": ("density", "temperature", "iso_energy", "holes", "mean_radius", "semi_minor", "semi_major", "anisotropy", "eccentricity"),
    "errors": ("density", "error", "next_error"),
}
TEXT = ("method", "largest_step")  # the latter may be "default"
METHOD_COLOURS = {"usher": BLUE, "usher-indirect": "#56B4E9", "usher-near": PURPLE, "screened": GREEN, "descent": VERMILLION}
LINES, MARKERS = ("-", "--", "-.", ":", (0, (1, 3))), ("o", "s", "^", "D", "v", "P", "X")
# Mostly they agree: the first shows beside the second, and that between the dashes of the third.
EQUATION_STYLES = {"johnson": {"label": "Johnson et al.", "color": "#56B4E9", "linewidth": 6.0, "alpha": 0.5},
                   "kolafa-nezbeda": {"label": "Kolafa, Nezbeda", "color": VERMILLION},
                   "thol": {"label": "Thol et al.", "color": "black", "linestyle": (0, (3, 3))}}
DENSITY, EVALUATIONS = r"density $\rho\;\;[\sigma^{-3}]$", "evaluations $n_f$"
LOG_FROM = 20.0  # a greater range of values is drawn on a logarithmic axis
LARGEST_STEPS_FROM = 3
TEMPERATURE_PANELS = 3


# ---- reading

def read_insertion(folder):
    """The tables that are there, by name; what is not a finite number in them is nan."""
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
    return tables


def step_size(text, density, file="largest step"):
    """A largest step in sigma, the default included."""
    try:
        step = 0.1 * density**-1.5 if text == "default" else float(text)
    except ValueError:
        step = np.nan
    if not 0.0 < step < np.inf:
        raise Unusable(f"{file}: {text}: largest_step must be above 0, or default")
    return step


def rows_where(table, chosen):
    return {name: values[chosen] for name, values in table.items()}


# ---- axes

def spread(axis, values):
    """A logarithmic axis for values over more than LOG_FROM, labelled at 1, 2 and 5."""
    values = np.concatenate([np.ravel(v) for v in values])
    values = values[values > 0.0]
    if len(values) and values.max() > LOG_FROM * values.min():
        logarithmic(axis, values.max() / values.min() < 1e3)
        return
    axis.axes.set_ylim(bottom=0.0)


def logarithmic(axis, between=True):
    (axis.axes.set_xscale if axis.axis_name == "x" else axis.axes.set_yscale)("log")
    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if between else (1.0,), numticks=15))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_locator(NullLocator())
    axis.set_minor_formatter(NullFormatter())


def legend_beside(axes, handles):
    axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.02, 1.0), borderaxespad=0.0)


def shades(count):
    """Colours of ordered values, dark to light."""
    return [plt.get_cmap("viridis")(x) for x in np.linspace(0.0, 0.85, max(2, count))][:count]


def common(label, values):
    """A part of a title where all values are the same, else nothing."""
    return [f"${label}={values[0]:g}$"] if len(set(values)) == 1 else []


def title(figure, parts, above=0.42):
    """So many inches above the panels."""
    figure.suptitle(",  ".join(parts), y=figure.subplotpars.top + above / figure.get_figheight(), va="bottom", fontsize=15)


# ---- growth at constant energy

def processes(table, run):
    """Equations of state at constant energy from the first row on, for fluids that they are of: without a cutoff, or corrected for it."""
    if run.get("model") != "lennard-jones" or run.get("model-file") or run.get("truncation") != "tail":
        return {}
    density, lines = table["density"], {}
    along = np.linspace(density[0], density[-1], 60)
    for name in equation_of_state.EQUATIONS:
        try:
            equation = equation_of_state.load(name)
            lines[name] = equation_of_state.constant_energy_process(equation, density[0], table["temperature"][0], along)
        except OSError as error:
            raise Unusable(f"{error.filename}: {error.strerror}") from error
        except equation_of_state.Unusable:
            continue  # where it says nothing
    return lines


def draw_densification(folder, table, system, run):
    if len(table["density"]) == 0:
        return
    lines = processes(table, run)
    figure, panels = plt.subplots(2, 2, sharex=True, figsize=(11.5, 8.0), gridspec_kw={"hspace": 0.22, "wspace": 0.26})
    quantities = (("energy", None, r"$e\;\;[\epsilon]$", "energy per particle"),
                  ("pressure", "pressure", r"$P\;\;[\epsilon\,\sigma^{-3}]$", "pressure"),
                  ("temperature", "temperature", r"$T\;\;[\epsilon/k_\mathrm{B}]$", "temperature"),
                  ("excess_energy", "e_ex", r"$e^\mathrm{ex}\;\;[\epsilon]$", "excess energy per particle"))
    for axes, name, (key, line, label, text) in zip(panels.flat, "abcd", quantities):
        for equation, process in lines.items():
            if line:
                axes.plot(process["density"], process[line], **EQUATION_STYLES[equation])
        axes.plot(table["density"], table[key], "o", color="black", markersize=6, markerfacecolor="white", markeredgewidth=1.5,
                  label="measured")
        axes.set_ylabel(label)
        letter(axes, f"({name}) {text}")
    start = table["energy"][0]
    if np.isfinite(start):
        panels[0, 0].axhline(start, color=GREY, linestyle="--", zorder=0)
        letter(panels[0, 0], f"(a) energy per particle, at first {start:.4g}".replace("-", "\u2212"))
    for axes in panels[1]:
        axes.set_xlabel(DENSITY)
    figure.align_ylabels(panels)
    title(figure, [*system, "growth at constant energy"], 0.8 if lines else 0.42)
    if lines:
        figure.legend(*panels[0, 1].get_legend_handles_labels(), loc="upper center", bbox_to_anchor=(0.5, 0.97), ncol=4)
    save(figure, folder / "densification.png")


# ---- scans

def one_per_density(table):
    """Which rows are of the one temperature that stands for their density: of several that with most densities."""
    densities, of = {}, {}
    for density, temperature in zip(table["density"], table["temperature"]):
        densities.setdefault(temperature, set()).add(density)
        of.setdefault(density, []).append(temperature)
    chosen = {density: max(temperatures, key=lambda t: len(densities[t])) for density, temperatures in of.items()}
    return np.array([chosen[d] == t for d, t in zip(table["density"], table["temperature"])], bool)


def with_one_step(table):
    """The rows with the default largest step, or else with the first that is there, and what a title says of it."""
    steps = table["largest_step"]
    step = "default" if "default" in steps else steps[0]
    return rows_where(table, steps == step), [] if step == "default" else [rf"$\Delta s_\mathrm{{max}}={float(step):g}\,\sigma$"]


class Combinations:
    """Colours by method, lines and markers by tolerance."""

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
        """(style, rows sorted along a column) of each combination that is there."""
        for method in self.methods:
            for tolerance in self.tolerances:
                rows = rows_where(table, (table["method"] == method) & (table["tolerance"] == tolerance))
                order = np.argsort(rows[along], kind="stable")
                if len(order):
                    yield self.style(method, tolerance), rows_where(rows, order)


def draw_evaluations(axes, combinations, table, along):
    for style, rows in combinations.lines(table, along):
        axes.errorbar(rows[along], above_zero(rows["evaluations"]), rows["evaluations_error"], capsize=3, **style)
    axes.margins(x=0.08)
    axes.xaxis.set_major_locator(MaxNLocator(nbins=6, steps=[1, 2, 5, 10]))


def above_zero(values):
    return np.where(values > 0.0, values, np.nan)


def draw_cost(folder, table, system):
    table, step = with_one_step(table)
    combinations, chosen = Combinations(table), rows_where(table, one_per_density(table))
    several = [density for density in sorted(set(table["density"])) if len(set(table["temperature"][table["density"] == density])) > 1]
    several = several[-TEMPERATURE_PANELS:]
    count = 1 + len(several)
    rows, columns = (2, 2) if count > 2 else (1, count)
    figure, panels = plt.subplots(rows, columns, squeeze=False, sharey=True, figsize=((8.0, 12.0)[columns - 1], 1.0 + 4.5 * rows),
                                  gridspec_kw={"wspace": 0.1, "hspace": 0.38})
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
    for axes in flat[count:]:
        axes.set_visible(False)
    for row in panels:
        row[0].set_ylabel(EVALUATIONS)
    legend_beside(panels[0, -1], combinations.handles())
    title(figure, [*system, *([] if several else common("T", chosen["temperature"])), *step, *combinations.title()],
          0.42 if several else 0.2)
    save(figure, folder / "insertion-cost.png")


def draw_distances(folder, table, system):
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
        axes.xaxis.set_major_locator(MaxNLocator(nbins=6, steps=[1, 2, 5, 10]))
        letter(axes, text)
    logarithmic(panels[0].yaxis)
    panels[0].set_ylabel(r"distance from start to place $[\sigma]$")
    legend_beside(panels[1], combinations.handles())
    title(figure, [*system, *common("T", table["temperature"]), *step, *combinations.title()])
    save(figure, folder / "insertion-distance.png")


def draw_steps(folder, table, system):
    if len(set(table["largest_step"])) < LARGEST_STEPS_FROM:
        return
    table = rows_where(table, one_per_density(table))
    combinations = Combinations(table)
    states = sorted(set(zip(table["density"], table["temperature"])))
    table["step"] = np.array([step_size(step, density) for step, density in zip(table["largest_step"], table["density"])])
    columns = min(2, len(combinations.methods))
    rows = -(-len(combinations.methods) // columns)
    figure, panels = plt.subplots(rows, columns, squeeze=False, sharex=True, sharey=True,
                                  figsize=((8.0, 12.0)[columns - 1], 1.0 + 4.5 * rows), gridspec_kw={"wspace": 0.1, "hspace": 0.25})
    one_temperature = len({temperature for _, temperature in states}) == 1
    defaults = False
    for axes, name, method in zip(panels.flat, "abcdefgh", combinations.methods):
        for colour, (density, temperature) in zip(shades(len(states)), states):
            of = rows_where(table, (table["method"] == method) & (table["density"] == density) & (table["temperature"] == temperature))
            for style, line in combinations.lines(of, "step"):
                axes.errorbar(line["step"], above_zero(line["evaluations"]), line["evaluations_error"], capsize=3,
                              **{**style, "color": colour, "markersize": 5})
                own = line["largest_step"] == "default"
                axes.plot(line["step"][own], above_zero(line["evaluations"][own]), "o", color=colour, markersize=13, markerfacecolor="none")
                defaults = defaults or own.any()
        letter(axes, f"({name}) {method}" if len(combinations.methods) > 1 else method)
    spread(panels[0, 0].yaxis, [table["evaluations"]])
    if table["step"].max() > 5.0 * table["step"].min():
        logarithmic(panels[0, 0].xaxis)
    for axes in list(panels.flat)[len(combinations.methods):]:
        axes.set_visible(False)
    for k in range(columns):
        last = panels[(len(combinations.methods) - 1 - k) // columns, k]
        last.set_xlabel(r"largest step $\Delta s_\mathrm{max}\;\;[\sigma]$")
        last.tick_params(labelbottom=True)
    for row in panels:
        row[0].set_ylabel(EVALUATIONS)
    handles = [Line2D([], [], color=colour, label=rf"$\rho={density:g}$" + ("" if one_temperature else f", $T={temperature:g}$"))
               for colour, (density, temperature) in zip(shades(len(states)), states)]
    if defaults:
        handles.append(Line2D([], [], color=GREY, linestyle="", marker="o", markersize=13, markerfacecolor="none",
                              label=r"default, $0.1\,\rho^{-3/2}$"))
    legend_beside(panels[0, -1], handles + combinations.handles(methods=False))
    title(figure, [*system, *common("T", table["temperature"]), *combinations.title()])
    save(figure, folder / "insertion-step.png")


def draw_holes(folder, table, system):
    table = rows_where(table, table["holes"] > 0)
    table = rows_where(table, one_per_density(table))
    if len(table["density"]) == 0:
        return
    figure, panels = plt.subplots(2, 2, sharex=True, figsize=(12.0, 8.0), gridspec_kw={"wspace": 0.27, "hspace": 0.22})
    (radii, major), (anisotropy, eccentricity) = panels
    energies = sorted(set(table["iso_energy"]))
    colours = [colour for colour, _ in PAIR_STYLES] if len(energies) <= len(PAIR_STYLES) else shades(len(energies))
    for colour, energy in zip(colours, energies):
        rows = rows_where(table, table["iso_energy"] == energy)
        rows = rows_where(rows, np.argsort(rows["density"], kind="stable"))
        for axes, key, marker, style in ((radii, "mean_radius", "o", "-"), (radii, "semi_minor", "v", "--"), (major, "semi_major", "^", ":"),
                                         (anisotropy, "anisotropy", "o", "-"), (eccentricity, "eccentricity", "o", "-")):
            axes.plot(rows["density"], rows[key], color=colour, marker=marker, linestyle=style)
    low, high = table["density"].min(), table["density"].max()
    guide = np.linspace(low, high, 60) if low < high else np.array([0.95, 1.05]) * low
    guides = ((0.1 * guide**-1.5, "black", r"$0.1\,\rho^{-3/2}$"), (0.225 / guide, "#B0A000", r"mean free path, $0.225/\rho$"))
    for values, colour, _ in guides:
        radii.plot(guide, values, color=colour, linewidth=6.0, alpha=0.25, zorder=0, solid_capstyle="butt")
    radii.set_ylim(bottom=0.0)
    spread(major.yaxis, [table["semi_major"]])
    anisotropy.set_ylim(bottom=0.0)
    for axes, text, label in ((radii, "(a) mean radius and semi-minor axis", r"$\langle R\rangle$, $a\;\;[\sigma]$"),
                              (major, "(b) semi-major axis", r"$b\;\;[\sigma]$"),
                              (anisotropy, "(c) anisotropy", r"$\langle R^2\rangle/\langle R\rangle^2-1$"),
                              (eccentricity, "(d) eccentricity of the ellipsoid", "eccentricity")):
        letter(axes, text)
        axes.set_ylabel(label)
        axes.xaxis.set_major_locator(MaxNLocator(nbins=6, steps=[1, 2, 5, 10]))
    eccentricity.ticklabel_format(axis="y", useOffset=False)
    for axes in panels[1]:
        axes.set_xlabel(DENSITY)
    figure.align_ylabels(panels)
    handles = [Line2D([], [], color=colour, label=rf"surface at ${energy:g}\,\epsilon$") for colour, energy in zip(colours, energies)]
    handles += [Line2D([], [], color=GREY, marker=marker, linestyle=style, label=text)
                for text, marker, style in (("mean radius", "o", "-"), ("semi-minor axis", "v", "--"), ("semi-major axis", "^", ":"))]
    handles += [Line2D([], [], color=colour, linewidth=6.0, alpha=0.25, label=text) for _, colour, text in guides]
    legend_beside(major, handles)
    title(figure, [*system, *common("T", table["temperature"]), "regions of low energy"])
    save(figure, folder / "insertion-holes.png")


def draw_errors(folder, table, system):
    table = rows_where(table, (table["error"] > 0.0) & (table["next_error"] > 0.0))
    if len(table["density"]) == 0:
        return
    figure, axes = plt.subplots(figsize=(9.0, 7.5))
    densities = sorted(set(table["density"]))
    colours = np.array(shades(len(densities)))[np.searchsorted(densities, table["density"])]
    mixed = np.random.default_rng(1).permutation(len(colours))  # or the last density hides the others
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
        axis.set_major_locator(LogLocator(numticks=9))
        axis.set_minor_locator(NullLocator())
    handles = [Line2D([], [], color=colour, marker="o", linestyle="", label=rf"$\rho={density:g}$")
               for colour, density in zip(shades(len(densities)), densities)]
    handles += [Line2D([], [], color="black", linestyle="--", linewidth=1.5, label="slope 1, equal"),
                Line2D([], [], color="black", linewidth=1.5, label="slope 2, squared")]
    legend_beside(axes, handles)
    title(figure, [*system, "errors of successive evaluations"], 0.2)
    save(figure, folder / "insertion-errors.png")


def draw_insertion(folder, tables, result, run):
    """A figure for each thing that there are rows of."""
    if "densification" in tables:
        draw_densification(folder, tables["densification"], system_parts(result, None, None), run)
    system = system_parts(result, None, run.get("particles"))
    if "scan" in tables and len(tables["scan"]["density"]) > 0:
        for draw in (draw_cost, draw_distances, draw_steps):
            draw(folder, tables["scan"], system)
    for name, draw in (("holes", draw_holes), ("errors", draw_errors)):
        if name in tables:
            draw(folder, tables[name], system)
