"""Flow through a slab with open faces: what is written, drawn, refused and resumed."""

import csv
import unittest

from cli_support import InterruptionTest

SMALL = ("flow", "--length", "20", "--width", "7", "--equilibration-steps", "250", "--resting-steps", "100",
         "--impedance", "2.1", "--threads", "1")
SHORT = (*SMALL, "--row-steps", "50", "--flow-steps", "200", "--sampling-steps", "100")
LONG = (*SMALL, "--flow-steps", "12000", "--sampling-steps", "100", "--row-steps", "1000")


def table(file):
    return list(csv.DictReader(file.read_text().splitlines()))


class Flow(InterruptionTest):
    def test_a_flow_is_printed_written_and_drawn(self):
        folder = self.folder / "flow"
        result = self.done(*SHORT, "--out", folder, "--plot")
        self.assertEqual((result["outcome"], result["rows"], result["outside"]), ("done", 6, "constant"))
        self.assertEqual(set(result["velocity"]), {"mean", "error", "slope", "slope_error"})
        self.assertLess(abs(result["balance"]["momentum_error"]), 1e-9)
        rows = table(folder / "flow.csv")
        self.assertEqual(list(rows[0]), ["time", "x", "density", "velocity", "velocity_y", "velocity_z", "temperature", "energy",
                                         "mass_flux", "pressure"])
        self.assertEqual(len(rows), 6 * 10)
        balance = table(folder / "balance.csv")
        self.assertEqual(float(balance[-1]["particles"]), result["balance"]["particles"])
        self.assertEqual(len(table(folder / "insertions.csv")), result["insertions"])
        for figure in ("flow", "flow-profiles", "flow-balance", "flow-insertions"):
            self.assertEqual((folder / f"{figure}.png").read_bytes()[:4], b"\x89PNG", figure)
        self.assertIn('pbc="F T T"', (folder / "last.extxyz").read_text().splitlines()[1])
        # A slab with open faces is a start of its own.
        again = self.done("flow", folder / "last.extxyz", "--resting-steps", "50", "--flow-steps", "50", "--sampling-steps", "50",
                          "--pressure", "2", "--enthalpy", "free")
        self.assertEqual(again["outcome"], "done")

    def test_a_continuum_is_written_beside_the_solver_alone(self):
        folder = self.folder / "coupled"
        result = self.done(*SHORT[:-4], "--flow-steps", "100", "--sampling-steps", "100", "--outside", "continuum", "--cells", "20",
                           "--pulse-amplitude", "0.05", "--pulse-centre", "-10", "--out", folder, "--plot")
        self.assertEqual(result["outside"], "continuum")
        cells, alone = table(folder / "continuum.csv"), table(folder / "alone.csv")
        self.assertEqual(len({row["time"] for row in cells}), 2)
        self.assertEqual(len(cells), 2 * 40)
        self.assertGreater(len(alone), len(cells))
        self.assertEqual((folder / "wave.png").read_bytes()[:4], b"\x89PNG")

    def test_bad_input_is_refused_and_leaves_no_folder(self):
        for arguments, says in ((("--density", "-0.5"), "density -0.5"), (("--mass-flux", "-1"), "mass flux -1"),
                                (("--velocity", "-1"), "velocity -1"), (("--buffer", "12"), "buffer width 12"),
                                (("--temperature", "nan"), "temperature"), (("--width", "0"), "--width"),
                                (("--nearest", "3"), "insertion from 3 to 2.5"), (("--outside", "vacuum"), "constant or continuum"),
                                (("--model", "kob-andersen"), "one species"), (("--truncation", "tail"), "tail"),
                                (("--region", "0,1,0,1,0,1"), "--nearest"), (("--cells", "10"), "--outside continuum"),
                                (("--outside", "continuum", "--cutoff", "2.5", "--cell-width", "0.2"), "coupling every"),
                                (("--outside", "continuum", "--model", "wca"), "equation of state"), (("--enthalpy", "much"), "--enthalpy"),
                                (("--sampling-steps", "900"), "900 sampling steps")):
            self.refused_cleanly(*SHORT[:-4], "--flow-steps", "200", *(() if "--sampling-steps" in arguments else SHORT[-2:]), *arguments, says=says)

    def test_a_rate_that_nothing_can_follow_ends_with_its_reason(self):
        folder = self.folder / "fast"
        result = self.done(*SHORT, "--velocity", "2000", "--out", folder, status=1)
        self.assertEqual(result["outcome"], "rate too high")
        self.assertTrue((folder / "last.extxyz").exists())

    def test_interrupted_and_killed_runs_resume_to_the_same_bits(self):
        self.assert_survives_interruption_and_kill(*LONG, checkpoint="checkpoint/flow.h5")


if __name__ == "__main__":
    unittest.main()
