"""Insertion into a fluid, scans of its cost, and densification."""

import csv
import unittest

from cli_support import DATA, FLUID, GROWTH, SCAN, TAIL, ProgramTest, frame, one_object, with_options, without_seconds


class Insertions(ProgramTest):
    def setUp(self):
        super().setUp()
        self.fluid = DATA / "ar_dilute_63.extxyz"

    def test_each_insertion_is_reported_and_the_file_has_the_fluid_with_the_particles(self):
        for extra in ((), ("--method", "screened"), ("--method", "descent", "--measure", "absolute"), ("--energy", "-0.5")):
            out = self.folder / f"out{len(extra)}{'-'.join(extra[1:2])}"
            run = self.done("insert", self.fluid, *TAIL, "--count", "5", "--tolerance", "0.02", *extra, "--out", out)
            self.assertEqual((len(run["insertions"]), run["failures"], run["particles"]), (5, 0, 68))
            before = self.done("energy", self.fluid, *TAIL)["energy"]
            after = self.done("energy", out / "inserted.extxyz", *TAIL)["energy"]
            self.assertAlmostEqual(after - before, sum(i["energy"] for i in run["insertions"]), delta=1e-11)
            scale = 1.0 if run["measure"] == "absolute" else abs(run["target"])
            for insertion in run["insertions"]:
                self.assertTrue({"position", "energy", "error", "evaluations", "trials", "distance"} <= set(insertion))
                self.assertLessEqual(abs(insertion["energy"] - run["target"]), 0.02 * scale)
                self.assertAlmostEqual(insertion["error"], (insertion["energy"] - run["target"]) / scale, delta=1e-14)
            self.assertEqual(run["mean_evaluations"], sum(i["evaluations"] for i in run["insertions"]) / 5)
            self.assertEqual(one_object((out / "result.json").read_text()), run)
        mean = self.done("insert", self.fluid, *TAIL)["target"]
        self.assertAlmostEqual(mean, before / 63, delta=1e-12)

    def test_insertions_do_not_depend_on_the_number_of_threads(self):
        runs = [without_seconds(self.done("insert", self.fluid, *TAIL, "--count", "40", "--threads", threads)) for threads in "12"]
        self.assertEqual(*runs)

    def test_a_region_is_kept_and_temperatures_give_velocities(self):
        region = (1.0, 4.0, 2.0, 5.5, 0.0, 9.0)
        for wall in ("reflect", "well"):
            run = self.done("insert", self.fluid, *TAIL, "--count", "10", "--wall", wall, "--temperature", "1.5",
                            "--region", ",".join(map(str, region)))
            for insertion in run["insertions"]:
                self.assertEqual(len(insertion["velocity"]), 3)
                for axis, x in enumerate(insertion["position"]):
                    self.assertTrue(region[2 * axis] <= x <= region[2 * axis + 1])

    def test_a_region_may_cross_faces_and_be_given_around_the_origin(self):
        lattice = [float(x) for x in self.fluid.read_text().split('Lattice="')[1].split('"')[0].split()][::4]
        for wall in ("reflect", "well"):
            region = f"-1.5,1.5,{-lattice[1] / 2},{lattice[1] / 2},{lattice[2] - 1},{lattice[2] + 2}"
            run = self.done("insert", self.fluid, *TAIL, "--count", "10", "--wall", wall, f"--region={region}")
            for x, y, z in (insertion["position"] for insertion in run["insertions"]):
                self.assertTrue(0 <= x <= 1.5 + 1e-9 or lattice[0] - 1.5 - 1e-9 <= x < lattice[0], x)
                self.assertTrue(0 <= y < lattice[1], y)
                self.assertTrue(0 <= z <= 2 + 1e-9 or lattice[2] - 1 - 1e-9 <= z < lattice[2], z)
            self.assertEqual(len({insertion["position"][0] > 2 for insertion in run["insertions"]}), 2)
        plain = self.done("insert", self.fluid, *TAIL, "--region", region)
        self.assertEqual(without_seconds(plain), without_seconds(self.done("insert", self.fluid, *TAIL, f"--region={region}")))

    def test_a_slab_takes_particles_between_its_faces_and_stays_a_slab(self):
        slab = self.file("slab.xyz", self.fluid.read_text().replace("T T T", "F T T"))
        edge = [float(x) for x in self.fluid.read_text().split('Lattice="')[1].split('"')[0].split()][::4]
        for extra in ((), ("--method", "screened"), ("--region", f"0,2,0,{edge[1]},0,{edge[2]}", "--wall", "well"), ("--remove", "2")):
            out = self.folder / f"slab{'-'.join(extra[:2])}".replace(",", "")
            run = self.done("insert", slab, "--model", "lennard-jones", "--count", "5", *extra, "--out", out)
            self.assertEqual((len(run["insertions"]), run["failures"]), (5, 0))
            for insertion in run["insertions"]:
                self.assertTrue(0 <= insertion["position"][0] <= edge[0])
            self.assertIn('pbc="F T T"', (out / "inserted.extxyz").read_text())
            if "--remove" in extra:
                continue
            before = self.done("energy", slab, "--model", "lennard-jones")["energy"]
            after = self.done("energy", out / "inserted.extxyz", "--model", "lennard-jones")["energy"]
            self.assertAlmostEqual(after - before, sum(i["energy"] for i in run["insertions"]), delta=1e-11)
        self.refused("insert", slab, "--model", "lennard-jones", "--region=-1,1,0,4,0,4", says="open along x")
        self.refused("insert", slab, *TAIL, says="open along x")
        self.refused("insert", "--densify", "0.5", slab, "--model", "lennard-jones", says='pbc "F T T"')

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
        run = self.done("insert", self.fluid, *TAIL, "--energy", "-80", "--most-trials", "50", "--count", "2", "--out", out, status=1)
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
                                ((self.fluid, "--largest-step", "0"), "step"), ((self.fluid, "--remove", "1", "--removal", "all"), ("all", "random")),
                                ((self.fluid, "--temperature", "-1"), "temperature"), ((empty,), "empty"), ((), "FILE"),
                                (("--scan", "--states", "0.4"), "density:temperature"), (("--scan", "--states", "-0.4:1"), "density"),
                                (("--scan", "--states", "0.4:0"), "temperature"), (("--scan", "--methods", "usher,,descent"), "--methods"),
                                (("--scan", "--energy", "mu"), "Widom"), (("--densify", "0.3"), "density"), (("--densify", "nan"), "density"),
                                (("--densify", "0.5", "--rate", "50"), "rate"), (("--densify", "0.5", "--time-step", "1"), "time step"),
                                ((self.fluid, "--precision", "mixed"), "precision"), ((self.fluid, "--plot"), "--plot")):
            with self.subTest(arguments):
                self.refused_cleanly("insert", *TAIL, *arguments, says=says)
        self.refused_cleanly("insert", self.fluid, "--model", "hard-sphere", says="hard spheres")
        for points in ("1", "1001"):
            self.refused("insert", *TAIL, "--scan", "--map-points", points, "--out", self.folder / "out", says=("map points", points))
        self.assertFalse((self.folder / "out").exists())

    def test_a_scan_reports_every_combination_and_state(self):
        out = self.folder / "out"
        run = self.done(*SCAN, "--out", out)
        self.assertEqual((len(run["scan"]), len(run["states"]), len(run["holes"]), run["failures"]), (12, 2, 4, 0))
        for row in run["scan"]:
            self.assertGreaterEqual(row["evaluations"], row["trials"])
            self.assertLessEqual(abs(row["error"]), row["tolerance"])
            self.assertEqual(row["candidates"] > 0, row["method"] == "screened")
        rows = list(csv.DictReader((out / "scan.csv").read_text().splitlines()))
        self.assertEqual([float(r["evaluations"]) for r in rows], [r["evaluations"] for r in run["scan"]])
        pairs = list(csv.DictReader((out / "errors.csv").read_text().splitlines()))
        self.assertGreater(len(pairs), 20)
        points = list(csv.DictReader((out / "map.csv").read_text().splitlines()))
        self.assertEqual(len(points), 2 * 3 * 3)
        for corner in (0, 9):  # of both states: the four corners are one point
            self.assertEqual(len({float(points[corner + k]["energy"]) for k in (0, 2, 6, 8)}), 1)
            self.assertAlmostEqual(float(points[corner + 8]["y"]), (64 / float(points[corner]["density"])) ** (1 / 3), delta=1e-12)

    def test_rows_of_growth_without_a_density_step_have_no_means(self):
        run = self.done(*with_options(GROWTH, "--densify", "0.42", "--rows", "10"))
        self.assertEqual((len(run["densification"]), run["inserted"]), (10, 3))
        self.assertEqual(run["densification"][0]["density"], None)
        self.assertEqual(sum(row["density"] is not None for row in run["densification"]), 3)

    def test_growth_ends_at_the_density_asked_for_and_keeps_account_of_energy(self):
        run = self.done(*GROWTH)
        self.assertEqual((run["particles"], run["inserted"], run["failures"], len(run["densification"])), (80, 16, 0, 4))
        densities = [row["density"] for row in run["densification"]]
        self.assertEqual(densities, sorted(densities))
        for row in run["densification"]:
            self.assertAlmostEqual(row["energy"], 1.5 * row["temperature"] + row["excess_energy"], delta=1e-9)
            self.assertLess(abs(row["drift"]), 0.1)


class Diameters(ProgramTest):
    def test_particles_with_diameters_are_inserted_and_removed(self):
        run = self.done("endpoints", "--model", "polydisperse", *FLUID, "--pairs", "1", "--out", self.folder / "ends")
        fluid = self.folder / "ends" / run["pairs"][0]["file"]
        poly = ("--model", "polydisperse")
        before = self.done("energy", fluid, *poly)["energy"]
        out = self.folder / "in"
        run = self.done("insert", fluid, *poly, "--energy", "12", "--count", "2", "--diameter", "0.6", "--out", out)
        self.assertEqual(run["outcome"], "done")
        after = self.done("energy", out / "inserted.extxyz", *poly)["energy"]
        self.assertAlmostEqual(after - before, sum(one["energy"] for one in run["insertions"]), delta=1e-9 * abs(after))
        taken = self.folder / "out"
        run = self.done("insert", out / "inserted.extxyz", *poly, "--energy", "12", "--count", "0", "--remove", "1",
                        "--removal", "least-disturbance", "--out", taken)
        left = self.done("energy", taken / "inserted.extxyz", *poly)["energy"]
        self.assertAlmostEqual(after - left, run["removals"][0]["energy"], delta=1e-9 * abs(after))

    def test_a_diameter_is_refused_where_there_is_none(self):
        self.refused("insert", DATA / "ar_dilute_63.extxyz", "--model", "lennard-jones", "--diameter", "0.9",
                     says=("--diameter is not allowed with model lennard-jones", "polydisperse"))
        self.refused("insert", "--scan", "--model", "polydisperse", says=("--scan is not allowed with model polydisperse",))


if __name__ == "__main__":
    unittest.main()
