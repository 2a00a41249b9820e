# Kob-Andersen and Lennard-Jones liquids: diffusion beside greedy, optimised and true geodesics, and what the figures of [C] and [G] vary.

# KA at density 1.2, LJ at 0.8, where it stays a liquid down to T = 0.7. t_max of diffusion: the mean squared displacement comes to 1 and more.
KOB_ANDERSEN = {5: 8, 4: 8, 3: 10, 2: 15, 1.5: 20, 1: 50, 0.8: 120, 0.7: 240, 0.6: 600, 0.5: 3000}
LENNARD_JONES = {5: 20, 4: 20, 3: 20, 2: 20, 1.5: 20, 1: 20, 0.8: 20, 0.7: 20}
SOFT = {
    "smoke": dict(
        systems={"ka": {5: 2, 2: 2}, "lj": {3: 2, 1.5: 2}}, few=[5], pairs=2, cold_pairs={}, cold_shortened={}, shortened=1, starts=1, fine=1, particles=32,
        distance=10, equilibration="--quick --melt-steps 2000 --cooling-steps 2000 --check-steps 2000 --check-tolerance 1 --settle-steps 1000",
        lags=50, between=1000, sizes=[], distances=[]),
    "committed": dict(
        systems={"ka": KOB_ANDERSEN, "lj": {t: LENNARD_JONES[t] for t in (5, 3, 2, 1, 0.7)}}, few=[5, 1], pairs=10, shortened=3,
        cold_pairs={("ka", 0.8): 6, ("ka", 0.7): 6, ("ka", 0.6): 3, ("ka", 0.5): 2, ("lj", 0.7): 2},
        cold_shortened={("ka", 0.8): 2, ("ka", 0.7): 2, ("ka", 0.6): 2, ("ka", 0.5): 0, ("lj", 0.7): 2}, starts=5, fine=1, particles=108,
        distance=108, equilibration="", lags=500, between=100000, sizes=[32, 64, 256], distances=[30, 54, 216]),
    "full": dict(
        systems={"ka": {**KOB_ANDERSEN, 0.45: 12000}, "lj": LENNARD_JONES}, few=[5, 4, 3, 2, 1], pairs=20, cold_pairs={}, cold_shortened={}, shortened=5, starts=20,
        fine=5, particles=108, distance=108, equilibration="", lags=500, between=100000, sizes=[32, 64, 256, 500], distances=[30, 54, 216]),
}[SIZE]
MODELS = {"ka": "--model kob-andersen --density 1.2", "lj": "--model lennard-jones --density 0.8"}
COLD = 0.8  # from here downwards a time step of 0.004 serves


def time_step(t):
    return "--time-step 0.004" if t <= COLD else ""


def liquid(system, t, particles):
    return f"{MODELS[system]} --temperature {t} --particles {particles} {time_step(t)}"


def soft_sweep(system, t, longest):
    """One state point: diffusion, greedy paths of both kinds of steps, optimised ones and true geodesics."""
    n, at = SOFT["particles"], f"soft/{system}-T{t}"
    pairs = SOFT["cold_pairs"].get((system, t), SOFT["pairs"])
    state = liquid(system, t, n) + " " + (SOFT["equilibration"] or ("--quick" if system == "lj" else ""))
    model = MODELS[system].split(" --density")[0]
    lags, between = SOFT["lags"], SOFT["between"]
    plan.diffusion(f"{at}-diffusion", f"{state} --interval {longest / lags:g} --lags {lags} --records {11 * lags} --between {between}")
    plan.ends(f"{at}-ends", f"{state} --distance {SOFT['distance']} --between-steps {between}", pairs)
    plan.paths(f"{at}-adaptive", f"{at}-ends", f"{model} --adaptive", pairs)
    if system == "ka" and t in SOFT["few"]:
        plan.paths(f"{at}-faithful", f"{at}-ends", model, min(pairs, 5))
    some = SOFT["cold_shortened"].get((system, t), min(pairs, SOFT["shortened"]))
    plan.shortened(f"{at}-optimised", f"{at}-ends", f"{model} --method montecarlo --adaptive --starts {SOFT['starts']}", some)
    plan.shortened(f"{at}-true", f"{at}-ends", f"{model} --method curve --adaptive", some)


def minimum_image(t):
    """What [C] compares, with the minimum image that the sources use: contour and escape steps, and lengths of steps."""
    at, minimum = f"soft/minimum-T{t}", "--model kob-andersen --images minimum"
    some = min(5, SOFT["pairs"])
    plan.ends(f"{at}-ends", liquid("ka", t, SOFT["particles"]) + f" --images minimum --quick --distance {SOFT['distance']}", some)
    plan.paths(f"{at}-contour", f"{at}-ends", minimum, some)
    plan.paths(f"{at}-escape", f"{at}-ends", f"{minimum} --method escape", some)
    plan.paths(f"{at}-step0.01", f"{at}-ends", f"{minimum} --step 0.01", some)
    plan.paths(f"{at}-step0.0001", f"{at}-ends", f"{minimum} --step 0.0001", SOFT["fine"])


def sizes_and_distances(t):
    for n in SOFT["sizes"]:
        at = f"soft/ka-T{t}-N{n}"
        pairs = 5 if n < 256 else 3
        plan.ends(f"{at}-ends", liquid("ka", t, n) + " --quick", pairs)
        plan.paths(f"{at}-adaptive", f"{at}-ends", "--model kob-andersen --adaptive", pairs)
        if n < 256:
            plan.shortened(f"{at}-true", f"{at}-ends", "--model kob-andersen --method curve --adaptive", 2)
    for distance in SOFT["distances"]:
        at = f"soft/ka-T{t}-R{distance}"
        plan.ends(f"{at}-ends", liquid("ka", t, SOFT["particles"]) + f" --quick --distance {distance}", 5)
        plan.paths(f"{at}-adaptive", f"{at}-ends", "--model kob-andersen --adaptive", 5)


for system, temperatures in SOFT["systems"].items():
    for temperature, longest in temperatures.items():
        soft_sweep(system, temperature, longest)
for temperature in SOFT["few"]:
    minimum_image(temperature)
for temperature in [1] if SOFT["sizes"] else []:
    sizes_and_distances(temperature)
