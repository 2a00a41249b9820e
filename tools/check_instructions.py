#!/usr/bin/env python3
"""Compares the instructions that hot kernels take, counted by valgrind, with those of a baseline: a cost that no noise hides.

Usage: check_instructions.py PROGRAM [CASE ...] [--baseline FILE] [--update]

PROGRAM is build/release/bench/instruction_counts, without CASE all that it lists are counted, on SSE2 and AVX2 (valgrind knows
no AVX-512). Instructions per evaluation are the difference of two runs over the difference of their rounds: what a program needs
to start and to make its configuration drops out. --update writes them into the baseline instead. Exit status 1 if a count is more
than 5 % above the baseline; 2 if one of the two lacks a case; 77 (skipped) without valgrind, with a compiler of another major
version than the baseline's, or where an instruction set could not run.
"""

import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ISAS = ("sse2", "avx2")
ALLOWED = 0.05
SKIPPED = 77
BASELINE = pathlib.Path(__file__).resolve().parent.parent / "bench" / "instruction_counts.json"


class Skip(Exception):
    """Why nothing can be compared here."""


class Refusal(Exception):
    """What is wrong with the input."""


def ask(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()


def major(compiler):
    """'GNU 12' of 'GNU 12.2.0'."""
    return compiler.split(".")[0]


def instructions(program, case, isa, rounds, folder):
    """All that one run of the program executes, in one thread."""
    out = pathlib.Path(folder) / "callgrind.out"
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "LC_ALL": "C"}
    run = subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}", program, case, isa, str(rounds)],
                         capture_output=True, text=True, check=False, env=environment)
    if run.returncode == SKIPPED:
        raise Skip(run.stderr.splitlines()[-1] if run.stderr else f"{isa} cannot run here")
    if run.returncode != 0:
        raise Refusal(f"valgrind {program} {case} {isa} {rounds} ended with status {run.returncode}: {run.stderr.strip()[-300:]}")
    for line in out.read_text(encoding="utf-8").splitlines():
        if line.startswith("summary:"):
            return int(line.split()[1])
    raise Refusal(f"{out}: no line 'summary:', is this callgrind's?")


def per_evaluation(program, case, isa, rounds):
    with tempfile.TemporaryDirectory() as folder:
        few, many = (instructions(program, case, isa, n, folder) for n in (1, 1 + rounds))
    return (many - few) / rounds


def judge(count, expected):
    """(whether it fails, what to say) of a count against the baseline's."""
    change = count / expected - 1.0
    if change > ALLOWED:
        return True, f"{change:+z.1%}: MORE than the {ALLOWED:.0%} that are allowed"
    if change < -ALLOWED:
        return False, f"{change:+z.1%}: less by more than {ALLOWED:.0%}, renew the baseline with --update"
    return False, f"{change:+z.1%}"


def check(program, cases, baseline, whole):
    if major(baseline["compiler"]) != major(ask(program, "--compiler")):
        raise Skip(f"this is {ask(program, '--compiler')}, the baseline is of {baseline['compiler']}")
    counts, failed, reasons = baseline["instructions"], [], []
    for isa in ISAS:
        lacking = [case for case in cases if case not in counts.get(isa, {})]
        if lacking:
            raise Refusal(f"no baseline for {', '.join(lacking)} on {isa}: add it with --update")
        gone = [case for case in counts[isa] if whole and case not in cases]
        if gone:
            raise Refusal(f"the baseline has {', '.join(gone)} on {isa}, the program has not: renew it with --update")
    for isa in ISAS:
        try:
            for case, rounds in cases.items():
                count = per_evaluation(program, case, isa, rounds)
                fails, words = judge(count, counts[isa][case])
                print(f"{isa:5} {case:24} {count:10.1f}, baseline {counts[isa][case]:10.1f}, {words}", flush=True)
                if fails:
                    failed.append(f"{case} on {isa}")
        except Skip as reason:
            print(f"{isa:5} skipped: {reason}")
            reasons.append(str(reason))
    if failed:
        print(f"more instructions than the baseline: {', '.join(failed)}")
        return 1
    return SKIPPED if reasons else 0


def update(program, cases, baseline, whole, file):
    """Counts of all cases anew, or of some beside the others that are there."""
    old = {} if whole else baseline["instructions"]
    counts = {isa: {**old.get(isa, {}), **{case: round(per_evaluation(program, case, isa, rounds), 1) for case, rounds in cases.items()}}
              for isa in ISAS}
    made_by = {"compiler": ask(program, "--compiler"), "valgrind": ask("valgrind", "--version")}
    if not whole and major(made_by["compiler"]) != major(baseline["compiler"]):
        raise Refusal(f"single cases of {made_by['compiler']} do not go into a baseline of {baseline['compiler']}")
    file.write_text(json.dumps({**made_by, "instructions": counts}, indent=2) + "\n", encoding="utf-8")
    return 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("cases", nargs="*", metavar="CASE")
    parser.add_argument("--baseline", type=pathlib.Path, default=BASELINE)
    parser.add_argument("--update", action="store_true")
    options = parser.parse_args()
    try:
        if shutil.which("valgrind") is None:
            raise Skip("valgrind is not installed (Debian: valgrind)")
        listed = {case: int(rounds) for case, rounds in (line.split() for line in ask(options.program, "--list").splitlines())}
        unknown = [case for case in options.cases if case not in listed]
        if unknown:
            raise Refusal(f"unknown case {unknown[0]}: there are {', '.join(listed)}")
        cases = {case: rounds for case, rounds in listed.items() if not options.cases or case in options.cases}
        whole = not options.cases
        baseline = {}
        if not (options.update and whole):
            baseline = json.loads(options.baseline.read_text(encoding="utf-8"))
        if options.update:
            return update(options.program, cases, baseline, whole, options.baseline)
        return check(options.program, cases, baseline, whole)
    except Skip as reason:
        print(f"skipped: {reason}")
        return SKIPPED
    except (Refusal, OSError, ValueError, KeyError, subprocess.CalledProcessError) as error:
        print(f"check_instructions.py: {error}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
