"""The figures of `lanescape flow` for tools/plot.py: flow.png, flow-profiles.png, flow-balance.png, flow-insertions.png and wave.png."""

import warnings

import numpy as np

from plot_style import BLUE, DENSITY, GREEN, GREY, ORANGE, PURPLE, SKY_BLUE, VERMILLION, letter, plt, read_table, save

SLICES = 5  # shown of those next to the inlet
COLOURS = (BLUE, VERMILLION, GREEN, PURPLE, ORANGE)
INSERTIONS = 30  # in a bin of density
SNAPSHOTS = 4  # of a wave
QUANTITIES = (("density", DENSITY), ("velocity", r"velocity $v_x\;\;[\sqrt{\epsilon/m}]$"), ("temperature", r"temperature $T\;\;[\epsilon/k_B]$"),
              ("pressure", r"pressure $p\;\;[\epsilon/\sigma^3]$"))
TIME = r"time $t\;\;[\sigma\sqrt{m/\epsilon}]$"


def by_rows(table):
    """Times, middles of slices, and each column as an array of rows by slices."""
    times, x = np.unique(table["time"]), np.unique(table["x"])
    return times, x, {name: values.reshape(len(times), len(x)) for name, values in table.items()}


def read_flow(folder):
    """The tables of a flow by name, or None if there is none."""
    if not (folder / "flow.csv").exists():
        return None
    tables = {"flow": read_table(folder / "flow.csv", ["time", "x", *(name for name, _ in QUANTITIES)]),
              "balance": read_table(folder / "balance.csv", ["time", "particles", "energy_error", "momentum", "momentum_error"])}
    for name, columns in (("insertions", ["density", "evaluations"]), ("continuum", ["time", "x", "density"]),
                          ("alone", ["time", "x", "density"])):
        if (folder / f"{name}.csv").exists():
            tables[name] = read_table(folder / f"{name}.csv", columns, text=("face",))
    return tables


def draw_history(folder, times, x, values, run):
    """[U] figure 4: temperature, density and velocity against time, in slices next to the inlet and, where it has one, their mean."""
    inside = x > float(run.get("buffer", 0.0))
    shown = np.flatnonzero(inside)[:SLICES]
    figure, panels = plt.subplots(3, 1, sharex=True, figsize=(8.5, 10.0), layout="constrained")
    for panel, name, tag in zip(panels, ("temperature", "density", "velocity"), "abc"):
        for k, colour in zip(shown, COLOURS):
            panel.plot(times, values[name][:, k], color=colour, linewidth=1.0, alpha=0.8, label=rf"$x = {x[k]:.3g}\,\sigma$")
        if name != "density":
            panel.plot(times, np.nanmean(values[name][:, inside], axis=1), color="black", label="mean")
        panel.set_ylabel(dict(QUANTITIES)[name])
        panel.axvline(0.0, color=GREY, linewidth=0.8)
        letter(panel, f"({tag}) {name}")
    if "velocity" in run:
        panels[2].axhline(float(run["velocity"]), color=GREY, linestyle=":")
    panels[2].set_xlabel(TIME)
    panels[0].legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    save(figure, folder / "flow.png")


def draw_profiles(folder, times, x, values, run):
    """Means over the last quarter of the flow along the slab."""
    last = times > 0.75 * times[-1]
    figure, panels = plt.subplots(2, 2, sharex=True, figsize=(11.0, 7.5), layout="constrained")
    buffer = float(run.get("buffer", 0.0))
    for panel, (name, label), colour in zip(panels.flat, QUANTITIES, COLOURS):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", RuntimeWarning)  # slices without a number
            rows = values[name][last]
            mean, error = np.nanmean(rows, axis=0), np.nanstd(rows, axis=0) / np.sqrt(max(1, len(rows)))
        panel.errorbar(x, mean, error, color=colour, marker="o", markersize=3, linewidth=1.0)
        panel.set_ylabel(label)
        for low, high in ((0.0, buffer), (x[-1] + x[0] - buffer, x[-1] + x[0])):
            panel.axvspan(low, high, color=GREY, alpha=0.12, linewidth=0)
    for panel in panels[1]:
        panel.set_xlabel(r"$x\;\;[\sigma]$")
    save(figure, folder / "flow-profiles.png")


def draw_balance(folder, balance):
    """What is in the slab, and what the balances of energy and momentum miss."""
    figure, panels = plt.subplots(3, 1, sharex=True, figsize=(8.5, 9.0), layout="constrained")
    panels[0].plot(balance["time"], balance["particles"], color=BLUE)
    panels[0].set_ylabel("particles")
    flowing = balance["time"] > 0.0  # before, a thermostat is at work
    panels[1].plot(balance["time"][flowing], balance["energy_error"][flowing], color=VERMILLION)
    panels[1].set_ylabel("energy stored less passed,\nper particle" + r" $[\epsilon]$")
    panels[2].plot(balance["time"], balance["momentum"], color=GREEN, label="stored")
    panels[2].plot(balance["time"], balance["momentum"] - balance["momentum_error"], color="black", linestyle=":", label="at the start, and what passed the faces")
    panels[2].set_ylabel(r"momentum along $x$")
    panels[2].set_xlabel(TIME)
    panels[2].legend()
    for panel, text in zip(panels, ("(a) particles", "(b) error of the energy", "(c) momentum along x")):
        letter(panel, text)
    save(figure, folder / "flow-balance.png")


def draw_insertions(folder, insertions):
    """Evaluations of an insertion against the density where it was searched for, in bins of equal counts."""
    order = np.argsort(insertions["density"], kind="stable")
    groups = np.array_split(order, max(1, len(order) // INSERTIONS))
    density = [insertions["density"][group].mean() for group in groups]
    evaluations = [insertions["evaluations"][group].mean() for group in groups]
    error = [insertions["evaluations"][group].std() / np.sqrt(len(group)) for group in groups]
    figure, panel = plt.subplots(figsize=(7.0, 5.0), layout="constrained")
    panel.errorbar(density, evaluations, error, color=BLUE, marker="o", markersize=4, linestyle="none")
    panel.set_xlabel("density where particles are put in" + r" $[\sigma^{-3}]$")
    panel.set_ylabel(r"evaluations per insertion $n_f$")
    panel.set_ylim(bottom=0.0)
    save(figure, folder / "flow-insertions.png")


def draw_wave(folder, tables, run):
    """Density of the continua, of the slab between them and of the solver alone, at some times."""
    times, x, values = by_rows(tables["flow"])
    outside, alone = by_rows(tables["continuum"]), by_rows(tables["alone"])
    chosen = alone[0][np.linspace(0, len(alone[0]) - 1, SNAPSHOTS + 1).astype(int)[1:]]
    buffer, length = float(run.get("buffer", 0.0)), x[-1] + x[0]
    figure, panels = plt.subplots(SNAPSHOTS, 1, sharex=True, sharey=True, figsize=(9.5, 11.0), layout="constrained")
    for panel, time in zip(panels, chosen):
        inside = (x > buffer) & (x < length - buffer)
        panel.plot(alone[1], alone[2]["density"][alone[0] == time][0], color="black", linewidth=1.2, label="solver alone")
        for side in (outside[1] < 0.5 * length, outside[1] > 0.5 * length):
            panel.plot(outside[1][side], outside[2]["density"][outside[0] == time][0][side], color=BLUE, label="coupled continuum")
        panel.plot(x[inside], values["density"][times == time][0][inside], color=VERMILLION, marker="o", markersize=3, linestyle="none",
                   label="particles")
        panel.set_ylabel(DENSITY)
        panel.set_title(rf"$t = {time:.3g}$", loc="right")
    panels[-1].set_xlabel(r"$x\;\;[\sigma]$")
    handles, labels = panels[0].get_legend_handles_labels()
    known = dict(zip(labels, handles))
    panels[0].legend(known.values(), known.keys(), loc="upper right")
    save(figure, folder / "wave.png")


def draw_flow(folder, tables, run):
    """All figures of a flow. Nothing is drawn for a table without rows."""
    if len(tables["flow"]["time"]) == 0:
        return
    times, x, values = by_rows(tables["flow"])
    draw_history(folder, times, x, values, run)
    draw_profiles(folder, times, x, values, run)
    draw_balance(folder, tables["balance"])
    if len(tables.get("insertions", {}).get("density", ())) > 0:
        draw_insertions(folder, tables["insertions"])
    if "continuum" in tables and "alone" in tables:
        draw_wave(folder, tables, run)
