"""Kernels of a host in Python, checked by lanescape.verification and by its pytest fixture.

Usage: verification_test.py PROGRAM Verification | Fixture     (Fixture without pytest: exit status 77)
"""

import importlib.util
import os
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import numpy

PACKAGE = Path(__file__).resolve().parents[2] / "bindings" / "python" / "lanescape"
EXAMPLE = Path(__file__).resolve().parents[2] / "docs" / "examples" / "host_kernel_python" / "test_my_fluid.py"
PROGRAM = str(Path(sys.argv.pop(1)).resolve())

# The two modules need nothing of the compiled package, so they are tested without it.
FOLDER = tempfile.TemporaryDirectory(prefix="lanescape-python-")
(Path(FOLDER.name) / "lanescape").mkdir()
for module in ("verification.py", "pytest_plugin.py"):
    shutil.copy(PACKAGE / module, Path(FOLDER.name) / "lanescape")
sys.path.insert(0, FOLDER.name)
from lanescape.verification import verify  # noqa: E402


def kernel(positions, box, species, parameters, own_images=True, dtype=float):
    """A Lennard-Jones mixture, shifted or plain."""
    if parameters["form"] != "lennard-jones" or parameters["truncation"] not in ("shifted", "plain"):
        return None
    box = box.astype(dtype)
    epsilon, sigma, cutoff = (parameters[key].astype(dtype)[species[:, None], species[None]] for key in ("epsilon", "sigma", "cutoff"))
    x6 = (sigma / cutoff) ** 6
    shift = 4 * epsilon * (x6 * x6 - x6) if parameters["truncation"] == "shifted" else 0 * epsilon
    reach = parameters["cutoff"].max() if parameters["images"] == "all" else 0
    most = numpy.where(reach > 0, numpy.ceil(reach / box + 0.5), 0).astype(int)
    positions = positions.astype(dtype)
    home = positions[:, None] - positions[None]
    home -= box * numpy.rint(home / box)
    energy, virial, forces = dtype(0), dtype(0), numpy.zeros_like(positions)
    for boxes in numpy.ndindex(*(2 * most + 1)):
        shift_of_image = (numpy.array(boxes) - most).astype(dtype) * box
        d = home + shift_of_image
        r2 = (d * d).sum(axis=-1)
        near = (r2 < cutoff * cutoff) & (r2 > 0)
        if not own_images or not shift_of_image.any():
            near &= ~numpy.eye(len(positions), dtype=bool)
        r2 = numpy.where(near, r2, 1)
        x6 = (sigma * sigma / r2) ** 3
        over_r = numpy.where(near, 24 * epsilon * x6 * (2 * x6 - 1) / r2, 0)
        energy += numpy.where(near, 4 * epsilon * x6 * (x6 - 1) - shift, 0).sum() / 2
        virial += (over_r * r2).sum() / 2
        forces += (over_r[..., None] * d).sum(axis=1)
    return energy, forces, virial


class Verification(unittest.TestCase):
    def setUp(self):
        os.environ["LANESCAPE_PROGRAM"] = PROGRAM

    def test_a_right_kernel_passes_within_ten_seconds(self):
        start = time.monotonic()
        report = verify(kernel)
        self.assertLess(time.monotonic() - start, 10)
        self.assertGreater(report["compared"], 100)
        self.assertEqual((report["failed"], report["compared"] + report["declined"]), (0, report["cases"]))

    def test_missing_own_images_are_found_and_named(self):
        with self.assertRaisesRegex(AssertionError, r"N=1 all .*: energy: expected .*, got 0"):
            verify(lambda *arguments: kernel(*arguments, own_images=False))

    def test_single_precision_passes_as_such_only(self):
        def in_single(*arguments):
            return kernel(*arguments, dtype=numpy.float32)
        with self.assertRaisesRegex(AssertionError, "the cutoff"):
            verify(in_single)
        self.assertGreater(verify(in_single, precision="single")["left_out"], 5)

    def test_a_kernel_that_declines_everything_fails(self):
        with self.assertRaisesRegex(AssertionError, "no case"):
            verify(lambda *arguments: None)

    def test_nan_is_found_and_named(self):
        def with_nan(positions, box, species, parameters):
            return None, numpy.full(positions.shape, numpy.nan)
        with self.assertRaisesRegex(AssertionError, "force on particle 0 .* got nan"):
            verify(with_nan)

    def test_what_the_kernel_raises_carries_the_name_of_the_case(self):
        def fails(*arguments):
            raise ZeroDivisionError("mine")
        with self.assertRaisesRegex(ZeroDivisionError, "mine") as caught:
            verify(fails)
        self.assertIn("in the case 'lennard-jones N=0 all shifted'", caught.exception.__notes__)

    def test_results_of_the_wrong_shape_are_refused(self):
        for result in (1.0, (1.0,), (1.0, 2.0, 3.0, 4.0)):
            with self.assertRaisesRegex(ValueError, "case 'lennard-jones N=0 all shifted'.*energy, forces"):
                verify(lambda *arguments: result)
        with self.assertRaisesRegex(ValueError, r"\(7,\).*\(0, 3\)"):
            verify(lambda *arguments: (0.0, numpy.zeros(7)))

    def test_bad_precisions_and_missing_programs_are_refused(self):
        with self.assertRaisesRegex(ValueError, "half.*double, single"):
            verify(lambda *arguments: None, precision="half")
        with self.assertRaisesRegex(FileNotFoundError, "LANESCAPE_PROGRAM"):
            verify(kernel, program="/nowhere/lanescape")


class Fixture(unittest.TestCase):
    def run_example(self, change, by):
        """The example of docs/HOST_KERNELS.md, with something changed in it."""
        text = EXAMPLE.read_text()
        self.assertIn(change, text)
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, EXAMPLE.name).write_text(text.replace(change, by))
            return subprocess.run([sys.executable, "-m", "pytest", "-p", "lanescape.pytest_plugin", "-q", folder], capture_output=True,
                                  text=True, env=os.environ | {"PYTHONPATH": FOLDER.name, "LANESCAPE_PROGRAM": PROGRAM}, timeout=120)

    def test_the_fixture_passes_a_right_kernel(self):
        run = self.run_example("0.5 *", "0.5 *")
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        self.assertIn("1 passed", run.stdout)

    def test_the_fixture_fails_a_wrong_kernel_and_names_its_case(self):
        run = self.run_example("(r2 > 0)", "~numpy.eye(len(positions), dtype=bool)")  # no own images
        self.assertEqual(run.returncode, 1, run.stdout + run.stderr)
        self.assertRegex(run.stdout, "cases are wrong, the worst is '[^']*lennard-jones[^']*': energy: expected")


if __name__ == "__main__":
    if sys.argv[1:] == ["Fixture"] and importlib.util.find_spec("pytest") is None:
        print("skipped: pytest is not installed")
        sys.exit(77)
    unittest.main()
