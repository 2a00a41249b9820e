#!/usr/bin/python3
"""tools/plot.py on small made-up folders of insertion runs: the figures that it writes, their content, and its refusals."""

import json
import math
import sys
import unittest

import numpy as np
from plot_support import SCRIPT, PlotTest

sys.path.insert(0, str(SCRIPT.parent))
import equation_of_state  # noqa: E402
import plot_densification  # noqa: E402
import plot_insertion  # noqa: E402

RUN = 'model = "lennard-jones"\ntruncation = "tail"\nparticles = 500\n'
SCAN_HEADER = "density,temperature,method,tolerance,largest_step,evaluations,evaluations_error,distance,largest_distance"
MAP_HEADER = "density,temperature,y,z,energy,target"
HOLES_HEADER = "density,temperature,iso_energy,holes,mean_radius,semi_minor,semi_major,anisotropy,eccentricity"
GROWTH_HEADER = "time,density,temperature,pressure,excess_energy,energy,inserted_energy,evaluations,drift"
STATES = ((0.4, 2.5), (0.6, 2.5), (0.8, 2.5), (0.8, 1.5))


def scan_rows(states=STATES, methods=("usher", "descent"), tolerances=(0.01,), steps=("default",), evaluations=None):
    return [f"{rho},{t},{method},{tolerance},{step},{evaluations or 10 + 300 * rho**4},1.5,{0.3 + rho},{1 + rho}"
            for rho, t in states for method in methods for tolerance in tolerances for step in steps]


def hole_rows(holes=20):
    return [f"{rho},{t},{e},{holes},{0.1 * rho**-1.5},{0.07 * rho**-1.5},{3 / rho},{1 - rho / 2},0.99" for rho, t in STATES for e in (0, 10)]


def error_rows():
    return [f"{rho},{10.0**-k},{10.0**(-2 * k)}" for rho in (0.4, 0.8) for k in range(-3, 8)] + ["0.8,1e-14,0"]


def growth_rows(count=8):
    return [f"{k},{0.42 + 0.04 * k},{2.5 + 0.1 * k},{1 + k},{-2.5 - 0.1 * k},{1.27 - 0.01 * (k % 3)},1,10,0" for k in range(count)]


def map_rows(points=9, states=STATES):
    """A trap above the target of -2 in the middle, a hole below it at the corners."""
    x = [k / (points - 1) for k in range(points)]
    return [f"{rho},{t},{5 * y},{5 * z},{-2.5 * math.cos(2 * math.pi * y) * math.cos(2 * math.pi * z) + 1.5 * (0.2 < y < 0.8)},-2"
            for rho, t in states for z in x for y in x]


class PlotInsertion(PlotTest):
    def setUp(self):
        super().setUp()
        (self.folder / "result.json").write_text('{"outcome": "done"}')
        (self.folder / "run.toml").write_text(RUN)

    def write(self, name, header, rows):
        (self.folder / name).write_text("\n".join([header, *rows]) + "\n")

    def test_a_scan_gives_cost_and_distance(self):
        self.write("scan.csv", SCAN_HEADER, scan_rows())
        self.assert_draws("insertion-cost.png", "insertion-distance.png")

    def test_three_largest_steps_give_a_figure_of_them_and_two_do_not(self):
        self.write("scan.csv", SCAN_HEADER, scan_rows(tolerances=(0.1, 0.001), steps=("default", 0.1, 0.4)))
        self.assert_draws("insertion-cost.png", "insertion-distance.png", "insertion-step.png")
        (self.folder / "insertion-step.png").unlink()
        self.write("scan.csv", SCAN_HEADER, scan_rows(steps=(0.1, 0.4)))
        self.assert_draws("insertion-cost.png", "insertion-distance.png")

    def test_every_method_at_several_temperatures_of_several_densities_can_be_drawn(self):
        states = [(rho, t) for rho in (0.3, 0.4, 0.5, 0.6, 0.7, 0.8) for t in (1.5, 2.5, 3.5)]
        self.write("scan.csv", SCAN_HEADER, scan_rows(states, tuple(plot_insertion.METHOD_COLOURS), (0.1, 0.01), (0.05, 0.1, 0.2)))
        self.assert_draws("insertion-cost.png", "insertion-distance.png", "insertion-step.png")

    def test_holes_and_errors_give_their_figures(self):
        self.write("holes.csv", HOLES_HEADER, hole_rows())
        self.write("errors.csv", "density,error,next_error", error_rows())
        self.assert_draws("insertion-holes.png", "insertion-errors.png")

    def test_squares_among_the_holes_are_the_steps_of_descent_with_the_fewest_evaluations(self):
        rows = [row for rho in (0.4, 0.8) for step, cost in ((0.05, 20), (0.1, 9), (0.2, 12), ("default", 15))
                for row in scan_rows([(rho, 2.5)], steps=(step,), evaluations=cost)]
        self.write("scan.csv", SCAN_HEADER, rows)
        self.write("holes.csv", HOLES_HEADER, hole_rows())
        self.assert_draws("insertion-cost.png", "insertion-distance.png", "insertion-step.png", "insertion-holes.png")
        _, axes = plot_insertion.plt.subplots()
        plot_insertion.draw_best_steps(axes, plot_insertion.read_insertion(self.folder)["scan"])
        squares = [(line.get_marker(), *line.get_xdata(), *line.get_ydata()) for line in axes.lines]
        self.assertEqual(squares, [("s", 0.4, 0.1), ("s", 0.8, 0.1)])
        plot_insertion.plt.close()

    def test_maps_show_traps_and_are_drawn_for_four_states_at_most(self):
        self.write("map.csv", MAP_HEADER, map_rows(states=[*STATES, (0.9, 2.5)]))
        self.assert_draws("insertion-map.png")
        of = plot_insertion.read_insertion(self.folder)["map"][0]
        self.assertEqual([float(x) for x in np.ravel(of.traps())], [2.5, 2.5])

    def test_maps_without_a_square_grid_or_a_target_are_refused(self):
        self.write("map.csv", MAP_HEADER, map_rows()[1:])
        self.assert_refuses("80 rows of one state are not a square grid")
        self.write("map.csv", MAP_HEADER, [row.rsplit(",", 1)[0] + ",nan" for row in map_rows()])
        self.assert_refuses("target must be finite")

    def test_growth_gives_its_figure_with_and_without_equations_of_state(self):
        self.write("densification.csv", GROWTH_HEADER, growth_rows())
        self.assert_draws("densification.png")
        (self.folder / "run.toml").unlink()
        self.assert_draws("densification.png")

    def test_one_row_of_each_table_can_be_drawn(self):
        self.write("scan.csv", SCAN_HEADER, scan_rows(STATES[:1], ("usher",)))
        self.write("holes.csv", HOLES_HEADER, hole_rows()[:1])
        self.write("errors.csv", "density,error,next_error", error_rows()[:1])
        self.write("densification.csv", GROWTH_HEADER, growth_rows(1))
        self.assert_draws("densification.png", "insertion-cost.png", "insertion-distance.png", "insertion-errors.png", "insertion-holes.png")

    def test_tables_without_rows_and_holes_that_were_not_found_give_no_figure(self):
        self.write("scan.csv", SCAN_HEADER, [])
        self.write("holes.csv", HOLES_HEADER, hole_rows(0))
        self.write("errors.csv", "density,error,next_error", ["0.8,1e-14,0"])
        self.write("map.csv", MAP_HEADER, [])
        self.write("densification.csv", GROWTH_HEADER, [])
        self.assert_draws()

    def test_numbers_that_are_missing_leave_a_gap(self):
        self.write("scan.csv", SCAN_HEADER, [*scan_rows(), "0.9,2.5,usher,0.01,default,nan,nan,0,inf"])
        self.write("densification.csv", GROWTH_HEADER, growth_rows() + ["9,0.8,2.9,nan,inf,nan,1,nan,0"])
        self.assert_draws("densification.png", "insertion-cost.png", "insertion-distance.png")

    def test_a_damaged_table_is_refused_and_nothing_is_drawn(self):
        self.write("densification.csv", GROWTH_HEADER, growth_rows())
        damaged = {"scan.csv": (SCAN_HEADER, scan_rows()), "holes.csv": (HOLES_HEADER, hole_rows()),
                   "errors.csv": ("density,error,next_error", error_rows()), "map.csv": (MAP_HEADER, map_rows())}
        for name, (header, rows) in damaged.items():
            for head, body in ((header, [*rows, "0.4,2"]), (header, [rows[0].replace("0.4", "x", 1)]), (header, ["-" + rows[0]]),
                               (header.replace("density,", "rho,"), rows), (header.rsplit(",", 1)[0], rows)):
                with self.subTest(name=name, head=head, body=body[-1]):
                    self.write(name, head, body)
                    self.assert_refuses(name)
            (self.folder / name).unlink()
        for steps in (("wide",), (0.1, -0.2)):
            self.write("scan.csv", SCAN_HEADER, scan_rows(steps=steps))
            self.assert_refuses("largest_step")

    def test_single_insertions_have_nothing_to_draw(self):
        (self.folder / "result.json").write_text(json.dumps({"insertions": []}))
        self.assert_refuses("nothing to draw")

    def test_equations_of_state_start_at_the_first_row_and_keep_their_energy(self):
        self.write("densification.csv", GROWTH_HEADER, growth_rows())
        table = plot_insertion.read_insertion(self.folder)["densification"]
        run = {"model": "lennard-jones", "truncation": "tail"}
        lines = plot_densification.processes(table, run)
        self.assertEqual(list(lines), list(equation_of_state.EQUATIONS))
        for name, line in lines.items():
            self.assertAlmostEqual(line["density"][0], 0.42)
            self.assertAlmostEqual(line["density"][-1], 0.70)
            self.assertAlmostEqual(line["temperature"][0], 2.5)
            np.testing.assert_allclose(1.5 * line["temperature"] + line["e_ex"], 3.75 + equation_of_state.load(name).e_ex(2.5, 0.42))
        for other in ({"model": "kob-andersen"}, {"truncation": "shifted"}, {"model-file": "argon.toml"}):
            self.assertEqual(plot_densification.processes(table, {**run, **other}), {})

    def test_an_equation_of_state_that_says_nothing_of_the_fluid_is_left_out(self):
        table = {"density": np.array([0.4, 1.6]), "temperature": np.array([2.5, 2.6])}
        self.assertEqual(plot_densification.processes(table, {"model": "lennard-jones", "truncation": "tail"}), {})

    def test_of_several_temperatures_that_with_most_densities_stands_for_a_density(self):
        table = {"density": np.array([0.8, 0.4, 0.8, 0.6, 0.9]), "temperature": np.array([1.5, 2.5, 2.5, 2.5, 1.0])}
        self.assertEqual(plot_insertion.one_per_density(table).tolist(), [False, True, True, True, True])

    def test_the_default_largest_step_is_preferred_to_others(self):
        for steps, kept in ((("0.1", "default", "0.2"), "default"), (("0.2", "0.1"), "0.2")):
            rows, said = plot_insertion.with_one_step({"largest_step": np.array(steps)})
            self.assertEqual(rows["largest_step"].tolist(), [kept])
            self.assertEqual(len(said), kept != "default")
        self.assertAlmostEqual(plot_insertion.step_size("default", 0.4), 0.1 * 0.4**-1.5)

    def test_a_range_beyond_a_factor_of_twenty_gets_a_logarithmic_axis(self):
        for values, scale in (([5.0, 100.0], "linear"), ([5.0, 101.0], "log"), ([0.0, np.nan], "linear")):
            _, axes = plot_insertion.plt.subplots()
            plot_insertion.spread(axes.yaxis, [np.array(values)])
            self.assertEqual(axes.get_yscale(), scale)
            plot_insertion.plt.close()


if __name__ == "__main__":
    unittest.main()
