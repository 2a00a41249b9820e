"""Figures of an analysis of finished runs for tools/plot.py: analysis-*.png, one of each kind for each model."""

import csv

import numpy as np
from matplotlib.lines import Line2D

from plot_style import (BLUE, GREEN, GREY, MODEL_NAMES, ORANGE, PURPLE, SKY_BLUE, VERMILLION, Unusable, legend_beside, letter, logarithmic,
                        plt, read_text, save, shades, species_name, title)

STATES = ("packing_fraction", "temperature")
TIMES = ("interval", "longest_time")  # of diffusion: they follow the state
COUNTS = ("group", "runs", "paths", "reached")
COLOURS = (BLUE, VERMILLION, GREEN, PURPLE, ORANGE, SKY_BLUE, GREY)
MARKERS, LINES = "osD^vPX", ("-", "--", ":", "-.")
RATIO = r"$(\Delta R/g)^2$"
SHOWN_DIFFUSION = "diffusion_long_time"  # the least uncertain, and right for coarse intervals too
STATE_LABELS = {"packing_fraction": r"$\phi$", "temperature": r"$T$"}
# [G] figures 4.20 to 4.25: slope and intercept of ln y against X of its fits to binary hard spheres from phi = 0.53 to 0.57.
SOURCE = {("mode-coupling", "ratio_squared"): (1.450393, -1.404044), ("vogel-fulcher-tammann", "diffusion_long_time_Xe"): (0.159643, -2.836295),
          ("berthier-witten", "diffusion_long_time_Xe"): (0.0125595, -3.653602)}
SOURCE_MODEL, SOURCE_FROM, SOURCE_TO = "hard-sphere-binary", 0.53, 0.57
FORMS = {"mode-coupling": (np.log, "$x_c-x$"), "vogel-fulcher-tammann": (lambda d: -1.0 / d, "$1/(x_c-x)$"),
         "berthier-witten": (lambda d: -1.0 / d**2, "$1/(x_c-x)^2$")}


FORM_NAMES = {"mode-coupling": "mode coupling", "vogel-fulcher-tammann": "Vogel-Fulcher-Tammann", "berthier-witten": "Berthier-Witten"}
TABLES = {  # what is read of each, and which of it are numbers or empty
    "groups": (("group", "kind", "model", "particles", "packing_fraction", "temperature", "method", "stepping"), ()),
    "means": (("group", "quantity", "mean", "error"), ("mean", "error")),
    "distributions": (("group", "quantity", "value", "probability", "error"), ("value", "probability", "error")),
    "fits": (("sweep", "quantity", "form", "from", "to", "slope", "intercept", "critical", "critical_error"),
             ("from", "to", "slope", "intercept", "critical")),
    "scaling": (("sweep", "diffusion_sweep", "quantity", "constant"), ("constant",)),
    "scaling_points": (("sweep", "diffusion_sweep", "quantity", "state", "ratio_squared", "ratio_squared_error", "diffusion", "diffusion_error",
                        "scaled", "diffusion_over_scaled", "diffusion_over_scaled_error"), ("state", "ratio_squared", "diffusion", "scaled")),
}


def number(text):
    return float(text) if text not in ("", None) else np.nan


def rows_of(folder, name):
    """The rows of one table as texts; none if there is no such file. Raises Unusable for a table that lacks what is drawn."""
    file = folder / f"{name}.csv"
    if not file.exists():
        return []
    reader = csv.DictReader(read_text(file).splitlines())
    columns, numbers = TABLES[name]
    missing = [column for column in columns if column not in (reader.fieldnames or [])]
    if missing:
        raise Unusable(f"{file}: no column {missing[0]}")
    rows = list(reader)
    try:
        for row in rows:
            for column in numbers:
                number(row[column])
    except ValueError as error:
        raise Unusable(f"{file}: not a table of numbers: {error}") from error
    return rows


class Sweep:
    """Groups that differ in their state alone, in ascending order, with what the tables say about them."""

    def __init__(self, key, groups):
        self.words, self.groups = key, groups
        self.first = groups[0]
        self.state = next((s for s in STATES if self.first[s]), None)
        self.label = ""

    def states(self):
        return [number(group[self.state]) for group in self.groups] if self.state else []


def sweeps_of(groups, means, distributions):
    """All groups with their means and distributions, by model and sweep."""
    by_key = {}
    for group in groups:
        group["means"] = {row["quantity"]: (number(row["mean"]), number(row["error"])) for row in means if row["group"] == group["group"]}
        group["distributions"] = distributions.get(group["group"], {})
        skipped = STATES + COUNTS + (TIMES if group["kind"] == "diffusion" else ())
        key = tuple((name, value) for name, value in group.items() if name not in skipped and isinstance(value, str) and value)
        by_key.setdefault(key, []).append(group)
    sweeps = [Sweep(key, sorted(of, key=lambda g: [number(g[s] or 0) for s in STATES])) for key, of in by_key.items()]
    for model in {sweep.first["model"] for sweep in sweeps}:
        name_sweeps([s for s in sweeps if s.first["model"] == model and s.first["kind"] in ("path", "shorten")])
    return sweeps


def name_sweeps(sweeps):
    """Labels made of the settings in which the sweeps of one model differ; of a single one its method."""
    values = {}
    for sweep in sweeps:
        for name, value in sweep.words:
            values.setdefault(name, set()).add(value)
    prefixes = {"particles": "$N$ = ", "distance": r"$\Delta R$ = ", "step": "step ", "avoidance_step": "avoidance step ", "starts": "starts "}
    for sweep in sweeps:
        words = [prefixes.get(name, "") + value for name, value in sweep.words if len(values[name]) > 1 and name != "kind"]
        sweep.label = ", ".join(words) or ", ".join(filter(None, (sweep.first["method"], sweep.first["stepping"])))


def read_analysis(folder):
    """What the tables of an analysis hold, or None if there are none."""
    groups = rows_of(folder, "groups")
    if not groups:
        return None
    distributions = {}
    for row in rows_of(folder, "distributions"):
        values = distributions.setdefault(row["group"], {}).setdefault(row["quantity"], [])
        values.append((number(row["value"]), number(row["probability"]), number(row["error"])))
    tables = {name: rows_of(folder, name) for name in ("fits", "scaling", "scaling_points")}
    return {"sweeps": sweeps_of(groups, rows_of(folder, "means"), distributions), **tables}


def with_errors(axes, x, y, error, colour, marker, label, **more):
    axes.errorbar(x, y, yerr=np.nan_to_num(error), color=colour, marker=marker, markersize=5, linestyle="none", capsize=2.5, linewidth=1.2,
                  label=label, **more)


def state_label(model_sweeps):
    return STATE_LABELS[next((s.state for s in model_sweeps if s.state), "packing_fraction")]


# (1) D and c (DeltaR/g)^2 against the state, and their quotient, of sweeps that go through some states at least.

FEWEST_STATES = 3


def draw_scaling(file, model, sweeps, rows, points):
    wanted = [row for row in rows if not row["quantity"].endswith("/T")]
    fewest = min(FEWEST_STATES, max((int(row["points"]) for row in wanted), default=0))
    wanted = [row for row in wanted if int(row["points"]) >= fewest]
    pairs = sorted({(row["diffusion_sweep"], row["quantity"]) for row in wanted})
    kinds = {quantity.rsplit("_", 1)[0] for _, quantity in pairs}
    way = next((kind for kind in (SHOWN_DIFFUSION, "diffusion_msd", "diffusion_vacf") if kind in kinds), None)
    pairs = [pair for pair in pairs if pair[1].rsplit("_", 1)[0] == way][:4]
    if not pairs:
        return
    figure, panels = plt.subplots(2, len(pairs), figsize=(6.2 * len(pairs), 7.6), squeeze=False, sharex="col",
                                  gridspec_kw={"height_ratios": (2.2, 1.0), "hspace": 0.08, "wspace": 0.3})
    names = sorted({row["sweep"] for row in wanted})
    for (diffusion, quantity), (upper, lower) in zip(pairs, panels.T):
        drawn = False
        for name, colour, marker in zip(names, COLOURS, MARKERS[1:] + MARKERS):
            of = [p for p in points if (p["sweep"], p["diffusion_sweep"], p["quantity"]) == (name, diffusion, quantity)]
            if not of:
                continue
            column = {key: np.array([number(p[key]) for p in of]) for key in of[0] if key not in ("sweep", "diffusion_sweep", "quantity")}
            if not drawn:
                with_errors(upper, column["state"], column["diffusion"], column["diffusion_error"], "black", "o", "$D$", zorder=3)
                drawn = True
            scale = column["scaled"] / column["ratio_squared"]
            with_errors(upper, column["state"], column["scaled"], scale * column["ratio_squared_error"], colour, marker,
                        f"$c\\,${RATIO}, {short_name(name, names)}", fillstyle="none")
            draw_quotients(lower, points, (name, diffusion, quantity), colour, marker)
        logarithmic(upper.yaxis)
        lower.axhline(1.0, color=GREY, linewidth=1.0)
        lower.set_xlabel(state_label(sweeps))
        letter(upper, f"{species_name(quantity.rsplit('_', 1)[1], model)}")
        draw_legend_of_fills(lower, points, diffusion, quantity)
    legend_beside(panels[0][-1], panels[0][-1].get_legend_handles_labels()[0])
    panels[0][0].set_ylabel("$D$")
    panels[1][0].set_ylabel(f"$D/c${RATIO}")
    title(figure, [MODEL_NAMES.get(model, model), f"$D$ beside {RATIO}"])
    save(figure, file)


def draw_quotients(axes, points, key, colour, marker):
    """D/(c (DeltaR/g)^2); of soft models the same of D/T too, with its own c."""
    for suffix, fill in (("", "none"), ("/T", "full")):
        of = [p for p in points if (p["sweep"], p["diffusion_sweep"], p["quantity"]) == (*key[:2], key[2] + suffix)]
        if of:
            quotient, error, state = (np.array([number(p[name]) for p in of])
                                      for name in ("diffusion_over_scaled", "diffusion_over_scaled_error", "state"))
            with_errors(axes, state, quotient, error, colour, marker, None, fillstyle=fill)


def draw_legend_of_fills(axes, points, diffusion, quantity):
    """Which marks are D and which D/T, where there are both."""
    if any((p["diffusion_sweep"], p["quantity"]) == (diffusion, quantity + "/T") for p in points):
        axes.legend(handles=[Line2D([], [], color=GREY, marker="o", linestyle="none", fillstyle=fill, label=label)
                             for fill, label in (("none", "$D$"), ("full", "$D/T$"))], loc="best", fontsize=10)


def short_name(name, names):
    """The words of a sweep's name that others do not share; of a single one without its kind and model."""
    words = [set(other.split()) for other in names]
    shared = set.intersection(*words) if len(names) > 1 else set(names[0].split()[:2])
    return " ".join(word for word in name.split() if word not in shared)


# (2) Fits.

def draw_fits(file, model, sweeps, fits):
    shown = [f for f in fits if f["critical_error"] == "" and (f["quantity"] == "ratio_squared" or f["quantity"].startswith(SHOWN_DIFFUSION))]
    rows = [q for q in ("ratio_squared", SHOWN_DIFFUSION) if any(f["quantity"].startswith(q) for f in shown)]
    if not rows:
        return
    forms = [form for form in FORMS if any(f["form"] == form for f in shown)]
    figure, panels = plt.subplots(len(rows), len(forms), figsize=(4.8 * len(forms), 4.8 * len(rows)), squeeze=False, gridspec_kw={"wspace": 0.28, "hspace": 0.45})
    for line, (quantity, of_row) in enumerate(zip(rows, panels)):
        lines = sorted({(f["sweep"], f["quantity"]) for f in shown if f["quantity"].startswith(quantity)})[:len(COLOURS)]
        for form, axes in zip(forms, of_row):
            label = FORMS[form][1]
            draw_form(axes, model, sweeps, [f for f in shown if f["form"] == form], form, lines)
            axes.set_xlabel(label.replace("x", STATE_LABELS[sweeps[0].state].strip("$")) if sweeps[0].state == "packing_fraction"
                            else label.replace("x_c-x", "T-T_c"))
            letter(axes, FORM_NAMES[form] if line == 0 else "")
        of_row[0].set_ylabel(RATIO if quantity == "ratio_squared" else "$D$")
        handles = [Line2D([], [], color=colour, marker="o", label=f"{short_name(name, [n for n, _ in lines])} {species_of(q, model)}".strip())
                   for (name, q), colour in zip(lines, COLOURS)]
        if model == SOURCE_MODEL:
            handles.append(Line2D([], [], color="black", linestyle="--", label="[G]'s fit"))
        legend_beside(of_row[-1], handles)
    title(figure, [MODEL_NAMES.get(model, model), "fits with a critical state held"], above=0.5)
    save(figure, file)


def species_of(quantity, model):
    return species_name(quantity.rsplit("_", 1)[1], model) if quantity.startswith("diffusion") else ""


def draw_form(axes, model, sweeps, fits, form, lines):
    """Points and fits in the coordinates in which the form is a straight line."""
    abscissa = FORMS[form][0]
    place = (lambda d: d) if form == "mode-coupling" else (lambda d: -abscissa(d))
    for (name, quantity), colour in zip(lines, COLOURS):
        fit = next((f for f in fits if (f["sweep"], f["quantity"]) == (name, quantity)), None)
        sweep = next((s for s in sweeps if fit and matches(s, name)), None)
        if sweep is None:
            continue
        critical, slope, intercept = (number(fit[key]) for key in ("critical", "slope", "intercept"))
        sign = 1.0 if sweep.state == "packing_fraction" else -1.0
        inside = [(x, *g["means"][quantity]) for x, g in zip(sweep.states(), sweep.groups)
                  if quantity in g["means"] and number(fit["from"]) <= x <= number(fit["to"]) and sign * (critical - x) > 0]
        states, values, errors = (np.array(column) for column in zip(*inside))
        with_errors(axes, place(sign * (critical - states)), values, errors, colour, "o", None)
        fine = sign * (critical - np.linspace(states.min(), states.max(), 200))
        axes.plot(place(fine), np.exp(slope * abscissa(fine) + intercept), color=colour, linewidth=1.5)
        if model == SOURCE_MODEL and (form, quantity) in SOURCE:
            fine = critical - np.linspace(SOURCE_FROM, SOURCE_TO, 50)
            published = SOURCE[form, quantity]
            axes.plot(place(fine), np.exp(published[0] * abscissa(fine) + published[1]), color="black", linestyle="--", linewidth=1.5, zorder=3)
    logarithmic(axes.yaxis)
    if form == "mode-coupling":
        logarithmic(axes.xaxis)


def matches(sweep, name):
    """Whether the sweep is the one of that name, which has the words of each group's name but those of its state."""
    return any(not set(name.split()) - set(group["group"].split()) for group in sweep.groups)


# (3) to (5) Distributions over steps and particles: a colour for each state, a kind of line for each sweep.

MOST_SWEEPS = 4  # in one figure: those of the most states; more lines cannot be told apart


class Panels:
    """Distributions of all groups of some sweeps, drawn alike in each panel."""

    def __init__(self, model, sweeps):
        self.model, self.all = model, sweeps
        self.sweeps = sweeps if len(sweeps) <= MOST_SWEEPS else sorted(sweeps, key=lambda sweep: -len(sweep.groups))[:MOST_SWEEPS]
        self.states = sorted({x for s in sweeps for x in s.states() if not np.isnan(x)})
        self.colours = dict(zip(self.states, shades(len(self.states))))

    def having(self, quantity):
        """The same for the groups with this distribution alone."""
        kept = []
        for sweep in self.all:
            groups = [g for g in sweep.groups if quantity in g["distributions"]]
            if groups:
                kept.append(Sweep(sweep.words, groups))
                kept[-1].label = sweep.label
        return Panels(self.model, kept)

    def draw(self, axes, quantity, label, width=None, log=True, shift=0.0):
        """Densities for bins of that width, which may be a function of N; without one, probabilities. Lines break at empty bins."""
        for sweep, style in zip(self.sweeps, LINES * 9):
            for group in sweep.groups:
                if quantity not in group["distributions"]:
                    continue
                value, share, _ = (np.array(column) for column in zip(*group["distributions"][quantity]))
                bin_width = 1.0 if width is None else width(number(group["particles"])) if callable(width) else width
                colour = self.colours.get(number(group[sweep.state]) if sweep.state else None, "black")
                middle = value + shift if width is None else value + shift - 0.5 * bin_width
                gaps = np.flatnonzero(np.diff(value) > 1.5 * bin_width) + 1
                axes.plot(np.insert(middle, gaps, np.nan), np.insert(share / bin_width, gaps, np.nan), color=colour, linestyle=style,
                          linewidth=1.4, marker="." if len(value) < 12 or len(gaps) else None, markersize=4)
        if log:
            axes.set_yscale("log")
        axes.set_xlabel(label)
        axes.set_ylabel("probability" if width is None else "density")

    def legend(self, axes, more=()):
        shown = self.states if len(self.states) <= 12 else self.states[::len(self.states) // 10]
        name = state_label(self.sweeps)
        handles = [Line2D([], [], color=self.colours[x], linewidth=3, label=f"{name} = {x:g}") for x in shown]
        if len(self.sweeps) > 1:
            handles += [Line2D([], [], color=GREY, linestyle=style, label=sweep.label) for sweep, style in zip(self.sweeps, LINES * 9)]
        legend_beside(axes, [*handles, *more])

    def finish(self, figure, axes, what, file, more=()):
        self.legend(axes, more)
        label = [self.sweeps[0].label] if len(self.sweeps) == 1 else []
        title(figure, [MODEL_NAMES.get(self.model, self.model), what, *label], above=0.3)
        save(figure, file)


def draw_participation(file, panels):
    panels = panels.having("participation_ratio")
    if not panels.sweeps:
        return
    figure, (left, right) = plt.subplots(1, 2, figsize=(12.5, 4.6), gridspec_kw={"wspace": 0.28})
    panels.draw(left, "participation_ratio", "$n/N$", width=lambda n: 1.0 / n)
    panels.draw(right, "alpha_2", r"$1+\alpha_2$", width=0.2, shift=1.0)
    logarithmic(right.xaxis)
    panels.finish(figure, right, "participation in steps", file)


def draw_heterogeneity(file, panels):
    names = sorted({q for s in panels.sweeps for g in s.groups for q in g["distributions"] if q.startswith("log10_length_")}, reverse=True)
    if not names:
        return
    figure, axes = plt.subplots(1, len(names) + 1, figsize=(5.0 * (len(names) + 1), 4.6), squeeze=False, gridspec_kw={"wspace": 0.28})
    for name, of in zip(names, axes[0]):
        panels.draw(of, name, r"$\log_{10}(g_j/\Delta R_j)$", width=0.05, log=False)
        letter(of, species_name(name.removeprefix("log10_length_"), panels.model))
    last = axes[0][-1]
    for sweep, marker in zip(panels.sweeps, MARKERS * 9):
        for name, colour in zip(names, COLOURS):
            species = name.removeprefix("log10_length_")
            of = [(x, *g["means"][f"heterogeneity_pooled_{species}"]) for x, g in zip(sweep.states(), sweep.groups)
                  if f"heterogeneity_pooled_{species}" in g["means"]]
            if of:
                with_errors(last, *zip(*of), colour, marker, None)
    last.set_xlabel(state_label(panels.sweeps))
    last.set_ylabel(r"standard deviation of $\log_{10}(g_j/\Delta R_j)$")
    species = [Line2D([], [], color=colour, marker="o", linestyle="none",
                      label=f"width, {species_name(name.removeprefix('log10_length_'), panels.model)}") for name, colour in zip(names, COLOURS)]
    markers = [Line2D([], [], color=GREY, marker=marker, linestyle="none", label=f"width, {sweep.label}")
               for sweep, marker in zip(panels.sweeps, MARKERS * 9)] if len(panels.sweeps) > 1 else []
    panels.finish(figure, last, "path lengths of particles", file, species + markers)


def draw_overlaps(file, panels):
    panels = panels.having("overlapping_partners")
    if not panels.sweeps:
        return
    shown = (("overlapping_partners", "partners $v$", None), ("moved_particles", "$c/N$", lambda n: 1.0 / n), ("groups", "$m/N$", lambda n: 1.0 / n),
             ("group_size", "group size $s$, all groups", None), ("group_size_few_groups", "$s$, few groups", None),
             ("group_size_some_groups", "$s$, some groups", None), ("group_size_many_groups", "$s$, many groups", None))
    shown = [panel for panel in shown if panels.having(panel[0]).sweeps]
    figure, axes = plt.subplots(2, 4, figsize=(15.0, 7.6), gridspec_kw={"wspace": 0.3, "hspace": 0.3})
    for (quantity, label, width), of in zip(shown, axes.flat):
        panels.draw(of, quantity, label, width)
    for of in axes.flat[len(shown):]:
        of.set_visible(False)
    panels.finish(figure, axes[0][3], "overlaps and groups in avoidance steps", file)


def draw_analysis(folder, analysis):
    """All figures that there are data for."""
    models = sorted({sweep.first["model"] for sweep in analysis["sweeps"]})
    for model in models:
        sweeps = [s for s in analysis["sweeps"] if s.first["model"] == model]
        names = {group["group"] for s in sweeps for group in s.groups}
        file = lambda what: folder / (f"analysis-{what}.png" if len(models) == 1 else f"analysis-{what}-{model}.png")
        own = lambda rows: [row for row in rows if any(not set(row["sweep"].split()) - set(name.split()) for name in names)]
        draw_scaling(file("scaling"), model, sweeps, own(analysis["scaling"]), own(analysis["scaling_points"]))
        draw_fits(file("fits"), model, sweeps, own(analysis["fits"]))
        paths = [s for s in sweeps if s.first["kind"] in ("path", "shorten")]
        if paths:
            panels = Panels(model, paths)
            draw_participation(file("participation"), panels)
            draw_heterogeneity(file("heterogeneity"), panels)
            draw_overlaps(file("overlaps"), panels)
