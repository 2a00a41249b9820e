"""The check of all kernels against the reference."""

import unittest
import xml.etree.ElementTree

from cli_support import DATA, OVERLAP, ProgramTest, frame


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
        self.assertEqual(counts[1]["lennard_jones_energy"], counts[0]["lennard_jones_energy"] + 4)

    def test_a_forced_instruction_set_is_the_only_one_and_the_others_are_said_to_be_skipped(self):
        isa = self.done("info")["isas"][0]
        for result in (self.done("verify", "--isa", isa), self.done("verify", LANESCAPE_ISA=isa)):
            self.assertEqual({k["isa"] for k in result["kernels"]}, {isa})
            self.assertNotIn(isa, [s["isa"] for s in result["skipped"]])
            self.assertTrue(all(s["reason"] for s in result["skipped"]))

    def test_bad_files_are_refused(self):
        self.refused_cleanly("verify", self.folder / "missing.xyz", says="missing.xyz")
        self.refused_cleanly("verify", self.file("o.xyz", frame(*OVERLAP)), "--model", "lennard-jones", says=("o.xyz", "1 and 3"))
        self.refused_cleanly("verify", "--junit", "/proc/junit.xml", says="/proc/junit.xml")


if __name__ == "__main__":
    unittest.main()
