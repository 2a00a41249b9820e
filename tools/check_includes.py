#!/usr/bin/env python3
"""Checks who includes whom against the rules of docs/ARCHITECTURE.md.

Usage: check_includes.py [ROOT]     (default: the source tree this file lies in)

One line per violation, `file:line: what; what is allowed`, and exit status 1 if there is any.
"""

import pathlib
import re
import sys

# A stage sees itself and the stages of lower numbers; stages of one number do not see each other. io stands above
# configuration because it reads and writes what that declares.
STAGES = {
    "core": 0,
    "configuration": 1,
    "io": 2, "dispatch": 2,
    "neighbour": 3,
    "interaction": 4,
    "landscape": 5,
    "dynamics": 6, "stepper": 6, "insertion": 6,
    "path": 7, "flow": 7,
    "observables": 8,
    "run": 9, "verification": 9,
    "api": 10, "capi": 10,
}  # fmt: skip
ABOVE_THE_API = {"capi"}  # sees itself and the installed headers alone, as hosts do
# Hosts catch what every stage throws, and verification calls what hosts declare.
SHARED_VOCABULARY = {("src/core/error.hpp", "lanescape/error.hpp"), ("src/verification/host_kernel.cpp", "lanescape/host_kernel.h")}
# dynamics: an event costs less than a virtual call would be worth, and event-driven dynamics is nothing but its kernels.
SEES_KERNEL_TABLE = {"dispatch", "neighbour", "interaction", "dynamics", "verification"}
SEEN_OF_KERNELS = ("views/", "pair_forms.hpp")
SEES_REFERENCE = {"verification"}
# The program starts runs, reads files, averages results and verifies; dynamics, steppers and paths reach it through run/ only, and
# landscapes but for the one of an engine; of flow it needs the options and the outsides.
PROGRAM_STAGES = {"core", "configuration", "io", "dispatch", "flow", "insertion", "interaction", "landscape", "observables", "run",
                  "verification"}

KERNEL_STANDARD_HEADERS = {"cstddef", "cstdint", "cmath", "type_traits", "utility"}
VECTOR_LAYER = "kernels/simd/"
# What a build of the kernels alone must not need.
FILE_FORMATS = {"hdf5.h": ("src/io/", "tests/"), "zlib.h": ("src/io/",), "toml++": ("src/io/",), "nlohmann": ("tools/", "tests/"), "CLI": ("tools/", "tests/fuzz/")}
EIGEN_USERS = ("src/path/shortening", "src/observables/fits", "tests/")

FOLDERS = ("kernels", "reference", "src", "tools", "bench", "bindings", "tests", "docs")
SOURCES = {".cpp", ".c", ".hpp", ".h", ".in"}
HEADERS = {".hpp", ".h"}
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^">]+)[">]')
C_STANDARD = {f"{name}.h" for name in ("assert", "errno", "float", "limits", "math", "stdbool", "stddef", "stdint", "stdio", "stdlib", "string")}


def is_standard(name):
    return re.fullmatch(r"[a-z_0-9]+", name) is not None or name in C_STANDARD


def is_intrinsics(name):
    return name.endswith("intrin.h") or name == "arm_neon.h"


class Target:
    """What an include names: one of our folders or stages, or a header from outside."""

    def __init__(self, root, path, name):
        first = name.split("/")[0]
        self.name = name
        self.stage = None
        if name.startswith("lanescape/"):
            self.place = "api"
        elif first in STAGES:
            self.place, self.stage = "src", first
        elif first in FOLDERS:
            self.place = first
        elif (root / "kernels" / name).is_file():
            self.place = "kernels"
        elif (path.parent / name).is_file():
            self.place = "neighbouring file"
        else:
            self.place = "outside"


def refuse_outside(relative, name):
    """Headers of other projects that only some files may see."""
    if (name.startswith("xsimd") or is_intrinsics(name)) and not relative.startswith(VECTOR_LAYER):
        return f"only {VECTOR_LAYER} sees xsimd and intrinsics"
    if name.split("/")[0] in ("Eigen", "unsupported") and not relative.startswith(EIGEN_USERS):
        return "Eigen is allowed in " + ", ".join(f"{user}*" for user in EIGEN_USERS)
    users = FILE_FORMATS.get(name.split("/")[0])
    if users and not relative.startswith(users):
        return f"{name} is allowed in {', '.join(users)}"
    if name.startswith("kissfft") and not relative.startswith("src/observables/"):
        return "kissfft is allowed in src/observables/"
    return None


def refuse_in_kernels(relative, target):
    if target.place == "kernels" or target.name in KERNEL_STANDARD_HEADERS:
        return None
    if relative.startswith(VECTOR_LAYER) and target.name in ("immintrin.h", "xsimd/xsimd.hpp"):
        return None
    return f"kernels see kernels and {', '.join(f'<{h}>' for h in sorted(KERNEL_STANDARD_HEADERS))}"


def refuse_in_reference(relative, target):
    if target.place == "reference" or (target.place == "outside" and is_standard(target.name)):
        return None
    return "reference sees itself and the standard library"


def refuse_in_installed_headers(relative, target):
    if target.place == "api" or (target.place == "outside" and is_standard(target.name)):
        return None
    return "installed headers see the standard library and lanescape/*"


def refuse_in_src(relative, target):
    stage = relative.split("/")[1]
    if relative.startswith("src/api/lanescape/"):
        return refuse_in_installed_headers(relative, target)
    if stage not in STAGES:
        return f"src/{stage} is no stage: list it in STAGES"
    if stage in ABOVE_THE_API and not (target.place == "api" or target.stage == stage or (target.place == "outside" and is_standard(target.name))):
        return f"{stage} sees itself, the installed headers and the standard library"
    if target.place == "src":
        allowed = target.stage == stage or STAGES[target.stage] < STAGES[stage]
        lower = ", ".join(s for s in STAGES if STAGES[s] < STAGES[stage])
        return None if allowed else f"stage {stage} sees itself{' and ' + lower if lower else ''}"
    if target.place == "api":
        if stage == "api" or stage in ABOVE_THE_API or (relative, target.name) in SHARED_VOCABULARY:
            return None
        return "the installed headers are seen by src/api and src/capi"
    if target.place == "kernels":
        if target.name.startswith(SEEN_OF_KERNELS) or (target.name == "kernel_table.hpp" and stage in SEES_KERNEL_TABLE):
            return None
        return f"of kernels/, src sees {', '.join(SEEN_OF_KERNELS)}, and kernel_table.hpp in {', '.join(sorted(SEES_KERNEL_TABLE))}"
    if target.place == "reference":
        return None if stage in SEES_REFERENCE else f"reference/ is seen by src/{', '.join(SEES_REFERENCE)}"
    if target.place == "neighbouring file":
        return f"src files are named from src/: \"{stage}/{target.name}\""
    return None if target.place == "outside" else "src sees src, kernels/views/ and other projects' headers"


def refuse_in_program(relative, target):
    if target.place in ("api", "neighbouring file", "outside") or (target.place == "src" and target.stage in PROGRAM_STAGES):
        return None
    return f"tools see src/api and {', '.join(sorted(PROGRAM_STAGES))}"


def refuse_in_bench(relative, target):
    return None if target.place in ("api", "src", "kernels", "reference", "neighbouring file", "outside") else "bench and docs see src, kernels and reference"


def refuse_in_host_code(relative, target):
    if relative.startswith("tests/install/kernels/"):  # a host of the kernels alone
        allowed = target.place == "kernels" or target.stage == "dispatch" or target.place == "outside"
        return None if allowed else "hosts of the kernels see the headers of the component kernels: kernels/ and dispatch/"
    return None if target.place in ("api", "neighbouring file", "outside") else "host code sees the installed headers lanescape/* only"


def refuse_in_tests(relative, target):
    if relative.startswith("tests/install/"):
        return refuse_in_host_code(relative, target)
    return refuse_in_bench(relative, target) and "tests see src, kernels, reference and their own folder"


RULES = {
    "kernels": refuse_in_kernels,
    "reference": refuse_in_reference,
    "src": refuse_in_src,
    "tools": refuse_in_program,
    "bench": refuse_in_bench,
    "bindings": refuse_in_host_code,
    "docs": refuse_in_bench,
    "tests": refuse_in_tests,
}


def refuse(root, path, relative, name):
    """Why this include is not allowed, or None."""
    if "." in name.split("/") or ".." in name.split("/"):
        return "no paths relative to the file's own folder"
    if name.split("/")[0] in ("tests", "tools"):
        return "nothing includes tests or tools"
    return RULES[relative.split("/")[0]](relative, Target(root, path, name)) or refuse_outside(relative, name)


def violations(root):
    """(relative path, line, what, allowed) for everything in the tree that breaks a rule."""
    found = []
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix not in SOURCES or not path.is_file():
                continue
            relative = path.relative_to(root).as_posix()
            lines = path.read_text(encoding="utf-8").splitlines()
            if path.suffix in HEADERS and "#pragma once" not in lines:
                found.append((relative, 1, "has no #pragma once", "every header starts with one"))
            for number, line in enumerate(lines, 1):
                match = INCLUDE.match(line)
                why = match and refuse(root, path, relative, match[1])
                if why:
                    found.append((relative, number, f"includes {match[1]}", why))
    return found


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parent.parent)
    if not (root / "src").is_dir():
        sys.exit(f"{root}: no folder src there; name the root of the source tree")
    found = violations(root)
    for relative, line, what, allowed in found:
        print(f"{relative}:{line}: {what}; {allowed}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
