"""tools/check_includes.py finds forbidden includes, and finds none in this tree."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "tools" / "check_includes.py"

# (file, its only include, whether it is allowed)
CASES = [
    ("kernels/a.cpp", "<cmath>", True),
    ("kernels/a.cpp", '"views/pair.hpp"', True),
    ("kernels/a.cpp", "<vector>", False),
    ("kernels/a.cpp", '"core/box.hpp"', False),
    ("kernels/a.cpp", "<xsimd/xsimd.hpp>", False),
    ("kernels/a.cpp", "<immintrin.h>", False),
    ("kernels/simd/avx2.hpp", "<xsimd/xsimd.hpp>", True),
    ("kernels/simd/avx2.hpp", "<immintrin.h>", True),
    ("kernels/simd/avx2.hpp", "<algorithm>", False),
    ("reference/a.cpp", '"reference/a.hpp"', True),
    ("reference/a.cpp", "<vector>", True),
    ("reference/a.cpp", "<fmt/format.h>", False),
    ("reference/a.cpp", '"views/pair.hpp"', False),
    ("reference/a.cpp", '"core/box.hpp"', False),
    ("src/core/a.cpp", '"core/box.hpp"', True),
    ("src/core/a.cpp", '"box.hpp"', False),
    ("src/core/a.cpp", '"configuration/a.hpp"', False),
    ("src/io/a.cpp", '"configuration/a.hpp"', True),
    ("src/configuration/a.cpp", '"io/a.hpp"', False),
    ("src/io/a.cpp", '"dispatch/isa.hpp"', False),
    ("src/io/a.cpp", "<hdf5.h>", True),
    ("src/io/a.cpp", "<toml++/toml.h>", True),
    ("src/configuration/a.cpp", "<toml++/toml.h>", False),
    ("src/verification/a.cpp", "<hdf5.h>", False),
    ("src/verification/a.cpp", "<nlohmann/json.hpp>", False),
    ("src/verification/host_kernel.cpp", "<lanescape/host_kernel.h>", True),
    ("src/verification/a.cpp", "<lanescape/host_kernel.h>", False),
    ("tools/lanescape/a.cpp", "<CLI/CLI.hpp>", True),
    ("src/run/a.cpp", "<CLI/CLI.hpp>", False),
    ("src/stepper/a.cpp", '"landscape/a.hpp"', True),
    ("src/stepper/a.cpp", '"dynamics/a.hpp"', False),
    ("src/landscape/a.cpp", '"path/finder.hpp"', False),
    ("src/run/a.cpp", '"observables/a.hpp"', True),
    ("src/run/a.cpp", '"verification/a.hpp"', False),
    ("src/run/a.cpp", "<lanescape/lanescape.hpp>", False),
    ("src/capi/a.cpp", '"run/a.hpp"', False),
    ("src/capi/a.cpp", '"core/box.hpp"', False),
    ("src/capi/a.cpp", "<fmt/format.h>", False),
    ("src/capi/a.cpp", '"capi/a.hpp"', True),
    ("src/capi/a.cpp", "<lanescape/lanescape.hpp>", True),
    ("src/path/a.cpp", '"views/pair.hpp"', True),
    ("src/path/a.cpp", '"kernel_table.hpp"', False),
    ("src/dispatch/a.cpp", '"kernel_table.hpp"', True),
    ("src/verification/a.cpp", '"kernel_table.hpp"', True),
    ("src/dispatch/a.cpp", '"simd/simd.hpp"', False),
    ("src/verification/a.cpp", '"reference/a.hpp"', True),
    ("src/run/a.cpp", '"reference/a.hpp"', False),
    ("src/interaction/a.cpp", "<xsimd/xsimd.hpp>", False),
    ("src/interaction/a.cpp", "<immintrin.h>", False),
    ("src/path/shortening.cpp", "<Eigen/Dense>", True),
    ("src/observables/fits.cpp", "<Eigen/Dense>", True),
    ("src/path/finder.cpp", "<Eigen/Dense>", False),
    ("src/unheard_of/a.cpp", '"core/box.hpp"', False),
    ("src/core/a.cpp", '"../reference/a.hpp"', False),
    ("src/core/a.cpp", '"tests/a.hpp"', False),
    ("src/core/a.cpp", '"tools/a.hpp"', False),
    ("src/api/lanescape/a.hpp", "<span>", True),
    ("src/api/lanescape/a.hpp", "<lanescape/version.h>", True),
    ("src/api/lanescape/a.hpp", "<stdint.h>", True),
    ("src/api/lanescape/a.hpp", '"core/box.hpp"', False),
    ("src/api/lanescape/a.hpp", "<fmt/format.h>", False),
    ("src/api/lanescape/a.h.in", "<omp.h>", False),
    ("src/api/a.cpp", '"run/a.hpp"', True),
    ("tools/lanescape/a.cpp", '"run/a.hpp"', True),
    ("tools/lanescape/a.cpp", '"verification/a.hpp"', True),
    ("tools/lanescape/a.cpp", '"lanescape/lanescape.hpp"', True),
    ("tools/lanescape/a.cpp", '"stepper/a.hpp"', False),
    ("tools/lanescape/a.cpp", '"kernel_table.hpp"', False),
    ("tools/lanescape/a.cpp", '"reference/a.hpp"', False),
    ("bench/a.cpp", '"stepper/a.hpp"', True),
    ("bench/a.cpp", '"kernel_table.hpp"', True),
    ("bench/a.cpp", '"reference/a.hpp"', True),
    ("bench/a.cpp", '"tests/a.hpp"', False),
    ("docs/snippets/a.cpp", '"kernel_table.hpp"', True),
    ("docs/snippets/a.cpp", '"verification/a.hpp"', True),
    ("docs/snippets/a.cpp", '"bench/a.hpp"', False),
    ("docs/snippets/a.cpp", '"tests/a.hpp"', False),
    ("bindings/python/a.cpp", "<lanescape/lanescape.hpp>", True),
    ("bindings/python/a.cpp", '"core/box.hpp"', False),
    ("tests/unit/a.cpp", '"stepper/a.hpp"', True),
    ("tests/unit/a.cpp", "<Eigen/Dense>", True),
    ("tests/unit/a.cpp", "<xsimd/xsimd.hpp>", False),
    ("tests/unit/a.cpp", '"tests/unit/a.hpp"', False),
    ("tests/install/a.cpp", "<lanescape/lanescape.hpp>", True),
    ("tests/install/a.cpp", '"core/box.hpp"', False),
    ("tests/install/kernels/a.cpp", '"dispatch/isa.hpp"', True),
    ("tests/install/kernels/a.cpp", '"kernel_table.hpp"', True),
    ("tests/install/kernels/a.cpp", '"io/extended_xyz.hpp"', False),
]


def check(root):
    return subprocess.run([sys.executable, str(SCRIPT), str(root)], capture_output=True, text=True, check=False)


class CheckIncludes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        (self.root / "src").mkdir()
        for header in ("views/pair.hpp", "kernel_table.hpp", "simd/simd.hpp"):
            self.write(f"kernels/{header}", "#pragma once\n")
        self.write("src/core/box.hpp", "#pragma once\n")

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path

    def test_each_include_is_judged_by_its_rule(self):
        for name, include, allowed in CASES:
            with self.subTest(file=name, include=include):
                before = (self.root / name).read_text(encoding="utf-8") if (self.root / name).exists() else None
                path = self.write(name, f"#pragma once\n#include {include}\n")
                result = check(self.root)
                self.assertEqual(result.returncode, 0 if allowed else 1, result.stdout + result.stderr)
                if not allowed:
                    self.assertRegex(result.stdout, rf"^{name}:2: includes \S+; ")
                    self.assertEqual(len(result.stdout.splitlines()), 1, result.stdout)
                path.unlink() if before is None else self.write(name, before)

    def test_a_header_without_pragma_once_is_named(self):
        self.write("src/core/a.hpp", "#include <cmath>\n")
        result = check(self.root)
        self.assertEqual(result.returncode, 1)
        self.assertTrue(result.stdout.startswith("src/core/a.hpp:1: has no #pragma once"), result.stdout)

    def test_every_violation_has_its_line(self):
        self.write("src/core/a.cpp", '#include "run/a.hpp"\n#include <cmath>\n  #  include "path/a.hpp"\n')
        result = check(self.root)
        places = [line.split(": ")[0] for line in result.stdout.splitlines()]
        self.assertEqual(places, ["src/core/a.cpp:1", "src/core/a.cpp:3"])

    def test_a_folder_that_is_no_source_tree_is_refused(self):
        self.assertNotEqual(check(self.root / "kernels").returncode, 0)

    def test_this_tree_keeps_the_rules(self):
        result = check(ROOT)
        self.assertEqual(result.returncode, 0, "\n" + result.stdout + result.stderr)


if __name__ == "__main__":
    unittest.main()
