#!/usr/bin/python3
"""Builds the KIM model driver and models over this build's library and compares them with lj/cut, in Debian's LAMMPS.

kim_test.py SOURCE BUILD

77: skipped, with the reason: no KIM API, no LAMMPS with it, no MPI.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

from lammps_support import Lammps, Liquid, largest_deviation, results, skip

AGREEMENT = 1e-12
KILOCALORIES_PER_MOL = 23.060547830619  # in an eV: e N_A/(4184 J) of CODATA 2018
# Kob and Andersen's mixture in Angstrom and eV, both 1.
MIXTURE = """kind = "lennard-jones"
name = "mixture"
cutoff = 2.5
truncation = "plain"
[[species]]
name = "Ni"
[[species]]
name = "P"
[[pair]]
species = ["Ni", "Ni"]
epsilon = 1.0
sigma = 1.0
[[pair]]
species = ["Ni", "P"]
epsilon = 1.5
sigma = 0.8
[[pair]]
species = ["P", "P"]
epsilon = 0.5
sigma = 0.88
"""
TAIL = MIXTURE.replace('"plain"', '"tail"')
STRANGE = MIXTURE.replace('"Ni"', '"Nickel"')


def build(folder, source, library):
    """The environment that has the items."""
    if not Path("/usr/include/kim-api").is_dir():
        skip("the KIM API is not here (Debian: package libkim-api-dev)")
    files = []
    for name, text in (("mixture", MIXTURE), ("tail", TAIL), ("strange", STRANGE)):
        files.append(folder / f"{name}.toml")
        files[-1].write_text(text)
    argon = (source / "bindings/kim/models/argon.toml").read_text()
    files.append(folder / "argon.toml")
    files[-1].write_text(argon.replace('"shifted"', '"plain"'))
    subprocess.run(["cmake", "--install", library, "--prefix", folder / "prefix", "--component", "CXX"], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "-G", "Ninja", "-S", source / "bindings/kim", "-B", folder / "kim", f"-Dlanescape_ROOT={folder / 'prefix'}",
                    f"-DLANESCAPE_KIM_MODELS={';'.join(str(file) for file in files)}"], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", folder / "kim"], check=True, stdout=subprocess.DEVNULL)
    return {"KIM_API_MODEL_DRIVERS_DIR": str(folder / "kim/model-drivers"), "KIM_API_PORTABLE_MODELS_DIR": str(folder / "kim/portable-models")}


def kim(name, species):
    return f"pair_style kim Lanescape_{name}\npair_coeff * * {species}"


def check_agreement(folder, lammps):
    argon, mixture = Liquid(1, units="metal", sigma=3.405, epsilon=0.010341), Liquid(2, units="metal")
    for liquid, styles in ((argon, kim("argon", "Ar")), (mixture, kim("mixture", "Ni P"))):
        for newton in ("on", "off"):
            liquid.newton = newton
            for ranks in (1, 2):
                expected = results(lammps, folder, liquid, liquid.own_style(), ranks=ranks)
                found = results(lammps, folder, liquid, styles, ranks=ranks)
                deviation = largest_deviation(found, expected)
                print(f"{styles.split()[2]}, newton {newton}, {ranks} ranks: {deviation:.1e}")
                assert deviation < AGREEMENT, deviation


def check_other_units(folder, lammps):
    """Units real of LAMMPS: Angstrom and kcal/mol."""
    metal, real = (Liquid(1, units=units, sigma=3.405, epsilon=0.010341, steps=0) for units in ("metal", "real"))
    in_metal, in_real = (results(lammps, folder, liquid, kim("argon", "Ar")) for liquid in (metal, real))
    for column in (4, 5, 6, 7):  # forces and energies of atoms; the KIM API's constant differs by 7.6e-7
        largest = abs(in_metal[1][0][:, column]).max()
        assert abs(in_real[1][0][:, column] / KILOCALORIES_PER_MOL - in_metal[1][0][:, column]).max() < 1e-6 * largest


def check_refusals(folder, lammps):
    liquid = Liquid(2, units="metal")
    for styles, words in ((kim("tail", "Ni P"), "truncation tail"), (kim("strange", "Ni P"), "species Nickel"),
                          (kim("mixture", "Ni Ar"), "symbol not found: Ar")):
        output, status = lammps.run(folder, liquid.script(styles))
        log = "".join(file.read_text() for file in folder.glob("kim.log"))
        assert status != 0 and words in output + log, (words, output[-400:], log[-400:])


def check_simulator(folder, source, environment):
    flags = subprocess.run(["pkg-config", "--cflags", "--libs", "libkim-api"], check=True, capture_output=True, text=True).stdout.split()
    subprocess.run(["c++", "-std=c++17", source / "tests/engines/kim_simulator.cpp", *flags, "-o", folder / "simulator"], check=True)
    subprocess.run([folder / "simulator", "Lanescape_argon", "Ar"], check=True, cwd=folder, env={**environment, "PATH": "/usr/bin:/bin"})


def main():
    source, library = (Path(word).resolve() for word in sys.argv[1:])
    lammps = Lammps.of_debian()
    with tempfile.TemporaryDirectory(prefix="lanescape-kim-") as name:
        folder = Path(name)
        lammps.environment = build(folder, source, library)
        check_simulator(folder, source, lammps.environment)
        check_agreement(folder, lammps)
        check_other_units(folder, lammps)
        check_refusals(folder, lammps)


if __name__ == "__main__":
    main()
