"""Tables of results in the format that all drivers write (README.md)."""

from benchmark_results import MODELS

BUSY_BELOW = 95.0  # [%] CPU use: below it another program was running


def print_rows(report):
    """The rows of `results`, group by group, then a line for each thing that is missing."""
    group = None
    width = max((len(f"{row['code']} {row['variant']}") for row in report["results"]), default=0)
    for row in report["results"]:
        if group != (row["model"], row["particles"]):
            group = row["model"], row["particles"]
            print(f"\n{MODELS[row['model']]}, N = {row['particles']}{agreement(report, group)}")
            print(f"  {'case':20} {'cores':>5}  {'code':{width}} {'ns':>9} {'spread':>7} {'ratio':>6}  remarks")
        spread = (max(row["samples"]) - min(row["samples"])) / row["ns_per_particle"]
        ratio = "" if row["ratio"] is None else f"{row['ratio']:.2f}"
        print(f"  {row['case']:20} {row['threads']:5}  {row['code'] + ' ' + row['variant']:{width}} {row['ns_per_particle']:9.2f} "
              f"{100 * spread:5.0f} % {ratio:>6}  {remarks(row)}".rstrip())
    if report["missing"]:
        print()
    for entry in report["missing"]:
        print(f"missing: {entry['what']}: {entry['why']}")


def agreement(report, group):
    differences = [e["relative_difference"] for e in report["energies"] if (e["model"], e["particles"]) == group]
    return f"; energies agree to {max(differences):.1g}" if differences else ""


def remarks(row):
    said = []
    if row["case"] == "step" and row.get("list_builds") is not None:
        said.append(f"{row['list_builds']} lists in {row['steps']} steps")
        if row.get("dangerous_builds"):
            said.append(f"{row['dangerous_builds']} of them late")
    if row.get("cpu_percent", 100.0) < BUSY_BELOW:
        said.append(f"had {row['cpu_percent']:.0f} % of the processor")
    return ", ".join(said)
