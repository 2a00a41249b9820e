#!/usr/bin/python3
"""Keeps what a campaign found, for the tables of docs/VALIDATION.md: keep.py PROGRAM OUT CHAPTER [...].

Copies the tables of OUT/CHAPTER/analysis to data/CHAPTER beside this, with numbers of six digits and without what no table shows, and what made them."""

import csv
import datetime
import json
import subprocess
import sys
from pathlib import Path

from data import FILES, KEPT, rows

# Of means.csv only what tables show: the beginnings of names.
QUANTITIES = ("ratio_squared", "participation_ratio", "direct_", "detour_", "evaluations", "seconds", "overlapping_partners", "moved_share", "groups_share",
              "group_size", "trials_per_detour", "heterogeneity", "shorter_by", "kuhn_tucker", "collisions", "steps", "compressibility", "diffusion_",
              "displacement_exponent", "temperature")


def shorter(text):
    try:
        return f"{float(text):.6g}" if text else text
    except ValueError:
        return text


def few_particle_steps(source):
    """Of distributions those of n/N up to five particles: all of them would be megabytes."""
    particles = {group["group"]: float(group["particles"]) for group in rows(source.parent / "groups.csv")}
    return [row for row in rows(source) if row["quantity"] == "participation_ratio" and float(row["value"]) * particles[row["group"]] < 5.5]


def keep_table(source, target):
    table = few_particle_steps(source) if source.name == "distributions.csv" else rows(source)
    if source.name == "means.csv":
        table = [row for row in table if row["quantity"].startswith(QUANTITIES)]
    if not table:
        return
    with open(target, "w", newline="", encoding="utf-8") as text:
        out = csv.writer(text, lineterminator="\n")
        out.writerow(table[0].keys())
        out.writerows([shorter(value) for value in row.values()] for row in table)


def core_hours(folder):
    """Computing time of the runs of a chapter."""
    results = [json.loads(file.read_text(encoding="utf-8")) for file in folder.glob("*/result.json")]
    return sum(result.get("seconds") or sum(path["seconds"] for path in result.get("paths", [])) for result in results) / 3600.0


def keep(program, out, chapter, size):
    analysis, kept = out / chapter / "analysis", KEPT / chapter
    kept.mkdir(parents=True, exist_ok=True)
    for name in FILES:
        if (analysis / name).exists():
            keep_table(analysis / name, kept / name)
    info = json.loads(subprocess.run([program, "info"], check=True, capture_output=True, text=True).stdout)
    provenance = {"command": f"snakemake -s campaigns/Snakefile {chapter} --config size={size}", "version": info["version"], "isa": info["isa"],
                  "cpu": info["cpu"], "compiler": info["compiler"], "date": datetime.date.today().isoformat(), "core_hours": round(core_hours(out / chapter), 2)}
    (kept / "provenance.json").write_text(json.dumps(provenance, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) < 5:
        sys.exit(__doc__)
    for name in sys.argv[4:]:
        keep(sys.argv[1], Path(sys.argv[2]), name, sys.argv[3])
