"""An option that has no effect in a run is refused, with its name, the reason and the runs that use it."""

import unittest

from cli_support import ARGON, DATA, EXAMPLES, GROWTH, HEADER, SCAN, TINY, TWO, TWO_MOVED, ProgramTest, frame, without_seconds

FLUID = DATA / "ar_dilute_63.extxyz"
LENNARD_JONES = ("--model", "lennard-jones")
MIXTURE = ("--model", "hard-sphere-binary")
SOFT_ONLY = ("--density", "--temperature", "--time-step", "--melt-temperature", "--melt-steps", "--cooling-steps", "--rescale-interval",
             "--check-steps", "--check-interval", "--check-tolerance", "--max-checks", "--settle-steps", "--cutoff")
HARD_ONLY = ("--packing-fraction", "--equilibration-collisions")


class UnusedOptions(ProgramTest):
    def all_refused(self, run, options, *reason):
        """The run refuses each of the options, `name` or `name=value`, and gives the reason."""
        for option in options:
            name, _, value = option.partition("=")
            with self.subTest(option):
                arguments = (name,) if value == "true" else (name, value or "1")
                self.refused_cleanly(*run, *arguments, says=(f"{name} is not allowed", *reason, "it is for"))

    def test_of_insertion_into_a_file(self):
        run = ("insert", FLUID, *LENNARD_JONES)
        self.all_refused(run, ("--holes", "--states=0.4:1", "--methods=usher", "--tolerances=0.1", "--largest-steps=1", "--configurations",
                               "--between-steps", "--widom-probes", "--iso-energies=0"), "without --scan", "--scan")
        self.all_refused(run, ("--rate=0.005", "--rows=40", "--density=0.4"), "without --scan and --densify", "--densify")
        self.all_refused(run, ("--equilibration-steps=10000", "--time-step=0.002", "--particles=1000", "--plot=true"),
                         "without --scan and --densify", "--scan and --densify")
        self.all_refused(run, ("--removal=random",), "without --remove", "--remove")
        self.all_refused(run, ("--wall=well",), "without --region", "--region")
        self.all_refused(run, ("--traverse-step=0.5",), "without method descent")
        self.all_refused(run, ("--clear-energy=50",), "without method screened")

    def test_of_a_composition_beside_a_file(self):
        pair = self.make_pairs("ends")[0]
        for run in (("insert", FLUID), ("energy", FLUID), ("endpoints", "--start", FLUID), ("path", "--pair", pair)):
            self.all_refused((*run, *LENNARD_JONES), ("--composition=1",), "with a file of particles")

    def test_of_scans_and_growth(self):
        self.refused_cleanly(*SCAN[:2], FLUID, *SCAN[2:4], says=("FILE is not allowed with --scan",))
        self.all_refused(("insert", "--scan", *LENNARD_JONES), ("--remove=1", "--removal=random", "--temperature=1", "--rate=1", "--rows=2",
                                                                "--density=0.5", "--method=usher"), "with --scan")
        self.all_refused(("insert", "--scan", *LENNARD_JONES), ("--iso-energies=0",), "without --holes")
        self.all_refused(("insert", "--scan", *LENNARD_JONES, "--tolerances", "0.1"), ("--tolerance=0.1",), "with --tolerances")
        for option in ("--traced-searches", "--map-points"):
            self.refused("insert", "--scan", *LENNARD_JONES, option, "2", says=(option, "without --out"))
        self.all_refused(GROWTH, ("--count=1", "--energy=-1", "--remove=1", "--states=0.4:1", "--holes=1"), "with --densify")
        self.all_refused(("insert", FLUID, *LENNARD_JONES, "--densify", "0.5"), ("--density=0.4", "--particles=100"), "with FILE")
        self.refused("insert", "--scan", "--densify", "0.5", *LENNARD_JONES, says=("--scan", "--densify", "together"))

    def test_of_the_other_family_of_models(self):
        for subcommand in ("endpoints", "path", "diffusion"):
            self.all_refused((subcommand, *MIXTURE), SOFT_ONLY, "with model hard-sphere-binary", "soft models")
            self.all_refused((subcommand, *LENNARD_JONES), HARD_ONLY, "with model lennard-jones", "hard spheres")
        self.all_refused(("endpoints", *LENNARD_JONES), ("--start-method=auto", "--between-collisions", "--overlap-tolerance=1e-7"),
                         "with model lennard-jones", "hard spheres")
        self.all_refused(("path", *MIXTURE), ("--landscape-energy=0",), "soft models")
        self.all_refused(("energy", FLUID, *LENNARD_JONES), ("--states=true",), "with model lennard-jones", "ucg")

    def test_of_paths_between_given_end_points(self):
        pair = self.file("pair.xyz", frame(*TWO, header=HEADER) + frame(*TWO_MOVED, header=HEADER))
        self.all_refused(("path", *ARGON, "--pair", pair),
                         ("--particles=108", "--density=1.2", "--temperature", "--distance", "--distance-species=Ar", "--pairs", "--quick=true",
                          "--melt-steps", "--check-tolerance", "--settle-steps", f"--start={pair}"), "with --pair", "without --pair")

    def test_of_paths_by_another_method(self):
        self.all_refused(("path", *ARGON, *TINY), ("--avoidance-step=1e-4", "--fictitious=linear"), "with method contour", "avoidance")
        self.all_refused(("path", *ARGON, *TINY), ("--escape-tolerance=1e-4",), "with method contour", "method escape")
        self.all_refused(("path", *MIXTURE), ("--max-depth=100",), "with method avoidance", "method away")
        self.all_refused(("path", *MIXTURE, "--adaptive"), ("--max-trials=100",), "with method avoidance and --adaptive", "faithful steps")
        self.all_refused(("path", *MIXTURE, "--method", "away"), ("--step=0.1", "--fictitious=linear"), "with method away", "avoidance")
        self.all_refused(("path", *ARGON, *TINY, "--adaptive"), ("--step=0.1", "--fictitious=linear"), "with method contour and --adaptive",
                         "faithful")

    def test_of_a_start_from_a_file(self):
        start = self.file("start.xyz", frame(*TWO))
        for subcommand in ("endpoints", "path", "diffusion"):
            self.all_refused((subcommand, *LENNARD_JONES, "--start", start), ("--particles=108", "--density"), "with --start")
        self.all_refused(("endpoints", *MIXTURE), ("--overlap-tolerance=1e-7",), "without a file")

    def test_of_diffusion_which_makes_no_pairs(self):
        self.all_refused(("diffusion", *LENNARD_JONES), ("--pairs", "--distance", "--distance-species=Ar", "--between-steps",
                                                         "--max-pair-steps"), "with diffusion", "endpoints and path")
        self.all_refused(("diffusion", *MIXTURE), ("--between-collisions", "--max-pair-collisions"), "with diffusion")

    def test_of_files_without_a_folder(self):
        for run, option in ((("path", *ARGON, *TINY), ("--plot",)), (("path", *ARGON, *TINY), ("--frames", "5")),
                            (("diffusion", *LENNARD_JONES), ("--plot",)), (GROWTH, ("--plot",))):
            self.refused(*run, *option, says=(f"{option[0]} is not allowed without --out", "it is for runs with --out"))

    def test_of_models_where_no_file_is_checked(self):
        self.all_refused(("verify",), ("--model=lennard-jones", "--cutoff=2", "--truncation=tail"), "without FILES")
        for option, value in (("--images", "all"), ("--precision", "double")):
            self.refused_cleanly("verify", FLUID, *LENNARD_JONES, option, value, says=(f"{option} is not allowed with verify", "both"))

    def test_of_a_name_besides_a_model_file(self):
        model = EXAMPLES / "liquid_vapour.toml"
        self.all_refused(("energy", FLUID, "--model-file", model), ("--model=lennard-jones", "--model=kob-andersen"), "with --model-file")

    def test_a_run_file_may_hold_defaults_of_options_without_an_effect_but_no_other_values(self):
        """Run files of earlier versions contain all options."""
        text = f'file = "{FLUID}"\nmodel = "lennard-jones"\nrate = 0.005\nrows = 40\nstates = "0.4:2.5,0.5:2.5,0.6:2.5,0.7:2.5,0.8:2.5"\n'
        plain = without_seconds(self.done("insert", FLUID, *LENNARD_JONES))
        self.assertEqual(without_seconds(self.done("insert", "--config", self.file("run.toml", text))), plain)
        self.refused_cleanly("insert", "--config", self.file("run.toml", text.replace("40", "41")), says=("--rows", "--densify"))

    def test_a_run_file_that_is_written_holds_only_options_with_an_effect(self):
        self.done("insert", FLUID, *LENNARD_JONES, "--out", self.folder / "run")
        keys = {line.split(" = ")[0] for line in (self.folder / "run" / "run.toml").read_text().splitlines()}
        self.assertLessEqual({"file", "count", "energy", "tolerance", "model", "seed"}, keys)
        self.assertEqual(keys & {"rate", "rows", "states", "holes", "particles", "time-step", "removal", "wall", "traverse-step"}, set())


if __name__ == "__main__":
    unittest.main()
