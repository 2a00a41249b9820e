"""Figure of `lanescape slab`: the density along z, and beneath it the mean probability of each state of the sites there."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7")  # Okabe and Ito
FEW = 20  # sites in a bin, all samples together: a mean of fewer says little


def draw_slab(folder, profiles):
    """Write profiles.png from the columns of profiles.csv."""
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
    figure.savefig(folder / "profiles.png", dpi=150)
    plt.close(figure)
