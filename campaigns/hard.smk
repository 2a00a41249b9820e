# Hard spheres: cost of end points, greedy, optimised and true geodesics against packing fraction, size, distance and steps, and the away method.

BINARY = ["0.05", "0.10", "0.20", "0.30", "0.40", "0.45", "0.50", "0.53", "0.55", "0.57"]
MONO = ["0.05", "0.10", "0.20", "0.30", "0.40", "0.45", "0.48"]
HARD = {
    "smoke": dict(
        phis={"binary": ["0.10", "0.30"], "mono": ["0.20"]}, dense={}, pairs=2, few=["0.30"], few_pairs=1, fine_pairs=1, optimised=["0.30"], true=["0.10"], true_pairs={},
        heterogeneity={"0.30": 3}, small_optimised={}, particles=32, distance=10, small_distance=8, sizes=[], largest_size={}, distances=[], away=["0.10"], away_sizes=[32]),
    "committed": dict(
        phis={"binary": BINARY, "mono": MONO}, dense={"0.58": 1}, pairs=5, few=["0.30", "0.50"], few_pairs=3, fine_pairs=2,
        optimised=["0.10", "0.30", "0.50"], true=["0.10", "0.30", "0.50"], true_pairs={"0.30": 2, "0.50": 1},
        heterogeneity={"0.10": 50, "0.20": 50, "0.30": 50, "0.40": 20, "0.50": 10, "0.55": 5}, small_optimised={"0.10": 5, "0.30": 5}, particles=108, distance=108,
        small_distance=90, sizes=[32, 64, 256, 500], largest_size={"0.30": 256, "0.50": 256}, distances=[30, 54, 216], away=["0.10", "0.30"], away_sizes=[32, 108]),
    "full": dict(
        phis={"binary": BINARY[:-1] + ["0.54", "0.56", "0.57"], "mono": MONO}, dense={"0.58": 5, "0.59": 1, "0.597": 1}, pairs=20, few=["0.10", "0.30", "0.50"],
        few_pairs=5, fine_pairs=5, optimised=BINARY[:-1] + ["0.54"], true=BINARY[:7], true_pairs={},
        heterogeneity={phi: 50 for phi in ("0.10", "0.20", "0.30", "0.40", "0.50", "0.55")},
        small_optimised={phi: 5 for phi in ("0.10", "0.20", "0.30", "0.40", "0.50", "0.55")}, particles=108, distance=108, small_distance=90,
        sizes=[32, 64, 256, 500], largest_size={}, distances=[30, 54, 216], away=["0.10", "0.20", "0.30", "0.40"], away_sizes=[32, 64, 108, 256]),
}[SIZE]
SPHERES = {"mono": "--model hard-sphere", "binary": "--model hard-sphere-binary"}


def spheres(kind, phi, particles):
    return f"{SPHERES[kind]} --packing-fraction {phi} --particles {particles} --start-method growth --quick"


def hard_sweep(kind, phi):
    at, model, n = f"hard/{kind}-{phi}", SPHERES[kind], HARD["particles"]
    plan.ends(f"{at}-ends", spheres(kind, phi, n) + f" --distance {HARD['distance']}", HARD["pairs"])
    plan.paths(f"{at}-avoidance", f"{at}-ends", model, HARD["pairs"])
    plan.paths(f"{at}-slide", f"{at}-ends", f"{model} --adaptive", HARD["pairs"])
    some = min(HARD["pairs"], HARD["few_pairs"])
    if phi in HARD["optimised"]:
        plan.shortened(f"{at}-optimised", f"{at}-ends", f"{model} --method montecarlo", some)
    if kind == "binary" and phi in HARD["true"]:
        plan.shortened(f"{at}-true", f"{at}-ends", f"{model} --method curve --adaptive", HARD["true_pairs"].get(phi, some))


def steps_and_potentials(phi):
    """[G] 4.10: lengths of steps and the two fictitious potentials, on the same pairs."""
    at, model = f"hard/binary-{phi}", SPHERES["binary"]
    for label, option, pairs in (
        ("linear", "--fictitious linear", "pairs"), ("cubic", "--fictitious cubic", "pairs"), ("direct0.1", "--step 0.1", "pairs"),
        ("direct0.001", "--step 0.001", "few_pairs"), ("avoid0.001", "--avoidance-step 0.001", "pairs"), ("avoid0.00001", "--avoidance-step 0.00001", "fine_pairs")):
        plan.paths(f"{at}-{label}", f"{at}-ends", f"{model} {option}", HARD[pairs])


def hard_sizes_and_distances(phi):
    """Steps of one length whatever N is, as published, and steps that grow with sqrt(N) as the distance between ends does."""
    model = SPHERES["binary"]
    for n in HARD["sizes"]:
        if n > HARD["largest_size"].get(phi, n):
            continue
        at, pairs = f"hard/binary-{phi}-N{n}", 5 if n < 256 else 3 if phi < "0.50" else 2
        plan.ends(f"{at}-ends", spheres("binary", phi, n), pairs)
        plan.paths(f"{at}-avoidance", f"{at}-ends", model, pairs)
        plan.paths(f"{at}-scaled", f"{at}-ends", f"{model} --step {0.01 * (n / 108) ** 0.5:.5f}", pairs)
        plan.paths(f"{at}-slide", f"{at}-ends", f"{model} --adaptive", pairs)
        if n == 64 and phi <= "0.30":
            plan.shortened(f"{at}-true", f"{at}-ends", f"{model} --method curve --adaptive", 2)
    for distance in HARD["distances"]:
        at = f"hard/binary-{phi}-R{distance}"
        plan.ends(f"{at}-ends", spheres("binary", phi, HARD["particles"]) + f" --distance {distance}", HARD["few_pairs"])
        plan.paths(f"{at}-avoidance", f"{at}-ends", model, HARD["few_pairs"])


def away(phi, n):
    at = f"hard/away-{phi}-N{n}"
    plan.ends(f"{at}-ends", spheres("binary", phi, n) + (f" --distance {HARD['distance']}" if n == HARD["particles"] else ""), 3, seed=3)
    plan.paths(f"{at}-away", f"{at}-ends", f"{SPHERES['binary']} --method away", 3)
    plan.paths(f"{at}-avoidance", f"{at}-ends", SPHERES["binary"], 3)


for kind, phis in HARD["phis"].items():
    for phi in phis:
        hard_sweep(kind, phi)
for phi in HARD["few"]:
    steps_and_potentials(phi)
    hard_sizes_and_distances(phi)
for phi, pairs in HARD["heterogeneity"].items():
    at = f"hard/small-{phi}"
    plan.ends(f"{at}-ends", spheres("binary", phi, HARD["particles"]) + f" --distance {HARD['small_distance']} --distance-species Ar", pairs)
    plan.paths(f"{at}-avoidance", f"{at}-ends", SPHERES["binary"], pairs)
    plan.shortened(f"{at}-optimised", f"{at}-ends", f"{SPHERES['binary']} --method montecarlo", HARD["small_optimised"].get(phi, 0))
for phi in HARD["away"]:
    for n in HARD["away_sizes"]:
        away(phi, n)
for phi, pairs in HARD["dense"].items():
    plan.ends(f"hard/binary-{phi}-ends", spheres("binary", phi, HARD["particles"]) + f" --distance {HARD['distance']}", pairs)
    if phi == "0.58":
        plan.paths(f"hard/binary-{phi}-avoidance", f"hard/binary-{phi}-ends", SPHERES["binary"], pairs)
