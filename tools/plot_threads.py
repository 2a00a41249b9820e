"""The figure of strong scaling of plot_bench.py."""

import math
import statistics

from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from bench_figures import MARKERS, PEER_COLOURS, in_order, panel_title, panels_of, particle_number, plain_numbers, shared_legend
from plot_style import GREY, plt, save


def fastest_peers(rows):
    """Of each code the variant that is fastest at one core, at the size that is nearest to 32000 particles. (label, rows) by code."""
    chosen = {}
    for code in in_order([row["code"] for row in rows]):
        of_code = [row for row in rows if row["code"] == code]
        size = min({row["particles"] for row in of_code}, key=lambda n: abs(math.log(n / 32000)))
        single = [row for row in of_code if row["particles"] == size and row["threads"] == 1]
        if single:
            variant = min(single, key=lambda row: statistics.median(row["samples"]))["variant"]
            label = f"{code} {variant}, N = {particle_number(size)}"
            chosen[label] = [row for row in of_code if (row["particles"], row["variant"]) == (size, variant)]
    return chosen


def thread_series(points, peers, isa):
    """Lines of one panel: (label, threads, median times), each from one thread on, ours by size."""
    series = {f"Lanescape{f' {isa}' if isa else ''}, N = {particle_number(n)}": [p for p in points if p["particles"] == n]
              for n in sorted({p["particles"] for p in points})}
    series |= fastest_peers(peers)
    lines = []
    for label, rows in series.items():
        times = {row["threads"]: statistics.median(row["samples"]) for row in sorted(rows, key=lambda row: row["threads"])}
        if 1 in times and len(times) > 1:
            lines.append((label, list(times), list(times.values())))
    return lines


def whole_numbers(axis, numbers):
    axis.set_major_locator(FixedLocator(numbers))
    axis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))
    axis.set_minor_locator(NullLocator())


def thread_rows(points, peers, isa):
    """The title and the lines of each row: a liquid's forces or steps."""
    rows = []
    for model, case in (panel for panel in panels_of(points) if panel[1] in ("force", "step")):
        own = [p for p in points if (p["model"], p["case"]) == (model, case)]
        theirs = [row for row in peers if row["case"] == case and row["model"] == (model or peers[0]["model"])]
        lines = thread_series(own, theirs, isa)
        if lines:
            rows.append((panel_title(model, case).replace("\n", " "), lines))
    return rows


def styles_of(rows):
    """How each label is drawn: ours in shades of blue by size, peers in colours of their own, dashed."""
    labels = in_order([label for _, lines in rows for label, _, _ in lines])
    own = [label for label in labels if label.startswith("Lanescape")]
    colours = {label: plt.get_cmap("Blues")(0.95 - 0.5 * k / max(1, len(own) - 1)) for k, label in enumerate(own)}
    for k, label in enumerate(label for label in labels if label not in colours):
        colours[label] = PEER_COLOURS[k % len(PEER_COLOURS)]
    return {label: {"color": colours[label], "label": label, "marker": MARKERS[k % len(MARKERS)],
                    "linestyle": "-" if label in own else "--", "markerfacecolor": "white", "markeredgewidth": 1.8}
            for k, label in enumerate(labels)}


def draw_row(time_axes, speed_axes, lines, styles):
    for label, threads, times in lines:
        time_axes.plot(threads, times, **styles[label])
        speed_axes.plot(threads, [times[0] / t for t in times], **styles[label])
    counts = sorted({count for _, threads, _ in lines for count in threads})
    ideal = {"color": GREY, "linewidth": 1.2, "linestyle": ":", "label": "Ideal"}
    for single in (min(times[0] for _, _, times in lines), max(times[0] for _, _, times in lines)):
        time_axes.plot(counts, [single / count for count in counts], **ideal)
    speed_axes.plot(counts, counts, **ideal)
    time_axes.set_yscale("log")
    plain_numbers(time_axes.yaxis)
    speed_axes.set_yscale("log", base=2)
    whole_numbers(speed_axes.yaxis, counts)
    for axes in (time_axes, speed_axes):
        axes.set_xscale("log", base=2)
        whole_numbers(axes.xaxis, counts)
        axes.set_xlim(0.85 * counts[0], counts[-1] / 0.85)
        axes.set_xlabel("Cores")
    time_axes.set_ylabel("Time per particle [ns]")
    speed_axes.set_ylabel("Speed-up")


def draw_threads(file, points, peers, isa):
    """Strong scaling: a row of two panels, time and speed-up, for each liquid and case. Nothing without several numbers of threads."""
    rows = thread_rows(points, peers, isa)
    if not rows:
        return
    figure, grid = plt.subplots(len(rows), 2, figsize=(11.0, 4.2 * len(rows)), squeeze=False, layout="constrained")
    styles = styles_of(rows)
    for (time_axes, speed_axes), (name, lines) in zip(grid, rows):
        draw_row(time_axes, speed_axes, lines, styles)
        time_axes.set_title(name, loc="left")
    shared_legend(figure, grid.flat, 3)
    save(figure, file)
