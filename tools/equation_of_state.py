#!/usr/bin/python3
"""What equations of state of the Lennard-Jones fluid say, as JSON: tools/equation_of_state.py --temperature 2.5 --density 0.8

or, from density 0.4 and T = 2.5 at constant energy to density 0.8, tools/equation_of_state.py --process 0.4 2.5 --to 0.8
--cutoff RC: of the potential truncated at RC and shifted to zero there, in mean field.
Exit status 0, or 2 with one line on stderr for input that cannot be used.

  johnson          Johnson, Zollweg, Gubbins, Mol. Phys. 78, 591 (1993), doi:10.1080/00268979300100411
  kolafa-nezbeda   Kolafa, Nezbeda, Fluid Phase Equilib. 100, 1 (1994), doi:10.1016/0378-3812(94)80001-4
  thol             Thol, Rutkai, Koester, Lustig, Span, Vrabec, J. Phys. Chem. Ref. Data 45, 023101 (2016), doi:10.1063/1.4945000

All are of the fluid without a cutoff unless one is given: compare simulations with long-range corrections. They were fitted to T from
about 0.7 to 6, 10 and 9 and up to freezing; beyond, and inside the binodal, they mean little. sigma = epsilon = k_B = 1; energies are
per particle.
"""

import argparse
import csv
import json
import math
import sys
from pathlib import Path

import numpy as np

DATA = Path(__file__).resolve().parent / "data"
# Wider than any fit, and all three are finite inside: the hard spheres of Kolafa and Nezbeda fill space at density 1.5 below T = 0.13.
TEMPERATURES, DENSITIES = (0.3, 100.0), (0.0, 1.5)
CUTOFFS = (2.0, 1e6)
STEP = 1e-30  # of derivatives in the complex plane: no difference is taken, so that nothing cancels, and the error is of order STEP^2


class Unusable(Exception):
    """What is wrong with the input, in one line."""


def check(temperature, density):
    """Both as arrays of doubles, or Unusable; written so that nan is refused."""
    for what, values, (low, high) in (("temperature", temperature, TEMPERATURES), ("density", density, DENSITIES)):
        values = np.atleast_1d(np.asarray(values, float))
        outside = values[~((values >= low) & (values <= high))]
        if len(outside):
            raise Unusable(f"{what} {outside[0]:g}: must be from {low:g} to {high:g}")
    return np.asarray(temperature, float), np.asarray(density, float)


def read_columns(name):
    """The columns of a table in data/ as arrays, of text where it names the row, else of numbers, 0 where a cell is empty."""
    rows = list(csv.DictReader(line for line in (DATA / name).read_text(encoding="utf-8").splitlines() if not line.startswith("#")))
    return {key: np.array([row[key] if key in ("index", "term") else float(row[key] or 0.0) for row in rows]) for key in rows[0]}


def powers(x, exponents):
    """x to each of the exponents, along a new last axis."""
    return np.asarray(x)[..., None]**np.asarray(exponents, float)


class EquationOfState:
    """What follows from the residual Helmholtz energy. An equation has a name and two formulas, _a_r(t, rho) and _e_ex(t, rho), which take
    complex arguments: all other derivatives are Im f(x + ih)/h, exact to rounding (Squire, Trapp, SIAM Rev. 40, 110 (1998),
    doi:10.1137/S003614459631241X). Methods take numbers, or arrays that broadcast, and raise Unusable outside the ranges above."""

    def a_r(self, temperature, density):
        """Residual Helmholtz energy: less that of the ideal gas at the same temperature and density  [epsilon]"""
        return self._a_r(*check(temperature, density))

    def e_ex(self, temperature, density):
        """Excess, that is potential, energy d(a_r/T)/d(1/T)  [epsilon]"""
        return self._e_ex(*check(temperature, density))

    def pressure(self, temperature, density):
        """rho T + rho^2 (d a_r/d rho)_T  [epsilon/sigma^3]"""
        t, rho = check(temperature, density)
        return rho * t + rho**2 * self._a_r(t, rho + 1j * STEP).imag / STEP

    def mu_ex(self, temperature, density):
        """Excess chemical potential a_r + rho (d a_r/d rho)_T  [epsilon]"""
        t, rho = check(temperature, density)
        return self._a_r(t, rho) + rho * self._a_r(t, rho + 1j * STEP).imag / STEP

    def de_ex_drho(self, temperature, density):
        """(d e_ex/d rho)_T  [epsilon sigma^3]"""
        t, rho = check(temperature, density)
        return self._e_ex(t, rho + 1j * STEP).imag / STEP

    def c_v_residual(self, temperature, density):
        """(d e_ex/d T)_rho  [k_B]"""
        t, rho = check(temperature, density)
        return self._e_ex(t + 1j * STEP, rho).imag / STEP

    def c_v(self, temperature, density):
        """3/2 + (d e_ex/d T)_rho  [k_B]"""
        return 1.5 + self.c_v_residual(temperature, density)

    def dp_drho(self, temperature, density):
        """(d p/d rho)_T  [epsilon]; the second derivative of rho a_r is Cauchy's integral over a circle of 16 points"""
        t, rho = check(temperature, density)
        turns, radius = np.exp(2j * math.pi * np.arange(16) / 16), 0.02
        points = rho[..., None] + radius * turns
        second = 2.0 * (points * self._a_r(t[..., None], points) / turns**2).mean(-1).real / radius**2
        return t + rho * second

    def dp_dt(self, temperature, density):
        """(d p/d T)_rho  [k_B/sigma^3], by Maxwell's relation"""
        t, rho = check(temperature, density)
        return (self.pressure(t, rho) - rho**2 * self.de_ex_drho(t, rho)) / t

    def sound_velocity(self, temperature, density):
        """c, c^2 = (d p/d rho)_T + T (d p/d T)_rho^2/(rho^2 c_v); mass 1; nan where c^2 < 0, in the binodal  [sqrt(epsilon/m)]"""
        t, rho = check(temperature, density)
        heated = np.divide(self.dp_dt(t, rho), rho, out=np.ones(np.broadcast(t, rho).shape), where=rho > 0.0)
        squared = self.dp_drho(t, rho) + t * heated**2 / self.c_v(t, rho)
        return np.sqrt(np.where(squared >= 0.0, squared, math.nan))


class PowersOfTemperature(EquationOfState):
    """a_r = sum c T^n f(rho), hence e_ex = sum (1 - n) c T^n f(rho)."""

    def _terms(self, t, rho):
        return self.c * powers(t, self.n) * self._density_functions(rho)

    def _a_r(self, t, rho):
        return self._terms(t, rho).sum(-1)

    def _e_ex(self, t, rho):
        return ((1.0 - self.n) * self._terms(t, rho)).sum(-1)


class Johnson(PowersOfTemperature):
    """Modified Benedict-Webb-Rubin: sum a_i(T) rho^i/i + sum b_i(T) G_i(rho), G_i = int_0^rho r^(2i-1) exp(-gamma r^2) dr (tables 5-7)."""

    name = "johnson"
    A = ((1, 0.5, 0, -1, -2), (1, 0, -1, -2), (1, 0, -1), (0,), (-1, -2), (-1,), (-1, -2), (-2,))  # powers of T in a_1 to a_8
    B = ((-2, -3), (-2, -4), (-2, -3), (-2, -4), (-2, -3), (-2, -3, -4))  # and in b_1 to b_6

    def __init__(self):
        *self.c, self.gamma = read_columns("eos_johnson1993.csv")["x"]
        self.n = np.concatenate(self.A + self.B).astype(float)
        self.function = np.repeat(np.arange(14), [len(group) for group in self.A + self.B])

    def _density_functions(self, rho):
        # G_i = (i-1)! exp(-x)/(2 gamma^i) sum_(k >= i) x^k/k!, x = gamma rho^2, has terms of one sign; the recursion of the source
        # cancels at low density. 48 terms suffice for all x up to 7.
        x, k = self.gamma * rho**2, np.arange(1.0, 49.0)
        factorial = np.cumprod(k)
        tails = np.cumsum((powers(x, k) / factorial)[..., ::-1], axis=-1)[..., :-7:-1]
        g = tails * np.exp(-x)[..., None] * factorial[:6] / k[:6] / (2.0 * self.gamma**k[:6])
        return np.concatenate([powers(rho, k[:8]) / k[:8], g], axis=-1)[..., self.function]


class KolafaNezbeda(PowersOfTemperature):
    """Hard spheres of diameter d(T), the second virial coefficient in excess of theirs, damped, and a series (Eqs. 4, 5, 29 to 32)."""

    name = "kolafa-nezbeda"

    def __init__(self):
        table = read_columns("eos_kolafa_nezbeda1994.csv")
        c, n, j = ({term: table[key][table["term"] == term] for term in table["term"]} for key in ("value", "i", "j"))
        self.d_c, self.d_n, self.d_log, self.gamma = c["dhBH"], 0.5 * n["dhBH"], c["dhBH_ln"][0], c["gamma"][0]
        self.c = np.concatenate([c["DeltaB2hBH"], c["C"]])
        self.n = np.concatenate([1.0 + 0.5 * n["DeltaB2hBH"], 0.5 * n["C"]])
        self.j, self.damped = np.concatenate([np.ones(len(c["DeltaB2hBH"])), j["C"]]), np.arange(len(self.c)) < len(c["DeltaB2hBH"])

    def _density_functions(self, rho):
        return powers(rho, self.j) * np.exp(-self.gamma * self.damped * np.asarray(rho)[..., None]**2)

    def _spheres(self, t, rho):
        """Their packing fraction, and T d'/d."""
        terms = self.d_c * powers(t, self.d_n)
        d = terms.sum(-1) + self.d_log * np.log(t)
        return math.pi / 6.0 * rho * d**3, ((self.d_n * terms).sum(-1) + self.d_log) / d

    def _a_r(self, t, rho):
        y, _ = self._spheres(t, rho)
        return t * (5.0 / 3.0 * np.log1p(-y) + y * (34.0 - 33.0 * y + 4.0 * y**2) / (6.0 * (1.0 - y)**2)) + super()._a_r(t, rho)

    def _e_ex(self, t, rho):
        y, slope = self._spheres(t, rho)
        z = (1.0 + y + y**2 - 2.0 / 3.0 * y**3 * (1.0 + y)) / (1.0 - y)**3
        return -3.0 * t * (z - 1.0) * slope + super()._e_ex(t, rho)


class Thol(EquationOfState):
    """a_r/T = sum n tau^t delta^d {1, exp(-delta^l) or exp[-eta (delta - epsilon)^2 - beta (tau - gamma)^2]}, tau = T_c/T and
    delta = rho/rho_c (table 2); e_ex = T tau d(a_r/T)/d tau."""

    name = "thol"
    T_C, RHO_C = 1.32, 0.31

    def __init__(self):
        self.__dict__.update(read_columns("eos_thol2016.csv"))

    def _terms(self, temperature, rho):
        tau, delta = np.asarray(self.T_C / temperature)[..., None], np.asarray(rho / self.RHO_C)[..., None]
        exponent = np.sign(self.l) * delta**self.l + self.eta * (delta - self.epsilon)**2 + self.beta * (tau - self.gamma)**2
        return self.n * tau**self.t * delta**self.d * np.exp(-exponent), tau

    def _a_r(self, t, rho):
        return t * self._terms(t, rho)[0].sum(-1)

    def _e_ex(self, t, rho):
        terms, tau = self._terms(t, rho)
        return t * (terms * (self.t - 2.0 * self.beta * tau * (tau - self.gamma))).sum(-1)


class TruncatedAndShifted(EquationOfState):
    """Another equation less the mean field of what is lost at a cutoff: rho [2 pi int_c^inf u r^2 dr + (2 pi/3) c^3 u(c)]."""

    def __init__(self, whole, cutoff):
        if not CUTOFFS[0] <= cutoff <= CUTOFFS[1]:
            raise Unusable(f"cutoff {cutoff:g}: must be from {CUTOFFS[0]:g} to {CUTOFFS[1]:g}")
        tail = 4.0 * (cutoff**-9 / 9.0 - cutoff**-3 / 3.0)
        self.name, self.whole = whole.name, whole
        self.lost = 2.0 * math.pi * (tail + cutoff**3 / 3.0 * 4.0 * (cutoff**-12 - cutoff**-6))

    def _a_r(self, t, rho):
        return self.whole._a_r(t, rho) - rho * self.lost

    def _e_ex(self, t, rho):
        return self.whole._e_ex(t, rho) - rho * self.lost


EQUATIONS = {equation.name: equation for equation in (Johnson, KolafaNezbeda, Thol)}


def load(name, cutoff=None):
    """The equation of state of that name, of the potential truncated and shifted where a cutoff is given; Unusable where there is none,
    OSError where its file in data/ is missing."""
    if name not in EQUATIONS:
        raise Unusable(f"equation of state {name}: must be one of {', '.join(EQUATIONS)}")
    return EQUATIONS[name]() if cutoff is None else TruncatedAndShifted(EQUATIONS[name](), cutoff)


def constant_energy_process(eos, density0, temperature0, densities):
    """Arrays density, temperature, pressure and e_ex along `densities` for a fluid that keeps its energy 3/2 T + e_ex(T, rho) per particle
    from (density0, temperature0) on: the integral of dT = -(d e_ex/d rho)_T d rho/c_v without its error, by Newton's method in steps of
    density that keep to its branch. Unusable where c_v is not above 0 or the temperature leaves TEMPERATURES."""
    check(temperature0, [density0, *densities])
    t, total, rho, temperatures = temperature0, 1.5 * temperature0 + eos.e_ex(temperature0, density0), density0, []
    for end in densities:
        for rho in np.linspace(rho, end, 2 + int(abs(end - rho) / 0.01))[1:]:
            for _ in range(50):
                c_v = eos.c_v(t, rho)
                step = (total - 1.5 * t - eos.e_ex(t, rho)) / c_v
                t = min(max(t + step, TEMPERATURES[0]), TEMPERATURES[1])
                if abs(step) <= 1e-10 * t:  # what is left is of the order of its square
                    break
            if not (c_v > 0.0 and abs(step) <= 1e-10 * t):
                raise Unusable(f"{eos.name}: no temperature at density {rho:g} follows from (density {density0:g}, T = {temperature0:g})")
        temperatures.append(t)
    t, rho = check(temperatures, densities)
    return {"density": rho, "temperature": t, "pressure": eos.pressure(t, rho), "e_ex": eos.e_ex(t, rho)}


class Arguments(argparse.ArgumentParser):
    """Refuses wrong usage in one line, exit status 2."""

    def error(self, message):
        print(f"{self.prog}: {message}", file=sys.stderr)
        sys.exit(2)


def finite(value):
    """As a number for JSON, which has no nan: None instead."""
    return float(value) if np.isfinite(value) else None


def answer(eos, options):
    if options.process is None:
        names = ("a_r", "e_ex", "pressure", "mu_ex", "de_ex_drho", "c_v_residual", "c_v", "sound_velocity")
        return {name: finite(getattr(eos, name)(options.temperature, options.density)) for name in names}
    start, temperature = options.process
    run = constant_energy_process(eos, start, temperature, [start, *(start + (options.to - start) * k / 8 for k in range(1, 9))])
    return {name: values.tolist() for name, values in run.items()}


def main(arguments):
    parser = Arguments(prog="equation_of_state.py", description="Three equations of state of the Lennard-Jones fluid, as JSON.")
    parser.add_argument("--temperature", type=float, help=f"from {TEMPERATURES[0]:g} to {TEMPERATURES[1]:g}")
    parser.add_argument("--density", type=float, help=f"from {DENSITIES[0]:g} to {DENSITIES[1]:g}")
    parser.add_argument("--process", type=float, nargs=2, metavar=("DENSITY", "TEMPERATURE"), help="start of a process of constant energy")
    parser.add_argument("--to", type=float, metavar="DENSITY", help="its end")
    parser.add_argument("--cutoff", type=float, metavar="RC", help="truncate the potential there and shift it to zero; default: neither")
    options = parser.parse_args(arguments)
    missing = [value is None for name, value in vars(options).items() if name != "cutoff"]
    if missing not in ([True, True, False, False], [False, False, True, True]):
        parser.error("give --temperature and --density, or --process and --to")
    try:
        print(json.dumps({name: answer(load(name, options.cutoff), options) for name in EQUATIONS}, indent=2))
    except (Unusable, OSError) as error:
        print(f"equation_of_state.py: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
