#!/usr/bin/python3
"""D and (DeltaR/g)^2 of hard spheres against the packing fraction: plot_hard_spheres.py DIR PNG, DIR filled by hard_spheres.smk."""

import math
import statistics
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from hard_report import DIFFUSION, INFINITE, PARTICLES, PATHS, load, reached, source_diffusion_big

BLUE, VERMILLION, GREEN, GREY = "#0072B2", "#D55E00", "#009E73", "#595959"
TITLES = {"binary": "binary, diameters 1.4 and 1", "mono": "one component"}
SPECIES = {"binary": [("Xe", "large", BLUE), ("Ar", "small", VERMILLION)], "mono": [("Ar", "$D$", BLUE)]}


def series(folder, kind, species):
    """D by the velocity correlation in units of 3N - 3 degrees of freedom, where there is a result."""
    scale = math.sqrt((PARTICLES - 1) / PARTICLES)
    found = [(float(phi), load(folder, f"diffusion-{kind}-{phi}")["species"][species]) for phi in DIFFUSION[kind]
             if (folder / f"diffusion-{kind}-{phi}.json").exists()]
    return {phi: (d["diffusion_vacf"] * scale, d["diffusion_vacf_error"] * scale) for phi, d in sorted(found, key=lambda f: f[0])}


def draw(axes, folder, kind):
    ratios = {float(phi): statistics.mean(p["ratio_squared"] for p in reached(folder, f"paths-{kind}-{phi}-harmonic"))
              for phi in PATHS[kind] if (folder / f"paths-{kind}-{phi}-harmonic.json").exists()}
    for species, label, colour in SPECIES[kind]:
        points = series(folder, kind, species)
        axes.errorbar(list(points), [d for d, _ in points.values()], [e for _, e in points.values()], fmt="o", color=colour, label=f"molecular dynamics, {label}")
        common = [phi for phi in ratios if phi in points]
        # [G]'s scaling: the mean of D / (DeltaR/g)^2 over the state points.
        scale = statistics.mean(points[phi][0] / ratios[phi] for phi in common)
        axes.plot(list(ratios), [scale * r for r in ratios.values()], "--", color=colour, label=rf"{scale:.3g} $(\Delta R/g)^2$")
    if kind == "binary":
        phis = [k / 100 for k in range(53, 58)]
        axes.plot(phis, [source_diffusion_big(phi) for phi in phis], ":", color=GREY, label="source's fit, large")
    else:
        axes.plot([float(phi) for phi in INFINITE], list(INFINITE.values()), "s", color=GREEN, mfc="none", label="infinite system, published")
    axes.set_yscale("log")
    axes.set_xlabel(r"packing fraction $\phi$")
    axes.set_title(TITLES[kind], loc="left")
    axes.legend(frameon=False)


def main():
    folder, picture = Path(sys.argv[1]), sys.argv[2]
    plt.rcParams.update({"font.size": 12, "axes.spines.top": False, "axes.spines.right": False, "savefig.dpi": 110})
    figure, panels = plt.subplots(1, 2, figsize=(12.0, 5.0))
    for axes, kind in zip(panels, PATHS):
        draw(axes, folder, kind)
    panels[0].set_ylabel(r"$D\;\;[\sigma(k_\mathrm{B}T/m)^{1/2}]$")
    figure.savefig(picture, bbox_inches="tight")


if __name__ == "__main__":
    main()
