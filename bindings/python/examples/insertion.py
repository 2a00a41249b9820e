"""Insertion of particles at a prescribed energy (USHER)."""

# %% A fluid
import lanescape

model = lanescape.Model.named("lennard-jones")
start = lanescape.make_start(model, particles=108, density=0.5)
dynamics = lanescape.MolecularDynamics(lanescape.Potential(model, start.species, start.box), start.positions, time_step=0.002)
dynamics.draw_velocities(temperature=2.0)
dynamics.run(500)

# %% Independent searches
inserter = lanescape.Inserter(model, None, dynamics.positions, start.box)
found = inserter.find(energy=-3.0, count=10, tolerance=0.01)
print(sum(one.found for one in found), "of 10 found,", sum(one.evaluations for one in found) / 10, "evaluations each")

# %% Particles inserted one after the other become part of the fluid
inserter.insert(energy=-3.0, count=3)
print(inserter.particles, "particles")

# %% The energy of one more particle on a line through the fluid
print(inserter.energies([[x, 0.0, 0.0] for x in (0.0, 0.5, 1.0)]))
