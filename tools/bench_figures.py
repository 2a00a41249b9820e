"""Shared by the figures of plot_bench.py: reading of results, names, colours and legends."""

import math
import statistics

from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from benchmark_results import ISAS, MODELS, parts_of, read_json, read_results, repetitions, value
from plot_style import GREEN, ORANGE, PURPLE, SKY_BLUE, VERMILLION
from unusable import Unusable

# Colours stand for codes, lines and markers for numbers of threads.
PEER_COLOURS = (VERMILLION, GREEN, PURPLE, ORANGE, SKY_BLUE, "#000000", "#8B5A2B")
MARKERS, LINES = ("o", "s", "^", "D", "v"), ("-", "--", "-.", ":", (0, (1, 3)))
CASE_NAMES = {"force": "Force", "force+energy+virial": "Force, energy and virial", "energy": "Energy", "step": "Molecular dynamics step"}


def read_bench(file):
    """The context, a point for each benchmark of the widest instruction set, and the name of that set.

    A point holds case, model, number of particles, threads, isa, samples [ns per particle] and the other counters.
    """
    data = read_results(file)
    points = []
    for name, entries in repetitions(data, file).items():
        parts = parts_of(name)
        if not isinstance(parts.get("N"), int):
            raise Unusable(f"{file}: {name}: no number of particles in the name (N:<number>)")
        point = {"case": parts["case"], "model": parts.get("model"), "particles": parts["N"], "threads": parts.get("threads", 1),
                 "isa": parts.get("isa"), "samples": [value(entry, "ns_per_particle", file) for entry in entries]}
        for counter in ("fraction_of_peak", "flops_per_byte", "gflops"):
            if all(counter in entry for entry in entries):
                point[counter] = statistics.median(value(entry, counter, file) for entry in entries)
        points.append(point)
    isas = [point["isa"] for point in points]
    best = next((isa for isa in ISAS if isa in isas), None)
    return data.get("context", {}), [point for point in points if point["isa"] == best], best


def read_peers(file):
    """The rows of other codes, checked."""
    report = read_json(file)
    rows = report.get("results") if isinstance(report, dict) else None
    if not isinstance(rows, list) or not rows:
        raise Unusable(f"{file}: no list 'results' of peers in it")
    for row in rows:
        for key, kind in (("case", str), ("model", str), ("particles", int), ("threads", int), ("code", str), ("variant", str),
                          ("samples", list)):
            if not isinstance(row, dict) or not isinstance(row.get(key), kind):
                raise Unusable(f"{file}: a result without {key}")
        if not row["samples"] or not all(isinstance(x, (int, float)) and math.isfinite(x) and x > 0 for x in row["samples"]):
            raise Unusable(f"{file}: {row['code']} {row['variant']}, N = {row['particles']}: times must be finite numbers above 0")
        ratio = row.get("ratio")
        if ratio is not None and not (isinstance(ratio, (int, float)) and math.isfinite(ratio) and ratio > 0):
            raise Unusable(f"{file}: {row['code']} {row['variant']}, N = {row['particles']}: the ratio must be a number above 0, or null")
    return [row for row in rows if row["code"] != "lanescape"]


def peak_of(context, isa):
    """Measured peak of one core [GFLOP/s] from the context: `peak_gflops`, or for example `peak avx2`. None if there is none."""
    try:
        peak = float(str(context.get("peak_gflops", context.get(f"peak {isa}", ""))).split()[0])
    except (ValueError, IndexError):
        return None
    return peak if math.isfinite(peak) and peak > 0 else None


def bandwidth_of(context):
    """Measured memory bandwidth of one core [GB/s] from the context. None if there is none."""
    try:
        bandwidth = float(context.get("memory_gb_per_second", ""))
    except (TypeError, ValueError):
        return None
    return bandwidth if math.isfinite(bandwidth) and bandwidth > 0 else None


def in_order(values, first=()):
    """The values without repetition: those in `first` in its order, then the others in theirs."""
    return sorted(dict.fromkeys(values), key=lambda v: first.index(v) if v in first else len(first))


def threads_of(rows):
    return sorted({row["threads"] for row in rows})


def style_of(threads, all_threads):
    k = all_threads.index(threads) % len(MARKERS)
    return {"marker": MARKERS[k], "linestyle": LINES[k]}


def cores(count):
    """The number of cores for a legend: one for each thread or process."""
    return f"{count} core{'s' if count > 1 else ''}"


def particle_number(n, _=None):
    return f"{n:g}" if n < 10_000 else f"{n / 1000:g}k" if n < 1_000_000 else f"{n / 1e6:.2g}M"


def plain_numbers(axis):
    """Labels 1, 2, 5, 10, ... on a logarithmic axis."""
    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0), numticks=30))
    axis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))
    axis.set_minor_formatter(NullFormatter())


def shared_legend(figure, axes_list, columns):
    """One legend for all panels, above them. Labels of the same code stand together, because columns are filled first."""
    found = {}
    for axes in axes_list:
        for handle, label in zip(*axes.get_legend_handles_labels()):
            found.setdefault(label, handle)
    order = in_order([label.split(",")[0] for label in found])
    found = dict(sorted(found.items(), key=lambda item: order.index(item[0].split(",")[0])))
    figure.legend(found.values(), found.keys(), loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=min(columns, len(found)),
                  borderaxespad=0.2, handlelength=2.6)


def panels_of(points):
    """The (model, case) of each panel. The model is None if the names of the benchmarks do not contain it."""
    models = in_order([point["model"] for point in points], tuple(MODELS))
    cases = in_order([point["case"] for point in points], tuple(CASE_NAMES))
    present = {(point["model"], point["case"]) for point in points}
    return [(m, c) for m in models for c in cases if (m, c) in present]


def panel_title(model, case):
    name = CASE_NAMES.get(case, case)
    return f"{MODELS[model]}:\n{name}" if model else name
