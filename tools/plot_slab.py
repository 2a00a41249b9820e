"""The figure of `lanescape slab` for tools/plot.py: profiles.png."""

import numpy as np

from plot_style import BLUE, GREEN, GREY, PURPLE, VERMILLION, plt, read_table

COLOURS = (BLUE, VERMILLION, GREEN, PURPLE)
FEW = 20  # sites in a bin, over all samples: a mean over fewer is too noisy


def read_slab(folder):
    """The table of profiles, or None if there is none."""
    file = folder / "profiles.csv"
    return read_table(file, ["z", "density", "sites"]) if file.exists() else None


def draw_slab(folder, profiles):
    """Density along z, and below it the mean probability of each state of the sites."""
    figure, (upper, lower) = plt.subplots(2, 1, sharex=True, figsize=(6.4, 5.2), layout="constrained")
    z = profiles["z"]
    upper.plot(z, profiles["density"], color=GREY)
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
    figure.savefig(folder / "profiles.png", dpi=150)
    plt.close(figure)
