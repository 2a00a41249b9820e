"""Options with mistakes are refused."""

import unittest

from cli_support import DATA, ARGON, TINY, TWO, TWO_MOVED, ProgramTest, frame, with_options


class BadOptions(ProgramTest):
    def test_numbers_out_of_range_are_refused_by_name(self):
        matrix = {"--particles": ("0", "-5", "1e12", "1000000000000", "x"), "--density": ("0", "-1", "nan", "inf", "1e9", "x"),
                  "--temperature": ("0", "-1", "nan", "inf", "x"), "--distance": ("0", "-1", "nan", "inf"),
                  "--cutoff": ("0", "-1", "nan", "inf", "1e12", "x"), "--time-step": ("0", "-1", "nan", "1"),
                  "--melt-temperature": ("0", "-1", "nan"), "--check-tolerance": ("0", "-1", "nan"), "--pairs": ("0", "-1", "1.5"),
                  "--melt-steps": ("-1", "x"), "--rescale-interval": ("0",), "--check-interval": ("0",)}
        for option, values in matrix.items():
            for value in values:
                with self.subTest(f"{option} {value}"):
                    for subcommand in ("endpoints", "path"):
                        arguments = with_options(("--images", "all", *TINY), option, value)
                        word = option[2:].replace("-", " ").split()[-1].rstrip("s")
                        self.refused_cleanly(subcommand, "--model", "lennard-jones", *arguments, says=word)

    def test_texts_that_are_no_numbers_are_refused_with_the_option_and_what_is_needed(self):
        needed = {("--cutoff", "2,5"): "a number is needed", ("--cutoff", "x"): "a number is needed", ("--cutoff", ""): "a number is needed",
                  ("--density", "1.2x"): "a number is needed", ("--particles", "1e3"): "a whole number without a sign in plain digits is needed",
                  ("--particles", "-5"): "a whole number without a sign in plain digits is needed",
                  ("--particles", "10000000000000000000000"): "too large", ("--threads", "1.5"): "a whole number in plain digits is needed",
                  ("--threads", "x"): "a whole number in plain digits is needed", ("--threads", "99999999999"): "too large"}
        for (option, value), words in needed.items():
            with self.subTest(f"{option} {value}"):
                said = self.refused("endpoints", "--model", "lennard-jones", option, value, says=(f"{option}: '{value}' is not allowed: ", words))
                self.assertNotIn("18446744073709551615", said)
        self.refused("insert", DATA / "ar_dilute_63.extxyz", *ARGON[:2], "--region", "0,x,0,1,0,1", says=("--region: 'x'", "a number is needed"))

    def test_no_particles_are_refused_as_such_where_the_distance_depends_on_them(self):
        for subcommand in ("endpoints", "path", "diffusion"):
            for model in ("lennard-jones", "hard-sphere", "ucg"):
                self.refused_cleanly(subcommand, "--model", model, "--particles", "0", says="0 particles are not allowed: from 1 to")

    def test_cutoffs_out_of_range_are_refused(self):
        for value in ("0", "-1", "nan", "inf", "1e12", "1e308", "x"):
            for backend in ("simd", "reference"):
                self.refused_cleanly("energy", DATA / "ka_tiny_8.extxyz", "--cutoff", value, "--backend", backend, says="cutoff")

    def test_numbers_of_a_path_out_of_range_are_refused(self):
        pair = self.file("pair.xyz", frame(*TWO) + frame(*TWO_MOVED))
        for option, value, word in (("--step", "0", "step"), ("--step", "-1", "step"), ("--step", "nan", "step"), ("--step", "2", "step"),
                                    ("--max-steps", "0", "limit"), ("--frames", "-1", "frames"), ("--frames", "1000000000", "frames"),
                                    ("--landscape-energy", "nan", "landscape"), ("--landscape-energy", "inf", "landscape"),
                                    ("--landscape-energy", "-1e3", "landscape"), ("--cutoff", "1e12", "cutoff")):
            with self.subTest(f"{option} {value}"):
                self.refused_cleanly("path", "--model", "lennard-jones", "--pair", pair, option, value, says=word)

    def test_a_landscape_energy_below_an_end_of_any_pair_is_refused_before_a_path_is_searched(self):
        low, high = frame(*TWO) + frame(*TWO_MOVED), frame("Ar 0 0 0", "Ar 0.9 0 0") + frame("Ar 0 0 1", "Ar 0.9 0 0")
        pairs = self.file("low.xyz", low), self.file("high.xyz", high)
        self.refused_cleanly("path", *ARGON, "--pair", *pairs, "--landscape-energy", "0", "--threads", "1", says="landscape")

    def test_unknown_words_are_refused_with_those_allowed(self):
        pair = self.file("pair.xyz", frame(*TWO) + frame(*TWO_MOVED))
        for option, allowed in (("--method", "contour, escape"), ("--model", "kob-andersen, lennard-jones"), ("--images", "all, minimum"),
                                ("--truncation", "shifted, plain, tail")):
            for value in ("nonsense", "CONTOUR", " all"):
                self.refused_cleanly("path", "--pair", pair, option, value, says=(value.strip(), allowed))
        self.refused_cleanly("energy", pair, *ARGON, "--backend", "gpu", says=("gpu", "simd or reference"))
        self.refused_cleanly("endpoints", *ARGON, *TINY, "--distance-species", "Xx", says=("Xx", "Ar"))

    def test_hard_spheres_have_no_energy(self):
        two = self.file("two.xyz", frame(*TWO))
        model = self.file("model.toml", 'kind = "hard-sphere"\nname = "marbles"\n[[species]]\nname = "Ar"\ndiameter = 1.0\n')
        for subcommand in ("energy", "verify"):
            for name, arguments in (("hard-sphere", ("--model", "hard-sphere")), ("hard-sphere-binary", ("--model", "hard-sphere-binary")),
                                    ("marbles", ("--model-file", model))):
                self.refused_cleanly(subcommand, two, *arguments, says=(subcommand, f"model {name} is made of hard spheres", "kob-andersen"))

    def test_hard_spheres_have_no_cutoff_images_or_truncation(self):
        two = self.file("two.xyz", frame(*TWO))
        for option, value in (("--cutoff", "2.5"), ("--images", "all"), ("--truncation", "plain")):
            self.refused_cleanly("energy", two, "--model", "hard-sphere", option, value, says=(option, "hard-sphere"))

    def test_hard_spheres_are_not_in_mixed_precision(self):
        self.refused_cleanly("endpoints", "--model", "hard-sphere", "--particles", "32", "--precision", "mixed",
                             says=("--precision", "hard-sphere"))

    def test_precision_is_double_or_mixed_and_mixed_needs_a_list(self):
        file = DATA / "ka_tiny_8.extxyz"
        self.refused_cleanly("energy", file, "--precision", "single", says=("single", "double", "mixed"))
        self.refused_cleanly("energy", file, "--precision", "mixed", "--backend", "reference", says=("--precision", "reference"))
        for subcommand, arguments in (("energy", (file, "--images", "minimum")), ("endpoints", (*ARGON, *TINY)),
                                      ("path", (*ARGON, *TINY)), ("diffusion", (*ARGON, "--particles", "8"))):
            self.refused_cleanly(subcommand, *arguments, "--precision", "mixed", says=("minimum-image", "mixed precision"))

    def test_plots_need_a_folder(self):
        self.refused("path", *ARGON, *TINY, "--plot", says=("--plot", "--out"))


if __name__ == "__main__":
    unittest.main()
