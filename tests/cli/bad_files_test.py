"""Files with mistakes are refused."""

import unittest

from cli_support import DATA, ARGON, WARM, LATTICE, PROPERTIES, HEADER, SPHERE_HEADER, TWO, TWO_MOVED, OVERLAP, ProgramTest, frame


class BadFiles(ProgramTest):
    def every_reader_refuses(self, content, *says):
        file = self.file("bad.xyz", content)
        for arguments in (("energy", file), ("energy", file, "--backend", "reference"), ("path", "--pair", file),
                          ("endpoints", "--start", file, *WARM)):
            self.refused(*arguments, *ARGON, says=("bad.xyz", *says))
        self.refused_cleanly("path", "--pair", file, *ARGON, says="bad.xyz")

    def test_headers_that_do_not_fit_are_refused(self):
        for header, word in ((LATTICE, "Properties"), (PROPERTIES, "Lattice"), ("", "Lattice"),
                             (f"{LATTICE} Properties=pos:R:3", "species"), (f"{LATTICE} Properties=species:S:1", "pos"),
                             (f"{LATTICE} Properties=species:S:1:pos:R:2", "pos"), (f"{LATTICE} Properties=species:S:1:pos:S:3", "pos"),
                             (f'Lattice="4 0 0 1 4 0 0 0 4" {PROPERTIES}', "orthorhombic"),
                             (f'Lattice="0 0 0 0 4 0 0 0 4" {PROPERTIES}', "Lattice"),
                             (f'Lattice="-4 0 0 0 4 0 0 0 4" {PROPERTIES}', "Lattice"),
                             (f'Lattice="nan 0 0 0 4 0 0 0 4" {PROPERTIES}', "Lattice"),
                             (f'Lattice="inf 0 0 0 4 0 0 0 4" {PROPERTIES}', "Lattice"),
                             (f'Lattice="4 0 0 0 4 0 0 0" {PROPERTIES}', "Lattice"),
                             (f'Lattice="4 0 0 0 4 0 0 0 4" {PROPERTIES} pbc="T F"', "pbc")):
            with self.subTest(header):
                self.every_reader_refuses(frame(*TWO, header=header), "bad.xyz:2", word)

    def test_open_axes_are_refused_by_all_that_need_a_periodic_box(self):
        header = HEADER.replace("T T T", "T T F")
        soft, hard = self.file("open.xyz", frame(*TWO, header=header)), self.file(
            "spheres.xyz", frame("Ar 0 0 0 0.5", "Ar 2 2 2 0.5", header=SPHERE_HEADER.replace("T T T", "T T F")))
        for arguments in (("path", "--pair", soft, *ARGON), ("endpoints", "--start", soft, *WARM, *ARGON),
                          ("diffusion", "--start", soft, "--temperature", "1", *ARGON), ("shorten", "--pair", soft, *ARGON),
                          ("insert", soft, "--densify", "0.5", *ARGON), ("verify", soft, "--model", "lennard-jones"), ("overlap", hard),
                          ("path", "--pair", hard, "--model", "hard-sphere")):
            with self.subTest(arguments[0]):
                self.refused(*arguments, says='pbc "T T F" is not allowed: the box must be periodic along all axes')

    def test_particle_lines_that_do_not_fit_are_refused(self):
        for line, word in (("Ar 1 1", "columns"), ("Ar 1 1 1 1", "columns"), ("Xx 1 1 1", "Xx"), ("Ar nan 1 1", "nan"),
                           ("Ar inf 1 1", "inf"), ("Ar 1 1 -inf", "inf"), ("Ar 1 x 1", "x"), ("Ar 1 1 1e999", "1e999"), ("", "columns")):
            with self.subTest(line):
                self.every_reader_refuses(frame("Ar 0 0 0", line), "bad.xyz:4", word)

    def test_counts_that_do_not_match_are_refused(self):
        for count in (0, -5, "x", "1e12", 1, 3, 10**12, 10**30):
            with self.subTest(count):
                self.every_reader_refuses(frame(*TWO, count=count))

    def test_files_that_are_no_structures_are_refused(self):
        for name, content in (("empty", b""), ("binary", bytes(range(256)) * 40), ("zeros", b"\0" * 4096), ("line ends", b"\n\n\n"),
                              ("truncated", frame(*TWO)[:-6].encode()), ("header only", frame(*TWO).splitlines()[0].encode())):
            with self.subTest(name):
                self.every_reader_refuses(content)

    def test_missing_files_and_folders_are_refused(self):
        for bad in (self.folder / "missing.xyz", self.folder):
            for arguments in (("energy", bad), ("path", "--pair", bad), ("endpoints", "--start", bad), ("verify", bad),
                              ("info", "--config", bad), ("energy", DATA / "ar_tiny_4.extxyz", "--model-file", bad)):
                self.refused_cleanly(*arguments, says=str(bad))

    def test_overlapping_particles_are_refused_with_both_indices(self):
        file = self.file("bad.xyz", frame(*OVERLAP))
        for arguments in (("energy", file), ("energy", file, "--backend", "reference"), ("endpoints", "--start", file, *WARM)):
            self.refused_cleanly(*arguments, *ARGON, says="1 and 3")
        fine = ("Ar 1 1 1", "Ar 0 0 0", "Ar 2 2 2", "Ar 3 3 3")
        for content in (frame(*OVERLAP) + frame(*fine), frame(*fine) + frame(*OVERLAP)):
            self.refused_cleanly("path", "--pair", self.file("bad.xyz", content), *ARGON, says=("bad.xyz", "1 and 3"))

    def test_end_points_that_do_not_belong_together_are_refused(self):
        two, moved = frame(*TWO), frame(*TWO_MOVED)
        other_box = frame(*TWO_MOVED, header=HEADER.replace('"4 0', '"4.1 0'))
        more = frame(*TWO_MOVED, "Ar 2 2 2")
        for name, content, words in (("one frame", two, "holds one frame"),
                                     ("three frames", two + moved + two, "more than two frames"),
                                     ("other box", two + other_box, "box"), ("more particles", two + more, "composition"),
                                     ("no way between", two + two, "coincide")):
            with self.subTest(name):
                self.refused_cleanly("path", "--pair", self.file("bad.xyz", content), *ARGON, says=("bad.xyz", words))
        mixed = frame("Ni 0 0 0", "P 1.1 0 0") + frame("P 0 0 0.5", "Ni 1.2 0.3 0")
        self.refused_cleanly("path", "--pair", self.file("bad.xyz", mixed), says=("bad.xyz", "composition"))

    def test_model_files_with_mistakes_are_refused(self):
        good = ('kind = "lennard-jones"\n[[species]]\nname = "Ar"\n[[pair]]\nspecies = ["Ar", "Ar"]\nepsilon = 1.0\nsigma = 1.0\n')
        two = self.file("two.xyz", frame(*TWO))
        self.done("energy", two, "--model-file", self.file("model.toml", good))
        for bad in ("", "nonsense", good.replace("lennard-jones", "hard-sphere"), good.replace("sigma = 1.0", "sigma = -1.0"), good.replace("sigma = 1.0", "sigma = nan"),
                    good.replace("epsilon = 1.0\n", ""), good + "colour = 3\n", good.replace('"Ar", "Ar"', '"Ar", "Kr"'),
                    good.replace('name = "Ar"', 'name = "Ar"\nmass = 0'), good.replace("epsilon = 1.0", 'epsilon = "one"'),
                    good.replace("[[pair]]", "[pair"), bytes(range(256)).decode("latin-1")):
            with self.subTest(bad):
                self.refused_cleanly("energy", two, "--model-file", self.file("model.toml", bad), says="model.toml")

    def test_an_empty_name_is_refused_as_such(self):
        two = self.file("two.xyz", frame(*TWO))
        good = 'kind = "lennard-jones"\nname = "a"\n[[species]]\nname = "Ar"\n[[pair]]\nspecies = ["Ar", "Ar"]\nepsilon = 1.0\nsigma = 1.0\n'
        for bad, words in ((good.replace('"a"', '""'), 'model.toml:2: name = "" is not allowed: a text with at least one character'),
                           (good.replace('"Ar"\n[[p', '""\n[[p'), 'model.toml:4: name = "" is not allowed'),
                           (good.replace('"a"', "3"), "model.toml:2: name is no text: a text in quotes is needed")):
            self.refused_cleanly("energy", two, "--model-file", self.file("model.toml", bad), says=words)

    def test_numbers_too_small_for_a_double_are_zero(self):
        small = self.done("energy", self.file("small.xyz", frame("Ar 1e-999 0 -1e-999", "Ar 1.1 0 0")), *ARGON)
        self.assertEqual(small, self.done("energy", self.file("two.xyz", frame(*TWO)), *ARGON))

    def test_a_key_without_a_value_leaves_the_next_key_whole(self):
        empty = self.done("energy", self.file("empty.xyz", frame(*TWO, header="config_type= " + HEADER)), *ARGON)
        self.assertEqual(empty, self.done("energy", self.file("two.xyz", frame(*TWO)), *ARGON))


if __name__ == "__main__":
    unittest.main()
