"""The figure of `lanescape shorten --method montecarlo` for tools/plot.py: shortening.png."""

import numpy as np
from matplotlib.ticker import MaxNLocator

from plot_style import BLUE, GREY, VERMILLION, legend_above, plt, read_table, save, system_parts, title


def read_trials(folder):
    """The table of trials, or None if there is none."""
    file = folder / "path-0001-trials.csv"
    return read_table(file, ["trial", "distance_to_goal", "length", "accepted"]) if file.exists() else None


def draw_shortening(folder, trials, result):
    """The length that each trial found and the shortest so far; the same lengths against the place of the changed configuration."""
    figure, (left, right) = plt.subplots(1, 2, sharey=True, figsize=(10.0, 5.4), layout="constrained")
    number, length, kept = trials["trial"], trials["length"], trials["accepted"] == 1
    shortest = np.minimum.accumulate(np.concatenate([[result["length_before"]], np.where(kept, length, np.inf)]))
    left.step(np.concatenate([[0], number]), shortest, where="post", color=BLUE, label="shortest so far")
    for axes, x in ((left, number), (right, trials["distance_to_goal"])):
        axes.plot(x[~kept], length[~kept], "o", color=GREY, fillstyle="none", label="longer: dropped")
        axes.plot(x[kept], length[kept], "o", color=VERMILLION, label="shorter: kept")
    left.xaxis.set_major_locator(MaxNLocator(integer=True))
    left.set_xlabel("trial")
    left.set_ylabel(r"path length  $g/\sigma$")
    right.set_xlabel(r"distance to the goal of what was changed  $[\sigma]$")
    legend_above(left)
    change = 100.0 * (1.0 - result["length"] / result["length_before"])
    title(figure, system_parts(result, None, None) + [f"{change:.3g} % shorter after {len(number)} trials"])
    save(figure, folder / "shortening.png")
