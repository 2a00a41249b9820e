#!/usr/bin/env python3
"""Checks that the kernel objects of one instruction set show the rest of the program nothing but their table.

Usage: check_symbols.py --isa NAME PATH ...     (object files, or folders that are searched for them)

The linker keeps one copy of a weak symbol, whatever flags it was compiled with. An inline function of the standard library
that was compiled for AVX-512 must therefore never leave these objects, or the program may run it on a processor without.
One line per violation, and exit status 1 if there is any.
"""

import argparse
import pathlib
import subprocess
import sys
from typing import NamedTuple

INSTRUCTION_SETS = pathlib.Path(__file__).resolve().parent.parent / "cmake" / "instruction_sets.txt"


def read_xsimd_tags():
    """Of each instruction set, xsimd's architecture as it appears in a mangled name."""
    lines = [line for line in INSTRUCTION_SETS.read_text(encoding="utf-8").splitlines() if line and not line.startswith("#")]
    fields = [[field.strip() for field in line.split("|")] for line in lines]
    return {field[0]: tuple(field[3].split()) for field in fields}


XSIMD_TAGS = read_xsimd_tags()

# What compilers call of themselves, and libm where an instruction set has no rounding instruction.
FROM_LIBC = {"memcpy", "memmove", "memset", "memcmp", "nearbyint", "nearbyintf", "rint", "copysign", "fma"}
FROM_TOOLCHAIN = {"_GLOBAL_OFFSET_TABLE_", "__stack_chk_fail"}
FROM_SANITIZERS = ("__asan_", "__ubsan_", "__tsan_", "__sanitizer_")


class Symbol(NamedTuple):
    file: pathlib.Path
    name: str
    binding: str
    visibility: str
    defined: bool


def read_symbols(path):
    """The symbols of an object file that the linker sees."""
    listing = subprocess.run(["readelf", "-sW", str(path)], capture_output=True, text=True, check=True)
    if "Symbol table" not in listing.stdout:
        raise ValueError(f"{path}: no symbol table: not an object file")
    symbols = []
    for line in listing.stdout.splitlines():
        words = line.split()
        if len(words) >= 8 and words[0].rstrip(":").isdigit() and words[4] != "LOCAL":
            symbols.append(Symbol(path, words[7], words[4], words[5], words[6] != "UND"))
    return symbols


def belongs_to(name, isa):
    """Whether a mangled name can only come from this instruction set's objects."""
    tags = XSIMD_TAGS[isa]
    return f"9lanescape7kernels{len(isa)}{isa}" in name or ("5xsimd" in name and bool(tags) and all(tag in name for tag in tags))


def violations(symbols, isa):
    found = []
    table = f"_ZN9lanescape7kernels{len(isa)}{isa}5tableE"
    defined = {s.name for s in symbols if s.defined}
    if table not in defined:
        found.append(f"{table} is not defined: the table is what these objects are for")
    for s in symbols:
        if not s.defined:
            known = s.name in defined or s.name in FROM_LIBC | FROM_TOOLCHAIN or s.name.startswith(FROM_SANITIZERS)
            if not known:
                found.append(f"{s.file}: needs {s.name}; allowed are {', '.join(sorted(FROM_LIBC))}")
        elif s.name == table:
            if s.visibility != "DEFAULT":
                found.append(f"{s.file}: {s.name} is {s.visibility.lower()}; the table must be visible")
        else:
            if s.visibility not in ("HIDDEN", "INTERNAL"):
                found.append(f"{s.file}: {s.name} is visible; only {table} may be")
            if not belongs_to(s.name, isa):
                found.append(f"{s.file}: {s.binding.lower()} {s.name} does not name {isa}; "
                             f"allowed are lanescape::kernels::{isa} and xsimd templates for its architecture")
    return found


def object_files(paths):
    files = []
    for path in map(pathlib.Path, paths):
        files += sorted(path.rglob("*.o")) if path.is_dir() else [path]
    return [file for file in files if file.suffix != ".gch"]  # CMake counts precompiled headers among a target's objects


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--isa", required=True, choices=sorted(XSIMD_TAGS))
    parser.add_argument("paths", nargs="+", metavar="PATH", help="object files, or folders that hold them")
    arguments = parser.parse_args()
    files = object_files(arguments.paths)
    if not files:
        parser.error(f"no object files in {', '.join(arguments.paths)}")
    found = violations([symbol for file in files for symbol in read_symbols(file)], arguments.isa)
    print("\n".join(found) if found else f"{arguments.isa}: {len(files)} objects, only the table is visible")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
