"""Kernels of a host that is no shared library: cases writes them, the host answers in JSON, check compares."""

import json
import unittest
import xml.etree.ElementTree

import numpy

from cli_support import ProgramTest, lanescape

NAME = "lennard-jones N=9 all shifted"


def frames(path):
    """(comment, symbols, numbers) of each frame of an extended XYZ file."""
    lines = path.read_text().splitlines()
    while lines:
        count = int(lines[0])
        rows = [line.split() for line in lines[2:2 + count]]
        yield lines[1], [row[0] for row in rows], numpy.array([[float(x) for x in row[1:]] for row in rows])
        lines = lines[2 + count:]


def one_component(case, positions):
    """Energy, forces and virial of a Lennard-Jones fluid, cut and shifted, with all images: plain loops, as a host has them."""
    box, cutoff = numpy.array(case["box"]), case["cutoff"][0][0]
    most = numpy.ceil(cutoff / box + 0.5).astype(int)
    shift = 4 * (cutoff ** -12 - cutoff ** -6)
    energy, virial, forces = 0.0, 0.0, numpy.zeros_like(positions)
    for boxes in numpy.ndindex(*(2 * most + 1)):
        d = positions[:, None] - positions[None]
        d += (numpy.array(boxes) - most) * box - box * numpy.rint(d / box)
        r2 = (d * d).sum(axis=-1)
        near = (r2 < cutoff * cutoff) & (r2 > 0)
        r6 = 1 / numpy.where(near, r2, 1) ** 3
        over_r = numpy.where(near, 24 * r6 * (2 * r6 - 1) / numpy.where(near, r2, 1), 0)
        energy += 0.5 * numpy.where(near, 4 * r6 * (r6 - 1) - shift, 0).sum()
        virial += 0.5 * (over_r * r2).sum()
        forces += (over_r[..., None] * d).sum(axis=1)
    return {"energy": energy, "forces": forces.tolist(), "virial": virial}


class HostCases(ProgramTest):
    def setUp(self):
        super().setUp()
        self.cases_folder = self.folder / "cases"
        self.written = self.done("cases", "--out", self.cases_folder)
        self.cases = json.loads((self.cases_folder / "cases.json").read_text())["cases"]
        self.positions = list(frames(self.cases_folder / "cases.extxyz"))

    def case(self, name=NAME):
        [case] = [case for case in self.cases if case["name"] == name]
        return case, self.positions[case["frame"]][2]

    def answer(self, results, text=None):
        (self.cases_folder / "host_results.json").write_text(json.dumps(results) if text is None else text)

    def check(self, *options, status=0):
        return self.done("check", self.cases_folder, *options, status=status)

    def check_refused(self, says, *options):
        self.refused_cleanly("check", self.cases_folder, *options, says=says)


class Cases(HostCases):
    def test_the_files_describe_every_case(self):
        self.assertEqual(self.written["cases"], len(self.cases))
        self.assertEqual(len({case["name"] for case in self.cases}), len(self.cases))
        for case in self.cases:
            if case["particles"] == 0:
                self.assertIsNone(case["frame"])
                continue
            comment, symbols, numbers = self.positions[case["frame"]]
            self.assertIn(case["name"], comment)
            self.assertEqual(len(symbols), case["particles"])
            self.assertLessEqual(set(symbols), set(case["species"]))
            self.assertEqual(numbers.shape[1], 4 if case["form"] == "polydisperse" else 3)
            for key in ("epsilon", "sigma", "cutoff"):
                self.assertEqual(numpy.shape(case[key]), (len(case["species"]),) * 2)
        self.assertEqual(sum(case["frame"] is not None for case in self.cases), len(self.positions))

    def test_every_potential_truncation_and_image_rule_occurs(self):
        self.assertEqual({case["form"] for case in self.cases}, {"lennard-jones", "mie", "inverse-power", "yukawa", "harmonic", "hertzian",
                                                                 "lennard-jones-12-6-4", "polydisperse"})
        self.assertEqual({case["truncation"] for case in self.cases}, {"shifted", "plain", "tail", "shifted-force", "smooth"})
        self.assertEqual({case["images"] for case in self.cases}, {"all", "minimum"})
        [mie] = [case for case in self.cases if case["name"].startswith("mie 12,6 N=9 all shifted")][:1]
        self.assertEqual(mie["numbers"], {"repulsive_exponent": 12, "attractive_exponent": 6})

    def test_a_folder_is_needed(self):
        self.refused("cases", says="--out")


class Check(HostCases):
    def test_right_results_pass_and_the_others_are_counted_as_missing_or_declined(self):
        names = [case["name"] for case in self.cases if case["species"] == ["Ar"] and case["truncation"] == "shifted" and
                 case["images"] == "all" and case["particles"]]
        self.answer({name: one_component(*self.case(name)) for name in names} | {"lennard-jones N=0 all shifted": None})
        result = self.check("--junit", self.folder / "junit.xml")
        self.assertEqual((result["compared"], result["declined"]), (len(names), 1))
        self.assertEqual(result["missing"], result["cases"] - len(names) - 1)
        self.assertEqual([q["cases"] for q in result["quantities"]], [len(names)] * 3)
        root = xml.etree.ElementTree.parse(self.folder / "junit.xml").getroot()
        self.assertEqual(len(list(root.iter("testcase"))) - len(list(root.iter("skipped"))), len(names))

    def test_a_wrong_component_is_found_and_named(self):
        right = one_component(*self.case())
        right["forces"][4][2] *= 1 + 1e-9
        self.answer({NAME: right})
        result = self.check(status=1)
        for part in (NAME, "force on particle 4 (from 0), z", "expected", "got"):
            self.assertIn(part, result["summary"])
        self.assertEqual(self.check("--precision", "single")["compared"], 1)

    def test_energies_alone_are_compared(self):
        self.answer({NAME: {"energy": one_component(*self.case())["energy"]}})
        self.assertEqual([q["cases"] for q in self.check()["quantities"]], [1, 0, 0])

    def test_nothing_to_compare_is_a_failure(self):
        for results in ({}, {NAME: None}):
            self.answer(results)
            self.assertIn("no case", self.check(status=1)["summary"])
        self.answer({NAME: {}})
        self.assertIn("neither energy nor forces", self.check(status=1)["summary"])

    def test_null_in_place_of_a_number_is_a_wrong_result(self):
        self.answer({NAME: one_component(*self.case()) | {"energy": None}})
        self.assertIn("energy: expected", self.check(status=1)["summary"])

    def test_malformed_results_are_refused(self):
        for text, says in ((" {", "line 1"), ('{"a": 1e400}', "1e400"), ('{"a":\n NaN}', ("line 2", "NaN", "null")), ("", "no JSON"), ("[]", "an object"), ("3", "an object")):
            self.answer(None, text)
            self.check_refused(("host_results.json", *((says,) if isinstance(says, str) else says)))

    def test_results_of_the_wrong_shape_are_refused(self):
        right = one_component(*self.case())
        for results, says in (({"no such case": right}, ("no such case", "unknown", "cases.json")), ({NAME: 3}, (NAME, "object")),
                              ({NAME: {"force": 1}}, (NAME, "force", "energy, forces and virial")),
                              ({NAME: {"energy": "1"}}, (NAME, "energy", "a number")), ({NAME: {"forces": 1}}, (NAME, "forces", "9 rows")),
                              ({NAME: {"forces": right["forces"][1:]}}, (NAME, "forces", "9 rows", "8")),
                              ({NAME: {"forces": [[1, 2]] * 9}}, (NAME, "forces[0]", "three numbers")),
                              ({NAME: {"forces": [[1, 2, "3"]] * 9}}, (NAME, "forces[0]", "a number"))):
            self.answer(results)
            self.check_refused(says)

    def test_files_that_were_rewritten_are_refused(self):
        self.answer({NAME: one_component(*self.case())})
        for name in ("cases.json", "cases.extxyz"):
            file = self.cases_folder / name
            original = file.read_text()
            file.write_text(original.replace("0.5", "0.50000000", 1))
            self.check_refused((name, "write the cases again"))
            file.write_text(original)
        self.check()

    def test_what_is_missing_is_refused(self):
        self.check_refused(("host_results.json", "cannot be read"))
        (self.cases_folder / "host_results.json").mkdir()
        self.check_refused(("host_results.json", "cannot be read"))
        (self.cases_folder / "host_results.json").rmdir()
        self.refused_cleanly("check", self.folder / "none", says=("none", "cannot be read"))
        self.refused_cleanly("check", says="DIR")
        self.answer({})
        self.check_refused(("half", "double, single"), "--precision", "half")
        self.check_refused("/proc/junit.xml", "--junit", "/proc/junit.xml")

    def test_a_failure_is_one_line_on_stderr(self):
        self.answer({NAME: one_component(*self.case()) | {"virial": 0}})
        run = lanescape("check", self.cases_folder)
        self.assertEqual(run.returncode, 1)
        self.assertRegex(run.stderr, r"\A1 of 1 cases are wrong, the worst is [^\n]+virial[^\n]+\n\Z")


if __name__ == "__main__":
    unittest.main()
