"""Resolved run files and output folders."""

import json
import shutil
import unittest

from cli_support import DATA, ARGON, TINY, WARM, FLUID, TWO, TWO_MOVED, ProgramTest, contents, frame, with_options, without_seconds


class RunFiles(ProgramTest):
    def repeat(self, subcommand, *arguments):
        """Runs twice, the second time from the resolved run file of the first."""
        first = self.done(subcommand, *arguments, "--out", self.folder / "first")
        second = self.done(subcommand, "--config", self.folder / "first" / "run.toml", "--out", self.folder / "second")
        self.assertEqual(without_seconds(first), without_seconds(second))
        self.assertEqual(contents(self.folder / "first"), contents(self.folder / "second"))
        for name in ("first", "second"):
            shutil.rmtree(self.folder / name)

    def test_a_resolved_run_file_gives_the_same_result(self):
        self.repeat("info")
        self.repeat("info", "--seed", 2**64 - 1)
        self.repeat("energy", DATA / "ka_tiny_8.extxyz", "--forces", "--images", "minimum", "--cutoff", "1.9")
        self.repeat("energy", DATA / "ka_tiny_8.extxyz", "--backend", "reference", "--truncation", "tail")
        self.repeat("endpoints", *ARGON, *with_options(TINY, "--seed", "5", "--time-step", "0.0007", "--temperature", str(1 / 3)))
        self.repeat("path", *ARGON, *FLUID, "--seed", "11", "--method", "escape", "--reverse", "--step", "0.0013")
        pairs = self.make_pairs("ends", 2)
        self.repeat("path", *ARGON, "--pair", *pairs, "--landscape-energy", "-11.25", "--threads", "2")
        self.repeat("verify", DATA / "ka_tiny_8.extxyz", DATA / "ka_melted_144.extxyz", "--isa", self.done("info")["isas"][0])

    def test_flags_win_over_the_run_file(self):
        config = self.file("run.toml", f'threads = 3\nisa = "{self.done("info")["isas"][0]}"\nseed = 4\n')
        result = self.done("info", "--config", config)
        self.assertEqual((result["threads"], result["isa"]), (3, self.done("info")["isas"][0]))
        self.assertEqual(self.done("info", "--threads", "2", "--config", config)["threads"], 2)
        self.assertEqual(self.done("info", "--config", config, "--threads=2")["threads"], 2)

    def test_flags_win_over_files_lists_and_switches_of_the_run_file(self):
        two, moved = self.file("two.xyz", frame(*TWO)), self.file("moved.xyz", frame(*TWO_MOVED))
        config = self.file("energy.toml", f'file = "{two}"\nmodel = "lennard-jones"\nforces = true\n')
        energies = [self.done("energy", *arguments, "--config", config)["energy"] for arguments in ((), (moved,))]
        self.assertEqual(energies, [self.done("energy", f, *ARGON)["energy"] for f in (two, moved)])
        self.assertIn("forces", self.done("energy", "--config", config))
        self.assertNotIn("forces", self.done("energy", "--config", config, "--forces=false"))
        pairs = self.make_pairs("ends", 2)
        config = self.file("path.toml", f'pair = {json.dumps(pairs)}\nmodel = "lennard-jones"\nimages = "minimum"\n')
        self.assertEqual(len(self.done("path", "--config", config)["paths"]), 2)
        self.assertEqual(len(self.done("path", "--config", config, "--pair", pairs[1])["paths"]), 1)

    def test_the_output_folder_may_come_from_the_run_file(self):
        self.done("info", "--config", self.file("run.toml", f'out = "{self.folder / "here"}"\n'))
        self.assertTrue((self.folder / "here" / "result.json").exists())

    def test_mistakes_are_refused_with_file_and_line(self):
        for text, line, word in (("seed = 1\n\nnonsense = 2\n", 3, "nonsense"), ("seed = 1\nthreads = \n", 2, "run file"),
                                 ("[table]\nseed = 1\n", 1, "table"), ("seed = 1\nconfig = 'x'\n", 2, "config"),
                                 ("resume = 'x'\n", 1, "resume"), ("help = true\n", 1, "help"),
                                 ("seed = 1\nseed = 2\n", 2, ""), ("seed = 1979-05-27\n", 1, "seed")):
            config = self.file("bad.toml", text)
            self.refused_cleanly("info", "--config", config, says=(f"{config}:{line}:", word))
        self.refused("info", "--config", self.folder / "missing.toml", says="missing.toml")
        self.refused("info", "--config", self.folder, says=str(self.folder))
        self.refused("info", "--config", self.file("bad.toml", "seed = 'x'\n"), says="--seed")
        self.refused("info", "--config", self.file("binary.toml", bytes(range(256))), says="binary.toml")
        self.refused("endpoints", "--config", self.file("bad.toml", "particles = -3\n"), says="--particles")


class OutputFolders(ProgramTest):
    def test_a_folder_that_holds_a_run_is_refused(self):
        out = self.folder / "run"
        self.done("info", "--out", out)
        before = contents(out)
        for arguments in (("info",), ("endpoints", *ARGON, *TINY)):
            self.refused(*arguments, "--out", out, says=(str(out), "--resume"))
        self.assertEqual(contents(out), before)

    def test_a_folder_that_cannot_be_used_is_refused(self):
        file = self.file("file", "in the way")
        for bad in (file, file / "below", "/proc/lanescape"):
            for arguments in (("info",), ("endpoints", *ARGON, *TINY)):
                self.refused(*arguments, "--out", bad, says=str(bad))
        self.assertEqual(file.read_text(), "in the way")

    def test_parents_are_made(self):
        self.done("info", "--out", self.folder / "a" / "b" / "c")
        self.assertTrue((self.folder / "a" / "b" / "c" / "result.json").exists())

    def test_other_files_in_the_folder_stay(self):
        self.file("note.txt", "mine")
        self.done("info", "--out", self.folder)
        self.assertEqual(sorted(f.name for f in self.folder.iterdir()), ["note.txt", "result.json", "run.toml"])

    def test_what_a_refused_run_finds_in_its_folder_stays(self):
        self.file("note.txt", "mine")
        two = self.file("two.xyz", frame(*TWO))
        self.refused("endpoints", *ARGON, *WARM, "--start", two, "--cutoff", "1000", "--images", "all", "--out", self.folder)
        self.assertEqual(sorted(f.name for f in self.folder.iterdir()), ["note.txt", "two.xyz"])


if __name__ == "__main__":
    unittest.main()
