#!/usr/bin/python3
"""Draw the profiles of a slab: tools/plot_slab.py DIR

Reads DIR/profiles.csv as state_slab writes it and writes DIR/profiles.png: density along z, and beneath it the probability of each
state of the sites there. Exit status 0, or 2 with one line on stderr when the file is missing or cannot be read.
"""

import csv
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7")  # Okabe and Ito
FEW = 20  # sites in a bin, all samples together: a mean of fewer says little


def read(path):
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def draw(profiles, path):
    figure, (upper, lower) = plt.subplots(2, 1, sharex=True, figsize=(6.4, 5.2), layout="constrained")
    z = profiles["z"]
    upper.plot(z, profiles["density"], color="#595959")
    upper.set_ylabel(r"density  $\rho\sigma^3$")
    upper.set_ylim(bottom=0.0)
    enough = profiles["sites"] >= FEW
    states = [name for name in profiles if name.startswith("probability_")]
    for k, name in enumerate(states):
        lower.plot(z, np.where(enough, profiles[name], np.nan), color=COLOURS[k % len(COLOURS)], label=f"state {name[12:]}")
    lower.set_ylabel("mean state probability")
    lower.set_ylim(-0.03, 1.03)
    lower.set_xlabel(r"$z/\sigma$")
    lower.set_xlim(z[0], z[-1])
    lower.legend(frameon=False, loc="center left", bbox_to_anchor=(1.0, 0.5))
    for axes in (upper, lower):
        axes.spines[["top", "right"]].set_visible(False)
    figure.savefig(path, dpi=150)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__.splitlines()[0])
    folder = Path(sys.argv[1])
    try:
        profiles = read(folder / "profiles.csv")
        draw(profiles, folder / "profiles.png")
    except (OSError, KeyError, IndexError, ValueError) as error:
        print(f"plot_slab.py: {folder / 'profiles.csv'}: {error}: a table written by state_slab is needed", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
