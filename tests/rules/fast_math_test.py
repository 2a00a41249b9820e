#!/usr/bin/env python3
"""A host that compiles with -ffast-math does not compile this project with it."""

import json
import pathlib
import shlex
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


class FastMathTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        command = ["cmake", "-S", ROOT, "-B", cls.folder.name, "-G", "Ninja", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON", "-DLANESCAPE_KERNELS_ONLY=ON",
                   "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS=-Ofast -ffast-math -ffinite-math-only",
                   f"-DPython_EXECUTABLE={sys.executable}"]  # fmt: skip
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        cls.commands = json.loads(pathlib.Path(cls.folder.name, "compile_commands.json").read_text())

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_every_source_switches_it_off_after_the_host(self):
        self.assertGreater(len(self.commands), 50)
        for entry in self.commands:
            words = shlex.split(entry["command"])
            self.assertLess(words.index("-ffast-math"), words.index("-fno-fast-math"), entry["file"])
            self.assertLess(words.index("-ffinite-math-only"), words.index("-fno-finite-math-only"), entry["file"])

    def test_the_compiler_then_keeps_to_ieee_arithmetic(self):
        for source in ("src/core/parallel.cpp", "kernels/vector_algebra.cpp", "reference/pair_sum.cpp"):
            words = next(shlex.split(entry["command"]) for entry in self.commands if entry["file"].endswith(source))
            flags = [word for word in words if word.startswith("-f") or word.startswith("-O") or word.startswith("-std")]
            macros = subprocess.run([*words[:1], *flags, "-dM", "-E", "-x", "c++", "/dev/null"], check=True, capture_output=True, text=True).stdout
            self.assertNotIn("__FAST_MATH__", macros, source)
            self.assertIn("#define __FINITE_MATH_ONLY__ 0", macros, source)


if __name__ == "__main__":
    unittest.main()
