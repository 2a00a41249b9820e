"""Sites whose states follow their surroundings (ultra-coarse-graining)."""

# %% Energy and probabilities
import lanescape

model = lanescape.Model.named("ucg")
start = lanescape.make_start(model, particles=108, density=0.5)
system = lanescape.StateSystem(model, start.species, start.box)
found = system.evaluate(start.positions, stress=True)
print("U =", found.energy)
print("probability of the first state:", system.probabilities()[:, 0].mean())

# %% It is a landscape
dynamics = lanescape.MolecularDynamics(system, start.positions, time_step=0.002)
dynamics.draw_velocities(temperature=1.0)
dynamics.run(200)
print("T =", dynamics.temperature)
