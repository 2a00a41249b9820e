"""The figure of a self-diffusion run for tools/plot.py: diffusion.png."""

from plot_style import GREY, PAIR_STYLES, plt, read_table, save, system_parts


def read_diffusion(folder):
    """The table of correlations and displacements, or None if there is none."""
    file = folder / "diffusion.csv"
    return read_table(file, ["time"]) if file.exists() else None


def draw_diffusion(folder, table, result, temperature):
    """Velocity correlation, its integral and the mean squared displacement by species, into diffusion.png."""
    names = [name.removeprefix("velocity_correlation_") for name in table if name.startswith("velocity_correlation_")]
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(15.0, 4.8), gridspec_kw={"wspace": 0.3})
    time = table["time"]
    for name, (colour, style) in zip(names, PAIR_STYLES):
        correlation = table[f"velocity_correlation_{name}"]
        left.plot(time, correlation / correlation[0], color=colour, linestyle=style, label=name)
        middle.plot(time, table[f"diffusion_integral_{name}"], color=colour, linestyle=style, label=f"{name}, integral")
        right.plot(time[1:], table[f"squared_displacement_{name}"][1:], color=colour, linestyle=style, label=name)
        species = result.get("species", {}).get(name, {})
        if "diffusion_msd" in species:
            middle.axhline(species["diffusion_msd"], color=colour, linewidth=1.0, alpha=0.6,
                           label=rf"$\langle r^2\rangle$: {species['diffusion_msd']:.4g}")
    left.axhline(0.0, color=GREY, linewidth=1.0)
    left.set_ylabel(r"$\langle v(t)\cdot v(0)\rangle/\langle v^2\rangle$")
    middle.set_ylabel("$D(t)$")
    right.set_ylabel(r"$\langle|\Delta r|^2\rangle\;\;[\sigma^2]$")
    right.set_xscale("log")
    right.set_yscale("log")
    for axes in (left, middle, right):
        axes.set_xlabel("$t$")
        axes.legend()
    figure.suptitle(",  ".join([*system_parts(result, temperature, result.get("particles")), "diffusion"]), fontsize=15)
    save(figure, folder / "diffusion.png")
