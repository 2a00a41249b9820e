#!/usr/bin/python3
"""Times whole steps of LAMMPS with the library's pair potentials and with lj/cut/opt, in turn, at the same state.

lammps_styles.py --plugin lanescapeplugin.so [--lammps LMP]     the plugin, in units lj
lammps_styles.py --kim Lanescape_lj [--lammps LMP]              a KIM model of Lennard-Jones argon (epsilon 0.0104 eV, sigma 3.4, plain), units metal

Every run starts from the same shaken lattice, whose potential energies and pressures are compared; it has melted when the timed half begins. docs/HOSTS.md says how
plugin and model are built.
"""

import argparse
import re
import statistics
import subprocess
import sys

AGREEMENT = 1e-10


def script(arguments, style):
    sigma, epsilon, mass, temperature = (1.0, 1.0, 1.0, 1.44) if arguments.plugin else (3.4, 0.0104, 39.948, 173.0)
    scale = 0.8442 if arguments.plugin else (4.0 / 0.8442) ** (1 / 3) * sigma  # units lj take the density
    cells = round((arguments.particles / 4) ** (1 / 3))
    own = f"pair_style lj/cut/opt {2.5 * sigma!r}\npair_coeff 1 1 {epsilon!r} {sigma!r} {2.5 * sigma!r}"
    plugin = f"plugin load {arguments.plugin}\npair_style lanescape lennard-jones truncation plain\npair_coeff * * Ar"
    kim = f"pair_style kim {arguments.kim}\npair_coeff * * Ar"
    return f"""newton on
units {"lj" if arguments.plugin else "metal"}
lattice custom {scale!r} a1 1 0 0 a2 0 1 0 a3 0 0 1 basis 0 0 0 basis 0 0.5 0.5 basis 0.5 0 0.5 basis 0.5 0.5 0
region box block 0 {cells} 0 {cells} 0 {cells}
create_box 1 box
create_atoms 1 box
mass 1 {mass}
displace_atoms all random {0.05 * sigma!r} {0.05 * sigma!r} {0.05 * sigma!r} 1 units box
velocity all create {temperature} 87287 loop geom
{own if style == "lj/cut/opt" else plugin if arguments.plugin else kim}
neighbor {0.3 * sigma!r} bin
neigh_modify delay 0 {arguments.neigh}
timestep {0.005 if arguments.plugin else 0.0107}
fix 1 all nve
thermo_style custom step pe press
thermo_modify format float %.15g
thermo {arguments.steps}
run {arguments.steps}
run {arguments.steps}
"""


def run(arguments, style):
    """(seconds per step, potential energy and pressure at the start)."""
    done = subprocess.run([*arguments.before, arguments.lammps, "-in", "/dev/stdin", "-log", "none"], input=script(arguments, style), capture_output=True, text=True)
    times = list(re.finditer(r"Loop time of (\S+)", done.stdout))
    if done.returncode != 0 or len(times) != 2:
        sys.exit(f"lammps_styles.py: {style}: {next((line for line in done.stdout.splitlines() if 'ERROR' in line), done.stderr.strip())}")
    first = next(line.split() for line in done.stdout.splitlines() if re.match(r" *0 +-?[0-9.]+ +-?[0-9.]+ *$", line))
    return float(times[1].group(1)) / arguments.steps, [float(word) for word in first[1:3]]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    kind = parser.add_mutually_exclusive_group(required=True)
    kind.add_argument("--plugin", metavar="FILE")
    kind.add_argument("--kim", metavar="MODEL")
    parser.add_argument("--lammps", default="lmp", metavar="LMP")
    parser.add_argument("--before", default=[], type=str.split, metavar="WORDS", help='before the command, such as "mpirun -np 2"')
    parser.add_argument("--neigh", default="every 20 check no", help="when LAMMPS renews its lists [every 20 check no, as in its own benchmark]")
    parser.add_argument("--particles", type=int, default=32_000)
    parser.add_argument("--steps", type=int, default=200)
    parser.add_argument("--turns", type=int, default=3)
    arguments = parser.parse_args()
    mine = "lanescape" if arguments.plugin else "kim"
    ratios = []
    for turn in range(arguments.turns):
        (peer, expected), (own, found) = run(arguments, "lj/cut/opt"), run(arguments, mine)
        if any(abs(a - b) > AGREEMENT * abs(b) for a, b in zip(found, expected)):
            sys.exit(f"lammps_styles.py: energy and pressure {found} differ from {expected}")
        ratios.append(own / peer)
        print(f"turn {turn + 1}: lj/cut/opt {1e3 * peer:.2f} ms, {mine} {1e3 * own:.2f} ms per step: {ratios[-1]:.3f}")
    print(f"median ratio {statistics.median(ratios):.3f}, N = {arguments.particles}")


if __name__ == "__main__":
    main()
