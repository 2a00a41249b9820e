# Diffusion of hard spheres: against packing fraction, system size, and the published tests of t_max and of the time between records.

# Of one component 0.15708 ... are the densities 0.3, 0.5, 0.7 and 0.9 of published figures.
DIFFUSION = {
    "smoke": dict(phis={"binary": ["0.10", "0.30"], "mono": ["0.20"]}, records="--records 9000 --lags 3000 --interval 0.005 --trajectories 3", particles=32, large=[], tests=[]),
    "committed": dict(
        phis={"binary": BINARY, "mono": ["0.05", "0.10", "0.15708", "0.20", "0.26180", "0.30", "0.36652", "0.40", "0.45", "0.47124", "0.48"]}, records="--trajectories 3",
        particles=108, large=["0.10", "0.30", "0.40", "0.45"], tests=[("mono", "0.30"), ("binary", "0.30"), ("binary", "0.50")]),
}
DIFFUSION["full"] = dict(DIFFUSION["committed"], records="", large=["0.10", "0.20", "0.30", "0.40", "0.45"], tests=[(kind, phi) for kind, phis in (("mono", MONO), ("binary", BINARY)) for phi in phis])
DIFFUSION = DIFFUSION[SIZE]
# Published parameters (PHYSICS.md, 1.3): time between records and number of lags, below each packing fraction.
PUBLISHED = {
    "mono": [(0.075, 1e-3, 30000), (0.175, 5e-4, 30000), (0.275, 2e-4, 30000), (0.375, 1e-4, 30000), (0.455, 5e-5, 30000), (1, 3e-5, 30000)],
    "binary": [(0.075, 6e-4, 40000), (0.175, 4e-4, 40000), (0.275, 2e-4, 40000), (0.375, 1.5e-4, 40000), (0.495, 1e-4, 40000), (1, 2e-5, 100000)],
}


def diffusing(kind, phi, particles):
    return f"{SPHERES[kind]} --packing-fraction {phi} --particles {particles} --start-method growth --quick {DIFFUSION['records']}"


for kind, phis in DIFFUSION["phis"].items():
    for phi in phis:
        plan.diffusion(f"diffusion/{kind}-{phi}", diffusing(kind, phi, DIFFUSION["particles"]))
for phi in DIFFUSION["large"]:
    plan.diffusion(f"diffusion/mono-{phi}-N500", diffusing("mono", phi, 500))
for kind, phi in DIFFUSION["tests"]:
    interval, lags = next((dt, n) for below, dt, n in PUBLISHED[kind] if float(phi) < below)
    shorter = f"--interval {interval:g} --lags {lags // 2} --records {100000 + lags // 2}"
    coarser = f"--interval {2 * interval:g} --lags {lags // 2} --records {50000 + lags // 2}"
    plan.diffusion(f"diffusion/{kind}-{phi}-shorter", f"{diffusing(kind, phi, 108)} {shorter}")
    plan.diffusion(f"diffusion/{kind}-{phi}-coarser", f"{diffusing(kind, phi, 108)} {coarser}")
