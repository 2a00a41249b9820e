"""shorten --check: the certificate of a written path, and bad input."""

import math
import struct
import unittest
import zlib

from cli_support import ARGON, DATA, HEADER, SPHERE_HEADER, InterruptionTest, frame, one_object

WHOLE = DATA / "two_spheres_path.h5"  # 201 nodes of the geodesic from 3 to 3 diameters at 170 degrees, chords of the arc


def with_trailer(content):
    """As docs/FORMATS.md describes it."""
    end = b"lanescape check\n" + struct.pack("<QI", len(content), 1)
    return content + end + struct.pack("<I", zlib.crc32(content + end))


def geodesic(a, b, angle, fraction):
    """A point of the shortest path around the unit disc: a tangent, an arc and a tangent; and its whole length."""
    first, second = math.acos(1 / a), math.radians(angle) - math.acos(1 / b)
    begin, arc, end = math.sqrt(a * a - 1), second - first, math.sqrt(b * b - 1)
    along = fraction * (begin + arc + end)
    polar = lambda r, phi: (r * math.cos(phi), r * math.sin(phi))
    mix = lambda p, q, t: tuple(u + t * (v - u) for u, v in zip(p, q))
    if along < begin:
        point = mix((a, 0.0), polar(1, first), along / begin)
    elif along < begin + arc:
        point = polar(1, first + along - begin)
    else:
        point = mix(polar(1, second), polar(b, math.radians(angle)), (along - begin - arc) / end)
    return point, begin + arc + end


def spheres(points, size=" 0.5", header=SPHERE_HEADER, edge="12"):
    """Frames of two spheres around (6, 6, 6) at these separations."""
    return "".join(frame(f"Ar {6 - x / 2!r} {6 - y / 2!r} 6{size}", f"Ar {6 + x / 2!r} {6 + y / 2!r} 6{size}",
                         header=header.replace("4", edge)) for x, y in points)


def path(a, b, angle, nodes):
    return [geodesic(a, b, angle, k / (nodes - 1))[0] for k in range(nodes)]


class PathCheck(InterruptionTest):
    HARD = ("shorten", "--model", "hard-sphere", "--check")

    def test_two_spheres_have_the_length_of_the_formula_and_no_residual(self):
        for a, b, angle in ((3, 3, 170), (2, 3.5, 150), (1.5, 1.5, 120)):
            result = self.done(*self.HARD, self.file("path.xyz", spheres(path(a, b, angle, 401))))
            self.assertAlmostEqual(result["length"], geodesic(a, b, angle, 0)[1] / math.sqrt(2), delta=1e-5)
            self.assertLess(result["kuhn_tucker_residual"], 1e-3)
            self.assertLess(result["largest_violation"], 1e-4)
            self.assertEqual((result["nodes"], result["landscape_energy"]), (401, None))
            self.assertAlmostEqual(result["ratio_squared"], (result["distance"] / result["length"]) ** 2, delta=1e-12)

    def test_a_detour_has_a_large_residual_and_a_straight_line_none(self):
        detour = [(3 * math.cos(t / 100), 3 * math.sin(t / 100)) for t in range(290)]
        self.assertGreater(self.done(*self.HARD, self.file("detour.xyz", spheres(detour)))["kuhn_tucker_residual"], 0.9)
        line = [(3 - 0.05 * k, 1.2) for k in range(100)]
        result = self.done(*self.HARD, self.file("line.xyz", spheres(line)))
        self.assertEqual((result["kuhn_tucker_residual"], result["largest_violation"]), (0.0, 0.0))
        self.assertAlmostEqual(result["ratio_squared"], 1.0, delta=1e-14)

    def test_a_path_through_a_sphere_violates_between_its_nodes(self):
        result = self.done(*self.HARD, self.file("through.xyz", spheres([(3, 0.1), (1.5, 0.25), (-1.5, 0.25), (-3, 0.1)])))
        self.assertAlmostEqual(result["largest_violation"], 0.75, delta=1e-12)

    def test_a_whole_path_brings_its_model(self):
        out = self.folder / "out"
        result = self.done("shorten", "--check", WHOLE, "--out", out)
        self.assertEqual(result, one_object((out / "result.json").read_text()))
        self.assertIsNone(result["length_before"])
        self.assertEqual((result["model"], result["method"], result["nodes"]), ("hard-sphere", "geodesic", 201))
        self.assertAlmostEqual(result["length"], 6.1620 / math.sqrt(2), delta=1e-4)
        self.assertLess(result["kuhn_tucker_residual"], 1e-3)
        again = self.done("shorten", "--config", out / "run.toml")
        self.assertEqual(again["kuhn_tucker_residual"], result["kuhn_tucker_residual"])
        self.refused("shorten", "--check", WHOLE, "--model", "hard-sphere", says="--model")

    def test_frames_of_a_soft_path_carry_their_landscape_energy(self):
        [pair] = self.make_pairs("ends")
        out = self.folder / "path"
        [greedy] = self.done("path", *ARGON, "--pair", pair, "--frames", "20", "--landscape-energy", "1e3", "--out", out)["paths"]
        result = self.done("shorten", *ARGON, "--check", out / "path-0001.extxyz", "--pair", pair)
        self.assertEqual((result["landscape_energy"], result["nodes"]), (1e3, 22))
        self.assertAlmostEqual(result["distance"], greedy["distance"], delta=1e-12)
        self.assertLessEqual(result["length"], greedy["length"] * (1 + 1e-12))

    def test_direction_and_threads_change_nothing(self):
        frames = spheres(path(3, 3, 170, 101))
        lines = frames.splitlines(keepends=True)
        backwards = "".join("".join(lines[k:k + 4]) for k in reversed(range(0, len(lines), 4)))
        ends = self.file("ends.xyz", "".join(lines[:4] + lines[-4:]))
        one, two, back = (self.done(*self.HARD, self.file("path.xyz", text), "--pair", ends, "--threads", threads)
                          for text, threads in ((frames, "1"), (frames, "2"), (backwards, "1")))
        for key in ("length", "largest_violation", "kuhn_tucker_residual"):
            self.assertEqual(one[key], two[key])
            self.assertAlmostEqual(one[key], back[key], delta=1e-7)

    def test_files_that_are_no_path_are_refused(self):
        whole = WHOLE.read_bytes()
        for cut in (8, 100, len(whole) // 2):
            self.refused_cleanly("shorten", "--check", self.file("cut.h5", whole[:cut]), says="cut.h5")
        at = whole.index(struct.pack("<d", 4.5))  # the first coordinate
        self.refused_cleanly("shorten", "--check", self.file("bad.h5", whole[:at] + bytes([whole[at] ^ 1]) + whole[at + 1:]), says="bad.h5")
        self.refused_cleanly("shorten", "--check", self.folder / "none.h5", says="none.h5")
        self.refused_cleanly("shorten", "--check", self.file("bare.h5", whole[:-32]), says=("bare.h5", "checksum"))
        self.done("shorten", "--check", self.file("made.h5", with_trailer(whole[:-32])))
        points = path(3, 3, 170, 5)
        self.refused_cleanly(*self.HARD, self.file("two.xyz", spheres(points[:2])), says=("two.xyz", "at least 3"))
        self.refused_cleanly(*self.HARD, self.file("nan.xyz", spheres(points).replace("6 0.5", "nan 0.5", 1)), says="nan.xyz")
        bare = spheres(points, size="", header=HEADER)
        self.refused_cleanly(*self.HARD, self.file("bare.xyz", bare), says=("bare.xyz", "radius"))
        self.refused_cleanly(*self.HARD, self.file("short.xyz", spheres(points)[:-20]), says="short.xyz")
        self.refused_cleanly(*self.HARD, self.file("rest.xyz", spheres(points[:2] + points[1:])), says=("rest.xyz", "coincide"))
        self.refused_cleanly("shorten", "--check", self.file("other.xyz", spheres(points)), says="other.xyz")  # not Kob and Andersen's

    def test_another_system_and_other_ends_are_refused(self):
        points = path(3, 3, 170, 5)
        file = self.file("path.xyz", spheres(points))
        self.done(*self.HARD, file, "--pair", self.file("pair.xyz", spheres([points[0], points[-1]])))
        for name, ends, says in (("ends", spheres([points[0], (-3.0, 0.0)]), "end points"),
                                 ("box", spheres([points[0], points[-1]], edge="13"), "box"),
                                 ("radii", spheres([points[0], points[-1]], size=" 0.4"), "radii"),
                                 ("more", "".join(frame("Ar 1 1 1 0.5", f"Ar 3 3 {z} 0.5", "Ar 9 9 9 0.5",
                                                        header=SPHERE_HEADER.replace("4", "12")) for z in (3, 4)), "particles")):
            self.refused_cleanly(*self.HARD, file, "--pair", self.file(f"{name}.xyz", ends), says=("path.xyz", says))

    def test_options_of_shortening_are_refused(self):
        for option in (("--method", "montecarlo"), ("--starts", "2"), ("--path", WHOLE), ("--step", "0.01")):
            self.refused_cleanly("shorten", "--check", WHOLE, *option, says=(option[0], "--check"))
        self.refused_cleanly("shorten", says="--pair")

    def test_a_whole_path_can_be_shortened_further_and_only_as_its_own_system(self):
        whole = self.folder / "pair.xyz"
        points = path(3, 3, 170, 201)
        whole.write_text(spheres([points[0], points[-1]]))
        self.refused_cleanly("shorten", "--pair", whole, "--model", "hard-sphere", "--path", WHOLE, says="overlap")  # its chords cut in
        self.refused_cleanly("shorten", "--pair", DATA / "ka108-T1-pair.extxyz", "--path", WHOLE, says="species")


if __name__ == "__main__":
    unittest.main()
