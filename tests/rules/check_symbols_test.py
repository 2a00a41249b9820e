"""tools/check_symbols.py accepts objects that export only their table, and names any other exported symbol."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "tools" / "check_symbols.py"

TABLE = """
namespace lanescape::kernels::sse2 {
double dot(const double* a) noexcept;
extern __attribute__((visibility("default"))) double (*const table)(const double*) noexcept;
double (*const table)(const double*) noexcept = dot;
}
"""
KERNEL = """
namespace lanescape::kernels::sse2 { double dot(const double* a) noexcept { return 2.0 * a[0]; } }
"""


class CheckSymbols(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.compile("table", TABLE)

    def compile(self, name, source, *flags):
        command = [os.environ.get("CXX", "g++"), "-std=c++20", "-O0", "-fPIC", "-fvisibility=hidden", "-x", "c++", "-c", "-",
                   "-o", str(self.folder / f"{name}.o"), *flags]
        subprocess.run(command, input=source, text=True, check=True)

    def check(self, isa="sse2", path=None):
        return subprocess.run([sys.executable, str(SCRIPT), "--isa", isa, str(path or self.folder)], capture_output=True, text=True,
                              check=False)

    def assert_refused(self, words, isa="sse2"):
        result = self.check(isa)
        self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
        self.assertIn(words, result.stdout)

    def test_hidden_kernels_behind_one_table_pass(self):
        self.compile("kernel", KERNEL)
        result = self.check()
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def test_memory_functions_of_libc_may_be_called(self):
        self.compile("kernel", KERNEL.replace("return", "double b[9]; __builtin_memcpy(b, a, sizeof b + (a[0] > 9)); return b[1] +"))
        self.assertEqual(self.check().returncode, 0, self.check().stdout)

    def test_a_weak_symbol_of_the_standard_library_is_named(self):
        self.compile("kernel", "#include <algorithm>\n" + KERNEL.replace("return 2.0", "return std::max(a[0], a[1])"))
        self.assert_refused("_ZSt3maxIdERKT_S2_S2_ does not name sse2")

    def test_a_visible_kernel_is_named(self):
        self.compile("kernel", KERNEL, "-fvisibility=default")
        self.assert_refused("_ZN9lanescape7kernels4sse23dotEPKd is visible")

    def test_an_undefined_function_is_named(self):
        self.compile("kernel", KERNEL.replace("namespace", 'extern "C" int puts(const char*);\nnamespace').replace("return", 'puts("");return'))
        self.assert_refused("needs puts")

    def test_a_kernel_without_definition_is_named(self):
        self.assert_refused("needs _ZN9lanescape7kernels4sse23dotEPKd")

    def test_objects_of_another_instruction_set_are_refused(self):
        self.compile("kernel", KERNEL)
        self.assert_refused("_ZN9lanescape7kernels4avx25tableE is not defined", isa="avx2")

    def test_a_folder_without_objects_is_an_error(self):
        (self.folder / "empty").mkdir()
        self.assertEqual(self.check(path=self.folder / "empty").returncode, 2)


if __name__ == "__main__":
    unittest.main()
