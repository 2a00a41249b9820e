"""Every test that docs/RELIABILITY.md names exists, and every promise has one."""

import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]


def main():
    listed = subprocess.run(["ctest", "-N"], cwd=sys.argv[1], capture_output=True, text=True, check=True).stdout
    there = set(re.findall(r"Test +#\d+: (\S+)", listed))
    faults, promises, of_promises = [], 0, False
    for number, line in enumerate((ROOT / "docs" / "RELIABILITY.md").read_text().splitlines(), 1):
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if not line.startswith("|"):
            of_promises = False
        elif cells[0] == "promise":
            of_promises = True
        if not of_promises or cells[0] in ("promise", "---"):
            continue
        promises += 1
        names = re.findall(r"`([a-zA-Z0-9_.]+)`", cells[-1])
        faults += [f"RELIABILITY.md:{number}: there is no test {name}" for name in names if name not in there]
        if not names:
            faults.append(f"RELIABILITY.md:{number}: no test shows this")
    if promises < 20:
        faults.append(f"RELIABILITY.md: {promises} promises were found: the form of its tables has changed")
    print("\n".join(faults))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
