"""The i-PI protocol: a model served to a driver of ASE's, and a client as a landscape."""

# %% A driver, and a model that is served to it by another process
import os
import subprocess
import sys

import numpy as np

import lanescape
from lanescape.ipi import SocketLandscape

model = lanescape.Model.named("kob-andersen")
start = lanescape.make_start(model, particles=108, density=1.2)
name = f"example-{os.getpid()}"
species = ",".join(str(s) for s in start.species)

with SocketLandscape(start.box, unixsocket=name, units="atomic") as landscape:
    client = subprocess.Popen([sys.executable, "-m", "lanescape.ipi", "--unixsocket", name, "--model", "kob-andersen", "--units", "atomic",
                               "--species", species, "--quiet"])
    energy, gradient = landscape.energy_and_gradient(start.positions)
    print("V =", energy)

    # %% Any client is a landscape: a path over it
    path = lanescape.find_path(landscape, start.positions, start.positions + 0.01, landscape_energy=energy + 1.0)
    print(path.outcome, "after", landscape.evaluations, "evaluations")

assert client.wait(timeout=10) == 0  # EXIT was sent
expected = lanescape.Potential(model, start.species, start.box).energy(start.positions)
assert np.isclose(energy, expected, rtol=1e-14)
