#!/usr/bin/python3
"""Makes the sdist, builds its wheel in a virtual environment and runs the tests of this folder there.

wheel_test.py SOURCE --library BUILD    the wheel takes the library that BUILD has compiled, and Debian's numpy and ASE: a minute
wheel_test.py SOURCE --whole            all is compiled from the sdist; numpy and ASE of the index; size and dependencies are checked

77: skipped, with the reason. --python names another interpreter.
"""

import argparse
import os
import re
import subprocess
import sys
import tarfile
import tempfile
import zipfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from environments import environment, install  # noqa: E402

LIBRARIES = ("ld-linux", "libc.", "libm.", "libgcc_s.", "libstdc++.", "linux-vdso")
LARGEST = 2e6  # bytes


def run(*command, **options):
    print("+", *command, flush=True)
    subprocess.run([str(word) for word in command], check=True, **options)


def sdist(folder, python, source):
    """The unpacked source distribution."""
    run(python, "-c", f"from scikit_build_core.build import build_sdist; build_sdist({str(folder / 'dist')!r})", cwd=source)
    archive, = (folder / "dist").glob("*.tar.gz")
    with tarfile.open(archive) as opened:
        opened.extractall(folder)
    return folder / archive.name.removesuffix(".tar.gz")


def wheel(folder, python, tree, *options):
    run(python, "-m", "pip", "wheel", "--quiet", "--no-deps", "--no-build-isolation", "-w", folder / "dist", *options, tree,
        env={**os.environ, "CMAKE_BUILD_PARALLEL_LEVEL": str(os.cpu_count()), "PATH": f"{python.parent}:{os.environ['PATH']}"})
    built, = (folder / "dist").glob("*.whl")
    return built


def check_sources(folder, python, tree):
    """The source distribution has all that CMake asks for."""
    run("cmake", "-S", tree, "-B", folder / "configured", "-DCMAKE_BUILD_TYPE=Release", "-DLANESCAPE_BUILD_PYTHON=ON", "-DLANESCAPE_BUILD_TESTS=OFF",
        "-DLANESCAPE_BUILD_BENCHMARKS=OFF", "-DLANESCAPE_BUILD_PROGRAM=OFF", "-DLANESCAPE_INSTALL=OFF", f"-DPython_EXECUTABLE={python}",
        stdout=subprocess.DEVNULL)


def check_contents(built):
    names = zipfile.ZipFile(built).namelist()
    print(built.name, built.stat().st_size, "bytes")
    assert any(re.fullmatch(r"lanescape/_core[.\w-]*\.so", name) for name in names), names
    for name in ("__init__.py", "_core.pyi", "ase.py", "ipi/__main__.py", "py.typed"):
        assert f"lanescape/{name}" in names, f"{name} is missing in {names}"
    assert "-> object" not in zipfile.ZipFile(built).read("lanescape/_core.pyi").decode(), "a result has no type in the stub"
    strangers = [name for name in names if not re.match(r"lanescape(-[\d.]+\.dist-info)?/", name)]
    assert not strangers, strangers


def check_size_and_libraries(python, built):
    assert built.stat().st_size <= LARGEST, f"{built.stat().st_size} bytes: at most {LARGEST:.0f} are allowed"
    core = subprocess.run([python, "-c", "import lanescape._core as c; print(c.__file__)"], capture_output=True, text=True, check=True).stdout.strip()
    linked = subprocess.run(["ldd", core], capture_output=True, text=True, check=True).stdout
    strangers = [line for line in linked.splitlines() if not Path(line.split()[0]).name.startswith(LIBRARIES)]
    assert not strangers, strangers


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("source", type=Path)
    parser.add_argument("--library", type=Path, metavar="BUILD")
    parser.add_argument("--whole", action="store_true")
    parser.add_argument("--python", default="/usr/bin/python3")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="lanescape-wheel-") as name:
        folder = Path(name)
        python = environment(folder, given.python, system=not given.whole)
        install(python, "scikit-build-core>=0.11", "nanobind>=2.9", "typing_extensions", *(["numpy", "ase", "cmake>=3.26"] if given.whole else []))
        tree = sdist(folder, python, given.source.resolve())
        if given.whole:
            built = wheel(folder, python, tree)
        else:
            check_sources(folder, python, tree)
            run("cmake", "--install", given.library, "--prefix", folder / "prefix", "--component", "CXX", stdout=subprocess.DEVNULL)
            built = wheel(folder, python, tree, "--config-settings", "cmake.source-dir=bindings/python", "--config-settings", f"cmake.define.lanescape_ROOT={folder / 'prefix'}")
        check_contents(built)
        run(python, "-m", "pip", "install", "--quiet", "--no-deps", built)
        if given.whole:
            check_size_and_libraries(python, built)
        tests = given.source.resolve() / "tests/python_package"
        run(python, "-W", "ignore::ResourceWarning", "-m", "unittest", "discover", "-s", tests, "-p", "[!w]*_test.py", cwd=folder,
            env={**os.environ, "LANESCAPE_SOURCE": str(given.source.resolve())})


if __name__ == "__main__":
    main()
