"""`analyze`: finished runs pooled over a sweep."""

import csv
import json
import math
import shutil
import unittest

import numpy

from cli_support import ARGON, FLUID, PROTOCOL, ProgramTest, one_object

SPHERES = ("--model", "hard-sphere-binary")
FEW = ("--particles", "32", "--distance", "10", "--equilibration-collisions", "20000", "--between-collisions", "1000")
DIFFUSION = ("diffusion", *SPHERES, "--particles", "32", "--equilibration-collisions", "20000", "--interval", "0.01", "--lags", "50",
             "--records", "300", "--between", "1000", "--trajectories", "2")


def rows_of(file):
    with open(file, newline="") as table:
        return list(csv.DictReader(table))


def standard_error(values):
    mean = sum(values) / len(values)
    return math.sqrt(sum((v - mean) ** 2 for v in values) / (len(values) * (len(values) - 1)))


class Analysis(ProgramTest):
    def path(self, name, packing, seed, pairs=2, *more):
        out = self.folder / name
        self.done("path", *SPHERES, *FEW, "--packing-fraction", packing, "--pairs", pairs, "--seed", seed, *more, "--out", out)
        return out

    def means(self, out):
        return {(row["group"], row["quantity"]): row for row in rows_of(out / "means.csv")}


class Pooling(Analysis):
    def test_runs_of_one_state_are_pooled_whatever_their_seeds(self):
        runs = [self.path("a", "0.2", 1), self.path("b", "0.2", 2, 1), self.path("c", "0.4", 3)]
        out = self.folder / "out"
        result = self.done("analyze", *reversed(runs), "--out", out)
        groups = rows_of(out / "groups.csv")
        self.assertEqual([(g["packing_fraction"], g["runs"], g["paths"], g["reached"]) for g in groups],
                         [("0.2", "2", "3", "3"), ("0.4", "1", "2", "2")])
        name = "path hard-sphere-binary N32 phi0.2 avoidance step0.01 dR10"
        self.assertEqual(groups[0]["group"], name)
        self.assertEqual([g["group"] for g in result["groups"]], [g["group"] for g in groups])
        paths = [path for run in runs[:2] for path in one_object((run / "result.json").read_text())["paths"]]
        for quantity in ("ratio_squared", "length", "participation_ratio", "evaluations"):
            values = [path[quantity] for path in paths]
            row = self.means(out)[name, quantity]
            self.assertEqual(row["count"], "3")
            self.assertAlmostEqual(float(row["mean"]) / (sum(values) / 3), 1.0, places=12)
            self.assertAlmostEqual(float(row["error"]) / standard_error(values), 1.0, places=9)
            self.assertLessEqual(min(values) * (1 - 1e-12), float(row["low"]))
            self.assertLess(float(row["low"]), float(row["high"]))
            self.assertLessEqual(float(row["high"]), max(values) * (1 + 1e-12))
            in_json = result["groups"][0]["means"][quantity]
            self.assertEqual([float(row[key]) for key in ("mean", "error", "low", "high")],
                             [in_json[key] for key in ("mean", "error", "low", "high")])
        trials = [sum((k + 1) * n for k, n in enumerate(p["corrections"])) / sum(p["corrections"]) for p in paths]
        self.assertAlmostEqual(float(self.means(out)[name, "trials_per_detour"]["mean"]), sum(trials) / 3, places=12)

    def test_distributions_are_those_of_all_steps_and_particles(self):
        runs = [self.path("a", "0.3", 1), self.path("b", "0.3", 2)]
        out = self.folder / "out"
        self.done("analyze", *runs, "--out", out)
        table = rows_of(out / "distributions.csv")
        steps, particles = {}, []
        for run in runs:
            for k in (1, 2):
                for row in rows_of(run / f"path-000{k}-steps.csv"):
                    of = steps.setdefault(row["quantity"], {})
                    of[float(row["value"])] = of.get(float(row["value"]), 0) + float(row["steps"])
                particles += rows_of(run / f"path-000{k}-particles.csv")
        sizes = {}
        for name, counts in list(steps.items()):
            if name.startswith("group_size"):
                for value, count in counts.items():
                    sizes[value] = sizes.get(value, 0) + count
        steps["group_size"] = sizes
        for quantity, per_particle in (("alpha_2", 1), ("overlapping_partners", 1), ("moved_particles", 32), ("groups", 32), ("group_size", 1),
                                       ("participation_ratio", 1), ("group_size_some_groups", 1)):
            shares = {float(r["value"]): float(r["probability"]) for r in table if r["quantity"] == quantity}
            total = sum(steps[quantity].values())
            self.assertEqual(len(shares), len(steps[quantity]), quantity)
            for value, count in steps[quantity].items():
                self.assertAlmostEqual(shares[value / per_particle], count / total, places=12)
            self.assertTrue(all(float(r["error"]) >= 0 for r in table if r["quantity"] == quantity))
        for species in ("Xe", "Ar"):
            x = [math.log10(float(p["path_length"]) / float(p["displacement"])) for p in particles if p["species"] == species]
            for row in table:
                if row["quantity"] == f"log10_length_{species}":
                    edge = float(row["value"])
                    self.assertAlmostEqual(float(row["probability"]), sum(edge - 0.05 + 1e-9 < v <= edge + 1e-9 for v in x) / len(x), places=12)
            mean = sum(x) / len(x)
            width = math.sqrt(sum((v - mean) ** 2 for v in x) / len(x))
            pooled = [r for r in rows_of(out / "means.csv") if r["quantity"] == f"heterogeneity_pooled_{species}"]
            self.assertAlmostEqual(float(pooled[0]["mean"]), width, places=12)
            self.assertGreater(float(pooled[0]["error"]), 0.0)

    def test_other_settings_make_other_groups(self):
        runs = [self.path(word, "0.2", 1, 2, *options)
                for word, options in (("a", ()), ("b", ("--step", "0.1")), ("c", ("--adaptive",)), ("d", ("--fictitious", "linear")),
                                      ("e", ("--method", "away")))]
        ends = self.folder / "ends"
        self.done("endpoints", *SPHERES, *FEW, "--packing-fraction", "0.2", "--seed", "1", "--pairs", "2", "--out", ends)
        # The same pairs from files, and the default of an option that is given.
        given = self.folder / "given"
        self.done("path", *SPHERES, "--pair", ends / "pair-0001.extxyz", ends / "pair-0002.extxyz", "--avoidance-step", "1e-4", "--out", given)
        shortened = []
        for k in (1, 2):
            shortened.append(self.folder / f"short{k}")
            self.done("shorten", *SPHERES, "--adaptive", "--pair", ends / f"pair-000{k}.extxyz", "--out", shortened[-1])
        result = self.done("analyze", *runs, ends, given, *shortened)
        names = [group["group"] for group in result["groups"]]
        self.assertEqual(len(names), len(set(names)))
        self.assertEqual(sorted((g["kind"], g["runs"], g["paths"]) for g in result["groups"]),
                         [("endpoints", 1, 2), ("path", 1, 2), ("path", 1, 2), ("path", 1, 2), ("path", 1, 2), ("path", 2, 4), ("shorten", 2, 2)])
        by_kind = {group["kind"]: group for group in result["groups"]}
        self.assertLess(0.0, by_kind["shorten"]["means"]["shorter_by"]["mean"])
        self.assertGreater(by_kind["shorten"]["means"]["length_before"]["mean"], by_kind["shorten"]["means"]["length"]["mean"])
        self.assertEqual(by_kind["endpoints"]["means"]["compressibility"]["count"], 1)
        self.assertEqual(by_kind["endpoints"]["means"]["collisions"]["count"], 2)

    def test_diffusion_keeps_its_error_and_several_runs_are_weighted_with_their_trajectories(self):
        one, two = self.folder / "one", self.folder / "two"
        self.done(*DIFFUSION, "--packing-fraction", "0.3", "--out", one)
        longer = list(DIFFUSION)
        longer[longer.index("--trajectories") + 1] = "3"
        self.done(*longer, "--packing-fraction", "0.3", "--seed", "2", "--out", two)
        alone = self.done("analyze", one)["groups"][0]
        results = [one_object((run / "result.json").read_text()) for run in (one, two)]
        first, second = (r["species"]["Xe"] for r in results)
        self.assertEqual((alone["paths"], alone["means"]["diffusion_vacf_Xe"]["mean"]), (2, first["diffusion_vacf"]))
        self.assertEqual(alone["means"]["diffusion_vacf_Xe"]["error"], first["diffusion_vacf_error"])
        both = self.done("analyze", one, two)["groups"][0]["means"]
        self.assertAlmostEqual(both["diffusion_msd_Xe"]["mean"], (2 * first["diffusion_msd"] + 3 * second["diffusion_msd"]) / 5, places=12)
        self.assertAlmostEqual(both["diffusion_msd_Xe"]["error"],
                               math.hypot(2 * first["diffusion_msd_error"], 3 * second["diffusion_msd_error"]) / 5, places=12)
        self.assertEqual(both["compressibility"]["count"], 2)

    def test_pairs_from_files_tell_their_state_and_the_distance_asked_for(self):
        pairs = self.make_pairs("pairs", 2)
        runs = []
        for k, pair in enumerate(pairs):
            runs.append(self.folder / f"p{k}")
            self.done("path", *ARGON, "--pair", pair, "--out", runs[-1])
        groups = self.done("analyze", *runs)["groups"]
        self.assertEqual([(g["distance"], g["paths"], g["particles"], g["density"], g["temperature"]) for g in groups],
                         [(5.0, 2, 32, 0.8, 1.0)])
        self.assertEqual(groups[0]["images"], "minimum")
        # Files of others do not tell: pairs that lie within 2 % of each other belong together, at an unknown temperature.
        for run in runs:
            pair = run / "pair-0001.extxyz"
            pair.write_text(pair.read_text().replace("asked_distance=", "other=").replace("temperature=", "another="))
        groups = self.done("analyze", *runs)["groups"]
        self.assertEqual([(g["distance"], g["paths"], g["temperature"]) for g in groups], [(5.0, 2, None)])

    def test_pairs_of_one_species_belong_together_however_far_they_are_in_all(self):
        ends = self.folder / "ends"
        self.done("endpoints", *SPHERES, *FEW, "--packing-fraction", "0.2", "--pairs", "2", "--distance-species", "Ar", "--out", ends)
        runs = []
        for k in (1, 2):
            runs.append(self.folder / f"p{k}")
            path = self.done("path", *SPHERES, "--adaptive", "--pair", ends / f"pair-000{k}.extxyz", "--out", runs[-1])["paths"][0]
            self.assertGreater(path["distance"], 11.0)
        groups = self.done("analyze", *runs)["groups"]
        self.assertEqual([(g["distance"], g["distance_species"], g["paths"]) for g in groups], [(10.0, "Ar", 2)])

    def test_the_same_bits_come_from_any_number_of_threads_and_order(self):
        runs = [self.path("a", "0.2", 1), self.path("b", "0.2", 2)]
        one, two = self.folder / "one", self.folder / "two"
        self.done("analyze", *runs, "--threads", "1", "--out", one)
        self.done("analyze", *reversed(runs), "--threads", "2", "--out", two)
        for table in ("groups.csv", "means.csv", "distributions.csv", "result.json"):
            self.assertEqual((one / table).read_bytes(), (two / table).read_bytes(), table)
        other = self.done("analyze", *runs, "--seed", "2")
        self.assertNotEqual(other, one_object((one / "result.json").read_text()))

    def test_a_path_that_did_not_reach_its_goal_counts_and_has_no_mean(self):
        out = self.folder / "stopped"
        self.done("path", *SPHERES, *FEW, "--packing-fraction", "0.3", "--max-steps", "10", "--out", out, status=1)
        group = self.done("analyze", out)["groups"][0]
        self.assertEqual((group["paths"], group["reached"], group["means"]), (1, 0, {}))


class Sweeps(Analysis):
    def sweep(self, packings=("0.1", "0.2", "0.3", "0.4")):
        runs = []
        for packing in packings:
            runs.append(self.path("path" + packing, packing, 1))
            runs.append(self.folder / ("diffusion" + packing))
            self.done(*DIFFUSION, "--packing-fraction", packing, "--seed", "3", "--out", runs[-1])
        return runs

    def test_fits_and_scaling_of_a_sweep_follow_from_its_means(self):
        runs, out = self.sweep(), self.folder / "out"
        result = self.done("analyze", *runs, "--free-critical", "--out", out)
        groups = {g["group"]: g for g in result["groups"]}
        ratio = {g["packing_fraction"]: g["means"]["ratio_squared"]["mean"] for g in groups.values() if g["kind"] == "path"}
        diffusion = {g["packing_fraction"]: g["means"]["diffusion_msd_Ar"]["mean"] for g in groups.values() if g["kind"] == "diffusion"}
        phi = numpy.array(sorted(ratio))
        y = numpy.log([ratio[x] for x in phi])
        sweep = "path hard-sphere-binary N32 avoidance step0.01 dR10"
        fits = {(f["sweep"], f["quantity"], f["form"], f["critical_error"] != ""): f for f in rows_of(out / "fits.csv")}
        for form, critical, x in (("mode-coupling", 0.59, numpy.log(0.59 - phi)), ("vogel-fulcher-tammann", 0.6122, -1 / (0.6122 - phi)),
                                  ("berthier-witten", 0.635, -1 / (0.635 - phi) ** 2)):
            fit = {k: float(v) for k, v in fits[sweep, "ratio_squared", form, False].items() if k not in ("sweep", "quantity", "form", "critical_error", "weighted")}
            (slope, intercept), covariance = numpy.polyfit(x, y, 1, cov=True)
            expected = {"points": 4, "from": 0.1, "to": 0.4, "critical": critical, "slope": slope, "intercept": intercept,
                        "slope_error": covariance[0, 0] ** 0.5, "intercept_error": covariance[1, 1] ** 0.5,
                        "residual_deviation": (numpy.sum((y - slope * x - intercept) ** 2) / 2) ** 0.5,
                        "r_squared": 1 - numpy.sum((y - slope * x - intercept) ** 2) / numpy.sum((y - y.mean()) ** 2)}
            for key, value in expected.items():
                self.assertAlmostEqual(fit[key], value, delta=1e-8 * max(1, abs(value)), msg=f"{form} {key}")
        # D of each species, by each way, and (DeltaR/g)^2: held, and free where that has an optimum.
        self.assertEqual(len([key for key in fits if not key[3]]), 7 * 3)
        self.assertEqual(len(result["fits"]) + len(result["refused_fits"]), 7 * 3 * 2)
        rows = rows_of(out / "scaling.csv")
        self.assertEqual(len(rows), 6)
        row = next(r for r in rows if r["quantity"] == "diffusion_msd_Ar")
        constants = [diffusion[x] / ratio[x] for x in phi]
        logarithms = numpy.log(constants)
        self.assertAlmostEqual(float(row["constant"]), numpy.mean(constants), places=12)
        self.assertAlmostEqual(float(row["constant_error"]), standard_error(constants), places=12)
        self.assertAlmostEqual(float(row["spread"]), numpy.std(logarithms, ddof=1), places=12)
        (slope, _), covariance = numpy.polyfit(y, numpy.log([diffusion[x] for x in phi]), 1, cov=True)
        self.assertAlmostEqual(float(row["slope"]), slope, places=9)
        self.assertAlmostEqual(float(row["slope_error"]), covariance[0, 0] ** 0.5, places=9)
        points = [p for p in rows_of(out / "scaling_points.csv") if p["quantity"] == "diffusion_msd_Ar"]
        self.assertEqual([float(p["state"]) for p in points], list(phi))
        for point, x in zip(points, phi):
            self.assertAlmostEqual(float(point["scaled"]), numpy.mean(constants) * ratio[x], places=12)
            self.assertAlmostEqual(float(point["diffusion_over_scaled"]), diffusion[x] / (numpy.mean(constants) * ratio[x]), places=12)

    def test_the_range_the_weights_and_the_critical_value_are_those_asked_for(self):
        runs = self.sweep()
        plain = self.done("analyze", *runs)["fits"]
        ranged = self.done("analyze", *runs, "--fit-range", "0.15,0.5", "--critical-mct", "0.6")["fits"]
        self.assertTrue(all((f["points"], f["from"], f["to"]) == (3, 0.2, 0.4) and f["adjusted_r_squared"] is None for f in ranged))
        self.assertEqual({f["critical"] for f in ranged if f["form"] == "mode-coupling"}, {0.6})
        weighted = self.done("analyze", *runs, "--weighted")["fits"]
        self.assertTrue(all(f["weighted"] for f in weighted) and not any(f["weighted"] for f in plain))
        self.assertNotEqual([f["slope"] for f in plain], [f["slope"] for f in weighted])
        refused = self.done("analyze", *runs, "--critical-mct", "0.4")
        self.assertEqual({f["form"] for f in refused["fits"]}, {"vogel-fulcher-tammann", "berthier-witten"})
        self.assertTrue(all("0.4" in f["reason"] for f in refused["refused_fits"]))

    def test_figures_are_drawn_of_what_there_is(self):
        out = self.folder / "out"
        self.done("analyze", *self.sweep(("0.2", "0.3", "0.4")), "--out", out, "--plot")
        for name in ("scaling", "fits", "participation", "heterogeneity", "overlaps"):
            self.assertEqual((out / f"analysis-{name}.png").read_bytes()[:4], b"\x89PNG", name)


    def test_a_search_that_found_nothing_belongs_to_those_that_did(self):
        ends = self.folder / "ends"
        self.done("endpoints", *SPHERES, *FEW, "--packing-fraction", "0.2", "--out", ends)
        runs = [self.folder / "found", self.folder / "failed"]
        for run, steps, status in zip(runs, ("1000000", "1"), (0, 1)):
            self.done("shorten", *SPHERES, "--method", "montecarlo", "--pair", ends / "pair-0001.extxyz", "--max-steps", steps, "--out", run,
                      status=status)
        for run in runs:  # as runs of others, whose files do not tell what was asked for
            pair = run / "pair-0001.extxyz"
            pair.write_text(pair.read_text().replace("asked_distance=", "other="))
        groups = self.done("analyze", *runs)["groups"]
        self.assertEqual([(g["paths"], g["reached"]) for g in groups], [(2, 1)])


class Refusals(Analysis):
    def test_what_is_no_finished_run_is_refused(self):
        run = self.path("run", "0.2", 1)
        self.refused_cleanly("analyze", says="RUN")
        self.refused_cleanly("analyze", self.folder / "nothing", says=("nothing", "folder of a finished run"))
        (self.folder / "empty").mkdir()
        self.refused_cleanly("analyze", run, self.folder / "empty", says=("empty", "no result.json"))
        self.refused_cleanly("analyze", run, str(run) + "/", says="named twice")
        slab = self.folder / "insertion"
        shutil.copytree(run, slab)
        (slab / "run.toml").write_text((run / "run.toml").read_text().replace("'path'", "'insert'"))
        self.refused_cleanly("analyze", run, slab, says=("insertion", "'insert'", "endpoints, path, shorten and diffusion"))

    def test_interrupted_runs_and_runs_without_results_are_refused(self):
        run = self.path("run", "0.2", 1)
        result = one_object((run / "result.json").read_text())
        for change, says in (({"exit_status": 4}, "--resume"), ({"exit_status": None}, "exit_status"), ({"paths": []}, "without any result"),
                             ({"paths": [{}]}, "paths[0]"), ({"paths": 3}, "paths")):
            damaged = self.folder / "damaged"
            shutil.copytree(run, damaged)
            (damaged / "result.json").write_text(json.dumps({**result, **change}))
            self.refused_cleanly("analyze", damaged, says=says)
            shutil.rmtree(damaged)

    def test_damaged_files_are_refused_by_name_and_line(self):
        run = self.path("run", "0.2", 1)
        for name, content, says in (("result.json", "{", "damaged"), ("result.json", "[]", "one JSON object"), ("run.toml", "a = ", "run.toml:1"),
                                    ("run.toml", "", "a run of ''"), ("path-0001-steps.csv", "quantity,value\n", "path-0001-steps.csv:1"),
                                    ("path-0001-steps.csv", "quantity,value,steps\nalpha_2,x,1\n", "path-0001-steps.csv:2: 'x'"),
                                    ("path-0001-steps.csv", "quantity,value,steps\nalpha_2,1,1\nalpha_2,2", "path-0001-steps.csv:3"),
                                    ("path-0002-particles.csv", None, "path-0002-particles.csv"), ("pair-0001.extxyz", "", "pair-0001.extxyz"),
                                    ("pair-0001.extxyz", None, "pair-0001.extxyz")):
            damaged = self.folder / "damaged"
            shutil.copytree(run, damaged)
            (damaged / name).unlink()
            if content is not None:
                (damaged / name).write_text(content)
            self.refused_cleanly("analyze", damaged, says=says)
            shutil.rmtree(damaged)

    def test_options_out_of_range_are_refused(self):
        run = self.path("run", "0.2", 1)
        for value in ("0", "99", "1000001", "x"):
            self.refused_cleanly("analyze", run, "--bootstrap", value, says="--bootstrap")
        self.refused_cleanly("analyze", run, "--threads", "0", says="--threads")
        for value in ("0.5", "0.6,0.5", "0.5,x", "0.1,0.2,0.3", "0.1,nan"):
            self.refused_cleanly("analyze", run, "--fit-range", value, says="--fit-range")
        for value in ("0", "-0.5", "inf"):
            self.refused_cleanly("analyze", run, "--critical-vft", value, says="critical value")
        self.refused("analyze", run, "--plot", says="--out")
        soft = self.folder / "soft"
        self.done("diffusion", *ARGON, *FLUID[:6], *PROTOCOL[:-2], "--lags", "10", "--records", "20", "--between", "10", "--out", soft)
        self.assertEqual(self.done("analyze", soft)["groups"][0]["density"], 0.8)
        self.refused_cleanly("analyze", run, soft, "--critical-mct", "0.59", says=("several models", "lennard-jones", "hard-sphere-binary"))


if __name__ == "__main__":
    unittest.main()
