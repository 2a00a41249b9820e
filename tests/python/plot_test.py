#!/usr/bin/python3
"""tools/plot.py on small made-up run folders: the figures that it writes, and its refusals."""

import json
import math
import unittest

from plot_support import PlotTest

PATH_HEADER = "step,length,distance_to_goal,energy,direct_fraction,participation_ratio"
END_POINT_HEADER = "step,time,temperature,potential_energy_per_particle,energy_per_particle,phase"


def path_summary(outcome="reached", ratio=0.25, method="contour"):
    return {"outcome": outcome, "length": 20.0, "distance": 10.0, "ratio_squared": ratio, "participation_ratio": 0.4,
            "steps": {"direct": 10, method: 90}, "landscape_energy": -50.0, "reversed": False}


def path_rows(count, gap=0.01):
    return [f"{k + 1},{20.0 * (k + 1) / count},{10.0 * (1 - (k + 1) / count)},{-50.0 - gap * (1 + k % 7)},"
            f"{0.1 * (k % 2)},{0.4 + 0.01 * (k % 5)}"
            for k in range(count)]


def end_point_rows(phases):
    return [f"{k},{0.001 * k},{1 + 0.01 * (k % 3)},{-6 + 0.01 * (k % 4)},-4.5,{phase}" for k, phase in enumerate(phases)]


def write_table(file, header, rows):
    file.write_text("\n".join([header, *rows]) + "\n")


class Plot(PlotTest):
    def write_run(self, summaries, rows=100, gap=0.01):
        (self.folder / "result.json").write_text(json.dumps({"paths": summaries, "model": "kob-andersen"}))
        (self.folder / "run.toml").write_text("temperature = 1.0\n")
        for number in range(1, len(summaries) + 1):
            write_table(self.folder / f"path-{number:04}-trace.csv", PATH_HEADER, path_rows(rows, gap))
            (self.folder / f"path-{number:04}.extxyz").write_text("5\n")

    def write_end_points(self, phases):
        write_table(self.folder / "endpoints-trace.csv", END_POINT_HEADER, end_point_rows(phases))
        write_table(self.folder / "radial-distribution.csv", "r,g_Ni_Ni,g_Ni_P,g_P_P", [f"{0.1 * k},{k % 2},1,0" for k in range(20)])

    def test_one_path_and_its_equilibration_give_two_figures(self):
        self.write_run([path_summary()])
        self.write_end_points(["melting"] * 9 + ["cooling"] * 20 + ["temperature check"] * 20 + ["settling"] * 20
                              + ["towards the far end point"] * 60)
        self.assert_draws("path-0001.png", "equilibration.png")

    def test_several_paths_give_a_summary_too(self):
        self.write_run([path_summary(ratio=0.25), path_summary(ratio=0.3), path_summary("stalled", None)])
        self.assert_draws("path-0001.png", "path-0002.png", "path-0003.png", "paths.png")

    def test_one_path_that_reached_its_goal_has_no_summary(self):
        self.write_run([path_summary(), path_summary("step_limit", None)])
        self.assert_draws("path-0001.png", "path-0002.png")

    def write_analysis(self, kind="path"):
        """Two states with one distribution each."""
        (self.folder / "result.json").write_text("{}")
        write_table(self.folder / "groups.csv", "group,kind,model,particles,packing_fraction,temperature,method,stepping,runs,paths,reached",
                    [f"{kind} x phi{phi},{kind},hard-sphere-binary,108,{phi},,avoidance,faithful,1,2,2" for phi in (0.3, 0.5)])
        write_table(self.folder / "means.csv", "group,quantity,count,mean,error,low,high",
                    [f"{kind} x phi{phi},heterogeneity_pooled_Ar,2,0.1,{error},," for phi, error in ((0.3, "0.01"), (0.5, ""))])
        write_table(self.folder / "distributions.csv", "group,quantity,value,probability,error",
                    [f"{kind} x phi{phi},{quantity},{0.05 * k},0.25," for phi in (0.3, 0.5)
                     for quantity in ("log10_length_Ar", "participation_ratio", "alpha_2") for k in (1, 2, 3, 7)])

    def test_an_analysis_gives_the_figures_that_it_has_tables_for(self):
        self.write_analysis()
        self.assert_draws("analysis-participation.png", "analysis-heterogeneity.png")

    def test_damaged_tables_of_an_analysis_are_refused(self):
        for table, old, new in (("means.csv", "mean,error", "meen,error"), ("distributions.csv", "0.25", "x"), ("groups.csv", "group,kind", "group,sort")):
            self.write_analysis()
            file = self.folder / table
            file.write_text(file.read_text().replace(old, new))
            self.assert_refuses(table)

    def test_trials_of_a_shortening_give_a_figure(self):
        (self.folder / "result.json").write_text(json.dumps({"length_before": 20.0, "length": 18.0, "model": "kob-andersen"}))
        write_table(self.folder / "path-0001-trials.csv", "trial,distance_to_goal,length,accepted",
                    ["1,5,21,0", "2,4,nan,0", "3,8,18,1", "4,2,19,0"])
        self.assert_draws("shortening.png")

    def write_shortened(self, column="excess", nodes=200):
        (self.folder / "result.json").write_text(
            json.dumps({"length_before": 20.0, "length": 15.0, "distance": 10.0, "model": "kob-andersen"}))
        for name, length in (("initial-0001", 20.0), ("path-0001", 15.0)):
            write_table(self.folder / f"{name}-nodes.csv", f"length,distance_to_goal,{column},multiplier,participation_ratio",
                        [f"{length * k / (nodes - 1)},{10.0 * (1 - k / (nodes - 1))},{(k % 7) * (0.1 if column != 'excess' else -0.1)},{0.01 * (k % 3)},{0.3 + 0.01 * (k % 5)}" for k in range(nodes)])

    def test_a_path_before_and_after_shortening_gives_a_figure(self):
        for column in ("excess", "smallest_gap"):
            self.write_shortened(column)
            self.assert_draws("shortened.png")

    def test_a_shortened_path_of_three_nodes_can_be_drawn(self):
        self.write_shortened(nodes=3)
        self.assert_draws("shortened.png")

    def test_damaged_nodes_are_refused(self):
        self.write_shortened(column="potential")
        self.assert_refuses("initial-0001-nodes.csv: no column excess")
        self.write_shortened(nodes=2)
        self.assert_refuses("initial-0001-nodes.csv: fewer than 3 nodes")

    def write_relaxation(self, species, rows, error="0.01"):
        (self.folder / "result.json").write_text(json.dumps({"model": "kob-andersen", "species": {
            name: {"wave_number": 7.25, "tau_alpha": 1.5 if name == "Ni" else None} for name in species}}))
        curves = ("squared_displacement", "intermediate_scattering", "alpha_2", "chi_4")
        write_table(self.folder / "relaxation.csv", ",".join(["time"] + [f"{c}{e}_{name}" for name in species for c in curves for e in ("", "_error")]),
                    [",".join([str(0.01 * 1.2**k)] + [f"{0.001 * 1.3**k},{error},{math.exp(-0.01 * 1.3**k)},{error},0.1,{error},{k},{error}"] * len(species))
                     for k in range(rows)])

    def test_relaxation_gives_a_figure(self):
        for species, error in ((["Ni", "P"], "0.01"), (["Ar"], "nan")):  # a single trajectory has no errors
            self.write_relaxation(species, 30, error)
            self.assert_draws("relaxation.png")
        self.write_relaxation(["Ar"], 1, "nan")
        self.assert_draws("relaxation.png")

    def test_damaged_relaxation_is_refused(self):
        (self.folder / "result.json").write_text("{}")
        write_table(self.folder / "relaxation.csv", "time,squared_displacement_error_Ar", ["0.1,0.2"])
        self.assert_refuses("relaxation.csv: no column squared_displacement_Ar")

    def test_equal_ratios_can_be_drawn(self):
        self.write_run([path_summary(), path_summary()], rows=5)
        self.assert_draws("path-0001.png", "path-0002.png", "paths.png")

    def test_a_stalled_path_can_be_drawn(self):
        self.write_run([path_summary("stalled", None, "escape")], gap=-1e-9)
        self.assert_draws("path-0001.png")

    def test_a_trace_of_one_row_can_be_drawn(self):
        self.write_run([path_summary("interrupted", None)], rows=1)
        self.write_end_points(["melting"])
        self.assert_draws("path-0001.png", "equilibration.png")

    def test_a_trace_without_rows_can_be_drawn(self):
        self.write_run([path_summary("interrupted", None)], rows=0)
        self.assert_draws("path-0001.png")

    def test_a_path_exactly_at_the_landscape_energy_can_be_drawn(self):
        self.write_run([path_summary()], gap=0.0)
        self.assert_draws("path-0001.png")

    def test_end_points_interrupted_while_cooling_can_be_drawn(self):
        self.write_run([])
        self.write_end_points(["melting"] * 9 + ["cooling"] * 3)
        self.assert_draws("equilibration.png")

    def test_a_missing_folder_is_refused(self):
        self.folder = self.folder / "nowhere"
        self.assert_refuses("nowhere")

    def test_a_missing_result_is_refused(self):
        self.assert_refuses("result.json")

    def test_a_missing_trace_is_refused(self):
        self.write_run([path_summary(), path_summary()])
        (self.folder / "path-0002-trace.csv").unlink()
        self.assert_refuses("path-0002-trace.csv")

    def test_a_missing_radial_distribution_is_refused(self):
        self.write_run([path_summary()])
        self.write_end_points(["melting"] * 3)
        (self.folder / "radial-distribution.csv").unlink()
        self.assert_refuses("radial-distribution.csv")

    def test_a_damaged_trace_is_refused(self):
        self.write_run([path_summary()])
        write_table(self.folder / "path-0001-trace.csv", PATH_HEADER, ["1,2,3"])
        self.assert_refuses("path-0001-trace.csv")

    def test_a_damaged_histogram_is_refused(self):
        self.write_run([path_summary()])
        write_table(self.folder / "path-0001-particles.csv", "particle,species,path_length,displacement", ["0,Ni,2.0,1.0"])
        for rows in (["participation_ratio,0.1,many"], ["participation_ratio,0.1"]):
            write_table(self.folder / "path-0001-steps.csv", "quantity,value,steps", rows)
            self.assert_refuses("path-0001-steps.csv")

    def test_an_empty_run_is_refused(self):
        self.write_run([])
        self.assert_refuses("nothing to draw")


if __name__ == "__main__":
    unittest.main()
