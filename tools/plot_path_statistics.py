"""Distributions over the steps and particles of all paths, for tools/plot.py: statistics.png."""

import numpy as np

from plot_path import path_method
from plot_style import BLUE, PAIR_STYLES, legend_above, plt, read_table, save, species_name, system_parts

STEP_PANELS = (  # quantity, label, whether it is divided by the number of particles
    ("participation_ratio", "$n/N$", False),
    ("alpha_2", r"$\alpha_2$", False),
    ("overlapping_partners", "overlapping partners $v$", False),
    ("moved_particles", "$c/N$", True),
    ("groups", "$m/N$", True),
)
GROUP_SIZES = (("group_size_few_groups", "few"), ("group_size_some_groups", "some"), ("group_size_many_groups", "many"))


def read_tables(folder, paths, table, columns, text):
    """One table of all paths; an empty list if a path has no such table."""
    files = [folder / f"{path['name']}-{table}.csv" for path in paths]
    return [read_table(file, columns, text) for file in files] if all(file.exists() for file in files) else []


def read_histograms(folder, paths):
    """Values and numbers of steps by quantity, summed over all paths."""
    sums = {}
    for table in read_tables(folder, paths, "steps", ("quantity", "value", "steps"), ("quantity",)):
        for quantity, value, steps in zip(table["quantity"], table["value"], table["steps"]):
            by_value = sums.setdefault(quantity, {})
            by_value[value] = by_value.get(value, 0.0) + steps
    return {quantity: (np.array(sorted(v)), np.array([v[x] for x in sorted(v)])) for quantity, v in sums.items()}


def read_particle_ratios(folder, paths):
    """log10(g_j / DeltaR_j) of the particles of all paths, by species."""
    ratios = {}
    for table in read_tables(folder, paths, "particles", ("species", "path_length", "displacement"), ("species",)):
        moved = (table["displacement"] > 0.0) & (table["path_length"] > 0.0)
        logarithms = np.log10(table["path_length"][moved] / table["displacement"][moved])
        for species, logarithm in zip(table["species"][moved], logarithms):
            ratios.setdefault(species, []).append(logarithm)
    return ratios


def draw_histogram(axes, values, counts, scale, label, colour, name=None):
    """The share of each value, with its mean in the legend. `scale` multiplies the values."""
    share = counts / counts.sum()
    mean = (values * share).sum() * scale
    axes.plot(values * scale, share, color=colour, marker="o", markersize=3, linewidth=1.2, label=f"{name or 'mean'} {mean:.3g}")
    axes.set_yscale("log")
    axes.set_xlabel(label)
    legend_above(axes, handle=0.9, gap=0.7)


def draw_path_lengths(axes, ratios, model):
    """Densities of log10(g_j / DeltaR_j) by species, with their standard deviations in the legend."""
    for (species, values), (colour, _) in zip(ratios.items(), PAIR_STYLES):
        values = np.array(values)
        bins = np.arange(np.floor(values.min() / 0.05) * 0.05, values.max() + 0.05, 0.05)
        axes.hist(values, bins=bins, density=True, histtype="step", linewidth=2.0, color=colour,
                  label=f"{species_name(species, model)} {values.std():.3f}")
    axes.set_xlabel(r"$\log_{10}(g_j/\Delta R_j)$, and its width")
    legend_above(axes)


def draw_statistics(folder, paths, histograms, ratios, result, temperature):
    """Distributions over the steps and the particles of all paths, into statistics.png. Nothing is drawn if either table is missing."""
    if not histograms or not ratios:
        return
    counted = {quantity for quantity, (_, counts) in histograms.items() if counts.sum() > 0}
    shown = [panel for panel in STEP_PANELS if panel[0] in counted]
    sizes = [(quantity, name) for quantity, name in GROUP_SIZES if quantity in counted]
    used = len(shown) + bool(sizes)  # panels before the one of particles
    rows = -(-(used + 1) // 3)
    figure, panels = plt.subplots(rows, 3, figsize=(13.0, 4.0 * rows), squeeze=False, gridspec_kw={"hspace": 0.35, "wspace": 0.28})
    flat = list(panels.flat)
    for (quantity, label, per_particle), axes in zip(shown, flat):
        draw_histogram(axes, *histograms[quantity], 1.0 / (paths[0]["particles"] or 1) if per_particle else 1.0, label, BLUE)
    for (quantity, name), (colour, _) in zip(sizes, PAIR_STYLES):
        draw_histogram(flat[len(shown)], *histograms[quantity], 1.0, "group size $s$", colour, name)
    draw_path_lengths(flat[used], ratios, result.get("model"))
    for axes in flat[used + 1:]:
        axes.set_visible(False)
    for row in panels:
        row[0].set_ylabel("share of steps")
    flat[used].set_ylabel("density")
    parts = [*system_parts(result, temperature, paths[0]["particles"]), f"{path_method(paths[0])} method",
             f"{len(paths)} path{'s' * (len(paths) > 1)}"]
    figure.suptitle(",  ".join(parts), y=0.95 if rows > 1 else 1.0, fontsize=15)
    save(figure, folder / "statistics.png")
