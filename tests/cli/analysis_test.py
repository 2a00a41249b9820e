"""`analyze`: finished runs pooled over a sweep."""

import csv
import json
import math
import shutil
import unittest

from cli_support import ARGON, FLUID, ProgramTest, lanescape, one_object

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
    def path(self, name, packing, seed, pairs=2, *more, size=FEW[:4]):
        out = self.folder / name
        self.done("path", *SPHERES, *(size or ("--particles", "64")), *FEW[4:], "--packing-fraction", packing, "--pairs", pairs, "--seed", seed, *more, "--out", out)
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
        runs = [self.path(word, "0.2", 1, 2, *options, size=())
                for word, options in (("a", ()), ("b", ("--step", "0.1")), ("c", ("--adaptive",)), ("d", ("--fictitious", "linear")),
                                      ("e", ("--method", "away")))]
        ends = self.folder / "ends"
        self.done("endpoints", *SPHERES, *FEW[4:], "--particles", "64", "--packing-fraction", "0.2", "--seed", "1", "--pairs", "2", "--out", ends)
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

    def test_soft_pairs_measure_the_distance_asked_for(self):
        pairs = self.make_pairs("pairs", 2)
        runs = []
        for k, pair in enumerate(pairs):
            runs.append(self.folder / f"p{k}")
            self.done("path", *ARGON, "--pair", pair, "--out", runs[-1])
        groups = self.done("analyze", *runs)["groups"]
        self.assertEqual([(g["distance"], g["paths"], g["particles"], g["density"]) for g in groups], [(5.0, 2, 32, 0.8)])
        self.assertEqual(groups[0]["images"], "minimum")

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


if __name__ == "__main__":
    unittest.main()
