#!/usr/bin/python3
"""Compares LennardJonesFluid with tools/equation_of_state.py, which differentiates in the complex plane: lennard_jones_fluid_test.py DUMP"""

import subprocess
import sys
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools"))

from equation_of_state import load  # noqa: E402

DUMP = sys.argv.pop() if len(sys.argv) > 1 else None


class LennardJonesFluid(unittest.TestCase):
    def test_every_property_is_that_of_the_script(self):
        density, temperature = np.meshgrid((1e-3, 0.1, 0.316, 0.5, 0.7, 0.85, 1.0), (0.7, 1.0, 1.32, 2.0, 2.5, 4.0, 9.0))
        density, temperature = density.ravel(), temperature.ravel()
        for cutoff in (0, 2.5, 3.0, 6.0):
            lines = "".join(f"{rho!r} {t!r} {cutoff}\n" for rho, t in zip(density.tolist(), temperature.tolist()))
            run = subprocess.run([DUMP], input=lines, capture_output=True, text=True, check=True)
            found = np.array([line.split() for line in run.stdout.splitlines()], float).T
            eos = load("thol", cutoff or None)
            expected = [f(temperature, density) for f in (eos.pressure, eos.e_ex, eos.c_v, eos.dp_drho, eos.dp_dt, eos.sound_velocity, eos.a_r)]
            self.assertEqual(found.shape, (7, len(density)))
            # Term 21 has exponents of 400, whose rounding is that of the result; dp_drho is a sum over a circle.
            for name, values, others in zip(("p", "e", "c_v", "dp_drho", "dp_dt", "c", "a"), found, expected):
                np.testing.assert_allclose(values, others, rtol=2e-11, atol=2e-11, err_msg=f"{name}, cutoff {cutoff}")
            self.assertGreater(np.isfinite(found[5]).sum(), 35)


if __name__ == "__main__":
    unittest.main()
