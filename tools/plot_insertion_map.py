"""A map of a probe's energy over a plane through the fluid, for tools/plot.py: figure 1 of [U]."""

import numpy as np
from matplotlib.lines import Line2D

from plot_style import BLUE, VERMILLION, legend_beside, letter, plt, save, title
from unusable import Unusable

COLUMNS = ("density", "temperature", "y", "z", "energy", "target")
MOST_PANELS = 4
LEVELS = 24  # colours between the lowest energy and the upper limit
ABOVE_TARGET = 4.0  # upper limit of the energies that are drawn, in |U0| above U0


class Map:
    """One state's energies on a square grid, [z, y]."""

    def __init__(self, table, rows, file):
        n = int(round(np.sqrt(np.count_nonzero(rows))))
        if n < 2 or n * n != np.count_nonzero(rows):
            raise Unusable(f"{file}: {np.count_nonzero(rows)} rows of one state are not a square grid")
        self.y, self.z, self.energy = (table[name][rows].reshape(n, n) for name in ("y", "z", "energy"))
        self.density, self.target = table["density"][rows][0], table["target"][rows][0]
        self.limit = self.target + ABOVE_TARGET * abs(self.target)

    def traps(self):
        """Points of the grid lower than their eight neighbours but above the target: a search on the plane would end there."""
        inner = self.energy[:-1, :-1]  # the last row and column repeat the first ones
        neighbours = [np.roll(inner, (a, b), (0, 1)) for a in (-1, 0, 1) for b in (-1, 0, 1) if (a, b) != (0, 0)]
        found = (inner < np.min(neighbours, axis=0)) & (inner > self.target) & (inner < self.limit)
        return self.y[:-1, :-1][found], self.z[:-1, :-1][found]


def read_maps(table, file):
    """The maps of a table, in the order of density and temperature. Energies that are not finite are left white."""
    if not np.isfinite(table["target"]).all():
        raise Unusable(f"{file}: target must be finite")
    states = sorted(set(zip(table["density"], table["temperature"])))
    return [Map(table, (table["density"] == density) & (table["temperature"] == temperature), file) for density, temperature in states]


def draw_one(axes, of):
    levels = np.linspace(np.nanmin([of.target, *of.energy.flat]), of.limit, LEVELS)
    axes.contourf(of.y, of.z, of.energy, levels, cmap="viridis")
    axes.contour(of.y, of.z, of.energy, [of.target], colors=[VERMILLION], linewidths=1.8)
    axes.plot(*of.traps(), "x", color="black", markersize=6)
    step = 0.1 * of.density**-1.5
    left, bottom = 0.04 * of.y.max(), 0.04 * of.z.max()
    axes.plot([left, left + step], [bottom, bottom], color=BLUE, linewidth=4.0, solid_capstyle="butt")
    axes.set_aspect("equal")
    axes.set_xlabel(r"$y\;\;[\sigma]$")


def draw_maps(folder, maps, system):
    """Regions of low energy in the plane x = 0, white where the energy is high, into insertion-map.png."""
    maps = [maps[k] for k in np.unique(np.linspace(0, len(maps) - 1, min(len(maps), MOST_PANELS)).astype(int))]
    columns = min(2, len(maps))
    rows = -(-len(maps) // columns)
    figure, panels = plt.subplots(rows, columns, squeeze=False, figsize=(6.2 * columns, 6.2 * rows))
    for axes in list(panels.flat)[len(maps):]:
        axes.set_visible(False)
    for axes, name, of in zip(panels.flat, "abcd", maps):
        draw_one(axes, of)
        letter(axes, rf"({name}) $\rho={of.density:g}$, $U_0={of.target:.3g}\,\epsilon$")
    for row in panels:
        row[0].set_ylabel(r"$z\;\;[\sigma]$")
    handles = [Line2D([], [], color=VERMILLION, label=r"$U=U_0$"),
               Line2D([], [], color="black", marker="x", linestyle="", label="traps: lowest points above it"),
               Line2D([], [], color=BLUE, linewidth=4.0, label=r"largest step, $0.1\,\rho^{-3/2}$")]
    legend_beside(panels[0, -1], handles)
    title(figure, [*system, "energy of one more particle at $x=0$"])
    save(figure, folder / "insertion-map.png")
