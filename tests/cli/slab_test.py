"""Profiles of a slab: what is written, drawn, refused and resumed."""

import csv
import unittest

from cli_support import EXAMPLES, InterruptionTest

MODEL = ("--model-file", EXAMPLES / "liquid_vapour.toml")
SMALL = ("slab", "--particles", "200", "--width", "6", "--length", "18", "--equilibration-steps", "100", "--sampling-steps", "100",
         "--bins", "18", "--threads", "1")
LONG = ("slab", "--particles", "200", "--width", "6", "--length", "18", "--equilibration-steps", "2000", "--sampling-steps", "28000",
        "--bins", "18", "--threads", "1")


class Slab(InterruptionTest):
    def test_profiles_are_printed_written_and_drawn(self):
        result = self.done(*SMALL, *MODEL, "--out", self.folder / "slab", "--plot")
        self.assertEqual((result["outcome"], result["samples"], result["particles"]), ("done", 5, 200))
        rows = list(csv.DictReader((self.folder / "slab" / "profiles.csv").read_text().splitlines()))
        self.assertEqual(list(rows[0]), ["z", "density", "local_density", "probability_0", "probability_1", "sites"])
        self.assertEqual([{k: float(v) for k, v in row.items()} for row in rows], result["profiles"])
        self.assertEqual(len(rows), 18)
        self.assertAlmostEqual(sum(float(row["density"]) for row in rows) * 36.0, 200.0, delta=1e-9)
        self.assertEqual((self.folder / "slab" / "profiles.png").read_bytes()[:4], b"\x89PNG")

    def test_bad_input_is_refused_and_leaves_no_folder(self):
        for arguments, says in ((("--temperature", "-1"), "temperature"), (("--model-file", "missing.toml"), "missing.toml"),
                                (("--model", "lennard-jones"), "kind ucg"), (("--bins", "0"), "bins"),
                                (("--interval", "0"), "interval"), (("--precision", "mixed"), "precision")):
            self.refused_cleanly(*SMALL, *arguments, says=says)
        self.refused_cleanly("slab", "--particles", "100000", says="do not fit")

    def test_interrupted_and_killed_runs_resume_to_the_same_bits(self):
        self.assert_survives_interruption_and_kill(*LONG, checkpoint="checkpoint/slab.h5")


if __name__ == "__main__":
    unittest.main()
