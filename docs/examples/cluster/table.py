#!/usr/bin/env python3
"""A row of a table (CSV) for each result of lanescape path, and the mean of (DeltaR/g)^2 at each temperature on stderr.

table.py campaign/path-T1-0001/result.json ... > campaign/paths.csv
"""

import csv
import json
import re
import statistics
import sys

COLUMNS = ("outcome", "length", "distance", "ratio_squared", "participation_ratio", "evaluations", "seconds", "landscape_energy")


def main():
    table = csv.writer(sys.stdout)
    table.writerow(("temperature", "pair", *COLUMNS))
    ratios = {}
    for name in sys.argv[1:]:
        temperature, pair = re.search(r"path-T([^/]+)-(\d+)/result\.json$", name).groups()
        with open(name, encoding="utf-8") as file:
            path = json.load(file)["paths"][0]
        table.writerow((temperature, int(pair), *(path[column] for column in COLUMNS)))
        if path["outcome"] == "reached":
            ratios.setdefault(temperature, []).append(path["ratio_squared"])
    for temperature, values in ratios.items():
        print(f"T = {temperature}: mean (DeltaR/g)^2 {statistics.mean(values):.4f} of {len(values)} paths", file=sys.stderr)


if __name__ == "__main__":
    main()
