"""The figure of growth at constant energy for tools/plot.py: densification.png."""

import numpy as np

import equation_of_state
from plot_style import DENSITY, GREY, SKY_BLUE, VERMILLION, letter, plt, save, title
from unusable import Unusable

# The equations mostly agree. The first line is wide and the last is dashed, so all three stay visible.
EQUATION_STYLES = {"johnson": {"label": "Johnson et al.", "color": SKY_BLUE, "linewidth": 6.0, "alpha": 0.5},
                   "kolafa-nezbeda": {"label": "Kolafa, Nezbeda", "color": VERMILLION},
                   "thol": {"label": "Thol et al.", "color": "black", "linestyle": (0, (3, 3))}}


def processes(table, run):
    """Equations of state at constant energy, from the density and temperature of the first row, by name.

    They describe the full Lennard-Jones potential. Other models and cutoffs without tail correction have none.
    """
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
            continue  # outside its range
    return lines


def draw_densification(folder, table, system, run):
    """Energy, pressure, temperature and excess energy against density. Nothing is drawn for a table without rows."""
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
