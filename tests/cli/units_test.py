"""Any unit of length, any box: energies, insertions and paths in units of 10^-30 to 10^30, boxes far larger than their particles."""

import unittest

from cli_support import ProgramTest

MODEL = """kind = "lennard-jones"
name = "argon"
[[species]]
name = "Ar"
[[pair]]
species = ["Ar", "Ar"]
epsilon = 1.0
sigma = {}
"""
UNITS = (1e-30, 3.405e-10, 1e-6, 2.0**-20, 1e4, 1e30)
EXPECTED = -916.590266926959  # the scalar reference's


class Units(ProgramTest):
    def cubes(self, n, unit, edge=None):
        spacing = 1.15 * unit
        edge = edge or n * spacing
        sites = [(i, j, k) for i in range(n) for j in range(n) for k in range(n)]
        lines = [f"Ar {' '.join(repr((x + 0.5) * spacing) for x in site)}" for site in sites]
        header = f'Lattice="{edge!r} 0 0 0 {edge!r} 0 0 0 {edge!r}" Properties=species:S:1:pos:R:3'
        return self.file(f"cubes-{n}-{unit}-{edge}.xyz", "\n".join([str(len(sites)), header, *lines]) + "\n")

    def model(self, unit):
        return ("--model-file", self.file(f"model-{unit}.toml", MODEL.format(repr(unit))))

    def test_energies_do_not_depend_on_the_unit_of_length(self):
        for unit in UNITS:
            for precision, delta in (("double", 1e-12), ("mixed", 1e-6)):
                with self.subTest(unit=unit, precision=precision):
                    result = self.done("energy", self.cubes(6, unit), *self.model(unit), "--precision", precision)
                    self.assertAlmostEqual(result["energy"] / EXPECTED, 1.0, delta=delta)

    def test_boxes_may_be_huge(self):
        for n in (2, 6):
            expected = self.done("energy", self.cubes(n, 1.0, 1e4), *self.model(1.0), "--backend", "reference")["energy"]
            for edge in (1e7, 1e20, 1e30):
                with self.subTest(n=n, edge=edge):
                    result = self.done("energy", self.cubes(n, 1.0, edge), *self.model(1.0))
                    self.assertAlmostEqual(result["energy"] / expected, 1.0, delta=1e-12)

    def test_numbers_out_of_range_are_refused(self):
        self.refused("energy", self.cubes(2, 1.0, 1e160), *self.model(1.0), says="box edge 1e+160")
        self.refused("energy", self.cubes(2, 1e-200), *self.model(1e-200), says="sigma 1e-200")
        self.refused("energy", self.cubes(2, 1.0), *self.model(1.0), "--cutoff", "1e-40", says="cutoff 1e-40")

    def test_insertions_paths_and_diffusion_scale_with_the_unit(self):
        def inserted(unit):
            result = self.done("insert", self.cubes(8, unit), *self.model(unit), "--energy", "5", "--count", "2")
            return [(i["energy"], i["evaluations"], [x / unit for x in i["position"]]) for i in result["insertions"]]

        def path(unit, *options):
            counts = [f"--{name}-steps=2000" for name in ("melt", "cooling", "check", "settle")]
            result = self.done("path", *self.model(unit), "--particles", "16", "--density", repr(0.5 / unit**3), "--distance", repr(unit),
                               "--temperature", "5", "--check-tolerance", "4", "--quick", *counts, *options)  # fmt: skip
            return [(p["outcome"], p["length"] / unit, p["steps"], p["landscape_energy"]) for p in result["paths"]]

        # At other densities the C library's cbrt() may round the edge of the box differently.
        def diffusion(unit):
            result = self.done("diffusion", *self.model(unit), "--particles", "32", "--density", repr(0.9 / unit**3), "--temperature", "3",
                               "--check-tolerance", "3", "--quick", "--melt-steps", "2000", "--cooling-steps", "2000", "--check-steps", "2000",
                               "--records", "300", "--lags", "200", "--trajectories", "1", "--between", "100")  # fmt: skip
            of = result["species"]["Ar"]
            return of["diffusion_msd"] / unit, of["displacement_exponent"], of["regime"], result["longest_time"] / unit

        self.assertEqual(diffusion(1.0)[2], "diffusive")
        def adaptive_path(unit):
            return path(unit, "--adaptive")

        for of in (inserted, path, adaptive_path, diffusion):
            with self.subTest(of.__name__):
                self.assertEqual(of(2.0**-20), of(1.0))


if __name__ == "__main__":
    unittest.main()
