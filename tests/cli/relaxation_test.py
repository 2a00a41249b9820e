"""Relaxation in `diffusion`: scattering function, tau_alpha, alpha_2, chi_4 and displacements at lags spaced by factors."""

import csv
import math
import unittest

from cli_support import ARGON, PROTOCOL, ProgramTest

FLUID = ("diffusion", *ARGON, "--particles", "64", "--density", "0.8", "--temperature", "1.5", *PROTOCOL[:-2])
SHORT = ("--lags", "50", "--records", "200", "--between", "10")
SPHERES = ("diffusion", "--model", "hard-sphere-binary", "--particles", "64", "--packing-fraction", "0.3", "--equilibration-collisions",
           "20000", "--interval", "0.02", "--between", "1000", *SHORT[:-2])
CURVES = ("squared_displacement", "intermediate_scattering", "alpha_2", "chi_4")


class Relaxation(ProgramTest):
    def table(self, out):
        with open(out / "relaxation.csv", newline="") as file:
            return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]

    def test_the_scattering_function_falls_to_an_e_th_at_tau_alpha(self):
        out = self.folder / "out"
        result = self.done(*FLUID, "--lags", "50", "--records", "2000", "--between", "10", "--trajectories", "3", "--out", out)
        argon, rows = result["species"]["Ar"], self.table(out)
        self.assertEqual(argon["wave_number"], 7.25)
        self.assertEqual(result["overlap_length"], 0.3)
        self.assertEqual(rows[-1]["time"], result["longest_relaxation_time"])
        self.assertEqual(rows[0]["time"], 0.01)
        tau = argon["tau_alpha"]
        before = [row["intermediate_scattering_Ar"] for row in rows if row["time"] < tau]
        after = [row["intermediate_scattering_Ar"] for row in rows if row["time"] >= tau]
        self.assertGreater(min(before), 1 / math.e)
        self.assertLessEqual(after[0], 1 / math.e)
        self.assertGreater(argon["tau_alpha_error"], 0.0)
        # A dense fluid at this temperature: ballistic at first, Gaussian to a tenth.
        self.assertAlmostEqual(rows[0]["squared_displacement_Ar"], 3 * result["temperature"] * 1e-4, delta=2e-5)
        self.assertTrue(all(abs(row["alpha_2_Ar"]) < 0.3 for row in rows))
        peak = max(rows, key=lambda row: row["chi_4_Ar"])
        self.assertEqual((argon["chi_4_peak"], argon["chi_4_peak_time"], argon["chi_4_peak_error"]),
                         (peak["chi_4_Ar"], peak["time"], peak["chi_4_error_Ar"]))

    def test_hard_spheres_have_a_wave_number_for_each_species(self):
        out = self.folder / "out"
        result = self.done(*SPHERES, "--wave-number", "5.2,7.25", "--overlap-length", "0.2", "--trajectories", "2",
                           "--relaxation-records", "300", "--out", out)
        self.assertEqual([result["species"][name]["wave_number"] for name in ("Xe", "Ar")], [5.2, 7.25])
        self.assertEqual(result["overlap_length"], 0.2)
        rows = self.table(out)
        self.assertEqual(sorted(rows[0]), sorted(["time"] + [f"{c}{e}_{s}" for c in CURVES for e in ("", "_error") for s in ("Xe", "Ar")]))
        self.assertGreater(rows[-1]["time"], 0.02 * 100)  # half of the records for diffusion
        self.assertEqual(rows[-1]["time"], result["longest_relaxation_time"])
        for row in rows:
            for name in ("Xe", "Ar"):
                self.assertLessEqual(abs(row[f"intermediate_scattering_{name}"]), 1.0)
                self.assertGreaterEqual(row[f"chi_4_{name}"], 0.0)

    def test_one_wave_number_serves_all_species_and_the_default_follows_the_largest(self):
        few = (*SPHERES, "--trajectories", "1")
        species = self.done(*few, "--wave-number", "6.5")["species"]
        self.assertEqual([species[name]["wave_number"] for name in species], [6.5, 6.5])
        species = self.done(*few)["species"]
        self.assertEqual([species[name]["wave_number"] for name in species], [7.25 / 1.4] * 2)
        self.assertIsNone(species["Xe"]["tau_alpha_error"])  # one trajectory

    def test_what_does_not_relax_in_the_window_has_no_time(self):
        argon = self.done(*FLUID, *SHORT[:2], "--records", "60", "--trajectories", "2", "--between", "10",
                          "--wave-number", "0.05")["species"]["Ar"]
        self.assertIsNone(argon["tau_alpha"])
        self.assertIsNone(argon["tau_alpha_error"])

    def test_bad_input_is_refused(self):
        for value in ("0", "-7.25", "nan", "inf", "7.25,0"):
            self.refused_cleanly(*FLUID, "--wave-number", value, says="wave number")
        for value in ("x", "1,", ",1", "7.25;5"):
            self.refused_cleanly(*FLUID, "--wave-number", value, says="--wave-number")
        self.refused_cleanly(*FLUID, "--wave-number", "1,2", says=("2 wave numbers", "1 is allowed"))
        self.refused_cleanly(*SPHERES, "--wave-number", "1,2,3", says=("3 wave numbers", "hard-sphere-binary", "2, one for each species"))
        for value in ("0", "-0.3", "nan"):
            self.refused_cleanly(*FLUID, "--overlap-length", value, says="overlap length")
        for value in ("0", "1"):
            self.refused_cleanly(*FLUID, "--relaxation-records", value, says=f"{value} records for relaxation")


if __name__ == "__main__":
    unittest.main()
