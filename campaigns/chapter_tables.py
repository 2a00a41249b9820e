"""The tables of docs/VALIDATION.md, one function each: from a chapter's data to rows of cells."""

import math
from typing import NamedTuple

import sources


class Table(NamedTuple):
    rows: list  # the first one is the head
    note: str = ""


def number(mean, digits=2):
    """A mean with its error, to `digits` digits of the error."""
    if mean is None:
        return ""
    if not mean.error:
        return f"{mean.value:.3g}"
    decimals = max(0, digits - 1 - math.floor(math.log10(mean.error)))
    return f"{mean.value:.{decimals}f} ± {mean.error:.{decimals}f}"


def plain(mean, form=".3g", scale=1.0):
    return "" if mean is None else format(mean.value * scale, form)


def pairs_note(*means):
    """How many pairs the means are over."""
    counts = sorted({mean.count for mean in means if mean is not None})
    if not counts:
        return ""
    return f"{counts[0]} pairs." if len(counts) == 1 else f"{counts[0]} to {counts[-1]} pairs."


# Kob-Andersen and Lennard-Jones

SYSTEMS = {"ka": ("kob-andersen", 108, ("Ni", "P")), "lj": ("lennard-jones", 108, ("Ar",))}
GREEDY = dict(kind="path", method="contour", stepping="adaptive", images=None, distance=108)
FAITHFUL = dict(GREEDY, stepping="faithful", step=0.001)
OPTIMISED = dict(kind="shorten", method="montecarlo", images=None, distance=108)
TRUE = dict(kind="shorten", method="curve", images=None, distance=108)


def system_table(system):
    """D beside (DeltaR/g)^2 of greedy, optimised and true paths, with and without a factor T."""
    def table(chapter):
        model, n, species = SYSTEMS[system]
        rows = [["T", *(f"D, {s}" for s in species), "greedy", "optimised", "true", f"D/(ΔR/g)², {species[0]}: greedy", "true", "with 1/T: greedy", "true"]]
        counted = []
        for t in reversed(chapter.values("temperature", kind="diffusion", model=model)):
            state = dict(model=model, particles=n, temperature=t)
            d = [chapter.mean(f"diffusion_long_time_{s}", kind="diffusion", **state) for s in species]
            paths = [chapter.mean("ratio_squared", **state, **kind) for kind in (GREEDY, OPTIMISED, TRUE)]
            counted += paths
            quotients = [d[0].value / p.value if d[0] and p else None for p in (paths[0], paths[2])]
            rows.append([f"{float(t):g}", *map(number, d), *map(number, paths), *("" if q is None else f"{q:.3g}" for q in quotients),
                         *("" if q is None else f"{q / float(t):.3g}" for q in quotients)])
        return Table(rows, f"(ΔR/g)² of three kinds of paths; D is the slope of the mean squared displacement. {pairs_note(*counted)}")
    return table


# The words by which analyses name sweeps, and what the tables call them.
PATHS = {"ka": {"greedy": "path {} contour adaptive dR108", "optimised": "shorten {} montecarlo", "true": "shorten {} curve"},
         "binary": {"greedy": "path {} avoidance step0.01 dR108", "optimised": "shorten {} montecarlo", "slide": "path {} avoidance adaptive dR108",
                    "true": "shorten {} curve"}}


def rows_of(chapter, file, sweep, quantity):
    """Rows of the sweep that begins with these words, for distances of 108 between ends."""
    return [row for row in chapter.table(file) if row["sweep"].startswith(sweep) and row["quantity"] == quantity and not row["sweep"].endswith("images-minimum")]


def slope_and_spread(row):
    return [f"{float(row['slope']):.2f} ± {float(row['slope_error']):.2f}", f"{float(row['spread']):.2f}"]


FEWEST_STATES = 3  # of a slope with an error


def proportionality(system, quantities):
    """How D, and of soft liquids D/T, goes with (DeltaR/g)^2: slope of the logarithms and scatter of the quotient."""
    def table(chapter):
        rows = [["", "", "paths", "states", "slope of ln D against ln (ΔR/g)²", "scatter of ln D/(ΔR/g)²", *(
            ["slope of ln D/T", "scatter of ln D/(T (ΔR/g)²)"] if system == "soft" else ["mean of D/(ΔR/g)²"])]]
        for (label, sweep, words), species in quantities:
            for paths, named in PATHS[words].items():
                for name, what in species.items():
                    found = rows_of(chapter, "scaling.csv", named.format(sweep), what)
                    if not found or int(found[0]["points"]) < FEWEST_STATES:
                        continue
                    d = found[0]
                    cells = slope_and_spread(d)
                    cells += (slope_and_spread(rows_of(chapter, "scaling.csv", named.format(sweep), f"{what}/T")[0]) if system == "soft"
                              else [f"{float(d['constant']):.3g} ± {float(d['constant_error']):.1g}"])
                    rows.append([label, name, paths, f"{float(d['from']):g} to {float(d['to']):g} ({d['points']})", *cells])
        return Table(rows, "Proportional quantities have slope 1 and no scatter (in natural logarithms).")
    return table


def steps_table(chapter):
    """[C]'s comparisons with the minimum image."""
    rows = [["T", "", "(ΔR/g)²", "n/N", "detours, % of steps", "s per path", "source, s"]]
    counted = []
    for t in reversed(chapter.values("temperature", images="minimum", kind="path")):
        for label, method, step in (("contour", "contour", 1e-3), ("escape", "escape", 1e-3), ("contour, step 0.01", "contour", 1e-2),
                                    ("contour, step 0.0001", "contour", 1e-4)):
            of = dict(kind="path", model="kob-andersen", images="minimum", temperature=t, method=method, step=step, distance=108)
            direct, detour = chapter.mean("direct_steps", **of), chapter.mean("detour_steps", **of)
            ratio = chapter.mean("ratio_squared", **of)
            counted.append(ratio)
            seconds = sources.CONTOUR_SECONDS.get(float(t), {}).get(method) if step == 1e-3 else None
            rows.append([f"{float(t):g}", label, number(ratio), number(chapter.mean("participation_ratio", **of)),
                         "" if not direct else f"{100 * detour.value / (direct.value + detour.value):.2f}", plain(chapter.mean("seconds", **of)),
                         str(seconds) if seconds else ""])
    return Table(rows, f"Minimum image, N = 108; the source is [C], table 1. {pairs_note(*counted)} Seconds are of runs that shared the machine.")


def soft_sizes_table(chapter):
    """Kob-Andersen liquids of several sizes, and distances."""
    rows = [["T", "N", "ΔR", "greedy", "true", "n/N, greedy", "n/N, true"]]
    counted = []
    for t in ("3", "1"):
        for n in chapter.values("particles", model="kob-andersen", temperature=t, kind="path", images=None):
            for distance in chapter.values("distance", model="kob-andersen", temperature=t, particles=n, kind="path", images=None):
                state = dict(model="kob-andersen", temperature=t, particles=n, images=None, distance=distance)
                greedy, true = dict(GREEDY, **state), dict(TRUE, **state)
                counted += [chapter.mean("ratio_squared", **greedy), chapter.mean("ratio_squared", **true)]
                rows.append([t, n, f"{float(distance):.4g}", number(counted[-2]), number(counted[-1]), number(chapter.mean("participation_ratio", **greedy)),
                             number(chapter.mean("participation_ratio", **true))])
    return Table(rows, pairs_note(*counted))


# Hard spheres

HARD = {"binary": "hard-sphere-binary", "mono": "hard-sphere"}
AVOIDANCE = dict(kind="path", method="avoidance", stepping="faithful", step=0.01, avoidance_step=1e-4, fictitious="harmonic", distance=108, distance_species=None)
SLIDE = dict(kind="path", method="avoidance", stepping="adaptive", distance=108, distance_species=None)
HARD_OPTIMISED = dict(kind="shorten", method="montecarlo", distance=108)
HARD_TRUE = dict(kind="shorten", method="curve", distance=108)


def spheres_table(kind):
    """(DeltaR/g)^2 of four kinds of paths against the packing fraction."""
    def table(chapter):
        model = HARD[kind]
        rows = [["φ", "greedy", "optimised", "slide", "true", "source's fit", "n/N, greedy", "optimised", "direct, 10³", "avoidance, 10³", "source, 10³", "s per path"]]
        counted = []
        for phi in chapter.values("packing_fraction", kind="path", model=model, particles=108, method="avoidance"):
            at = dict(model=model, particles=108, packing_fraction=phi)
            greedy, optimised = dict(AVOIDANCE, **at), dict(HARD_OPTIMISED, **at)
            paths = [chapter.mean("ratio_squared", **of) for of in (greedy, optimised, dict(SLIDE, **at), dict(HARD_TRUE, **at))]
            if not any(paths):
                continue
            counted += paths
            fit = sources.ratio_fit(float(phi)) if kind == "binary" else None
            steps = sources.STEPS.get(f"{float(phi):.2f}") if kind == "binary" else None
            rows.append([f"{float(phi):.2f}", *map(number, paths), f"{fit:.3g}" if fit else "", number(chapter.mean("participation_ratio", **greedy)),
                         number(chapter.mean("participation_ratio", **optimised)), plain(chapter.mean("direct_steps", **greedy), ".1f", 1e-3),
                         plain(chapter.mean("detour_steps", **greedy), ".0f", 1e-3), steps or "", plain(chapter.mean("seconds", **greedy))])
        return Table(rows, f"N = 108, ΔR = 108. {pairs_note(*counted)}")
    return table


def variants_table(chapter):
    """Fictitious potentials and lengths of steps on the same pairs."""
    rows = [["φ", "", "(ΔR/g)²", "n/N", "direct, 10³", "avoidance, 10³", "s per path"]]
    variants = (("harmonic, δ_di = 0.01, δ_ca = 1e-4", {}), ("linear", dict(fictitious="linear")), ("cubic", dict(fictitious="cubic")), ("δ_di = 0.1", dict(step=0.1)),
                ("δ_di = 0.001", dict(step=0.001)), ("δ_ca = 1e-3", dict(avoidance_step=1e-3)), ("δ_ca = 1e-5", dict(avoidance_step=1e-5)))
    counted = []
    for phi in chapter.values("packing_fraction", kind="path", model=HARD["binary"], particles=108, fictitious="linear"):
        for label, differs in variants:
            of = {**AVOIDANCE, "model": HARD["binary"], "particles": 108, "packing_fraction": phi, **differs}
            counted.append(chapter.mean("ratio_squared", **of))
            rows.append([f"{float(phi):.2f}", label, number(counted[-1]), number(chapter.mean("participation_ratio", **of)),
                         plain(chapter.mean("direct_steps", **of), ".1f", 1e-3), plain(chapter.mean("detour_steps", **of), ".0f", 1e-3),
                         plain(chapter.mean("seconds", **of))])
    return Table(rows, f"Binary, N = 108. {pairs_note(*counted)}")


def hard_sizes_table(chapter):
    """Sizes and distances: steps of one length, steps that grow with sqrt(N), slide paths and true geodesics."""
    rows = [["φ", "N", "ΔR", "δ_di = 0.01", "δ_di ~ √N", "slide", "true", "n/N", "c/N", "m/N", "s"]]
    counted = []
    for phi in chapter.values("packing_fraction", kind="path", model=HARD["binary"], particles=64):
        for n in chapter.values("particles", kind="path", model=HARD["binary"], packing_fraction=phi):
            for distance in chapter.values("distance", kind="path", model=HARD["binary"], packing_fraction=phi, particles=n, method="avoidance", distance_species=None):
                at = dict(model=HARD["binary"], particles=n, packing_fraction=phi, distance=distance)
                fixed = dict(AVOIDANCE, **at)
                scaled = dict(fixed, step=round(0.01 * (int(n) / 108)**0.5, 5))
                counted.append(chapter.mean("ratio_squared", **fixed))
                if counted[-1] is None:
                    continue
                rows.append([f"{float(phi):.2f}", n, f"{float(distance):.4g}", *(number(chapter.mean("ratio_squared", **of)) for of in (
                    fixed, scaled, {**SLIDE, **at}, {**HARD_TRUE, **at})), *(number(chapter.mean(q, **fixed)) for q in (
                        "participation_ratio", "moved_share", "groups_share", "group_size"))])
    return Table(rows, f"Binary. {pairs_note(*counted)}")


def overlaps_table(chapter):
    """Means over avoidance steps."""
    rows = [["φ", "N", "partners v", "moved c/N", "groups m/N", "size s", "s, few groups", "some", "many", "trials per avoidance step"]]
    counted = []
    for n in ("108", "256"):
        for phi in chapter.values("packing_fraction", kind="path", model=HARD["binary"], particles=n, fictitious="harmonic"):
            of = {**AVOIDANCE, "model": HARD["binary"], "particles": n, "packing_fraction": phi, "distance": 108 if n == "108" else 160}
            counted.append(chapter.mean("overlapping_partners", **of))
            if counted[-1]:
                rows.append([f"{float(phi):.2f}", n, *(number(chapter.mean(q, **of)) for q in (
                    "overlapping_partners", "moved_share", "groups_share", "group_size", "group_size_few_groups", "group_size_some_groups",
                    "group_size_many_groups", "trials_per_detour"))])
    return Table(rows, f"Binary; few, some and many groups: m below, between and above 4 and 18 (N = 108), 10 and 45 (256). {pairs_note(*counted)}")


def few_particles_table(chapter):
    """Shares of steps in which few particles move, which show as peaks of n/N and alpha_2."""
    rows = [["φ", "n = 2 (α₂ = 31.4)", "n = 3 (20.6)", "n = 4 (15.2)", "n = 5 (12.0)"]]
    for phi in chapter.values("packing_fraction", kind="path", model=HARD["binary"], particles=108, method="avoidance"):
        of = {**AVOIDANCE, "model": HARD["binary"], "particles": 108, "packing_fraction": phi}
        shares = [chapter.probability("participation_ratio", n / 108, **of) for n in (2, 3, 4, 5)]
        if None not in shares:
            rows.append([f"{float(phi):.2f}", *(f"{100 * share:.2g} %" for share in shares)])
    return Table(rows, "Binary, N = 108, shares of all steps.")


def heterogeneity_table(chapter):
    """The width of log10(g_j/DeltaR_j) of small spheres."""
    rows = [["φ", "pairs", "width, all particles together", "mean of the widths of single paths", "pairs, optimised", "width", "mean of single paths"]]
    for phi in chapter.values("packing_fraction", kind="path", distance_species="Ar"):
        of = dict(model=HARD["binary"], packing_fraction=phi, distance_species="Ar")
        cells = []
        for kind in (dict(of, kind="path"), dict(of, kind="shorten", method="montecarlo")):
            pooled, single = chapter.mean("heterogeneity_pooled_Ar", **kind), chapter.mean("heterogeneity_Ar", **kind)
            cells += [str(single.count) if single else "", number(pooled), number(single)]
        rows.append([f"{float(phi):.2f}", *cells])
    return Table(rows, "Small spheres, ΔR of the small spheres 90, N = 108.")


def fits_table(chapter):
    """Fits from 0.53 to 0.57 with the source's critical packing fractions, beside its own."""
    rows = [["", "form", "slope", "intercept", "R²", "source: slope", "intercept", "R²"]]
    for label, sweep, quantity in (("(ΔR/g)², greedy", PATHS["binary"]["greedy"].format("hard-sphere-binary N108"), "ratio_squared"),
                                   ("D, large", "diffusion hard-sphere-binary N108", "diffusion_vacf_Xe"),
                                   ("D, small", "diffusion hard-sphere-binary N108", "diffusion_vacf_Ar")):
        for form, critical in (("mode-coupling", "0.59"), ("vogel-fulcher-tammann", "0.6122"), ("berthier-witten", "0.635")):
            found = [row for row in rows_of(chapter, "fits.csv", sweep, quantity) if row["form"] == form and row["slope"] and not row["critical_error"]]
            for row in found[:1]:
                cells = [f"{float(row[key]):.4g} ± {float(row[key + '_error']):.1g}" for key in ("slope", "intercept")]
                rows.append([label, f"{form}, {critical}", *cells, f"{float(row['r_squared']):.4f}", *sources.FITS.get((label, form), ("", "", ""))])
    return Table(rows, "Binary, N = 108. ln y against ln(φ_c - φ), -1/(φ_0 - φ) and -1/(φ_0 - φ)².")


def away_table(chapter):
    """The away method beside avoidance, against N."""
    rows = [["φ", "N", "reached", "(ΔR/g)², away", "avoidance", "n/N, away", "avoidance"]]
    for phi in chapter.values("packing_fraction", kind="path", method="away"):
        for n in chapter.values("particles", kind="path", method="away", packing_fraction=phi):
            away = chapter.group(kind="path", method="away", packing_fraction=phi, particles=n)
            of = [dict(kind="path", method="away", packing_fraction=phi, particles=n),
                  {**AVOIDANCE, "model": HARD["binary"], "packing_fraction": phi, "particles": n, "distance": away["distance"]}]
            rows.append([f"{float(phi):.2f}", n, f"{away['reached']} of {away['paths']}", *(number(chapter.mean("ratio_squared", **o)) for o in of),
                         *(number(chapter.mean("participation_ratio", **o)) for o in of)])
    return Table(rows, "Binary.")


def ends_table(chapter):
    """What a pair of end points costs."""
    rows = [["φ", "pairs", "10⁶ collisions per pair", "s", "source, s", "Z", "equation of state"]]
    for phi in chapter.values("packing_fraction", kind="endpoints", model=HARD["binary"], particles=108):
        of = dict(kind="endpoints", model=HARD["binary"], packing_fraction=phi, particles=108, distance=108, distance_species=None)
        collisions = chapter.mean("collisions", **of)
        if collisions:
            rows.append([f"{float(phi):g}", str(collisions.count), plain(collisions, ".3g", 1e-6), plain(chapter.mean("seconds", **of)),
                         sources.END_POINT_SECONDS.get(f"{float(phi):g}", ""), plain(chapter.mean("compressibility", **of), ".4g"), f"{sources.bmcsl(float(phi)):.4g}"])
    return Table(rows, "Binary, N = 108, ΔR = 108; the source is [G], table 4.1. Seconds are of runs that shared the machine.")


# Diffusion of hard spheres: D in units of the temperature of 3N - 3 degrees of freedom.

NAMES = {"binary": {"Xe": "large", "Ar": "small"}, "mono": {"Ar": "D"}}


def real(chapter, quantity, n, **settings):
    mean = chapter.mean(quantity, kind="diffusion", particles=n, **settings)
    scale = math.sqrt((n - 1) / n)
    return mean and mean._replace(value=mean.value * scale, error=mean.error and mean.error * scale)


def published(kind, phi):
    """The settings of a run with the published time between records and t_max, which are those of the program."""
    return dict(model=HARD[kind], packing_fraction=phi, interval=None)


def diffusion_table(kind):
    def table(chapter):
        reference = "source's fit, large" if kind == "binary" else "infinite system"
        rows = [["φ", *(f"{name}, {how}" for name in NAMES[kind].values() for how in ("VACF", "MSD")), "exponent of the MSD at t_max", reference, "Z", "equation of state"]]
        for phi in chapter.values("packing_fraction", model=HARD[kind], particles=108):
            of = published(kind, phi)
            cells = [number(real(chapter, f"diffusion_{how}_{s}", 108, **of)) for s in NAMES[kind] for how in ("vacf", "msd")]
            exponent = chapter.mean(f"displacement_exponent_{next(iter(NAMES[kind]))}", kind="diffusion", particles=108, **of)
            expected = sources.diffusion_fit(float(phi)) if kind == "binary" else sources.INFINITE.get(f"{float(phi):.5f}")
            z = sources.bmcsl(float(phi)) if kind == "binary" else sources.carnahan_starling(float(phi))
            rows.append([f"{float(phi):g}", *cells, plain(exponent, ".2f"), f"{expected:.4g}" if expected else "",
                         plain(chapter.mean("compressibility", kind="diffusion", particles=108, **of), ".4g"), f"{z:.4g}"])
        return Table(rows, "N = 108, D in units of sigma (k_B T/m)^1/2 with 3N - 3 degrees of freedom.")
    return table


def tests_table(chapter):
    """Shorter t_max and coarser records, as [G]'s tables 4.4, 4.6 and 4.7."""
    rows = [["", "φ", "species", "published t_max and Δt", "half t_max", "twice Δt"]]
    for kind in HARD:
        for phi in chapter.values("packing_fraction", model=HARD[kind], particles=108):
            intervals = chapter.values("interval", model=HARD[kind], particles=108, packing_fraction=phi)
            if len(intervals) != 2:
                continue
            tests = [published(kind, phi), *(dict(published(kind, phi), interval=interval) for interval in intervals)]
            for species, name in NAMES[kind].items():
                rows.append([kind, f"{float(phi):g}", name, *(number(real(chapter, f"diffusion_vacf_{species}", 108, **of)) for of in tests)])
    return Table(rows, "From velocity correlations.")


def collapse_table(chapter):
    """Sizes: D against that of the infinite system, and both scaled to meet at 0.40."""
    sizes = (108, 500)
    columns = {phi: [real(chapter, "diffusion_vacf_Ar", n, **published("mono", phi)) for n in sizes]
               for phi in chapter.values("packing_fraction", model=HARD["mono"], particles=500)}
    rows = [["φ", "D, N = 108", "D, N = 500", "quotient", "quotient over that at 0.40"]]
    at = columns.get("0.4")
    for phi, (small, large) in columns.items():
        quotient = small.value / large.value
        rows.append([f"{float(phi):.2f}", number(small), number(large), f"{quotient:.3f}", f"{quotient / (at[0].value / at[1].value):.3f}" if at else ""])
    return Table(rows, "One component.")


TABLES = {"soft-kob-andersen": system_table("ka"), "soft-lennard-jones": system_table("lj"), "soft-scaling": proportionality("soft", (
              (("Kob-Andersen", "kob-andersen N108 rho1.2", "ka"), {"A": "diffusion_long_time_Ni", "B": "diffusion_long_time_P"}),
              (("Lennard-Jones", "lennard-jones N108 rho0.8", "ka"), {"": "diffusion_long_time_Ar"}))), "soft-steps": steps_table, "soft-sizes": soft_sizes_table,
          "hard-binary": spheres_table("binary"), "hard-mono": spheres_table("mono"), "hard-variants": variants_table, "hard-sizes": hard_sizes_table,
          "hard-overlaps": overlaps_table, "hard-few": few_particles_table, "hard-heterogeneity": heterogeneity_table, "hard-away": away_table, "hard-fits": fits_table,
          "hard-scaling": proportionality("hard", (
              (("binary", "hard-sphere-binary N108", "binary"), {"large": "diffusion_vacf_Xe", "small": "diffusion_vacf_Ar"}),
              (("one component", "hard-sphere N108", "binary"), {"": "diffusion_vacf_Ar"}))), "hard-ends": ends_table,
          "diffusion-binary": diffusion_table("binary"), "diffusion-mono": diffusion_table("mono"), "diffusion-tests": tests_table,
          "diffusion-collapse": collapse_table}
