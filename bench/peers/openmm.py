#!/usr/bin/env python3
"""OpenMM's CPU platform and bench_lists side by side on the same liquid: bench/peers/openmm.py [--json FILE]

The Lennard-Jones liquid near its triple point (systems.py), cutoff 2.5 sigma. OpenMM melts a lattice unless a driver has left the
configuration in --folder. Then
  1. potential energies are compared. The platform evaluates pairs in single precision: it must agree with `lanescape energy` to 1e-6, and to
     nothing worse after forces have been computed on any number of threads. Else nothing is timed (exit status 1);
  2. whole steps are timed in turn, --repetitions times: OpenMM's leapfrog without thermostat, and the benchmarks `step` and `step-mixed` of
     bench_lists, at the same time step of 0.005. The potential of OpenMM is cut and not shifted, as the forces of ours are.
Times are those of the clock, per particle and step. OpenMM chooses its own skin.

It needs a Python with the package openmm, for example of a virtual environment; without it the report says so.
Exit status: 0; 1 if energies disagree, a program fails (the last line on stderr says why) or there is no OpenMM; 2 for wrong usage.
"""

import datetime
import json
import os
import statistics
import sys
import time
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
ROOT = FOLDER.parents[1]
sys.path[:] = [entry for entry in sys.path if Path(entry or ".").resolve() != FOLDER]  # or this file would be imported as `openmm`
try:
    import openmm
except ImportError as error:
    openmm, WHY_MISSING = None, str(error)
sys.path[:0] = [str(FOLDER), str(ROOT / "tools")]

import numpy as np  # noqa: E402

from benchmark_results import Arguments  # noqa: E402
from ours import Bench, Failed, energy_and_virial  # noqa: E402
from peer_options import add_options, check_options, check_work  # noqa: E402
from peer_tables import print_rows  # noqa: E402
from systems import CUTOFF, LIQUIDS, Configuration, check_melted, kept_configuration, lattice, wrapped  # noqa: E402

TOLERANCE = 1e-6  # relative, of the energy: pairs are in single precision; it agrees to about 1e-8
TIMESTEP = 0.005  # that of bench_lists
MELT_TIMESTEP, HOT_STEPS, COLD_STEPS = 0.004, 500, 1000
KELVIN = 1.0 / 0.00831446261815324  # a reduced temperature of 1: OpenMM's k_B is in kJ/(mol K)
LIQUID = LIQUIDS["lennard-jones"]


class Simulation:
    """The liquid on OpenMM's CPU platform. Reduced units: nm, amu, ps and kJ/mol are 1 sigma, mass, time and epsilon."""

    def __init__(self, configuration, threads, integrator=None):
        system, force = openmm.System(), openmm.NonbondedForce()
        system.setDefaultPeriodicBoxVectors(*(configuration.edge * np.eye(3)))
        for _ in range(len(configuration)):
            system.addParticle(1.0)
            force.addParticle(0.0, 1.0, 1.0)
        force.setNonbondedMethod(openmm.NonbondedForce.CutoffPeriodic)
        force.setCutoffDistance(CUTOFF)
        force.setUseDispersionCorrection(False)
        system.addForce(force)
        self.integrator = integrator or openmm.VerletIntegrator(TIMESTEP)
        platform = openmm.Platform.getPlatformByName("CPU")
        self.context = openmm.Context(system, self.integrator, platform, {"Threads": str(threads)})
        self.context.setPositions(configuration.positions)

    def energy(self):
        return self.context.getState(getEnergy=True).getPotentialEnergy()._value

    def positions(self):
        return self.context.getState(getPositions=True).getPositions(asNumpy=True)._value

    def time(self, steps, seed):
        """Nanoseconds of the clock per particle and step, after as many steps as bring lists and threads under way."""
        self.context.setVelocitiesToTemperature(LIQUID.temperature * KELVIN, seed)
        self.integrator.step(max(10, steps // 10))
        begin = time.perf_counter()
        self.integrator.step(steps)
        return 1e9 * (time.perf_counter() - begin) / (steps * self.context.getSystem().getNumParticles())


def melt(particles, seed, threads):
    """A liquid: OpenMM melts a lattice and brings it to the temperature. Raises Failed if it is still a lattice."""
    start = lattice(LIQUID, particles, seed)
    bath = openmm.LangevinMiddleIntegrator(LIQUID.melting_temperature * KELVIN, 2.0, MELT_TIMESTEP)
    bath.setRandomNumberSeed(seed)
    simulation = Simulation(start, threads, bath)
    simulation.context.setVelocitiesToTemperature(LIQUID.melting_temperature * KELVIN, seed)
    bath.step(HOT_STEPS)
    bath.setTemperature(LIQUID.temperature * KELVIN)
    bath.step(COLD_STEPS)
    melted = Configuration(LIQUID, start.edge, start.species, wrapped(simulation.positions(), start.edge))
    check_melted(melted, particles, "OpenMM")
    return melted


def check_energies(options, file, configuration):
    """OpenMM on every number of threads against `lanescape energy`."""
    expected, _ = energy_and_virial(options.lanescape, file, LIQUID, CUTOFF, truncation="plain")
    rows = []
    for threads in options.threads:
        found = Simulation(configuration, threads).energy()
        difference = abs(found - expected) / abs(expected)
        rows.append({"model": LIQUID.model, "particles": len(configuration), "peer": f"OpenMM CPU, {threads} threads", "energy": expected,
                     "peer_energy": found, "relative_difference": difference})
        if not difference <= TOLERANCE:
            raise Failed(f"N = {len(configuration)}: energies disagree: OpenMM on {threads} threads {found!r}, lanescape {expected!r}, "
                         f"relative difference {difference:.2g}, allowed is {TOLERANCE:g}; nothing was timed")
    return rows


def time_all(options, file, configuration, missing):
    """Samples by (code, variant, threads), all codes in turn."""
    particles = len(configuration)
    bench = Bench(options.bench, file, LIQUID, particles, ("step", "step-mixed"), options.threads, options.isa)
    missing += [{"what": f"bench_lists {case}, {count} threads", "why": f"no such benchmark for N = {particles}, {bench.isa}"}
                for case, count in bench.missing]
    steps, samples = max(20, round(options.work / particles)), {}
    for repetition in range(options.repetitions):
        say(f"N = {particles}: timing, {repetition + 1} of {options.repetitions}")
        for (case, count), nanoseconds in bench.measure().items():
            variant = f"{bench.isa}, mixed" if case == "step-mixed" else bench.isa
            samples.setdefault(("lanescape", variant, count), []).append(nanoseconds)
        for count in options.threads:
            simulation = Simulation(configuration, count)
            samples.setdefault(("OpenMM", "CPU", count), []).append(simulation.time(steps, options.seed))
    return samples, bench.isa


def rows_of(samples, isa, particles):
    """Medians as rows of the results; ratios are to ours in double precision."""
    rows = []
    for (code, variant, threads), times in sorted(samples.items(), key=lambda item: (item[0][2], item[0][0] != "lanescape", item[0][1])):
        own = samples.get(("lanescape", isa, threads))
        median = statistics.median(times)
        rows.append({"model": LIQUID.model, "particles": particles, "case": "step", "threads": threads, "code": code, "variant": variant,
                     "ns_per_particle": median, "ratio": median / statistics.median(own) if own else None, "samples": times})
    return rows


def run(options, report):
    for particles in options.sizes:
        def made(particles=particles):
            say(f"N = {particles}: melting")
            return melt(particles, options.seed, max(options.threads))
        file, configuration = kept_configuration(options.folder, LIQUID, particles, options.seed, made)
        say(f"N = {particles}: energies")
        report["energies"] += check_energies(options, file, configuration)
        samples, isa = time_all(options, file, configuration, report["missing"])
        report["results"] += rows_of(samples, isa, particles)


def say(text):
    print(text, file=sys.stderr, flush=True)


def parse(arguments):
    parser = Arguments(prog="openmm.py", description="OpenMM's CPU platform and bench_lists side by side; the head of this file describes it.")
    parser.add_argument("--sizes", nargs="+", type=int, default=(32000,), metavar="N", help="particles [32000]")
    parser.add_argument("--work", type=float, default=6.4e6, help="particles times steps of one timing [6.4e6]")
    add_options(parser, repetitions=3)
    options = parser.parse_args(arguments)
    check_options(parser, options, 256)
    check_work(parser, options)
    return options


def main(arguments):
    options = parse(arguments)
    options.bench, options.lanescape, options.folder = (path.absolute() for path in (options.bench, options.lanescape, options.folder))
    report = {"context": {"date": datetime.datetime.now().astimezone().isoformat(timespec="seconds"), "load_average": os.getloadavg()[0],
                          "cutoff": CUTOFF, "timestep": TIMESTEP, "tolerance": TOLERANCE, "repetitions": options.repetitions,
                          "openmm": openmm.__version__ if openmm else None}, "missing": [], "energies": [], "results": []}
    try:
        options.folder.mkdir(parents=True, exist_ok=True)
        if openmm:
            run(options, report)
        else:
            report["missing"].append({"what": "OpenMM", "why": WHY_MISSING})
        if options.json:
            options.json.write_text(json.dumps(report, indent=2) + "\n")
    except (Failed, OSError, *((openmm.OpenMMException,) if openmm else ())) as error:
        print(f"openmm.py: {error}", file=sys.stderr)
        return 1
    print(f"OpenMM {report['context']['openmm'] or 'missing'}; nanoseconds of the clock per particle and step, medians of "
          f"{options.repetitions}; ratio: to lanescape in double precision")
    print_rows(report)
    return 0 if openmm else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
