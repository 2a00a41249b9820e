"""Shared by the tests of bench/peers: stand-ins for the program and for bench_lists."""

FAKE_LANESCAPE = """#!/usr/bin/python3
import os
open(os.environ["FAKE_RECORD"], "a").write("lanescape energy\\n")
print('{"energy": -1234.5, "virial": 600.0}')
"""

FAKE_BENCH = """#!/usr/bin/python3
import json, os, re, sys
option = dict(word.lstrip("-").split("=", 1) for word in sys.argv[1:] if "=" in word)
n = int(open(option["configuration"]).readline())
steps = option["model"] in os.environ.get("FAKE_STEPS", "kob-andersen lennard-jones")
cases = ["force", "force+energy+virial", "step-mixed"] + ["step"] * steps
names = [f"{c}/N:{n}/threads:{t}/{i}" for c in cases for t in (1, 2) for i in ("sse2", "avx2")]
if os.environ.get("FAKE_LACKS"):
    names = [name for name in names if not name.startswith(os.environ["FAKE_LACKS"])]
names = [name for name in names if re.search(option.get("benchmark_filter", "."), name)]
if "--benchmark_list_tests" in sys.argv:
    print("\\n".join(names))
else:
    failed = {"error_occurred": True, "error_message": "wrong gradient"} if os.environ.get("FAKE_WRONG") else {}
    print(json.dumps({"context": {}, "benchmarks": [{"name": name, "run_name": name, "run_type": "iteration", "ns_per_particle": 20.0,
                                                     **failed} for name in names]}))
"""
