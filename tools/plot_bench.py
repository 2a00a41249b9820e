#!/usr/bin/python3
"""Draw the benchmark of neighbour lists: tools/plot_bench.py BENCH.json [--peers PEERS.json] --out DIR

BENCH.json is the JSON that Google Benchmark writes for bench_lists at several sizes, with or without repetitions. PEERS.json is the JSON
that bench/peers/report.py or one of the drivers beside it writes. Writes into DIR:
  scaling.png    time per particle (counter ns_per_particle) against the number of particles, a panel for each case, peers included
  threads.png    strong scaling: time per particle and speed-up of forces and steps against the number of cores, a line for each size, peers
                 by their fastest variant, and the ideal. Only where there are results for one thread and for more
  roofline.png   speed against arithmetic intensity with the measured peak and memory bandwidth of a core, from the counters flops_per_byte
                 and gflops (of all threads) and the context peak_gflops and memory_gb_per_second (of one core). Without these counters it
                 shows the share of the measured peak (fraction_of_peak) against the number of particles. Without that counter it is not drawn
  peers.png      time of the peers over time of Lanescape, by case and size; only with --peers

The figures show the widest instruction set in the file. Points are medians of repetitions, bars their range.
Exit status: 0; or 2 with one line on stderr if input is missing or cannot be read. Then nothing is drawn.
"""

import math
import statistics
import sys
from pathlib import Path

import numpy as np
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from bench_figures import (CASE_NAMES, PEER_COLOURS, bandwidth_of, cores, in_order, panel_title, panels_of, particle_number, peak_of,
                           plain_numbers, read_bench, read_peers, shared_legend, style_of, threads_of)
from benchmark_results import MODELS, Arguments
from plot_style import BLUE, GREEN, GREY, ORANGE, PURPLE, SKY_BLUE, VERMILLION, plt, save
from plot_threads import draw_threads
from unusable import Unusable, exit_status

plt.rcParams.update({"axes.titlesize": 14, "lines.markersize": 7})


def draw_line(axes, rows, colour, label, style):
    """Medians against N with bars for the range of the repetitions."""
    rows = sorted(rows, key=lambda row: row["particles"])
    x, samples = [row["particles"] for row in rows], [row["samples"] for row in rows]
    y = np.array([statistics.median(s) for s in samples])
    bars = np.array([[m - min(s), max(s) - m] for m, s in zip(y, samples)]).T
    axes.errorbar(x, y, yerr=bars, color=colour, label=label, capsize=3, elinewidth=1.0, markerfacecolor="white", markeredgewidth=1.8, **style)


def particle_axis(axes, sizes):
    """A logarithmic axis with ticks at the sizes, or at every second size if they are close."""
    sizes = sorted(set(sizes))
    axes.set_xscale("log")
    axes.set_xlim(sizes[0] / 1.6, sizes[-1] * 1.6)
    decades = np.diff(np.log10(sizes)).min() if len(sizes) > 1 else 1.0
    axes.xaxis.set_major_locator(FixedLocator(sizes if decades > 0.25 else sizes[::2]))
    axes.xaxis.set_major_formatter(FuncFormatter(particle_number))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.set_xlabel("Particles $N$")


def draw_scaling(file, points, peers, isa):
    panels = panels_of(points)
    columns = min(3, len(panels))
    rows = math.ceil(len(panels) / columns)
    figure, grid = plt.subplots(rows, columns, figsize=(max(7.0, 4.6 * columns), 4.4 * rows), squeeze=False, layout="constrained")
    for axes in grid.flat[len(panels):]:
        axes.set_visible(False)
    threads = threads_of(points + peers)
    codes = in_order([(row["code"], row["variant"]) for row in peers])
    for axes, (model, case) in zip(grid.flat, panels):
        own = [p for p in points if (p["model"], p["case"]) == (model, case)]
        # Names without a model: the liquid is the first one in the file of peers.
        theirs = [row for row in peers if row["case"] == case and row["model"] == (model or peers[0]["model"])]
        for t in threads:
            mine = [p for p in own if p["threads"] == t]
            if mine:
                draw_line(axes, mine, BLUE, f"Lanescape {isa or ''}, {cores(t)}".replace(" ,", ","), style_of(t, threads))
            for k, code in enumerate(codes):
                rows_of_code = [row for row in theirs if row["threads"] == t and (row["code"], row["variant"]) == code]
                if rows_of_code:
                    draw_line(axes, rows_of_code, PEER_COLOURS[k % len(PEER_COLOURS)], f"{' '.join(code)}, {cores(t)}", style_of(t, threads))
        particle_axis(axes, [row["particles"] for row in own + theirs])
        times = [x for row in own + theirs for x in row["samples"]]
        if max(times) > 5.0 * min(times):
            axes.set_yscale("log")
            axes.set_ylim(min(times) / 1.5, max(times) * 1.5)
            plain_numbers(axes.yaxis)
        else:
            axes.set_ylim(bottom=0.0)
        axes.set_title(panel_title(model, case), loc="left")
    for axes in grid[:, 0]:
        axes.set_ylabel("Time per particle [ns]")
    shared_legend(figure, grid.flat, max(2, 1 + len(codes)))
    save(figure, file)


def draw_speeds(axes, points):
    """A marker for each benchmark: colours stand for liquids and cases, markers for numbers of cores, as the legend says."""
    threads, panels = threads_of(points), panels_of(points)
    colours = (BLUE, VERMILLION, GREEN, PURPLE, ORANGE, SKY_BLUE, "#000000", GREY)
    for k, (model, case) in enumerate(panels):
        colour = colours[k % len(colours)]
        axes.plot([], [], color=colour, marker="s", linestyle="none", label=panel_title(model, case).replace("\n", " "))
        for t in threads:
            chosen = [p for p in points if (p["model"], p["case"], p["threads"]) == (model, case, t)]
            axes.plot([p["flops_per_byte"] for p in chosen], [p["gflops"] / t for p in chosen], color=colour, markerfacecolor="white",
                      markeredgewidth=1.8, marker=style_of(t, threads)["marker"], linestyle="none")
    for t in threads:
        axes.plot([], [], color=GREY, markerfacecolor="white", markeredgewidth=1.8, marker=style_of(t, threads)["marker"], linestyle="none",
                  label=cores(t))


def draw_roofline(file, points, roof, isa):
    """Speed against arithmetic intensity, under the measured peak and the slope of the memory bandwidth, as far as they are known."""
    peak, bandwidth = roof
    figure, axes = plt.subplots(figsize=(8.5, 5.6), layout="constrained")
    draw_speeds(axes, points)
    intensities = [p["flops_per_byte"] for p in points]
    low, high = min(intensities) / 3.0, max(intensities) * 3.0
    if peak and bandwidth:
        high = max(high, 2.0 * peak / bandwidth)  # the ridge is in the figure
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlim(low, high)
    speeds = [p["gflops"] / p["threads"] for p in points] + ([peak] if peak else [])
    if bandwidth:
        ridge = min(high, peak / bandwidth) if peak else high
        axes.plot([low, ridge], [bandwidth * low, bandwidth * ridge], color=GREY, linewidth=1.5, linestyle="--",
                  label=f"Measured memory bandwidth: {bandwidth:.3g} GB/s")
        speeds.append(bandwidth * low)
    if peak:
        axes.plot([max(low, peak / bandwidth) if bandwidth else low, high], [peak, peak], color=GREY, linewidth=1.5,
                  label=f"Measured peak{f' ({isa})' if isa else ''}: {peak:.3g} GFLOP/s")
    axes.set_ylim(min(speeds) / 2.0, max(speeds) * 1.5)
    plain_numbers(axes.xaxis)
    plain_numbers(axes.yaxis)
    axes.set_xlabel("Arithmetic intensity [FLOP/byte]")
    axes.set_ylabel("Speed per core [GFLOP/s]")
    shared_legend(figure, [axes], 2)
    save(figure, file)


def draw_fraction(file, points, isa):
    figure, axes = plt.subplots(figsize=(8.5, 5.2), layout="constrained")
    threads = threads_of(points)
    colours = (BLUE, VERMILLION, GREEN, PURPLE, ORANGE, GREY)
    for k, (model, case) in enumerate(panels_of(points)):
        for t in threads:
            chosen = [p for p in points if (p["model"], p["case"], p["threads"]) == (model, case, t)]
            if chosen:
                draw_line(axes, [{**p, "samples": [100.0 * p["fraction_of_peak"]]} for p in chosen], colours[k % len(colours)],
                          panel_title(model, case).replace("\n", " ") + f", {cores(t)}", style_of(t, threads))
    particle_axis(axes, [p["particles"] for p in points])
    axes.set_ylim(bottom=0.0)
    axes.set_ylabel(f"Share of the measured peak{f' of {isa}' if isa else ''} [%]")
    shared_legend(figure, [axes], 2)
    save(figure, file)


def draw_peers(file, peers):
    """A panel for each liquid and number of threads, a group of bars for each case and size."""
    rows = [row for row in peers if row.get("ratio") is not None]
    models, threads = in_order([row["model"] for row in rows], tuple(MODELS)), threads_of(rows)
    codes = in_order([(row["code"], row["variant"]) for row in rows])
    present = [(m, t) for m in models for t in threads if any((row["model"], row["threads"]) == (m, t) for row in rows)]
    figure, grid = plt.subplots(len(present), 1, figsize=(11.0, 1.0 + 3.0 * len(present)), squeeze=False, layout="constrained")
    top = 1.15 * max(row["ratio"] for row in rows)
    for axes, (model, t) in zip(grid[:, 0], present):
        chosen = [row for row in rows if (row["model"], row["threads"]) == (model, t)]
        groups = [(c, n) for c in in_order([row["case"] for row in chosen], tuple(CASE_NAMES))
                  for n in sorted({row["particles"] for row in chosen if row["case"] == c})]
        width = 0.8 / len(codes)
        places, place, last = {}, 0.0, None
        for group in groups:
            place += 0.0 if last is None else 1.0 if group[0] == last else 1.6  # a gap between cases
            places[group], last = place, group[0]
        for k, code in enumerate(codes):
            for row in (row for row in chosen if (row["code"], row["variant"]) == code):
                x = places[row["case"], row["particles"]] + (k - 0.5 * (len(codes) - 1)) * width
                axes.bar(x, row["ratio"], 0.92 * width, color=PEER_COLOURS[k % len(PEER_COLOURS)], label=" ".join(code))
                axes.annotate(f"{row['ratio']:.1f}", (x, row["ratio"]), ha="center", va="bottom", fontsize=10)
        axes.axhline(1.0, color=GREY, linewidth=1.2, linestyle="--", label="Lanescape")
        axes.set_xticks(list(places.values()), [particle_number(n) for _, n in groups])
        for case in dict.fromkeys(c for c, _ in groups):
            middle = statistics.mean(x for (c, _), x in places.items() if c == case)
            axes.annotate(CASE_NAMES.get(case, case), (middle, 0.0), (0, -24), xycoords=("data", "axes fraction"), textcoords="offset points",
                          ha="center", va="top", fontsize=12)
        axes.set_xlim(-0.6, place + 0.6)
        axes.tick_params(axis="x", length=0)
        axes.set_ylim(0.0, top)
        axes.set_ylabel("Time of peer /\ntime of Lanescape")
        axes.set_title(f"{MODELS.get(model, model)}, {cores(t)}", loc="left")
    grid[-1, 0].set_xlabel("Particles $N$", labelpad=26.0)
    figure.get_layout_engine().set(hspace=0.06)
    shared_legend(figure, grid[:, 0], 5)
    save(figure, file)


def draw(options):
    context, points, isa = read_bench(options.bench)
    peers = read_peers(options.peers) if options.peers else []
    try:
        options.out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise Unusable(f"{options.out}: {error.strerror}") from error
    draw_scaling(options.out / "scaling.png", points, peers, isa)
    draw_threads(options.out / "threads.png", points, peers, isa)
    roof = [point for point in points if "flops_per_byte" in point and "gflops" in point]
    shares = [point for point in points if "fraction_of_peak" in point]
    if roof:
        draw_roofline(options.out / "roofline.png", roof, (peak_of(context, isa), bandwidth_of(context)), isa)
    elif shares:
        draw_fraction(options.out / "roofline.png", shares, isa)
    if any(row.get("ratio") is not None for row in peers):
        draw_peers(options.out / "peers.png", peers)


def main(arguments):
    parser = Arguments(prog="plot_bench.py", description="Draws the benchmark of neighbour lists; the head of this file describes them.")
    parser.add_argument("bench", metavar="BENCH.json")
    parser.add_argument("--peers", metavar="PEERS.json", help="of bench/peers/report.py or a driver")
    parser.add_argument("--out", metavar="DIR", type=Path, required=True, help="the folder of the figures")
    return exit_status("plot_bench.py", lambda: draw(parser.parse_args(arguments)))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
