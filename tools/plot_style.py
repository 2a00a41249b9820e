"""What the figures of a run's folder share: reading, style and titles. Importing it sets matplotlib up."""

import csv
import json
import tomllib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

# Okabe and Ito, told apart with every common colour vision.
BLUE, VERMILLION, GREEN, PURPLE, GREY = "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#595959"
PAIR_STYLES = [(BLUE, "-"), (VERMILLION, "--"), (GREEN, "-."), (PURPLE, ":"), ("#E69F00", "-"), ("#56B4E9", "--")]
MODEL_NAMES = {"kob-andersen": "Kob-Andersen", "lennard-jones": "Lennard-Jones", "hard-sphere": "Hard spheres",
               "hard-sphere-binary": "Binary hard spheres"}

plt.rcParams.update({
    "font.size": 13, "axes.labelsize": 14, "axes.titlesize": 15, "legend.fontsize": 12, "xtick.labelsize": 12, "ytick.labelsize": 12,
    "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False, "savefig.dpi": 150, "lines.linewidth": 2.0,
    "mathtext.fontset": "dejavusans", "axes.linewidth": 1.0,
})


class Unusable(Exception):
    """What is missing or unreadable, in one line."""


# ---- reading

def read_text(file):
    try:
        return file.read_text()
    except (OSError, UnicodeDecodeError) as error:
        raise Unusable(f"{file}: {getattr(error, 'strerror', None) or 'not a text file'}") from error


def read_result(folder):
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
    file = folder / "run.toml"
    if not file.exists():
        return {}
    try:
        return tomllib.loads(read_text(file))
    except tomllib.TOMLDecodeError as error:
        raise Unusable(f"{file}: not TOML: {error}") from error


def read_table(file, required, text=("phase",)):
    """Columns by name, as arrays of numbers; those in `text` stay what they are."""
    reader = csv.DictReader(read_text(file).splitlines())
    header, rows = reader.fieldnames or [], list(reader)
    missing = [name for name in required if name not in header]
    if missing:
        raise Unusable(f"{file}: no column {missing[0]}")
    try:
        return {name: np.array([row[name] if name in text else float(row[name]) for row in rows]) for name in header}
    except (TypeError, ValueError) as error:
        raise Unusable(f"{file}: not a table of numbers: {error}") from error


# ---- drawing

def legend_above(axes, columns=4, handle=1.6, gap=1.4):
    """A legend between the panels, where no data can be."""
    if axes.get_legend_handles_labels()[0]:
        axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncol=columns, borderaxespad=0.0, borderpad=0.3,
                    handlelength=handle, columnspacing=gap)


def letter(axes, text):
    axes.set_title(text, loc="left", fontsize=13, pad=8.0)


def save(figure, file):
    figure.savefig(file, bbox_inches="tight", pad_inches=0.15)
    plt.close(figure)


def system_parts(result, temperature, particles):
    """What a title says of the system, as far as it is known."""
    model = result.get("model", "")
    parts = [MODEL_NAMES.get(model, model)] if model else []
    packing = result.get("packing_fraction") or result.get("endpoints", {}).get("packing_fraction")
    if packing is not None:
        parts.append(rf"$\phi={packing:.4g}$")
    elif temperature is not None:
        parts.append(f"$T={temperature:g}$")
    return parts + ([f"$N={particles}$"] if particles else [])
