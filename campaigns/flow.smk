# Open flows against the equation of state: the part of docs/VALIDATION.md on flow.
#
#   snakemake -s campaigns/flow.smk --cores 2 --config program=build/release/lanescape out=out/validation-flow
#
# About half an hour of one core. Interrupted, it goes on where it was.

PROGRAM = config.get("program", "build/release/lanescape")
OUT = config.get("out", "out/validation-flow")
REPORT = f"{workflow.basedir}/flow_report.py"

DENSITIES, SEEDS = ("0.5", "0.7"), range(1, 17)
IMPEDANCE = {"0.5": 2.06, "0.7": 4.40}  # density times sound velocity
COMMON = "--quiet --threads 1 --cutoff 3 --temperature 2.5"

rule all:
    input:
        f"{OUT}/flow.md",
        f"{OUT}/coupled/wave.png",

rule front:
    output:
        f"{OUT}/front-{{density}}-{{seed}}/result.json",
    params:
        impedance=lambda w: IMPEDANCE[w.density],
    shell:
        "{PROGRAM} flow {COMMON} --density {wildcards.density} --length 100 --width 20 --velocity 0.4 --impedance {params.impedance} "
        "--equilibration-steps 2500 --resting-steps 5000 --flow-steps 6500 --sampling-steps 500 --row-steps 100 --seed {wildcards.seed} "
        "--resume-or-start {OUT}/front-{wildcards.density}-{wildcards.seed} > /dev/null"

rule long:
    output:
        f"{OUT}/long-{{density}}/result.json",
    params:
        impedance=lambda w: IMPEDANCE[w.density],
    shell:
        "{PROGRAM} flow {COMMON} --density {wildcards.density} --length 60 --width 12 --velocity 0.3 --impedance {params.impedance} "
        "--resting-steps 10000 --flow-steps 200000 --sampling-steps 100000 --row-steps 500 --seed 2 "
        "--resume-or-start {OUT}/long-{wildcards.density} > /dev/null"

rule coupled:
    output:
        f"{OUT}/coupled/wave.png",
    shell:
        "{PROGRAM} flow {COMMON} --outside continuum --density 0.5 --length 60 --width 20 --impedance 2.06 --resting-steps 5000 "
        "--flow-steps 12500 --sampling-steps 5000 --cells 50 --cell-width 2 --pulse-amplitude 0.1 --pulse-centre -30 --pulse-width 8 "
        "--resume-or-start {OUT}/coupled --plot > /dev/null"

rule report:
    input:
        expand(f"{OUT}/front-{{density}}-{{seed}}/result.json", density=DENSITIES, seed=SEEDS),
        expand(f"{OUT}/long-{{density}}/result.json", density=DENSITIES),
    output:
        f"{OUT}/flow.md",
    shell:
        "/usr/bin/python3 {REPORT} {OUT} > {output}"
