#!/usr/bin/python3
"""Hard-sphere tables of docs/VALIDATION.md from the folder that hard_spheres.smk fills."""

import json
import math
import statistics
import sys
from pathlib import Path

from report import mean_and_error

PAIRS = 5
PATHS = {
    "binary": ["0.05", "0.10", "0.20", "0.30", "0.40", "0.45", "0.50", "0.53", "0.55", "0.57"],
    "mono": ["0.05", "0.10", "0.20", "0.30", "0.40", "0.45", "0.48"],
}
# 0.15708 ... are the densities 0.3, 0.5, 0.7 and 0.9 of published figures.
DIFFUSION = {"binary": PATHS["binary"], "mono": ["0.05", "0.10", "0.15708", "0.20", "0.26180", "0.30", "0.36652", "0.40", "0.45", "0.47124", "0.48"]}
POTENTIALS = ["0.30", "0.50"]
PARTICLES = 108
# Source: direct and avoidance steps in thousands, its table 4.2.
SOURCE_STEPS = {"0.30": (18, 300), "0.50": (43, 1000)}
# Self-diffusion without finite-size effects, event-driven molecular dynamics of github.com/macioosch/dynamo-hard-spheres-sim.
INFINITE = {"0.15708": 0.5555, "0.26180": 0.2649, "0.36652": 0.1209, "0.47124": 0.0363}


def load(folder, name):
    return json.loads((folder / f"{name}.json").read_text())


def there(folder, name):
    """A sweep that was stopped leaves rows out."""
    return (folder / f"{name}.json").exists()


def cell(values, form):
    mean, error = mean_and_error(values)
    return f"{mean:{form}}" if math.isnan(error) else f"{mean:{form}} ± {error:{form}}"


def fitted(phi):
    """Whether [G]'s fits are for this packing fraction."""
    return 0.53 <= phi <= 0.57


def source_ratio(phi):
    """Mode-coupling fit of [G]'s figure 4.20, 0.53 to 0.57."""
    return math.exp(1.450393 * math.log(0.59 - phi) - 1.404044) if fitted(phi) else None


def source_diffusion_big(phi):
    """Vogel-Fulcher-Tammann fit of [G]'s figure 4.23, 0.53 to 0.57."""
    return math.exp(-0.159643 / (0.6122 - phi) - 2.836295) if fitted(phi) else None


def bmcsl(phi):
    m1, m2, m3 = 1.2, (1.96 + 1) / 2, (2.744 + 1) / 2
    return 1 / (1 - phi) + 3 * phi / (1 - phi) ** 2 * m1 * m2 / m3 + phi**2 * (3 - phi) / (1 - phi) ** 3 * m2**3 / m3**2


def carnahan_starling(phi):
    return (1 + phi + phi**2 - phi**3) / (1 - phi) ** 3


def reached(folder, name):
    return [p for p in load(folder, name)["paths"] if p["outcome"] == "reached"]


def path_row(paths):
    return [
        cell([p["ratio_squared"] for p in paths], ".3g"),
        cell([p["participation_ratio"] for p in paths], ".3f"),
        cell([p["steps"]["direct"] / 1e3 for p in paths], ".1f"),
        cell([p["steps"]["avoidance"] / 1e3 for p in paths], ".0f"),
        f"{statistics.mean(p['seconds'] for p in paths):.2f}",
    ]


def row(*cells):
    print("| " + " | ".join("" if c is None else str(c) for c in cells) + " |")


def header(*cells):
    row(*cells)
    print("|" + "---|" * len(cells))


def paths_table(folder, kind):
    print(f"### Paths, {kind} (N = 108, ΔR = 108, {PAIRS} pairs)\n")
    header("φ", "(ΔR/g)²", "source's fit", "n/N", "direct, 10³", "avoidance, 10³", "source, 10³", "s per path")
    for phi in PATHS[kind]:
        if not there(folder, f"paths-{kind}-{phi}-harmonic"):
            continue
        ratio, share, direct, avoidance, seconds = path_row(reached(folder, f"paths-{kind}-{phi}-harmonic"))
        source = source_ratio(float(phi)) if kind == "binary" else None
        steps = SOURCE_STEPS.get(phi) if kind == "binary" else None
        row(phi, ratio, f"{source:.3g}" if source else None, share, direct, avoidance, f"{steps[0]} / {steps[1]}" if steps else None, seconds)
    print()


def potentials_table(folder):
    print("### The three fictitious potentials on the same pairs, binary\n")
    header("φ", "potential", "(ΔR/g)²", "n/N", "direct, 10³", "avoidance, 10³", "s per path")
    for phi in POTENTIALS:
        for potential in ("harmonic", "cubic", "linear"):
            if not there(folder, f"paths-binary-{phi}-{potential}"):
                continue
            row(phi, potential, *path_row(reached(folder, f"paths-binary-{phi}-{potential}")))
    print()


def overlap_statistics_table(folder):
    print("### Overlaps along a path, binary: means over steps\n")
    header("φ", "partners v", "moved c/N", "groups m/N", "trials per avoidance step")
    for phi in PATHS["binary"]:
        if not there(folder, f"paths-binary-{phi}-harmonic"):
            continue
        paths = reached(folder, f"paths-binary-{phi}-harmonic")
        means = [p["mean_over_steps"] for p in paths]
        trials = [sum((k + 1) * n for k, n in enumerate(p["corrections"])) / max(1, sum(p["corrections"])) for p in paths]
        row(phi, cell([m["overlapping_partners"] for m in means], ".2f"), cell([m["moved_particles"] / PARTICLES for m in means], ".3f"),
            cell([m["groups"] / PARTICLES for m in means], ".3f"), cell(trials, ".2f"))
    print()


def with_error(d, name, scale):
    error = d[name + "_error"]
    return f"{d[name] * scale:.4g}" + (f" ± {error * scale:.1g}" if error is not None else "")


def diffusion_table(folder, kind):
    # From [G]'s (3/2) N T to 3N - 3 degrees of freedom.
    scale = math.sqrt((PARTICLES - 1) / PARTICLES)
    species = {"binary": ["Xe", "Ar"], "mono": ["Ar"]}[kind]
    print(f"### Diffusion, {kind} (N = 108; D in units of sigma (k_B T/m)^1/2, 3N - 3 degrees of freedom)\n")
    names = {"Xe": "large", "Ar": "small" if kind == "binary" else "D"}
    reference = "source's fit, large" if kind == "binary" else "infinite system"
    header("φ", *[f"{names[s]}, {how}" for s in species for how in ("VACF", "MSD")], reference, "Z", "BMCSL" if kind == "binary" else "Carnahan-Starling")
    for phi in DIFFUSION[kind]:
        if not there(folder, f"diffusion-{kind}-{phi}"):
            continue
        result = load(folder, f"diffusion-{kind}-{phi}")
        cells = [with_error(result["species"][s], f"diffusion_{how}", scale) for s in species for how in ("vacf", "msd")]
        expected = source_diffusion_big(float(phi)) if kind == "binary" else INFINITE.get(phi)
        z = bmcsl(float(phi)) if kind == "binary" else carnahan_starling(float(phi))
        note = "" if all(result["species"][s]["regime"] == "diffusive" for s in species) else " (t_max too short)"
        row(phi + note, *cells, f"{expected:.4g}" if expected else None, f"{result['compressibility']:.4g}", f"{z:.4g}")
    print()


def main():
    folder = Path(sys.argv[1])
    paths_table(folder, "binary")
    potentials_table(folder)
    overlap_statistics_table(folder)
    paths_table(folder, "mono")
    diffusion_table(folder, "binary")
    diffusion_table(folder, "mono")


if __name__ == "__main__":
    main()
