#!/bin/sh
# From nothing to a picture: installs what is missing, builds, and runs one Kob-Andersen geodesic (N = 108, T = 1,
# DeltaR = 108, short equilibration) with its plots. Run again, it builds what changed and replaces the results.
set -eu
cd "$(dirname "$0")/.."

tools/install_packages.sh
cmake --preset release -DLANESCAPE_BUILD_TESTS=OFF -DLANESCAPE_BUILD_BENCHMARKS=OFF
cmake --build --preset release
rm -rf out/first-geodesic
build/release/lanescape path --model kob-andersen --particles 108 --temperature 1 --distance 108 --quick --plot --out out/first-geodesic
echo "results: out/first-geodesic/result.json, pictures: out/first-geodesic/path-0001.png, out/first-geodesic/equilibration.png" >&2
