"""The figure of relaxation for tools/plot.py: relaxation.png."""

import math

from plot_style import GREY, PAIR_STYLES, letter, logarithmic, plt, read_table, save, system_parts

CURVES = ("squared_displacement", "intermediate_scattering", "alpha_2", "chi_4")


def read_relaxation(folder):
    """The table of relaxation, or None if there is none."""
    file = folder / "relaxation.csv"
    if not file.exists():
        return None
    table = read_table(file, ["time"])
    names = names_of(table)
    return read_table(file, [column for name in names for curve in CURVES for column in (f"{curve}_{name}", f"{curve}_error_{name}")])


def names_of(table):
    start = "squared_displacement_error_"
    return [column.removeprefix(start) for column in table if column.startswith(start)]


def draw_curve(axes, table, curve, name, colour, style, label):
    """A curve with a band of its standard error, which a single trajectory does not have."""
    values, errors = table[f"{curve}_{name}"], table[f"{curve}_error_{name}"]
    axes.plot(table["time"], values, color=colour, linestyle=style, label=label)
    axes.fill_between(table["time"], values - errors, values + errors, color=colour, alpha=0.2, linewidth=0.0)


def draw_relaxation(folder, table, result, temperature):
    """Scattering function, mean squared displacement, alpha_2 and chi_4 by species, into relaxation.png."""
    figure, panels = plt.subplots(2, 2, figsize=(11.0, 9.0), gridspec_kw={"wspace": 0.28, "hspace": 0.32})
    (scattering, squared), (non_gaussian, susceptibility) = panels
    for name, (colour, style) in zip(names_of(table), PAIR_STYLES):
        species = result.get("species", {}).get(name, {})
        wave_number, tau = species.get("wave_number"), species.get("tau_alpha")
        label = name + (rf", $k={wave_number:.4g}$" if wave_number else "") + (rf", $\tau_\alpha={tau:.4g}$" if tau else "")
        for axes, curve, words in ((scattering, "intermediate_scattering", label), (squared, "squared_displacement", name),
                                   (non_gaussian, "alpha_2", name), (susceptibility, "chi_4", name)):
            draw_curve(axes, table, curve, name, colour, style, words)
    scattering.axhline(1.0 / math.e, color=GREY, linewidth=1.0)
    non_gaussian.axhline(0.0, color=GREY, linewidth=1.0)
    for axes, text in ((scattering, "$F_s(k,t)$"), (squared, r"$\langle|\Delta r|^2\rangle\;\;[\sigma^2]$"),
                       (non_gaussian, r"$\alpha_2(t)$"), (susceptibility, r"$\chi_4(t)$")):
        letter(axes, text)
        axes.set_xlabel("$t$")
        logarithmic(axes.xaxis, between=False)
        axes.legend(fontsize=10)
    squared.set_yscale("log")
    figure.suptitle(",  ".join([*system_parts(result, temperature, result.get("particles")), "relaxation"]), fontsize=15)
    save(figure, folder / "relaxation.png")
