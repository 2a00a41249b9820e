"""The program as its users' scripts see it: exit statuses, streams, files and JSON keys.

Usage: cli_test.py PROGRAM DATA_DIR [unittest arguments]
"""

import csv
import itertools
import json
import math
import os
import pty
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import xml.etree.ElementTree
from pathlib import Path

import numpy

PROGRAM = DATA = None

SUBCOMMANDS = ("info", "energy", "overlap", "endpoints", "path", "diffusion", "insert", "verify")
COMMON_OPTIONS = ("--help", "--seed", "--threads", "--isa", "--quiet", "--config", "--out", "--resume")

# A liquid small and short enough for a test. Eight particles and the nearest image make 10^6 steps in half a second.
PROTOCOL = ("--melt-steps", "500", "--cooling-steps", "500", "--check-steps", "500", "--check-tolerance", "50",
            "--settle-steps", "200", "--between-steps", "100")
ARGON = ("--model", "lennard-jones", "--images", "minimum")
TINY = ("--particles", "8", "--density", "0.8", "--temperature", "2", "--distance", "1") + PROTOCOL
FLUID = ("--particles", "32", "--density", "0.8", "--temperature", "1", "--distance", "5") + PROTOCOL

LATTICE = 'Lattice="4 0 0 0 4 0 0 0 4"'
PROPERTIES = "Properties=species:S:1:pos:R:3"
HEADER = f'{LATTICE} {PROPERTIES} pbc="T T T"'


def with_options(arguments, *changes):
    """The arguments with some options changed or added: the program takes each option once."""
    arguments = list(arguments)
    for option, value in zip(changes[::2], changes[1::2]):
        if option in arguments:
            arguments[arguments.index(option) + 1] = value
        else:
            arguments += [option, value]
    return arguments


def frame(*particles, header=HEADER, count=None):
    return "\n".join([str(len(particles) if count is None else count), header, *particles]) + "\n"


TWO = ("Ar 0 0 0", "Ar 1.1 0 0")
TWO_MOVED = ("Ar 0 0 0.5", "Ar 1.2 0.3 0")
OVERLAP = ("Ar 1 1 1", "Ar 0 0 0", "Ar 2 2 2", "Ar 0.2 0.1 3.9")  # 1 and 3, across the wall


def environment(**changes):
    result = {k: v for k, v in os.environ.items() if k not in ("LANESCAPE_ISA", "OMP_NUM_THREADS")}
    result.update(changes)
    return result


def lanescape(*arguments, cwd=None, timeout=30, **variables):
    return subprocess.run([PROGRAM, *map(str, arguments)], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          cwd=cwd, timeout=timeout, env=environment(**variables))


def one_object(text):
    """The JSON object that the text is, and nothing besides it."""
    def refuse_duplicates(pairs):
        keys = [key for key, _ in pairs]
        assert len(keys) == len(set(keys)), keys
        return dict(pairs)
    result = json.loads(text, object_pairs_hook=refuse_duplicates)
    assert isinstance(result, dict), text
    return result


def without_seconds(result):
    """All that one seed decides: no times, and no folder in the names of files."""
    if isinstance(result, dict):
        return {k: Path(v).name if k == "file" and v else without_seconds(v) for k, v in result.items() if k != "seconds"}
    return [without_seconds(v) for v in result] if isinstance(result, list) else result


def contents(folder):
    """Every file of a run by name, byte for byte, apart from times and binary checkpoints."""
    files = {}
    for file in sorted(Path(folder).iterdir()):
        if file.name == "result.json":
            files[file.name] = without_seconds(one_object(file.read_text()))
        elif file.name in ("paths.csv", "scan.csv"):
            files[file.name] = [{k: v for k, v in row.items() if k != "seconds"} for row in csv.DictReader(file.read_text().splitlines())]
        elif file.is_file():
            files[file.name] = file.read_bytes()
    return files


class ProgramTest(unittest.TestCase):
    maxDiff = 2000

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="lanescape-cli-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def file(self, name, content):
        path = self.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    def done(self, *arguments, status=0, **options):
        run = lanescape(*arguments, **options)
        self.assertEqual(run.returncode, status, f"{arguments}: {run.stderr}")
        return one_object(run.stdout)

    def refused(self, *arguments, says=(), **options):
        """Exit 2 with nothing on stdout and one line on stderr that has all of `says`."""
        run = lanescape(*arguments, **options)
        self.assertEqual((run.returncode, run.stdout), (2, ""), f"{arguments}: {run.stderr}")
        self.assertRegex(run.stderr, r"\Alanescape: [^\n\r]+\n\Z")
        for part in (says,) if isinstance(says, str) else says:
            self.assertIn(part, run.stderr)
        return run.stderr

    def refused_cleanly(self, *arguments, **options):
        """Refused, and neither a new folder for --out, with its parents, nor an empty one is touched."""
        self.refused(*arguments, **options)
        before = sorted(self.folder.rglob("*"))
        self.refused(*arguments, "--out", self.folder / "new" / "nested", **options)
        self.assertEqual(sorted(self.folder.rglob("*")), before, f"{arguments} left a folder behind")
        (self.folder / "there").mkdir()
        self.refused(*arguments, "--out", self.folder / "there", **options)
        self.assertEqual(list((self.folder / "there").iterdir()), [], f"{arguments} left files behind")
        (self.folder / "there").rmdir()

    def make_pairs(self, name, count=1, *, seed=7):
        run = self.done("endpoints", *ARGON, *FLUID, "--pairs", count, "--seed", seed, "--out", self.folder / name)
        return [pair["file"] for pair in run["pairs"]]


class Usage(ProgramTest):
    def test_every_subcommand_has_help_with_the_common_options(self):
        for subcommand in SUBCOMMANDS:
            run = lanescape(subcommand, "--help")
            self.assertEqual((run.returncode, run.stderr), (0, ""))
            for option in COMMON_OPTIONS:
                self.assertRegex(run.stdout, rf"{option}\b", subcommand)

    def test_help_lists_the_subcommands_there_are_and_no_others(self):
        run = lanescape("--help")
        self.assertEqual(run.returncode, 0)
        listed = re.findall(r"^  ([a-z]+) ", run.stdout.split("Subcommands:")[1], re.MULTILINE)
        self.assertEqual(tuple(listed), SUBCOMMANDS)

    def test_what_nobody_has_asked_for_yet_is_absent(self):
        for subcommand in SUBCOMMANDS:
            text = lanescape(subcommand, "--help").stdout
            for absent in ("--adaptive", "swap"):
                self.assertNotIn(absent, text, subcommand)
        for absent in ("shorten", "analyze"):
            self.refused(absent, says=absent)
        self.refused("energy", self.file("two.xyz", frame(*TWO)), "--model", "water", says=("water", "kob-andersen", "ucg"))

    def test_version_is_printed(self):
        run = lanescape("--version")
        self.assertEqual(run.returncode, 0)
        self.assertEqual(run.stdout.strip(), self.done("info")["version"])

    def test_usage_errors_are_one_line_on_stderr(self):
        self.refused()
        self.refused("nonsense", says="nonsense")
        self.refused("info", "--nonsense", says="--nonsense")
        self.refused("info", "superfluous", says="superfluous")
        self.refused("info", "--seed", says="--seed")
        self.refused("energy", says="FILE")
        for bad in ("-1", "1.5", "x", "", "99999999999999999999"):
            self.refused("info", "--seed", bad, says="--seed")

    def test_thread_counts_below_one_are_refused(self):
        for bad in ("0", "-1", "100000", "x"):
            for subcommand in ("info", "endpoints", "verify"):
                self.refused(subcommand, "--threads", bad, says="--threads")

    def test_threads_come_from_the_flag_or_else_the_environment(self):
        self.assertEqual(self.done("info", OMP_NUM_THREADS="3")["threads"], 3)
        self.assertEqual(self.done("info", "--threads", "2", OMP_NUM_THREADS="3")["threads"], 2)

    def test_stdout_that_cannot_be_written_is_an_internal_error(self):
        with open("/dev/full", "w") as full:
            run = subprocess.run([PROGRAM, "info"], stdout=full, stderr=subprocess.PIPE, text=True, env=environment())
        self.assertEqual(run.returncode, 3)
        self.assertIn("stdout", run.stderr)


class Info(ProgramTest):
    def test_info_has_the_keys_of_the_contract(self):
        result = self.done("info")
        self.assertLessEqual({"version", "compiler", "cpu", "isas", "isa", "threads"}, set(result))
        self.assertRegex(result["version"], r"^\d+\.\d+\.\d+$")
        self.assertIn(result["isa"], result["isas"])
        self.assertGreaterEqual(result["threads"], 1)


class InstructionSets(ProgramTest):
    def setUp(self):
        super().setUp()
        self.isas = self.done("info")["isas"]

    def test_every_available_one_runs_is_reported_and_agrees(self):
        energies = []
        for isa in self.isas:
            self.assertEqual(self.done("info", "--isa", isa)["isa"], isa)
            result = self.done("energy", DATA / "ka_melted_108.extxyz", "--isa", isa)
            self.assertEqual(result["isa"], isa)
            energies.append(result["energy"])
        numpy.testing.assert_allclose(energies, energies[0], rtol=1e-13)

    def test_the_best_one_is_the_default(self):
        self.assertEqual(self.done("info")["isa"], self.isas[-1])
        self.assertEqual(self.done("info", "--isa", "auto")["isa"], self.isas[-1])

    def test_the_environment_chooses_and_the_flag_wins_over_it(self):
        for isa in self.isas:
            self.assertEqual(self.done("info", LANESCAPE_ISA=isa)["isa"], isa)
            self.assertEqual(self.done("info", "--isa", isa, LANESCAPE_ISA=self.isas[0])["isa"], isa)

    def test_an_unknown_one_is_refused_by_every_subcommand(self):
        two = self.file("two.xyz", frame(*TWO))
        for arguments in (("info",), ("energy", two, *ARGON), ("endpoints", *ARGON, *TINY), ("path", *ARGON, *TINY), ("verify",)):
            self.refused(*arguments, "--isa", "neon512", says=("neon512", "avx2"))
            self.refused(*arguments, LANESCAPE_ISA="neon512", says=("neon512", "avx2"))

    def test_one_seed_gives_the_same_end_points_twice_on_each(self):
        for isa in self.isas:
            first, second = (without_seconds(self.done("endpoints", *ARGON, *TINY, "--isa", isa)) for _ in range(2))
            self.assertEqual(first, second)
        self.assertNotEqual(first, without_seconds(self.done("endpoints", *ARGON, *TINY, "--isa", isa, "--seed", "2")))


class Energy(ProgramTest):
    def test_energy_forces_and_stress_are_those_of_ase(self):
        ase = json.loads((DATA / "ase_lennard_jones.json").read_text())
        self.assertGreaterEqual(len(ase), 9)
        for name, expected in ase.items():
            with self.subTest(name):
                result = self.done("energy", DATA / name, "--model", "lennard-jones", "--forces")
                self.assertAlmostEqual(result["energy"] / expected["energy"], 1.0, delta=1e-10)
                forces = numpy.array(expected["forces"])
                numpy.testing.assert_allclose(result["forces"], forces, rtol=0, atol=1e-10 * abs(forces).max() + 2e-12)
                lattice = [float(x) for x in re.search('Lattice="([^"]*)"', (DATA / name).read_text()).group(1).split()]
                volume = lattice[0] * lattice[4] * lattice[8]
                virial = numpy.array(expected["virial"])
                numpy.testing.assert_allclose(result["stress"], -virial / volume, rtol=0, atol=1e-10 * abs(virial).max() / volume)

    def test_keys_are_those_of_the_contract(self):
        keys = {"energy", "energy_per_particle", "virial", "stress", "particles", "model", "isa", "images", "precision"}
        file = DATA / "ka_melted_108.extxyz"
        result = self.done("energy", file)
        self.assertEqual(set(result), keys)
        self.assertEqual(set(self.done("energy", file, "--forces")), keys | {"forces"})
        self.assertEqual((result["particles"], result["model"], result["images"]), (108, "kob-andersen", "all"))
        self.assertEqual(result["energy_per_particle"], result["energy"] / 108)
        self.assertEqual(len(result["stress"]), 6)

    def test_mixed_precision_agrees_with_double_to_its_stated_error(self):
        for name in ("ka_tiny_8", "ka_melted_108", "ka_rattled_256"):
            arguments = ("energy", DATA / f"{name}.extxyz", "--forces")
            double, mixed = self.done(*arguments), self.done(*arguments, "--precision", "mixed")
            self.assertEqual((double["precision"], mixed["precision"]), ("double", "mixed"))
            self.assertNotEqual(double["energy"], mixed["energy"])
            self.assertAlmostEqual(mixed["energy"] / double["energy"], 1.0, delta=1e-6)
            expected = numpy.array(double["forces"])
            numpy.testing.assert_allclose(mixed["forces"], expected, rtol=0, atol=3e-6 * abs(expected).max())
            numpy.testing.assert_allclose(mixed["stress"], double["stress"], rtol=1e-9)

    def test_a_path_in_mixed_precision_reaches_its_goal_and_says_so(self):
        arguments = ("path", "--model", "lennard-jones", *FLUID, "--precision", "mixed", "--out", self.folder / "run")
        result = self.done(*arguments)
        self.assertEqual((result["precision"], result["paths"][0]["outcome"]), ("mixed", "reached"))
        self.assertIn('precision = "mixed"', re.sub("'", '"', (self.folder / "run" / "run.toml").read_text()))

    def test_the_reference_backend_agrees_with_the_kernels(self):
        for name, images, truncation in itertools.product(("ka_melted_108", "ka_tiny_8", "ka_rattled_256"), ("all", "minimum"),
                                                          ("shifted", "plain", "tail")):
            with self.subTest(f"{name} {images} {truncation}"):
                arguments = ("energy", DATA / f"{name}.extxyz", "--forces", "--images", images, "--truncation", truncation)
                simd, reference = self.done(*arguments), self.done(*arguments, "--backend", "reference")
                self.assertEqual(reference["isa"], "reference")
                for key in ("energy", "virial"):
                    self.assertAlmostEqual(simd[key] / reference[key], 1.0, delta=1e-12)
                for key in ("stress", "forces"):
                    expected = numpy.array(reference[key])
                    numpy.testing.assert_allclose(simd[key], expected, rtol=0, atol=1e-12 * abs(expected).max())

    def test_stress_is_minus_virial_over_volume(self):
        result = self.done("energy", DATA / "ka_melted_108.extxyz")
        volume = 108 / 1.2
        self.assertAlmostEqual(-sum(result["stress"][:3]) * volume / result["virial"], 1.0, delta=1e-9)

    def test_stress_is_the_strain_derivative_of_the_energy(self):
        lines = (DATA / "ka_melted_108.extxyz").read_text().splitlines()
        lattice = [float(x) for x in re.search('Lattice="([^"]*)"', lines[1]).group(1).split()]

        def energy(strain):
            cell = [lattice[0] * (1 + strain), 0, 0, 0, lattice[4], 0, 0, 0, lattice[8]]
            particles = []
            for line in lines[2:]:
                symbol, x, y, z = line.split()[:4]
                particles.append(f"{symbol} {float(x) * (1 + strain)!r} {y} {z}")
            header = f'Lattice="{" ".join(map(repr, cell))}" {PROPERTIES}'
            return self.done("energy", self.file("strained.xyz", frame(*particles, header=header)))["energy"]

        slope = (energy(1e-6) - energy(-1e-6)) / 2e-6
        stress = self.done("energy", DATA / "ka_melted_108.extxyz")["stress"][0]
        self.assertAlmostEqual(slope / (stress * lattice[0] * lattice[4] * lattice[8]), 1.0, delta=1e-5)

    def test_the_image_rules_differ_where_the_cutoff_exceeds_half_the_box_and_only_there(self):
        small, large = DATA / "ka_melted_108.extxyz", DATA / "ka_rattled_256.extxyz"
        both = [[self.done("energy", file, "--images", rule, "--cutoff", cutoff) for rule in ("all", "minimum")]
                for file, cutoff in ((small, 2.5), (small, 2.2), (large, 2.5))]
        self.assertEqual([r["images"] for r in both[0]], ["all", "minimum"])
        self.assertGreater(abs(both[0][0]["energy"] - both[0][1]["energy"]), 1e-3)
        for every, nearest in both[1:]:
            self.assertEqual(every["energy"], nearest["energy"])

    def test_of_several_frames_the_first_is_used(self):
        first, second = frame(*TWO), frame(*TWO_MOVED)
        energies = [self.done("energy", self.file("f.xyz", text), *ARGON)["energy"] for text in (first + second, first, second)]
        self.assertEqual(energies[0], energies[1])
        self.assertNotEqual(energies[0], energies[2])

    def test_a_model_file_replaces_the_named_model(self):
        file, data = DATA / "ka_melted_108.extxyz", self.file("ka.toml", """
            kind = "lennard-jones"
            name = "mixture"
            [[species]]
            name = "Ni"
            fraction = 0.8
            [[species]]
            name = "P"
            fraction = 0.2
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
        """)
        result = self.done("energy", file, "--model-file", data)
        self.assertEqual((result["model"], result["energy"]), ("mixture", self.done("energy", file)["energy"]))

    def test_nothing_is_written_without_out(self):
        shutil.copy(DATA / "ka_tiny_8.extxyz", self.folder)
        self.done("energy", "ka_tiny_8.extxyz", cwd=self.folder)
        self.done("path", *ARGON, *TINY, cwd=self.folder)
        self.assertEqual([f.name for f in self.folder.iterdir()], ["ka_tiny_8.extxyz"])


EXAMPLES = Path(__file__).resolve().parents[2] / "docs" / "examples"


class States(ProgramTest):
    """Models of kind ucg."""

    def melt(self, symbol):
        return self.file(f"{symbol}.extxyz", (DATA / "ar_melted_107.extxyz").read_text().replace("\nAr ", f"\n{symbol} "))

    def test_both_examples_agree_with_the_reference(self):
        # The reference takes tanh, the kernels a spline of it.
        for model, symbol in (("liquid_vapour", "Ar"), ("methanol", "C")):
            with self.subTest(model):
                arguments = ("energy", self.melt(symbol), "--model", "ucg", "--model-file", EXAMPLES / f"{model}.toml", "--forces", "--states")
                simd, reference = self.done(*arguments), self.done(*arguments, "--backend", "reference")
                self.assertEqual(reference["isa"], "reference")
                for key in ("energy", "one_body_energy", "virial"):
                    self.assertAlmostEqual(simd[key], reference[key], delta=1e-8 * abs(reference["energy"]))
                for key in ("forces", "densities", "probabilities"):
                    expected = numpy.array(reference[key])
                    numpy.testing.assert_allclose(simd[key], expected, rtol=0, atol=4e-7 * abs(expected).max())
                self.assertEqual(numpy.array(simd["probabilities"]).shape, (107, 2))
                numpy.testing.assert_allclose(numpy.sum(simd["probabilities"], axis=1), 1.0, rtol=0, atol=1e-15)

    def test_the_named_model_is_the_example(self):
        file = self.melt("Ar")
        named = self.done("energy", file, "--model", "ucg", "--forces")
        from_file = self.done("energy", file, "--model-file", EXAMPLES / "liquid_vapour.toml", "--forces")
        self.assertEqual((named.pop("model"), from_file.pop("model")), ("ucg", "liquid-vapour"))
        self.assertEqual(named, from_file)

    def test_keys_are_those_of_the_contract(self):
        keys = {"energy", "energy_per_particle", "one_body_energy", "virial", "stress", "particles", "model", "isa", "images", "precision"}
        file = self.melt("Ar")
        self.assertEqual(set(self.done("energy", file, "--model", "ucg")), keys)
        self.assertEqual(set(self.done("energy", file, "--model", "ucg", "--states")), keys | {"densities", "probabilities"})

    def test_forces_do_not_depend_on_threads_and_hardly_on_the_instruction_set(self):
        arguments = ("energy", self.melt("Ar"), "--model", "ucg", "--forces")
        one = self.done(*arguments, "--threads", 1)
        self.assertEqual(one, self.done(*arguments, "--threads", 2))
        sse2 = self.done(*arguments, "--isa", "sse2")
        numpy.testing.assert_allclose(sse2["forces"], one["forces"], rtol=0, atol=1e-11 * abs(numpy.array(one["forces"])).max())

    def test_a_path_reaches_its_goal_by_either_method(self):
        ends = self.done("endpoints", "--model", "ucg", *FLUID, "--seed", 3, "--out", self.folder / "ends")
        for method in ("contour", "escape"):
            result = self.done("path", "--model", "ucg", "--pair", ends["pairs"][0]["file"], "--method", method)
            self.assertEqual((result["paths"][0]["outcome"], result["model"], result["images"]), ("reached", "ucg", "all"))
            self.assertLess(result["paths"][0]["largest_violation"], 2e-4)

    def test_model_files_that_do_not_fit_are_refused(self):
        good = (EXAMPLES / "liquid_vapour.toml").read_text()
        tables = (EXAMPLES / "methanol.toml").read_text()
        argon, carbon = self.melt("Ar"), self.melt("C")
        for content, file, *says in (
            (good.replace("states = [0, 1]", "states = [0, 2]"), argon, "whole number from 0 to 1"),
            (good.replace("states = [0, 1]", "states = [1, 1]"), argon, "given twice"),
            (good.replace("states = [0, 1]\n", ""), argon, "'states' is missing"),
            (good[:good.rindex("[[pair]]")], argon, "states 1 and 1, is missing"),
            (good.replace("threshold = 4.0\n", ""), argon, "'threshold' is missing"),
            (good.replace("# 1: dilute\n", "\nthreshold = 2.0\n"), argon, "last state"),
            (good.replace("cutoff = 2.5\n\n[[species.state]]", "cutoff = 1.2\n\n[[species.state]]"), argon, "below its cutoff"),
            (good.replace("width = 1.5", "width = 0"), argon, "width = 0 is not allowed"),
            (good.replace("[species.density]", "[species.densty]"), argon, "unknown key 'densty'"),
            (good.replace("epsilon = 0.8", "epsilon = nan"), argon, "epsilon = nan"),
            (good + '[[filter]]\nof = "Ar"\ncounts = "Kr"\nweight = 1.0\n', argon, "unknown species 'Kr'"),
            (good + '[[filter]]\nof = "Ar"\ncounts = "Ar"\nweight = -1.0\n', argon, "weight = -1 is not allowed"),
            (tables.replace("last = 2.3", "last = 2.4", 1), carbon, "different distances"),
            (tables.replace("0.0,\n]", "0.1,\n]", 1), carbon, "must be 0"),
            (tables.replace("values = [", "values = [ 'a',", 1), carbon, "values is no number"),
        ):
            with self.subTest(says=says):
                self.assertNotIn(content, (good, tables))
                bad = self.file("bad.toml", content)
                self.refused_cleanly("energy", file, "--model-file", bad, says=("bad.toml:", *says))

    def test_options_that_do_not_fit_are_refused(self):
        file = self.melt("Ar")
        for arguments, *says in ((("--images", "minimum"), "--images", "all images"), (("--truncation", "tail"), "--truncation"),
                                 (("--precision", "mixed"), "--precision", "double"), (("--cutoff", "-1"), "cutoff -1")):
            with self.subTest(arguments):
                self.refused_cleanly("energy", file, "--model", "ucg", *arguments, says=says)
        lennard_jones = self.file("lj.toml", 'kind = "lennard-jones"\n[[species]]\nname = "Ar"\n'
                                             '[[pair]]\nspecies = ["Ar", "Ar"]\nepsilon = 1.0\nsigma = 1.0\n')
        self.refused_cleanly("energy", file, "--model", "ucg", "--model-file", lennard_jones, says=("ucg", "another kind"))
        self.refused_cleanly("energy", file, *ARGON, "--states", says=("--states", "ucg"))
        self.refused_cleanly("verify", file, "--model", "ucg", says=("verify", "sites with states"))
        self.refused_cleanly("diffusion", "--model", "ucg", *FLUID, says=("diffusion", "ucg"))
        self.refused_cleanly("energy", self.file("close.extxyz", frame("Ar 0 0 0", "Ar 0.2 0 0")), "--model", "ucg", says=("close.extxyz", "overlap"))


class EndPoints(ProgramTest):
    def test_json_and_files_are_those_of_the_contract(self):
        out = self.folder / "run"
        run = lanescape("endpoints", *ARGON, *TINY, "--pairs", "2", "--out", out)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        result = one_object(run.stdout)
        self.assertLessEqual({"pairs", "temperature"}, set(result))
        self.assertEqual(result["outcome"], "done")
        self.assertEqual(result, one_object((out / "result.json").read_text()))
        self.assertEqual([Path(p["file"]).name for p in result["pairs"]], ["pair-0001.extxyz", "pair-0002.extxyz"])
        self.assertLess(result["pairs"][0]["distance"], 1.1)
        for pair in result["pairs"]:
            self.assertEqual(set(pair), {"file", "distance", "steps", "time", "seconds"})
            self.assertGreaterEqual(pair["distance"], 1.0)
            self.assertAlmostEqual(pair["time"], pair["steps"] * 1e-3, delta=1e-12)
            lines = Path(pair["file"]).read_text().splitlines()
            self.assertEqual((len(lines), lines[0], lines[10]), (20, "8", "8"))
            ends = [numpy.array([[float(x) for x in line.split()[1:]] for line in lines[k:k + 8]]) for k in (2, 12)]
            moved = ends[1] - ends[0]
            self.assertAlmostEqual(numpy.linalg.norm(moved - moved.mean(axis=0)), pair["distance"], delta=1e-12)

    def test_without_out_pairs_have_no_file(self):
        self.assertEqual([p["file"] for p in self.done("endpoints", *ARGON, *TINY)["pairs"]], [None])

    def test_a_start_configuration_is_taken_from_a_file(self):
        start = self.file("start.xyz", frame(*[f"Ar {x} {y} {z}" for x in (0, 2) for y in (0, 2) for z in (0, 2)]))
        out = self.folder / "run"
        self.done("endpoints", *ARGON, *TINY, "--start", start, "--out", out)
        self.assertIn('Lattice="4 0 0 0 4 0 0 0 4"', (out / "pair-0001.extxyz").read_text())

    def test_a_distance_beyond_the_steps_allowed_is_a_goal_not_reached(self):
        result = self.done("endpoints", *ARGON, *with_options(TINY, "--distance", "50", "--max-pair-steps", "20"), status=1)
        self.assertEqual((result["pairs"], result["outcome"]), ([], "distance not reached"))
        result = self.done("path", *ARGON, *with_options(TINY, "--distance", "50", "--max-pair-steps", "20"), status=1)
        self.assertEqual((result["paths"], result["mean_ratio_squared"]), ([], None))

    def test_a_temperature_that_is_not_held_is_a_goal_not_reached(self):
        result = self.done("endpoints", *ARGON, *with_options(TINY, "--check-tolerance", "1e-9", "--max-checks", "2"), status=1)
        self.assertEqual((result["pairs"], result["outcome"]), ([], "temperature not held"))

    def test_stderr_has_a_progress_bar_on_a_terminal_only(self):
        arguments = ("endpoints", *ARGON, *with_options(TINY, "--melt-steps", "200000"))
        self.assertEqual(lanescape(*arguments).stderr, "")
        for quiet in (False, True):
            master, terminal = pty.openpty()
            run = subprocess.run([PROGRAM, *arguments, *(["--quiet"] if quiet else [])], stdout=subprocess.PIPE, stderr=terminal,
                                 env=environment(), timeout=60)
            os.close(terminal)
            os.set_blocking(master, False)
            try:
                shown = os.read(master, 65536).decode()
            except OSError:
                shown = ""
            os.close(master)
            self.assertEqual(run.returncode, 0)
            one_object(run.stdout)
            self.assertEqual("melting" in shown and "/s" in shown, not quiet, shown)


class Paths(ProgramTest):
    KEYS = {"outcome", "length", "distance", "ratio_squared", "participation_ratio", "steps", "evaluations", "seconds",
            "landscape_energy", "largest_violation"}

    def test_json_and_files_are_those_of_the_contract(self):
        pairs = self.make_pairs("ends", 2)
        for method in ("contour", "escape"):
            out = self.folder / method
            run = lanescape("path", *ARGON, "--pair", *pairs, "--method", method, "--frames", "5", "--out", out)
            self.assertEqual((run.returncode, run.stderr), (0, ""))
            result = one_object(run.stdout)
            self.assertLessEqual({"paths", "mean_ratio_squared", "standard_error"}, set(result))
            self.assertEqual(result, one_object((out / "result.json").read_text()))
            for path in result["paths"]:
                self.assertLessEqual(self.KEYS, set(path))
                self.assertEqual(path["outcome"], "reached")
                self.assertEqual(set(path["steps"]), {"direct", method})
                self.assertGreater(path["steps"][method], 100)
                self.assertGreater(path["length"], path["distance"])
                self.assertAlmostEqual(path["ratio_squared"], (path["distance"] / path["length"]) ** 2, delta=1e-12)
                self.assertTrue(1 / 32 <= path["participation_ratio"] <= 1)
                self.assertLessEqual(path["largest_violation"], 0.0 if method == "contour" else 1e-4 * (1 + 1e-9))
            ratios = [path["ratio_squared"] for path in result["paths"]]
            self.assertAlmostEqual(result["mean_ratio_squared"], numpy.mean(ratios), delta=1e-12)
            self.assertAlmostEqual(result["standard_error"], numpy.std(ratios, ddof=1) / math.sqrt(2), delta=1e-12)
            rows = list(csv.DictReader((out / "paths.csv").read_text().splitlines()))
            self.assertEqual([float(row["length"]) for row in rows], [path["length"] for path in result["paths"]])
            for k, pair in enumerate(pairs, 1):
                lines = (out / f"path-{k:04}.extxyz").read_text().splitlines()
                self.assertEqual(len(lines), 7 * 34)
                ends = Path(pair).read_text().splitlines()
                self.assertEqual((lines[2:34], lines[-32:]), (ends[2:34], ends[-32:]))

    def test_end_points_are_made_where_none_are_given(self):
        made = self.done("path", *ARGON, *FLUID, "--seed", "7", "--out", self.folder / "made")
        [pair] = self.make_pairs("ends")
        given = self.done("path", *ARGON, "--pair", pair)
        self.assertEqual(without_seconds(made["paths"]), without_seconds(given["paths"]))
        self.assertEqual((self.folder / "made" / "pair-0001.extxyz").read_bytes(), Path(pair).read_bytes())
        self.assertIsNone(given["standard_error"])

    def test_results_do_not_depend_on_the_number_of_threads(self):
        arguments = ("path", *ARGON, *FLUID, "--pairs", "3", "--reverse")
        one, two = (self.done(*arguments, "--threads", n, "--out", self.folder / n) for n in ("1", "2"))
        self.assertEqual(without_seconds(one), without_seconds(two))
        self.assertEqual(len(one["paths"]), 3)
        files = [contents(self.folder / n) for n in ("1", "2")]
        for f in files:
            del f["run.toml"]
        self.assertEqual(files[0], files[1])

    def test_large_systems_do_not_depend_on_the_number_of_threads(self):
        arguments = ("path", "--particles", "300", "--temperature", "2", "--quick", "--distance", "12", "--step", "0.05",
                     "--melt-steps", "300", "--cooling-steps", "300", "--check-steps", "300", "--settle-steps", "100",
                     "--check-tolerance", "1", "--frames", "3")
        one, two = (self.done(*arguments, "--threads", n, "--out", self.folder / n) for n in ("1", "2"))
        for key in ("length", "distance", "steps", "evaluations", "landscape_energy"):
            self.assertEqual(one["paths"][0][key], two["paths"][0][key])
        first, second = ((self.folder / n / "path-0001.extxyz").read_text() for n in ("1", "2"))
        self.assertEqual(first, second)

    def test_reverse_keeps_the_shorter_of_both_ways(self):
        pairs = self.make_pairs("ends", 3)
        forward = self.done("path", *ARGON, "--pair", *pairs)
        both = self.done("path", *ARGON, "--pair", *pairs, "--reverse")
        swapped = []
        for k, pair in enumerate(pairs):
            lines = Path(pair).read_text().splitlines()
            swapped.append(self.file(f"swapped-{k}.xyz", "\n".join(lines[34:] + lines[:34]) + "\n"))
        backward = self.done("path", *ARGON, "--pair", *swapped)
        for shorter, f, b in zip(both["paths"], forward["paths"], backward["paths"]):
            self.assertEqual(shorter["length"], min(f["length"], b["length"]))
            self.assertEqual(shorter["reversed"], b["length"] < f["length"])

    def test_a_step_limit_is_a_goal_not_reached(self):
        [pair] = self.make_pairs("ends")
        out = self.folder / "run"
        result = self.done("path", *ARGON, "--pair", pair, "--max-steps", "50", "--out", out, status=1)
        [path] = result["paths"]
        self.assertEqual((path["outcome"], path["ratio_squared"], sum(path["steps"].values())), ("step_limit", None, 50))
        self.assertIsNone(result["mean_ratio_squared"])
        self.assertEqual(result, one_object((out / "result.json").read_text()))

    def test_a_head_on_obstacle_is_a_stalled_path(self):
        pair = self.file("head-on.xyz", frame("Ar 0 0 0", "Ar 1.2 0 0") + frame("Ar 1.2 0 0", "Ar 0 0 0"))
        for method in ("contour", "escape"):
            [path] = self.done("path", *ARGON, "--pair", pair, "--method", method, status=1)["paths"]
            self.assertEqual((path["outcome"], path["ratio_squared"]), ("stalled", None))
            self.assertTrue(path["reason"])

    def test_a_higher_landscape_energy_shortens_the_path(self):
        [pair] = self.make_pairs("ends")
        [low] = self.done("path", *ARGON, "--pair", pair)["paths"]
        [high] = self.done("path", *ARGON, "--pair", pair, "--landscape-energy", low["landscape_energy"] + 1e6)["paths"]
        self.assertAlmostEqual(high["length"], high["distance"], delta=1e-9)
        self.assertLess(high["length"], low["length"])


SPHERES = ("--model", "hard-sphere-binary", "--particles", "32")
QUICK_SPHERES = ("--equilibration-collisions", "20000", "--between-collisions", "2000", "--distance", "6")
SPHERE_HEADER = 'Lattice="4 0 0 0 4 0 0 0 4" Properties=species:S:1:pos:R:3:radius:R:1 pbc="T T T"'


class Overlap(ProgramTest):
    def file(self, *particles, header=SPHERE_HEADER):
        path = self.folder / "spheres.extxyz"
        path.write_text(frame(*particles, header=header))
        return path

    def test_overlapping_pairs_are_named_with_their_gaps(self):
        result = self.done("overlap", self.file("Xe 0.1 0 0 0.7", "Ar 3.9 0 0 0.5", "Kr 2 2 2 0.6", "Ar 1.3 0 0 0.4"))
        self.assertEqual(result["overlaps"], 1)
        (first, second, gap), = result["pairs"]
        self.assertEqual((first, second), (0, 1))  # across the wall
        self.assertAlmostEqual(gap, 0.2 - 1.2, places=14)
        self.assertAlmostEqual(result["smallest_gap"], -1.0, places=14)

    def test_touching_spheres_do_not_overlap(self):
        result = self.done("overlap", self.file("Ar 0 0 0 0.5", "Ar 1 0 0 0.5"))
        self.assertEqual((result["overlaps"], result["pairs"], result["smallest_gap"]), (0, [], 0.0))

    def test_a_single_sphere_has_no_gap(self):
        self.assertIsNone(self.done("overlap", self.file("Ar 0 0 0 0.5"))["smallest_gap"])

    def test_radii_must_be_there_and_positive(self):
        self.refused("overlap", self.file("Ar 0 0 0 0", "Ar 1 0 0 0.5"), says="radius")
        self.refused("overlap", self.file("Ar 0 0 0 -1"), says="radius")
        self.refused("overlap", self.file("Ar 0 0 0", header=HEADER), says="radius")

    def test_a_box_below_two_diameters_is_refused(self):
        self.refused("overlap", self.file("Ar 0 0 0 1.1"), says="box edge")


class HardSpheres(ProgramTest):
    def ends(self, out, *more):
        return self.done("endpoints", *SPHERES, "--packing-fraction", "0.45", *QUICK_SPHERES, *more, "--out", out)

    def test_end_points_are_apart_and_free_of_overlaps(self):
        out = self.folder / "ends"
        result = self.ends(out, "--pairs", "2")
        self.assertEqual((len(result["pairs"]), result["outcome"]), (2, "done"))
        self.assertAlmostEqual(result["packing_fraction"], 0.45, places=12)
        for pair in result["pairs"]:
            self.assertGreaterEqual(pair["distance"], 6.0)
            self.assertEqual(pair["collisions"] % 20, 0)
            self.assertGreater(pair["time"], 0.0)
            self.assertEqual(self.done("overlap", pair["file"])["overlaps"], 0)

    def test_a_path_reaches_its_goal_with_all_its_files(self):
        ends, out = self.folder / "ends", self.folder / "path"
        pair = self.ends(ends)["pairs"][0]
        result = self.done("path", "--model", "hard-sphere-binary", "--pair", pair["file"], "--frames", "5", "--out", out)
        path, = result["paths"]
        self.assertEqual(path["outcome"], "reached")
        self.assertEqual(path["largest_violation"], 0.0)
        self.assertIsNone(path["landscape_energy"])
        self.assertEqual(set(path["steps"]), {"direct", "avoidance"})
        self.assertGreater(path["length"], path["distance"])
        self.assertAlmostEqual(path["ratio_squared"], (path["distance"] / path["length"]) ** 2, places=12)
        names = {file.name for file in out.iterdir()}
        self.assertLessEqual({"paths.csv", "path-0001.extxyz", "path-0001-trace.csv", "path-0001-steps.csv", "path-0001-particles.csv"}, names)
        rows = list(csv.DictReader((out / "path-0001-particles.csv").read_text().splitlines()))
        self.assertEqual(len(rows), 32)
        self.assertTrue(all(float(r["path_length"]) >= float(r["displacement"]) - 1e-9 for r in rows))
        steps = list(csv.DictReader((out / "path-0001-steps.csv").read_text().splitlines()))
        whole = sum(int(r["steps"]) for r in steps if r["quantity"] == "participation_ratio")
        self.assertEqual(whole, sum(path["steps"].values()))

    def test_an_interrupted_path_resumes_to_the_same_bits(self):
        ends = self.folder / "ends"
        pair = self.done("endpoints", *SPHERES, "--packing-fraction", "0.55",
                         *with_options(QUICK_SPHERES, "--distance", "30"), "--out", ends)["pairs"][0]
        arguments = ("path", "--model", "hard-sphere-binary", "--pair", pair["file"])
        whole, out = self.folder / "whole", self.folder / "cut"
        self.done(*arguments, "--out", whole)
        process = subprocess.Popen([PROGRAM, *arguments, "--out", str(out)], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True, env=environment())
        while not (out / "run.toml").exists():
            time.sleep(0.005)
        time.sleep(0.15)
        process.send_signal(signal.SIGTERM)
        stdout, _ = process.communicate(timeout=30)
        self.assertEqual((process.returncode, one_object(stdout)["paths"][0]["outcome"]), (1, "interrupted"))
        resumed = self.done("path", "--resume", out)
        self.assertEqual(without_seconds(resumed), without_seconds(one_object((whole / "result.json").read_text())))
        self.assertEqual(contents(out), contents(whole))

    def assert_resumes_from_an_interruption(self, *arguments, after):
        """Interrupted that many seconds after its folder is there, a run goes on to the bits of one left alone."""
        whole, out = self.folder / "whole", self.folder / "cut"
        self.done(*arguments, "--out", whole)
        process = subprocess.Popen([PROGRAM, *map(str, arguments), "--out", str(out)], stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment())
        while not (out / "run.toml").exists():
            time.sleep(0.005)
        time.sleep(after)
        process.send_signal(signal.SIGTERM)
        stdout, _ = process.communicate(timeout=30)
        self.assertEqual((process.returncode, one_object(stdout)["outcome"]), (1, "interrupted"))
        resumed = self.done(arguments[0], "--resume", out)
        self.assertEqual(without_seconds(resumed), without_seconds(one_object((whole / "result.json").read_text())))
        self.assertEqual(contents(out), contents(whole))

    def test_interrupted_end_points_resume_to_the_same_bits(self):
        self.assert_resumes_from_an_interruption("endpoints", *SPHERES, "--packing-fraction", "0.5", *with_options(
            QUICK_SPHERES, "--equilibration-collisions", "3000000"), after=0.3)

    def test_diffusion_interrupted_in_equilibration_resumes_to_the_same_bits(self):
        self.assert_resumes_from_an_interruption(
            "diffusion", *SPHERES, "--packing-fraction", "0.5", "--equilibration-collisions", "3000000", "--interval", "0.01",
            "--lags", "100", "--records", "500", "--trajectories", "2", "--between", "1000", after=0.3)

    def test_diffusion_interrupted_in_a_trajectory_resumes_to_the_same_bits(self):
        self.assert_resumes_from_an_interruption(
            "diffusion", *SPHERES, "--packing-fraction", "0.5", "--equilibration-collisions", "1000", "--interval", "0.002",
            "--lags", "500", "--records", "100000", "--trajectories", "4", "--between", "1000", after=0.4)

    def test_diffusion_gives_both_estimates_and_the_compressibility(self):
        result = self.done("diffusion", "--model", "hard-sphere", "--particles", "32", "--packing-fraction", "0.2", "--quick",
                           "--interval", "0.01", "--lags", "400", "--records", "4000", "--trajectories", "3", "--between", "1000")
        argon = result["species"]["Ar"]
        self.assertAlmostEqual(argon["diffusion_vacf"], argon["diffusion_msd"], delta=0.2 * argon["diffusion_msd"])
        self.assertGreater(argon["diffusion_vacf_error"], 0.0)
        self.assertAlmostEqual(result["compressibility"], 2.41, delta=0.1)
        self.assertEqual(result["trajectories"], 3)

    def test_soft_models_diffuse_too(self):
        result = self.done("diffusion", *ARGON, "--particles", "32", "--density", "0.8", "--temperature", "1", *PROTOCOL,
                           "--lags", "50", "--records", "200", "--trajectories", "2", "--between", "10")
        self.assertIn("pressure", result)
        self.assertGreater(result["species"]["Ar"]["diffusion_vacf"], 0.0)

    def test_bad_input_is_refused(self):
        endpoints = ("endpoints", *SPHERES, *QUICK_SPHERES)
        for packing in ("0", "-0.1", "0.75", "nan"):
            self.refused(*endpoints, "--packing-fraction", packing, says="packing fraction")
        self.refused(*endpoints, "--packing-fraction", "0.6", "--start-method", "lattice", says="lattice")
        self.refused(*endpoints, "--start-method", "magic", says="allowed are auto, lattice, contraction, growth")
        self.refused(*endpoints, "--temperature", "1", says="--temperature is not allowed")
        self.refused(*endpoints, "--density", "1", says="--density is not allowed")
        self.refused("endpoints", "--packing-fraction", "0.4", says="--packing-fraction is not allowed")
        self.refused("path", *SPHERES, *QUICK_SPHERES, "--method", "contour", says="contour")
        self.refused("path", "--method", "avoidance", says="avoidance")
        self.refused("path", *SPHERES, *QUICK_SPHERES, "--fictitious", "soft", says="harmonic, linear, cubic")
        self.refused("energy", DATA / "ar_tiny_4.extxyz", "--model", "hard-sphere", says="hard spheres")

    def test_overlaps_beyond_rounding_are_refused_and_rounding_is_scaled_away(self):
        file = self.folder / "pair.extxyz"
        def write(gap):
            file.write_text("".join(frame("Ar 0 0 0 0.5", f"Ar {1 + gap} {y} 0 0.5", header=SPHERE_HEADER) for y in (0, 0.5)))
        write(-1e-3)
        self.refused("path", "--model", "hard-sphere", "--pair", file, says="overlap")
        write(-1e-8)
        result = self.done("path", "--model", "hard-sphere", "--pair", file, "--out", self.folder / "path")
        self.assertLess(result["radius_factor"], 1.0)
        self.assertGreater(result["radius_factor"], 1.0 - 1e-7)
        resumed = self.done("path", "--resume", self.folder / "path")
        self.assertEqual(without_seconds(resumed), without_seconds(result))
        single = self.folder / "single.extxyz"
        single.write_text(frame("Ar 0 0 0 0.5", "Ar 0.99999999 0 0 0.5", header=SPHERE_HEADER))
        ends = self.done("endpoints", "--model", "hard-sphere", "--start", single, *with_options(QUICK_SPHERES, "--distance", "1"))
        self.assertEqual(ends["radius_factor"], result["radius_factor"])

    def test_the_away_method_reaches_its_goal_in_a_dilute_fluid(self):
        pair = self.done("endpoints", *SPHERES, "--packing-fraction", "0.1", *QUICK_SPHERES, "--out", self.folder / "ends")["pairs"][0]
        path, = self.done("path", "--model", "hard-sphere-binary", "--method", "away", "--pair", pair["file"])["paths"]
        self.assertEqual(path["outcome"], "reached")
        self.assertEqual(set(path["steps"]), {"direct", "away"})
        self.assertLess(path["largest_violation"], 1e-9)
        self.assertEqual(set(path["heterogeneity"]), {"Xe", "Ar"})
        self.refused("path", *SPHERES, "--method", "away", "--step", "0.1", says="--step is not allowed")


class Insertions(ProgramTest):
    TAIL = ("--model", "lennard-jones", "--truncation", "tail")
    SCAN = ("insert", "--scan", *TAIL, "--states", "0.4:2.5,0.5:2", "--particles", "64", "--configurations", "2", "--count", "20",
            "--methods", "usher,screened,descent", "--tolerances", "0.2,0.01", "--equilibration-steps", "200", "--between-steps", "100",
            "--widom-probes", "500", "--holes", "2", "--iso-energies", "0,5", "--traced-searches", "5", "--threads", "1")
    GROWTH = ("insert", "--densify", "0.5", *TAIL, "--particles", "64", "--rows", "4", "--rate", "0.1", "--equilibration-steps", "200",
              "--threads", "1")

    def setUp(self):
        super().setUp()
        self.fluid = DATA / "ar_dilute_63.extxyz"

    def test_each_insertion_is_reported_and_the_file_has_the_fluid_with_the_particles(self):
        for extra in ((), ("--method", "screened"), ("--method", "descent", "--measure", "absolute"), ("--energy", "-0.5")):
            out = self.folder / f"out{len(extra)}{'-'.join(extra[1:2])}"
            run = self.done("insert", self.fluid, *self.TAIL, "--count", "5", "--tolerance", "0.02", *extra, "--out", out)
            self.assertEqual((len(run["insertions"]), run["failures"], run["particles"]), (5, 0, 68))
            before = self.done("energy", self.fluid, *self.TAIL)["energy"]
            after = self.done("energy", out / "inserted.extxyz", *self.TAIL)["energy"]
            self.assertAlmostEqual(after - before, sum(i["energy"] for i in run["insertions"]), delta=1e-11)
            scale = 1.0 if run["measure"] == "absolute" else abs(run["target"])
            for insertion in run["insertions"]:
                self.assertTrue({"position", "energy", "error", "evaluations", "trials", "distance"} <= set(insertion))
                self.assertLessEqual(abs(insertion["energy"] - run["target"]), 0.02 * scale)
                self.assertAlmostEqual(insertion["error"], (insertion["energy"] - run["target"]) / scale, delta=1e-14)
            self.assertEqual(run["mean_evaluations"], sum(i["evaluations"] for i in run["insertions"]) / 5)
            self.assertEqual(one_object((out / "result.json").read_text()), run)
        mean = self.done("insert", self.fluid, *self.TAIL)["target"]
        self.assertAlmostEqual(mean, before / 63, delta=1e-12)

    def test_insertions_do_not_depend_on_the_number_of_threads(self):
        runs = [without_seconds(self.done("insert", self.fluid, *self.TAIL, "--count", "40", "--threads", threads)) for threads in "12"]
        self.assertEqual(*runs)

    def test_a_region_is_kept_and_temperatures_give_velocities(self):
        region = (1.0, 4.0, 2.0, 5.5, 0.0, 9.0)
        for wall in ("reflect", "well"):
            run = self.done("insert", self.fluid, *self.TAIL, "--count", "10", "--wall", wall, "--temperature", "1.5",
                            "--region", ",".join(map(str, region)))
            for insertion in run["insertions"]:
                self.assertEqual(len(insertion["velocity"]), 3)
                for axis, x in enumerate(insertion["position"]):
                    self.assertTrue(region[2 * axis] <= x <= region[2 * axis + 1])

    def test_species_are_inserted_and_removed(self):
        mixture = DATA / "ka_dilute_50.extxyz"
        out = self.folder / "out"
        run = self.done("insert", mixture, "--species", "P", "--count", "2", "--energy", "-1", "--remove", "3", "--removal",
                        "least-disturbance", "--out", out)
        before, after = (f.read_text().split("\n")[2:] for f in (mixture, out / "inserted.extxyz"))
        count = [sum(line.startswith("P ") for line in lines) for lines in (before, after)]
        self.assertEqual(count[1], count[0] - 1)
        self.assertEqual(len(run["removals"]), 3)
        energies = [self.done("energy", f)["energy"] for f in (mixture, out / "inserted.extxyz")]
        change = sum(i["energy"] for i in run["insertions"]) - sum(r["energy"] for r in run["removals"])
        self.assertAlmostEqual(energies[1] - energies[0], change, delta=1e-11)

    def test_a_target_that_no_place_has_ends_with_status_one_and_nothing_inserted(self):
        out = self.folder / "out"
        run = self.done("insert", self.fluid, *self.TAIL, "--energy", "-80", "--most-trials", "50", "--count", "2", "--out", out, status=1)
        self.assertEqual((run["insertions"], run["failures"], run["mean_evaluations"], run["outcome"]), ([], 2, None, "limit of trials"))
        self.assertFalse((out / "inserted.extxyz").exists())

    def test_bad_input_is_refused(self):
        empty = self.file("empty.xyz", frame(count=0))
        for arguments, says in (((self.fluid, "--region", "0,5,3,2,0,5"), ("region", "y")), ((self.fluid, "--region", "0,500,0,5,0,5"), "region"),
                                ((self.fluid, "--region", "1,2,3"), "six numbers"), ((self.fluid, "--tolerance", "0"), "tolerance"),
                                ((self.fluid, "--tolerance", "-1"), "tolerance"), ((self.fluid, "--tolerance", "nan"), "tolerance"),
                                ((self.fluid, "--energy", "inf"), "energy"), ((self.fluid, "--energy", "deep"), ("deep", "mean")),
                                ((self.fluid, "--method", "newton"), ("newton", "usher, usher-indirect")),
                                ((self.fluid, "--species", "Xx"), ("Xx", "Ar")), ((self.fluid, "--most-trials", "0"), "trials"),
                                ((self.fluid, "--largest-step", "0"), "step"), ((self.fluid, "--removal", "all"), ("all", "random")),
                                ((self.fluid, "--temperature", "-1"), "temperature"), ((empty,), "empty"), ((), "FILE"),
                                (("--scan", "--states", "0.4"), "density:temperature"), (("--scan", "--states", "-0.4:1"), "density"),
                                (("--scan", "--states", "0.4:0"), "temperature"), (("--scan", "--methods", "usher,,descent"), "--methods"),
                                (("--scan", "--energy", "mu"), "Widom"), (("--densify", "0.3"), "density"), (("--densify", "nan"), "density"),
                                (("--densify", "0.5", "--rate", "50"), "rate"), (("--densify", "0.5", "--time-step", "1"), "time step"),
                                ((self.fluid, "--precision", "mixed"), "precision"), ((self.fluid, "--plot"), "--plot")):
            with self.subTest(arguments):
                self.refused_cleanly("insert", *self.TAIL, *arguments, says=says)
        self.refused_cleanly("insert", self.fluid, "--model", "hard-sphere", says="hard spheres")

    def test_a_scan_reports_every_combination_and_state(self):
        out = self.folder / "out"
        run = self.done(*self.SCAN, "--out", out)
        self.assertEqual((len(run["scan"]), len(run["states"]), len(run["holes"]), run["failures"]), (12, 2, 4, 0))
        for row in run["scan"]:
            self.assertGreaterEqual(row["evaluations"], row["trials"])
            self.assertLessEqual(abs(row["error"]), row["tolerance"])
            self.assertEqual(row["candidates"] > 0, row["method"] == "screened")
        rows = list(csv.DictReader((out / "scan.csv").read_text().splitlines()))
        self.assertEqual([float(r["evaluations"]) for r in rows], [r["evaluations"] for r in run["scan"]])
        pairs = list(csv.DictReader((out / "errors.csv").read_text().splitlines()))
        self.assertGreater(len(pairs), 20)

    def test_growth_ends_at_the_density_asked_for_and_keeps_account_of_energy(self):
        run = self.done(*self.GROWTH)
        self.assertEqual((run["particles"], run["inserted"], run["failures"], len(run["densification"])), (80, 16, 0, 4))
        densities = [row["density"] for row in run["densification"]]
        self.assertEqual(densities, sorted(densities))
        for row in run["densification"]:
            self.assertAlmostEqual(row["energy"], 1.5 * row["temperature"] + row["excess_energy"], delta=1e-9)
            self.assertLess(abs(row["drift"]), 0.1)


class Verify(ProgramTest):
    def test_every_kernel_passes_on_every_instruction_set(self):
        junit = self.folder / "junit.xml"
        result = self.done("verify", "--junit", junit)
        self.assertIs(result["passed"], True)
        self.assertEqual({k["isa"] for k in result["kernels"]}, set(self.done("info")["isas"]))
        for kernel in result["kernels"]:
            self.assertLessEqual(kernel["worst"], kernel["tolerance"])
            self.assertGreater(kernel["cases"], 0)
        root = xml.etree.ElementTree.parse(junit).getroot()
        self.assertEqual(len(list(root.iter("testcase"))), len(result["kernels"]))
        self.assertEqual(list(root.iter("failure")), [])

    def test_files_of_the_user_are_further_cases(self):
        isa = self.done("info")["isas"][0]
        counts = [{k["kernel"]: k["cases"] for k in self.done("verify", *files, "--isa", isa, "--quiet")["kernels"]}
                  for files in ((), (DATA / "ka_melted_108.extxyz", DATA / "ka_tiny_8.extxyz"))]
        self.assertEqual(counts[1]["lj_energy"], counts[0]["lj_energy"] + 4)

    def test_a_forced_instruction_set_is_the_only_one_and_the_others_are_said_to_be_skipped(self):
        isa = self.done("info")["isas"][0]
        for result in (self.done("verify", "--isa", isa), self.done("verify", LANESCAPE_ISA=isa)):
            self.assertEqual({k["isa"] for k in result["kernels"]}, {isa})
            self.assertNotIn(isa, [s["isa"] for s in result["skipped"]])
            self.assertTrue(all(s["reason"] for s in result["skipped"]))

    def test_bad_files_are_refused(self):
        self.refused_cleanly("verify", self.folder / "missing.xyz", says="missing.xyz")
        self.refused_cleanly("verify", self.file("o.xyz", frame(*OVERLAP)), *ARGON, says=("o.xyz", "1 and 3"))
        self.refused_cleanly("verify", "--junit", "/proc/junit.xml", says="/proc/junit.xml")


class RunFiles(ProgramTest):
    def repeat(self, subcommand, *arguments):
        """Runs twice, the second time from the resolved run file of the first."""
        first = self.done(subcommand, *arguments, "--out", self.folder / "first")
        second = self.done(subcommand, "--config", self.folder / "first" / "run.toml", "--out", self.folder / "second")
        self.assertEqual(without_seconds(first), without_seconds(second))
        self.assertEqual(contents(self.folder / "first"), contents(self.folder / "second"))
        for name in ("first", "second"):
            shutil.rmtree(self.folder / name)

    def test_a_resolved_run_file_gives_the_same_result(self):
        self.repeat("info")
        self.repeat("info", "--seed", 2**64 - 1)
        self.repeat("energy", DATA / "ka_tiny_8.extxyz", "--forces", "--images", "minimum", "--cutoff", "1.9")
        self.repeat("energy", DATA / "ka_tiny_8.extxyz", "--backend", "reference", "--truncation", "tail")
        self.repeat("endpoints", *ARGON, *with_options(TINY, "--seed", "5", "--time-step", "0.0007", "--temperature", str(1 / 3)))
        self.repeat("path", *ARGON, *FLUID, "--seed", "11", "--method", "escape", "--reverse", "--step", "0.0013")
        pairs = self.make_pairs("ends", 2)
        self.repeat("path", *ARGON, "--pair", *pairs, "--landscape-energy", "-11.25", "--threads", "2")
        self.repeat("verify", DATA / "ka_tiny_8.extxyz", DATA / "ka_melted_144.extxyz", "--isa", self.done("info")["isas"][0])

    def test_flags_win_over_the_run_file(self):
        config = self.file("run.toml", f'threads = 3\nisa = "{self.done("info")["isas"][0]}"\nseed = 4\n')
        result = self.done("info", "--config", config)
        self.assertEqual((result["threads"], result["isa"]), (3, self.done("info")["isas"][0]))
        self.assertEqual(self.done("info", "--threads", "2", "--config", config)["threads"], 2)
        self.assertEqual(self.done("info", "--config", config, "--threads=2")["threads"], 2)

    def test_flags_win_over_files_lists_and_switches_of_the_run_file(self):
        two, moved = self.file("two.xyz", frame(*TWO)), self.file("moved.xyz", frame(*TWO_MOVED))
        config = self.file("energy.toml", f'file = "{two}"\nmodel = "lennard-jones"\nforces = true\n')
        energies = [self.done("energy", *arguments, "--config", config)["energy"] for arguments in ((), (moved,))]
        self.assertEqual(energies, [self.done("energy", f, *ARGON)["energy"] for f in (two, moved)])
        self.assertIn("forces", self.done("energy", "--config", config))
        self.assertNotIn("forces", self.done("energy", "--config", config, "--forces=false"))
        pairs = self.make_pairs("ends", 2)
        config = self.file("path.toml", f'pair = {json.dumps(pairs)}\nmodel = "lennard-jones"\nimages = "minimum"\n')
        self.assertEqual(len(self.done("path", "--config", config)["paths"]), 2)
        self.assertEqual(len(self.done("path", "--config", config, "--pair", pairs[1])["paths"]), 1)

    def test_the_output_folder_may_come_from_the_run_file(self):
        self.done("info", "--config", self.file("run.toml", f'out = "{self.folder / "here"}"\n'))
        self.assertTrue((self.folder / "here" / "result.json").exists())

    def test_mistakes_are_refused_with_file_and_line(self):
        for text, line, word in (("seed = 1\n\nnonsense = 2\n", 3, "nonsense"), ("seed = 1\nthreads = \n", 2, "run file"),
                                 ("[table]\nseed = 1\n", 1, "table"), ("seed = 1\nconfig = 'x'\n", 2, "config"),
                                 ("resume = 'x'\n", 1, "resume"), ("help = true\n", 1, "help"),
                                 ("seed = 1\nseed = 2\n", 2, ""), ("seed = 1979-05-27\n", 1, "seed")):
            config = self.file("bad.toml", text)
            self.refused_cleanly("info", "--config", config, says=(f"{config}:{line}:", word))
        self.refused("info", "--config", self.folder / "missing.toml", says="missing.toml")
        self.refused("info", "--config", self.folder, says=str(self.folder))
        self.refused("info", "--config", self.file("bad.toml", "seed = 'x'\n"), says="--seed")
        self.refused("info", "--config", self.file("binary.toml", bytes(range(256))), says="binary.toml")
        self.refused("endpoints", "--config", self.file("bad.toml", "particles = -3\n"), says="--particles")


class OutputFolders(ProgramTest):
    def test_a_folder_that_holds_a_run_is_refused(self):
        out = self.folder / "run"
        self.done("info", "--out", out)
        before = contents(out)
        for arguments in (("info",), ("endpoints", *ARGON, *TINY)):
            self.refused(*arguments, "--out", out, says=(str(out), "--resume"))
        self.assertEqual(contents(out), before)

    def test_a_folder_that_cannot_be_used_is_refused(self):
        file = self.file("file", "in the way")
        for bad in (file, file / "below", "/proc/lanescape"):
            for arguments in (("info",), ("endpoints", *ARGON, *TINY)):
                self.refused(*arguments, "--out", bad, says=str(bad))
        self.assertEqual(file.read_text(), "in the way")

    def test_parents_are_made(self):
        self.done("info", "--out", self.folder / "a" / "b" / "c")
        self.assertTrue((self.folder / "a" / "b" / "c" / "result.json").exists())

    def test_other_files_in_the_folder_stay(self):
        self.file("note.txt", "mine")
        self.done("info", "--out", self.folder)
        self.assertEqual(sorted(f.name for f in self.folder.iterdir()), ["note.txt", "result.json", "run.toml"])

    def test_what_a_refused_run_finds_in_its_folder_stays(self):
        self.file("note.txt", "mine")
        two = self.file("two.xyz", frame(*TWO))
        self.refused("endpoints", *ARGON, *TINY, "--start", two, "--cutoff", "1000", "--images", "all", "--out", self.folder)
        self.assertEqual(sorted(f.name for f in self.folder.iterdir()), ["note.txt", "two.xyz"])


class Resuming(ProgramTest):
    LONG_ENDS = ("endpoints", *ARGON, *with_options(TINY, "--melt-steps", "3000000", "--pairs", "2"))

    def start(self, *arguments, out):
        process = subprocess.Popen([PROGRAM, *map(str, arguments), "--out", str(out)], stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment())
        self.addCleanup(lambda: (process.poll() is None and process.kill(), process.communicate()))
        return process

    def wait_for(self, process, file):
        for _ in range(3000):
            if file.exists():
                return
            self.assertIsNone(process.poll(), "the run ended before it could be interrupted")
            time.sleep(0.005)
        self.fail(f"{file} never came")

    def interrupt(self, *arguments, out, after, with_signal):
        process = self.start(*arguments, out=out)
        self.wait_for(process, out / after)
        time.sleep(0.1)
        process.send_signal(with_signal)
        stdout, stderr = process.communicate(timeout=30)
        self.assertEqual((process.returncode, stderr), (1, ""))
        result = one_object(stdout)
        self.assertEqual(result, one_object((out / "result.json").read_text()))
        return result

    def assert_resumes_to(self, out, whole, subcommand, times=1):
        for _ in range(times):
            resumed = self.done(subcommand, "--resume", out)
        self.assertEqual(without_seconds(resumed), without_seconds(one_object((whole / "result.json").read_text())))
        self.assertEqual(contents(out), contents(whole))

    def test_interrupted_end_points_resume_to_the_same_bits(self):
        whole = self.folder / "whole"
        self.done(*self.LONG_ENDS, "--out", whole)
        for which in (signal.SIGTERM, signal.SIGINT):
            out = self.folder / which.name
            result = self.interrupt(*self.LONG_ENDS, out=out, after="run.toml", with_signal=which)
            self.assertEqual((result["outcome"], result["pairs"]), ("interrupted", []))
            self.assert_resumes_to(out, whole, "endpoints", times=2)  # the second time it is finished already

    def test_killed_end_points_resume_to_the_same_bits(self):
        whole, out = self.folder / "whole", self.folder / "killed"
        self.done(*self.LONG_ENDS, "--out", whole)
        process = self.start(*self.LONG_ENDS, out=out)
        self.wait_for(process, out / "checkpoint" / "endpoints.h5")
        process.kill()
        self.assertEqual(process.wait(), -signal.SIGKILL)
        self.assertFalse((out / "result.json").exists())
        self.assert_resumes_to(out, whole, "endpoints")

    def test_interrupted_scans_and_growth_resume_to_the_same_bits(self):
        for name, arguments, checkpoint in (
                ("scan", with_options(Insertions.SCAN, "--states", "0.4:2.5,0.5:2,0.6:2", "--equilibration-steps", "300000"), "scan.h5"),
                ("growth", with_options(Insertions.GROWTH, "--particles", "256", "--rows", "40", "--rate", "0.001"), "densification.h5")):
            whole, out, killed = (self.folder / f"{name}-{which}" for which in ("whole", "cut", "killed"))
            self.done(*arguments, "--out", whole)
            result = self.interrupt(*arguments, out=out, after=f"checkpoint/{checkpoint}", with_signal=signal.SIGTERM)
            self.assertEqual(result["outcome"], "interrupted")
            self.assert_resumes_to(out, whole, "insert", times=2)
            process = self.start(*arguments, out=killed)
            self.wait_for(process, killed / "checkpoint" / checkpoint)
            process.kill()
            process.wait()
            self.assert_resumes_to(killed, whole, "insert")

    def test_interrupted_and_killed_paths_resume_to_the_same_bits(self):
        for method in ("contour", "escape"):
            pairs = self.make_pairs(f"ends-{method}", 2)
            arguments = ("path", *ARGON, "--pair", *pairs, "--method", method, "--step", "1e-5", "--threads", "1")
            whole = self.folder / f"whole-{method}"
            self.done(*arguments, "--out", whole)
            # The files may change or go once the run has begun: it keeps copies.
            copies = [(Path(p), Path(p).read_bytes()) for p in pairs]
            runs = {which: self.folder / f"{method}-{which.name}" for which in (signal.SIGTERM, signal.SIGINT, signal.SIGKILL)}
            for which, out in runs.items():
                if which == signal.SIGKILL:
                    process = self.start(*arguments, out=out)
                    self.wait_for(process, out / "checkpoint" / "path-0001.h5")
                    process.kill()
                    process.wait()
                else:
                    result = self.interrupt(*arguments, out=out, after="run.toml", with_signal=which)
                    self.assertIn("interrupted", [path["outcome"] for path in result["paths"]])
                    self.assertEqual(len(result["paths"]), 2)
            for path, _ in copies:
                path.unlink()
            for out in runs.values():
                self.assert_resumes_to(out, whole, "path", times=2)

    def test_a_path_run_interrupted_while_end_points_are_made_resumes_to_the_same_bits(self):
        arguments = ("path", *ARGON, *with_options(FLUID, "--melt-steps", "200000"))
        whole, out = self.folder / "whole", self.folder / "cut"
        self.done(*arguments, "--out", whole)
        result = self.interrupt(*arguments, out=out, after="run.toml", with_signal=signal.SIGTERM)
        self.assertEqual((result["endpoints"]["outcome"], result["paths"]), ("interrupted", []))
        self.assert_resumes_to(out, whole, "path")

    def test_an_interrupted_run_may_go_on_with_another_number_of_threads(self):
        arguments = ("path", *ARGON, *with_options(FLUID, "--melt-steps", "200000", "--pairs", "2"), "--threads")
        whole, out = self.folder / "whole", self.folder / "cut"
        complete = self.done(*arguments, "1", "--out", whole)
        self.interrupt(*arguments, "1", out=out, after="run.toml", with_signal=signal.SIGTERM)
        self.assertEqual(without_seconds(self.done("path", "--resume", out, "--threads", "2", "--quiet")), without_seconds(complete))

    def test_every_finished_run_resumes_to_its_result(self):
        for arguments in (("info",), ("energy", DATA / "ka_tiny_8.extxyz", "--forces"), ("endpoints", *ARGON, *TINY),
                          ("path", *ARGON, *FLUID, "--max-steps", "5000000"), ("verify", "--isa", self.done("info")["isas"][0])):
            out = self.folder / arguments[0]
            self.done(*arguments, "--out", out)
            before = contents(out)
            self.done(arguments[0], "--resume", out)
            self.assertEqual(contents(out), before)

    def test_a_run_that_missed_its_goal_resumes_to_the_same_status(self):
        [pair] = self.make_pairs("ends")
        out = self.folder / "limit"
        first = self.done("path", *ARGON, "--pair", pair, "--max-steps", "50", "--out", out, status=1)
        self.assertEqual(self.done("path", "--resume", out, status=1), first)

    def test_other_flags_besides_resume_are_refused(self):
        out = self.folder / "run"
        self.done("endpoints", *ARGON, *TINY, "--out", out)
        before = contents(out)
        for flags in (("--seed", "2"), ("--seed=1",), ("--isa", "auto"), ("--out", out), ("--config", out / "run.toml"),
                      ("--distance", "2"), ("--quick",)):
            self.refused("endpoints", "--resume", out, *flags, says=(str(flags[0]).split("=")[0], "--resume"))
        self.refused("energy", "--resume", out, DATA / "ka_tiny_8.extxyz", says=("FILE", "--resume"))
        self.assertEqual(contents(out), before)

    def test_a_folder_without_a_run_is_refused(self):
        empty = self.folder / "empty"
        empty.mkdir()
        for bad in (self.folder / "missing", empty, self.file("file", "")):
            for subcommand in ("info", "energy", "endpoints", "path", "verify"):
                self.refused(subcommand, "--resume", bad, says=(str(bad), "no run to resume"))
        self.assertEqual(list(empty.iterdir()), [])

    def test_a_damaged_checkpoint_is_refused_and_kept(self):
        out = self.folder / "run"
        self.done("endpoints", *ARGON, *TINY, "--out", out)
        checkpoint = out / "checkpoint" / "endpoints.h5"
        damaged = checkpoint.read_bytes()[:5000]
        checkpoint.write_bytes(damaged)
        self.refused("endpoints", "--resume", out, says="endpoints.h5")
        self.assertEqual(checkpoint.read_bytes(), damaged)


class BadFiles(ProgramTest):
    def every_reader_refuses(self, content, *says):
        file = self.file("bad.xyz", content)
        for arguments in (("energy", file), ("energy", file, "--backend", "reference"), ("path", "--pair", file),
                          ("endpoints", "--start", file, *TINY)):
            self.refused(*arguments, *ARGON, says=("bad.xyz", *says))
        self.refused_cleanly("path", "--pair", file, *ARGON, says="bad.xyz")

    def test_headers_that_do_not_fit_are_refused(self):
        for header, word in ((LATTICE, "Properties"), (PROPERTIES, "Lattice"), ("", "Lattice"),
                             (f"{LATTICE} Properties=pos:R:3", "species"), (f"{LATTICE} Properties=species:S:1", "pos"),
                             (f"{LATTICE} Properties=species:S:1:pos:R:2", "pos"), (f"{LATTICE} Properties=species:S:1:pos:S:3", "pos"),
                             (f'Lattice="4 0 0 1 4 0 0 0 4" {PROPERTIES}', "orthorhombic"),
                             (f'Lattice="0 0 0 0 4 0 0 0 4" {PROPERTIES}', "Lattice"),
                             (f'Lattice="-4 0 0 0 4 0 0 0 4" {PROPERTIES}', "Lattice"),
                             (f'Lattice="nan 0 0 0 4 0 0 0 4" {PROPERTIES}', "Lattice"),
                             (f'Lattice="inf 0 0 0 4 0 0 0 4" {PROPERTIES}', "Lattice"),
                             (f'Lattice="4 0 0 0 4 0 0 0" {PROPERTIES}', "Lattice"),
                             (f'Lattice="4 0 0 0 4 0 0 0 4" {PROPERTIES} pbc="T T F"', "pbc")):
            with self.subTest(header):
                self.every_reader_refuses(frame(*TWO, header=header), "bad.xyz:2", word)

    def test_particle_lines_that_do_not_fit_are_refused(self):
        for line, word in (("Ar 1 1", "columns"), ("Ar 1 1 1 1", "columns"), ("Xx 1 1 1", "Xx"), ("Ar nan 1 1", "nan"),
                           ("Ar inf 1 1", "inf"), ("Ar 1 1 -inf", "inf"), ("Ar 1 x 1", "x"), ("Ar 1 1 1e999", "1e999"), ("", "columns")):
            with self.subTest(line):
                self.every_reader_refuses(frame("Ar 0 0 0", line), "bad.xyz:4", word)

    def test_counts_that_do_not_match_are_refused(self):
        for count in (0, -5, "x", "1e12", 1, 3, 10**12, 10**30):
            with self.subTest(count):
                self.every_reader_refuses(frame(*TWO, count=count))

    def test_files_that_are_no_structures_are_refused(self):
        for name, content in (("empty", b""), ("binary", bytes(range(256)) * 40), ("zeros", b"\0" * 4096), ("line ends", b"\n\n\n"),
                              ("truncated", frame(*TWO)[:-6].encode()), ("header only", frame(*TWO).splitlines()[0].encode())):
            with self.subTest(name):
                self.every_reader_refuses(content)

    def test_missing_files_and_folders_are_refused(self):
        for bad in (self.folder / "missing.xyz", self.folder):
            for arguments in (("energy", bad), ("path", "--pair", bad), ("endpoints", "--start", bad), ("verify", bad),
                              ("info", "--config", bad), ("energy", DATA / "ar_tiny_4.extxyz", "--model-file", bad)):
                self.refused_cleanly(*arguments, says=str(bad))

    def test_overlapping_particles_are_refused_with_both_indices(self):
        file = self.file("bad.xyz", frame(*OVERLAP))
        for arguments in (("energy", file), ("energy", file, "--backend", "reference"), ("endpoints", "--start", file, *TINY)):
            self.refused_cleanly(*arguments, *ARGON, says="1 and 3")
        fine = ("Ar 1 1 1", "Ar 0 0 0", "Ar 2 2 2", "Ar 3 3 3")
        for content in (frame(*OVERLAP) + frame(*fine), frame(*fine) + frame(*OVERLAP)):
            self.refused_cleanly("path", "--pair", self.file("bad.xyz", content), *ARGON, says=("bad.xyz", "1 and 3"))

    def test_end_points_that_do_not_belong_together_are_refused(self):
        two, moved = frame(*TWO), frame(*TWO_MOVED)
        other_box = frame(*TWO_MOVED, header=HEADER.replace('"4 0', '"4.1 0'))
        more = frame(*TWO_MOVED, "Ar 2 2 2")
        for name, content, words in (("one frame", two, "1 frame"), ("three frames", two + moved + two, "3 frames"),
                                     ("other box", two + other_box, "box"), ("more particles", two + more, "composition"),
                                     ("no way between", two + two, "coincide")):
            with self.subTest(name):
                self.refused_cleanly("path", "--pair", self.file("bad.xyz", content), *ARGON, says=("bad.xyz", words))
        mixed = frame("Ni 0 0 0", "P 1.1 0 0") + frame("P 0 0 0.5", "Ni 1.2 0.3 0")
        self.refused_cleanly("path", "--pair", self.file("bad.xyz", mixed), says=("bad.xyz", "composition"))

    def test_model_files_with_mistakes_are_refused(self):
        good = ('kind = "lennard-jones"\n[[species]]\nname = "Ar"\n[[pair]]\nspecies = ["Ar", "Ar"]\nepsilon = 1.0\nsigma = 1.0\n')
        two = self.file("two.xyz", frame(*TWO))
        self.done("energy", two, "--model-file", self.file("model.toml", good))
        for bad in ("", "nonsense", good.replace("lennard-jones", "hard-sphere"), good.replace("sigma = 1.0", "sigma = -1.0"), good.replace("sigma = 1.0", "sigma = nan"),
                    good.replace("epsilon = 1.0\n", ""), good + "colour = 3\n", good.replace('"Ar", "Ar"', '"Ar", "Kr"'),
                    good.replace('name = "Ar"', 'name = "Ar"\nmass = 0'), good.replace("epsilon = 1.0", 'epsilon = "one"'),
                    good.replace("[[pair]]", "[pair"), bytes(range(256)).decode("latin-1")):
            with self.subTest(bad):
                self.refused_cleanly("energy", two, "--model-file", self.file("model.toml", bad), says="model.toml")


class BadOptions(ProgramTest):
    def test_numbers_out_of_range_are_refused_by_name(self):
        matrix = {"--particles": ("0", "-5", "1e12", "1000000000000", "x"), "--density": ("0", "-1", "nan", "inf", "1e9", "x"),
                  "--temperature": ("0", "-1", "nan", "inf", "x"), "--distance": ("0", "-1", "nan", "inf"),
                  "--cutoff": ("0", "-1", "nan", "inf", "1e12", "x"), "--time-step": ("0", "-1", "nan", "1"),
                  "--melt-temperature": ("0", "-1", "nan"), "--check-tolerance": ("0", "-1", "nan"), "--pairs": ("0", "-1", "1.5"),
                  "--melt-steps": ("-1", "x"), "--rescale-interval": ("0",), "--check-interval": ("0",)}
        for option, values in matrix.items():
            for value in values:
                with self.subTest(f"{option} {value}"):
                    for subcommand in ("endpoints", "path"):
                        arguments = with_options(("--images", "all", *TINY), option, value)
                        word = option[2:].replace("-", " ").split()[-1].rstrip("s")
                        self.refused_cleanly(subcommand, "--model", "lennard-jones", *arguments, says=word)

    def test_cutoffs_out_of_range_are_refused(self):
        for value in ("0", "-1", "nan", "inf", "1e12", "1e308", "x"):
            for backend in ("simd", "reference"):
                self.refused_cleanly("energy", DATA / "ka_tiny_8.extxyz", "--cutoff", value, "--backend", backend, says="cutoff")

    def test_numbers_of_a_path_out_of_range_are_refused(self):
        pair = self.file("pair.xyz", frame(*TWO) + frame(*TWO_MOVED))
        for option, value, word in (("--step", "0", "step"), ("--step", "-1", "step"), ("--step", "nan", "step"), ("--step", "2", "step"),
                                    ("--max-steps", "0", "limit"), ("--frames", "-1", "frames"), ("--frames", "1000000000", "frames"),
                                    ("--landscape-energy", "nan", "landscape"), ("--landscape-energy", "inf", "landscape"),
                                    ("--landscape-energy", "-1e3", "landscape"), ("--cutoff", "1e12", "cutoff")):
            with self.subTest(f"{option} {value}"):
                self.refused_cleanly("path", "--model", "lennard-jones", "--pair", pair, option, value, says=word)

    def test_a_landscape_energy_below_an_end_of_any_pair_is_refused_before_a_path_is_searched(self):
        low, high = frame(*TWO) + frame(*TWO_MOVED), frame("Ar 0 0 0", "Ar 0.9 0 0") + frame("Ar 0 0 1", "Ar 0.9 0 0")
        pairs = self.file("low.xyz", low), self.file("high.xyz", high)
        self.refused_cleanly("path", *ARGON, "--pair", *pairs, "--landscape-energy", "0", "--threads", "1", says="landscape")

    def test_unknown_words_are_refused_with_those_allowed(self):
        pair = self.file("pair.xyz", frame(*TWO) + frame(*TWO_MOVED))
        for option, allowed in (("--method", "contour, escape"), ("--model", "kob-andersen, lennard-jones"), ("--images", "all, minimum"),
                                ("--truncation", "shifted, plain, tail")):
            for value in ("nonsense", "CONTOUR", " all"):
                self.refused_cleanly("path", "--pair", pair, option, value, says=(value.strip(), allowed))
        self.refused_cleanly("energy", pair, *ARGON, "--backend", "gpu", says=("gpu", "simd or reference"))
        self.refused_cleanly("endpoints", *ARGON, *TINY, "--distance-species", "Xx", says=("Xx", "Ar"))

    def test_hard_spheres_have_no_energy(self):
        two = self.file("two.xyz", frame(*TWO))
        model = self.file("model.toml", 'kind = "hard-sphere"\nname = "marbles"\n[[species]]\nname = "Ar"\ndiameter = 1.0\n')
        for subcommand in ("energy", "verify"):
            for name, arguments in (("hard-sphere", ("--model", "hard-sphere")), ("hard-sphere-binary", ("--model", "hard-sphere-binary")),
                                    ("marbles", ("--model-file", model))):
                self.refused_cleanly(subcommand, two, *arguments, says=(subcommand, f"model {name} is made of hard spheres", "kob-andersen"))

    def test_hard_spheres_have_no_cutoff_images_or_truncation(self):
        two = self.file("two.xyz", frame(*TWO))
        for option, value in (("--cutoff", "2.5"), ("--images", "all"), ("--truncation", "plain")):
            self.refused_cleanly("energy", two, "--model", "hard-sphere", option, value, says=(option, "hard-sphere"))

    def test_hard_spheres_are_not_in_mixed_precision(self):
        self.refused_cleanly("endpoints", "--model", "hard-sphere", "--particles", "32", "--precision", "mixed",
                             says=("--precision", "hard-sphere"))

    def test_precision_is_double_or_mixed_and_mixed_needs_a_list(self):
        file = DATA / "ka_tiny_8.extxyz"
        self.refused_cleanly("energy", file, "--precision", "single", says=("single", "double", "mixed"))
        self.refused_cleanly("energy", file, "--precision", "mixed", "--backend", "reference", says=("--precision", "reference"))
        for subcommand, arguments in (("energy", (file, "--images", "minimum")), ("endpoints", (*ARGON, *TINY)),
                                      ("path", (*ARGON, *TINY)), ("diffusion", (*ARGON, *TINY))):
            self.refused_cleanly(subcommand, *arguments, "--precision", "mixed", says=("minimum-image", "mixed precision"))

    def test_plots_need_a_folder(self):
        self.refused("path", *ARGON, *TINY, "--plot", says=("--plot", "--out"))


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    PROGRAM, DATA = str(Path(sys.argv[1]).resolve()), Path(sys.argv[2]).resolve()
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
