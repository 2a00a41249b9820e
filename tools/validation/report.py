#!/usr/bin/python3
"""Tables of docs/VALIDATION.md from the folder that the Snakefile beside this fills."""

import json
import math
import statistics
import sys
from pathlib import Path
from typing import NamedTuple

TEMPERATURES = [1, 2, 3, 4, 5]


class Variant(NamedTuple):
    label: str
    particles: int
    images: str
    method: str
    step: float
    pairs: int


# What is run, for the Snakefile too.
VARIANTS = {
    "minimum-108": Variant("contour, minimum image, N = 108", 108, "minimum", "contour", 1e-3, 10),
    "all-108": Variant("contour, all images, N = 108", 108, "all", "contour", 1e-3, 10),
    "escape-108": Variant("escape, minimum image, N = 108", 108, "minimum", "escape", 1e-3, 10),
    "coarse-108": Variant("contour, step 0.01", 108, "minimum", "contour", 1e-2, 10),
    "fine-108": Variant("contour, step 0.0001", 108, "minimum", "contour", 1e-4, 2),
    "all-256": Variant("contour, all images, N = 256", 256, "all", "contour", 1e-3, 5),
}
# Seconds per path in [C]'s table 1 (contour, escape).
SOURCE_SECONDS = {5: (750, 12000), 4: (800, 12000), 3: (850, 12000), 2: (900, 13000), 1: (1100, 15000)}


def load(folder, variant, temperature):
    return json.loads((folder / f"paths-{variant}-T{temperature}.json").read_text())["paths"]


def mean_and_error(values):
    error = statistics.stdev(values) / math.sqrt(len(values)) if len(values) > 1 else float("nan")
    return statistics.mean(values), error


def cell(values, digits):
    mean, error = mean_and_error(values)
    return f"{mean:.{digits}f} ± {error:.{digits}f}"


def table(folder, title, value, digits):
    print(f"### {title}\n")
    print("| | " + " | ".join(f"T = {t}" for t in TEMPERATURES) + " |")
    print("|---" * (len(TEMPERATURES) + 1) + "|")
    for variant, (label, *_) in VARIANTS.items():
        cells = [cell([value(p) for p in load(folder, variant, t)], digits) for t in TEMPERATURES]
        print(f"| {label} ({len(load(folder, variant, 1))} pairs) | " + " | ".join(cells) + " |")
    print()


def times(folder):
    print("### Seconds per path (N = 108, step 0.001)\n")
    print("| T | contour | escape | source, contour | source, escape |\n|---|---|---|---|---|")
    for t in TEMPERATURES:
        contour = statistics.mean(p["seconds"] for p in load(folder, "minimum-108", t))
        escape = statistics.mean(p["seconds"] for p in load(folder, "escape-108", t))
        source = SOURCE_SECONDS[t]
        print(f"| {t} | {contour:.2f} | {escape:.2f} | {source[0]} | {source[1]} |")
    print()


def same_pairs(folder):
    print("### Escape against contour, pair by pair (minimum image, N = 108)\n")
    print("| T | (ΔR/g)² ratio escape/contour | n/N ratio |\n|---|---|---|")
    for t in TEMPERATURES:
        pairs = list(zip(load(folder, "escape-108", t), load(folder, "minimum-108", t)))
        ratio = [e["ratio_squared"] / c["ratio_squared"] for e, c in pairs]
        participation = [e["participation_ratio"] / c["participation_ratio"] for e, c in pairs]
        print(f"| {t} | {cell(ratio, 4)} | {cell(participation, 4)} |")
    print()


def main():
    folder = Path(sys.argv[1])
    table(folder, "(ΔR/g)²", lambda p: p["ratio_squared"], 4)
    table(folder, "Participation ratio n/N", lambda p: p["participation_ratio"], 4)
    table(folder, "Detour steps, per cent of all", lambda p: 100 * (1 - p["steps"]["direct"] / sum(p["steps"].values())), 2)
    same_pairs(folder)
    times(folder)


if __name__ == "__main__":
    main()
