"""Virtual environments in which tests use packages of PyPI, and how a test says that it cannot run."""

import os
import shutil
import subprocess
import sys


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(77)


def environment(folder, python, *, system):
    """The interpreter of a new virtual environment."""
    made = subprocess.run([python, "-m", "venv", *(["--system-site-packages"] if system else []), folder / "venv"], capture_output=True, text=True)
    if made.returncode != 0:
        skip(f"{python} makes no virtual environment (Debian: package python3-venv): {' '.join((made.stderr + made.stdout).split())}")
    return folder / "venv/bin/python"


def install(python, *packages):
    done = subprocess.run([python, "-m", "pip", "install", "--quiet", *packages], capture_output=True, text=True)
    if done.returncode != 0:
        reason = (done.stderr.strip().splitlines() or ["no message"])[-1]
        skip(f"pip cannot install {' '.join(packages)} here: {reason}")


def snakemake(folder):
    """Snakemake: that of LANESCAPE_SNAKEMAKE, that on PATH, or that of PyPI in a new environment in the folder."""
    found = os.environ.get("LANESCAPE_SNAKEMAKE") or shutil.which("snakemake")
    if found:
        return found
    install(environment(folder, "/usr/bin/python3", system=False), "snakemake==9.27.1")
    return folder / "venv/bin/snakemake"
