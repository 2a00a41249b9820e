# Geodesics and diffusion of hard spheres against [G]'s figures: the hard-sphere part of docs/VALIDATION.md.
#
#   snakemake -s tools/validation/hard_spheres.smk --cores 2 --config program=build/release/lanescape out=out/validation-hard
#
# About half an hour of one core. Interrupted, it goes on where it was.

import os
import sys

PROGRAM = config.get("program", "build/release/lanescape")
OUT = config.get("out", "out/validation-hard")
REPORT = workflow.source_path("hard_report.py")
sys.path.insert(0, os.path.dirname(REPORT))
from hard_report import DIFFUSION, PAIRS, PATHS, POTENTIALS

MODELS = {"mono": "hard-sphere", "binary": "hard-sphere-binary"}


rule all:
    input:
        f"{OUT}/hard-spheres.md",


rule endpoints:
    output:
        f"{OUT}/ends-{{kind}}-{{phi}}/result.json",
    params:
        model=lambda w: MODELS[w.kind],
    shell:
        "rm -rf {OUT}/ends-{wildcards.kind}-{wildcards.phi} && "
        "{PROGRAM} endpoints --quiet --model {params.model} --packing-fraction {wildcards.phi} --start-method growth "
        "--pairs {PAIRS} --seed 1 --out {OUT}/ends-{wildcards.kind}-{wildcards.phi} > /dev/null"


rule paths:
    input:
        f"{OUT}/ends-{{kind}}-{{phi}}/result.json",
    output:
        f"{OUT}/paths-{{kind}}-{{phi}}-{{potential}}.json",
    params:
        model=lambda w: MODELS[w.kind],
        files=lambda w: [f"{OUT}/ends-{w.kind}-{w.phi}/pair-{k + 1:04}.extxyz" for k in range(PAIRS)],
    shell:
        "{PROGRAM} path --quiet --threads 1 --model {params.model} --fictitious {wildcards.potential} --frames 20 "
        "--pair {params.files} > {output}.part && mv {output}.part {output}"


rule diffusion:
    output:
        f"{OUT}/diffusion-{{kind}}-{{phi}}.json",
    params:
        model=lambda w: MODELS[w.kind],
    shell:
        "{PROGRAM} diffusion --quiet --model {params.model} --packing-fraction {wildcards.phi} --start-method growth "
        "--seed 2 > {output}.part && mv {output}.part {output}"


rule report:
    input:
        [f"{OUT}/paths-{kind}-{phi}-harmonic.json" for kind in PATHS for phi in PATHS[kind]],
        [f"{OUT}/paths-binary-{phi}-{potential}.json" for phi in POTENTIALS for potential in ("linear", "cubic")],
        [f"{OUT}/diffusion-{kind}-{phi}.json" for kind in DIFFUSION for phi in DIFFUSION[kind]],
    output:
        f"{OUT}/hard-spheres.md",
    shell:
        "/usr/bin/python3 {REPORT} {OUT} > {output}"
