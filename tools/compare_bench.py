#!/usr/bin/python3
"""Compare two runs of a benchmark: tools/compare_bench.py BASELINE.json NEW.json

Both files are Google Benchmark's JSON of runs with --benchmark_repetitions=K, K of at least 2; 5 or more are advisable.

The ratio new/old is that of the geometric means over repetitions. Its confidence interval is Welch's t interval of the difference
of the mean logarithms: times scatter by factors rather than by amounts, the two runs may be unequally noisy, and with the 3 to 10
repetitions that one can afford a bootstrap covers less than it claims. A disturbed repetition widens the interval, so that noise
hides a change rather than making one up.

Verdicts: `slower` where the whole interval is above 1 and the ratio above 1 + threshold: statistically slower, and by enough to
matter. `faster` likewise, interval below 1 and ratio below 1/(1 + threshold). `no change` otherwise. Each benchmark is judged by
itself: of n that did not change, about n (1 - confidence)/2 intervals lie above 1, so raise --confidence where there are many.
With --higher-is-better, for rates, the ratio is that of the inverse values, so that above 1 is worse in any case.

Exit status 0; 1 if a benchmark is slower; 2 with one line on stderr for input that cannot be compared.
"""

import json
import math
import sys

import numpy as np
from scipy.special import stdtrit  # quantiles of Student's t, without the seconds that scipy.stats takes to load

from benchmark_results import TIMES, Arguments, Unusable, read_results, repetitions, value

MARKS = {"slower": "x", "faster": "+", "no change": " "}


def parse(arguments):
    parser = Arguments(prog="compare_bench.py", description="Compares two Google Benchmark JSON files; exit status 1 if any is slower.")
    parser.add_argument("baseline", metavar="BASELINE.json")
    parser.add_argument("new", metavar="NEW.json")
    parser.add_argument("--confidence", type=float, default=0.95, help="of the interval, above 0 and below 1 [0.95]")
    parser.add_argument("--threshold", type=float, default=0.05, help="relative change that matters, at least 0 [0.05]")
    parser.add_argument("--metric", default="cpu_time", help="cpu_time, real_time or the name of a counter [cpu_time]")
    parser.add_argument("--higher-is-better", action="store_true", help="the metric is a rate, not a time")
    parser.add_argument("--json", action="store_true", help="print the comparison as JSON")
    options = parser.parse_args(arguments)
    if not 0.0 < options.confidence < 1.0:
        parser.error(f"--confidence {options.confidence}: must be above 0 and below 1")
    if not (math.isfinite(options.threshold) and options.threshold >= 0.0):
        parser.error(f"--threshold {options.threshold}: must be a number of at least 0")
    return options


def samples(runs, name, metric, source):
    values = [value(entry, metric, source) for entry in runs[name]]
    if len(values) < 2:
        raise Unusable(f"{source}: {name}: 1 repetition, at least 2 are needed for an interval (--benchmark_repetitions)")
    return np.array(values)


def geometric_mean(values):
    return math.exp(np.log(values).mean())


def welch_interval(old, new, confidence):
    """The ratio new/old of geometric means, and its interval."""
    a, b = np.log(old), np.log(new)
    ratio = b.mean() - a.mean()
    squared_errors = np.array([x.var(ddof=1) / len(x) for x in (a, b)])
    error = math.sqrt(squared_errors.sum())
    half = 0.0
    if error > 0.0:
        freedom = squared_errors.sum()**2 / (squared_errors**2 / [len(a) - 1, len(b) - 1]).sum()
        half = error * stdtrit(freedom, 0.5 + 0.5 * confidence)
    return tuple(np.exp(np.clip([ratio, ratio - half, ratio + half], -700.0, 700.0)).tolist())


def verdict(ratio, low, high, threshold):
    if low > 1.0 and ratio > 1.0 + threshold:
        return "slower"
    if high < 1.0 and ratio < 1.0 / (1.0 + threshold):
        return "faster"
    return "no change"


def compare(old_runs, new_runs, options):
    common = [name for name in old_runs if name in new_runs]
    if not common:
        raise Unusable(f"{options.baseline} and {options.new}: no benchmark in common")
    rows = []
    for name in common:
        old = samples(old_runs, name, options.metric, options.baseline)
        new = samples(new_runs, name, options.metric, options.new)
        worse = (1.0 / old, 1.0 / new) if options.higher_is_better else (old, new)
        ratio, low, high = welch_interval(*worse, options.confidence)
        rows.append({"name": name, "baseline": geometric_mean(old), "new": geometric_mean(new), "repetitions": [len(old), len(new)],
                     "ratio": ratio, "interval": [low, high], "verdict": verdict(ratio, low, high, options.threshold)})
    return {"metric": options.metric, "unit": "ns" if options.metric in TIMES else None, "confidence": options.confidence,
            "threshold": options.threshold, "higher_is_better": options.higher_is_better, "benchmarks": rows,
            "only_in_baseline": [name for name in old_runs if name not in new_runs],
            "only_in_new": [name for name in new_runs if name not in old_runs],
            "slower": sum(row["verdict"] == "slower" for row in rows), "faster": sum(row["verdict"] == "faster" for row in rows)}


def print_table(comparison, options):
    rows = comparison["benchmarks"]
    width = max(9, *(len(row["name"]) for row in rows))
    unit = f" [{comparison['unit']}]" if comparison["unit"] else ""
    print(f"{comparison['metric']}{unit}, geometric means; {100 * options.confidence:g} % intervals; threshold {100 * options.threshold:g} %")
    print(f"  {'benchmark':{width}}  {'baseline':>12}  {'new':>12}  {'ratio':>7}  {'interval':>18}  verdict")
    for row in rows:
        low, high = row["interval"]
        print(f"{MARKS[row['verdict']]} {row['name']:{width}}  {row['baseline']:12.6g}  {row['new']:12.6g}  {row['ratio']:7.3f}"
              f"  {f'{low:.3f} .. {high:.3f}':>18}  {row['verdict']}")
    for key, file in (("only_in_baseline", options.baseline), ("only_in_new", options.new)):
        for name in comparison[key]:
            print(f"? {name}: only in {file}")
    print(f"{comparison['slower']} slower, {comparison['faster']} faster, "
          f"{len(rows) - comparison['slower'] - comparison['faster']} without change")


def main(arguments):
    options = parse(arguments)
    try:
        runs = [repetitions(read_results(file), file) for file in (options.baseline, options.new)]
        comparison = compare(*runs, options)
    except Unusable as error:
        print(f"compare_bench.py: {error}", file=sys.stderr)
        return 2
    if options.json:
        print(json.dumps(comparison, indent=2))
    else:
        print_table(comparison, options)
    return 1 if comparison["slower"] else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
