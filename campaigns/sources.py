"""What the sources state in numbers, beside which docs/VALIDATION.md puts ours (docs/REFERENCES.md has them)."""

import math

# Seconds per Kob-Andersen path, [C] table 1.
CONTOUR_SECONDS = {5: dict(contour=750, escape=12000), 4: dict(contour=800, escape=12000), 3: dict(contour=850, escape=12000), 2: dict(contour=900, escape=13000),
                   1: dict(contour=1100, escape=15000)}
# Thousands of direct and avoidance steps, [G] table 4.2.
STEPS = {"0.30": "18 / 300", "0.50": "43 / 1000", "0.58": "150 / 6000"}
# Seconds per pair of end points, [G] table 4.1.
END_POINT_SECONDS = {"0.5": "700", "0.58": "80,000", "0.59": "520,000", "0.597": "3,500,000"}
# Self-diffusion of one component without finite-size effects, event-driven molecular dynamics of github.com/macioosch/dynamo-hard-spheres-sim.
INFINITE = {"0.15708": 0.5555, "0.26180": 0.2649, "0.36652": 0.1209, "0.47124": 0.0363}


def fitted(phi):
    """Whether [G]'s fits are for this packing fraction."""
    return 0.53 <= phi <= 0.57


def ratio_fit(phi):
    """Mode-coupling fit of [G]'s figure 4.20."""
    return math.exp(1.450393 * math.log(0.59 - phi) - 1.404044) if fitted(phi) else None


def diffusion_fit(phi):
    """Vogel-Fulcher-Tammann fit of [G]'s figure 4.23, of large spheres."""
    return math.exp(-0.159643 / (0.6122 - phi) - 2.836295) if fitted(phi) else None


def bmcsl(phi):
    """Z of the equation of state of Boublik, Mansoori, Carnahan, Starling and Leland for diameters 1.4 and 1, half of each."""
    m1, m2, m3 = 1.2, (1.96 + 1) / 2, (2.744 + 1) / 2
    return 1 / (1 - phi) + 3 * phi / (1 - phi)**2 * m1 * m2 / m3 + phi**2 * (3 - phi) / (1 - phi)**3 * m2**3 / m3**2


def carnahan_starling(phi):
    return (1 + phi + phi**2 - phi**3) / (1 - phi)**3


# Slope, intercept and R^2 of [G]'s fits in the form of ours, figures 4.20 to 4.25, 4.30 and 4.33.
FITS = {("(ΔR/g)², greedy", "mode-coupling"): ("1.450393", "-1.404044", "0.9993"),
        ("(ΔR/g)², greedy", "vogel-fulcher-tammann"): ("0.1375", "", ""), ("(ΔR/g)², greedy", "berthier-witten"): ("0.01083", "", ""),
        ("D, large", "mode-coupling"): ("1.688", "", ""), ("D, large", "vogel-fulcher-tammann"): ("0.159643", "-2.836295", "0.9862"),
        ("D, large", "berthier-witten"): ("0.0125595", "-3.653602", "0.9833")}
