"""What `lanescape analyze` found in the runs of a chapter, from the small files that are kept beside this: data/CHAPTER/."""

import csv
import json
from pathlib import Path
from typing import NamedTuple

KEPT = Path(__file__).resolve().parent / "data"
FILES = ("groups.csv", "means.csv", "distributions.csv", "scaling.csv", "fits.csv")


class Mean(NamedTuple):
    value: float
    error: float  # None where there is one value only
    count: int


def rows(file):
    with open(file, newline="", encoding="utf-8") as text:
        return list(csv.DictReader(text))


def same(group, name, wanted):
    """Numbers are compared as numbers, distances as roughly as pairs end beyond the distance asked for; None is a setting that a group does not have."""
    setting = group[name]
    if wanted is None:
        return setting == ""
    try:
        return abs(float(setting) - float(wanted)) <= (0.02 if name == "distance" else 1e-6) * abs(float(wanted))
    except ValueError:
        return setting == str(wanted)


class Chapter:
    def __init__(self, name, folder=KEPT):
        self.name, self.folder = name, Path(folder) / name
        self.groups = rows(self.folder / "groups.csv")
        self.means = {(row["group"], row["quantity"]): row for row in rows(self.folder / "means.csv")}
        self.provenance = json.loads((self.folder / "provenance.json").read_text(encoding="utf-8"))

    def table(self, file):
        return rows(self.folder / file) if (self.folder / file).exists() else []

    def probability(self, quantity, value, **settings):
        """That of one value of a quantity over the steps of a group's paths; None without the group."""
        group = self.group(**settings)
        if group is None:
            return None
        found = [float(row["probability"]) for row in self.table("distributions.csv")
                 if row["group"] == group["group"] and row["quantity"] == quantity and abs(float(row["value"]) - value) < 1e-6]
        return sum(found)

    def group(self, **settings):
        """The one group with these settings, or None."""
        found = [group for group in self.groups if all(same(group, name, wanted) for name, wanted in settings.items())]
        if len(found) > 1:
            raise ValueError(f"{self.name}: {settings} holds for {', '.join(group['group'] for group in found)}")
        return found[0] if found else None

    def values(self, column, **settings):
        """The values of a setting over the groups that have the others, as texts in the order of numbers."""
        found = {group[column] for group in self.groups if all(same(group, name, wanted) for name, wanted in settings.items())}
        return sorted(found - {""}, key=float)

    def mean(self, quantity, **settings):
        group = self.group(**settings)
        row = self.means.get((group["group"], quantity)) if group else None
        return Mean(float(row["mean"]), float(row["error"]) if row["error"] else None, int(row["count"])) if row else None
