"""What all figures share: reading of tables, style, axes and titles. Importing this module configures matplotlib."""

import csv
import json
import tomllib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter, NullLocator

from unusable import Unusable

# The palette of Okabe and Ito: people with colour-vision deficiencies can distinguish these colours.
BLUE, VERMILLION, GREEN, PURPLE, ORANGE, SKY_BLUE, GREY = "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#595959"
PAIR_STYLES = [(BLUE, "-"), (VERMILLION, "--"), (GREEN, "-."), (PURPLE, ":"), (ORANGE, "-"), (SKY_BLUE, "--")]
MODEL_NAMES = {"kob-andersen": "Kob-Andersen", "lennard-jones": "Lennard-Jones", "hard-sphere": "Hard spheres",
               "hard-sphere-binary": "Binary hard spheres"}
DENSITY = r"density $\rho\;\;[\sigma^{-3}]$"

plt.rcParams.update({
    "font.size": 13, "axes.labelsize": 14, "axes.titlesize": 15, "legend.fontsize": 12, "xtick.labelsize": 12, "ytick.labelsize": 12,
    "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False, "savefig.dpi": 150, "lines.linewidth": 2.0,
    "mathtext.fontset": "dejavusans", "axes.linewidth": 1.0,
})


def read_text(file):
    """The text of a file. Raises Unusable if there is none."""
    try:
        return file.read_text()
    except (OSError, UnicodeDecodeError) as error:
        raise Unusable(f"{file}: {getattr(error, 'strerror', None) or 'not a text file'}") from error


def read_result(folder):
    """The object in result.json. Raises Unusable if there is none."""
    if not folder.is_dir():
        raise Unusable(f"{folder}: no such folder")
    file = folder / "result.json"
    try:
        result = json.loads(read_text(file))
    except json.JSONDecodeError as error:
        raise Unusable(f"{file}: line {error.lineno}: not JSON: {error.msg}") from error
    if not isinstance(result, dict):
        raise Unusable(f"{file}: not a JSON object")
    return result


def read_run_file(folder):
    """The options in run.toml; an empty dictionary if there is no such file."""
    file = folder / "run.toml"
    if not file.exists():
        return {}
    try:
        return tomllib.loads(read_text(file))
    except tomllib.TOMLDecodeError as error:
        raise Unusable(f"{file}: not TOML: {error}") from error


def particles_of(file):
    """The number of particles in the first line of an extended XYZ file; None if it is unknown."""
    if not file.exists():
        return None
    with open(file) as lines:
        first = lines.readline().strip()
    return int(first) if first.isdigit() else None


def read_table(file, required, text=("phase",)):
    """Columns by name, as arrays of numbers; columns in `text` stay strings. Raises Unusable if a required column is missing."""
    reader = csv.DictReader(read_text(file).splitlines())
    header, rows = reader.fieldnames or [], list(reader)
    missing = [name for name in required if name not in header]
    if missing:
        raise Unusable(f"{file}: no column {missing[0]}")
    try:
        return {name: np.array([row[name] if name in text else float(row[name]) for row in rows]) for name in header}
    except (TypeError, ValueError) as error:
        raise Unusable(f"{file}: not a table of numbers: {error}") from error


def running(values, statistic, windows=50):
    """A statistic over a sliding window of 1/windows of the series. The window is shorter at both ends."""
    half = max(0, len(values) // (2 * windows))
    padded = np.pad(np.asarray(values, float), half, constant_values=np.nan)
    return statistic(np.lib.stride_tricks.sliding_window_view(padded, 2 * half + 1), axis=1)


def draw_series(axes, x, y, colour, statistic=np.nanmedian, label=None, windows=50):
    """The raw series as a light line, and its running statistic. A series of one or two points gets markers."""
    marker = "o" if len(x) < 3 else None
    axes.plot(x, y, color=colour, alpha=0.3, linewidth=0.8)
    axes.plot(x, running(y, statistic, windows), color=colour, marker=marker, label=label)


def shades(count):
    """Colours for ordered values, from dark to light."""
    return [plt.get_cmap("viridis")(x) for x in np.linspace(0.0, 0.85, max(2, count))][:count]


def decade_ticks(axis, count):
    """At most about `count` ticks, at powers of ten."""
    axis.set_major_locator(LogLocator(numticks=count))
    axis.set_minor_locator(NullLocator())


def logarithmic(axis, between=True):
    """A logarithmic axis with plain numbers at powers of ten, and with `between` also at 2 and 5 times them."""
    (axis.axes.set_xscale if axis.axis_name == "x" else axis.axes.set_yscale)("log")
    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if between else (1.0,), numticks=15))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_locator(NullLocator())
    axis.set_minor_formatter(NullFormatter())


def legend_above(axes, columns=4, handle=1.6, gap=1.4):
    """A legend above the panel, where it cannot cover data."""
    if axes.get_legend_handles_labels()[0]:
        axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncol=columns, borderaxespad=0.0, borderpad=0.3,
                    handlelength=handle, columnspacing=gap)


def legend_beside(axes, handles):
    """A legend to the right of the panel."""
    axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.02, 1.0), borderaxespad=0.0)


def letter(axes, text):
    """The title of a panel, which starts with its letter."""
    axes.set_title(text, loc="left", fontsize=13, pad=8.0)


def title(figure, parts, above=0.42):
    """The title of a figure, `above` inches above its panels."""
    figure.suptitle(",  ".join(parts), y=figure.subplotpars.top + above / figure.get_figheight(), va="bottom", fontsize=15)


def save(figure, file):
    figure.savefig(file, bbox_inches="tight", pad_inches=0.15)
    plt.close(figure)


def system_parts(result, temperature, particles):
    """Model, state and number of particles for a title, as far as they are known."""
    model = result.get("model", "")
    parts = [MODEL_NAMES.get(model, model)] if model else []
    packing = result.get("packing_fraction") or result.get("endpoints", {}).get("packing_fraction")
    if packing is not None:
        parts.append(rf"$\phi={packing:.4g}$")
    elif temperature is not None:
        parts.append(f"$T={temperature:g}$")
    return parts + ([f"$N={particles}$"] if particles else [])


def species_name(symbol, model):
    """The name of a species in the literature on its model."""
    return {"kob-andersen": {"Ni": "A", "P": "B"}}.get(model, {}).get(symbol, symbol)
