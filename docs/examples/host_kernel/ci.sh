#!/bin/sh
# What continuous integration runs, on any service: builds the project and checks its kernel. LANESCAPE_PREFIX is where Lanescape is
# installed. Exit status 0: the kernel agrees with the reference in every case that it does.
set -eu
cd "$(dirname "$0")"
build=${BUILD_DIR:-build}

cmake -S . -B "$build" -DCMAKE_BUILD_TYPE=Release -DMY_FLUID_VERIFICATION=ON -DCMAKE_PREFIX_PATH="$LANESCAPE_PREFIX"
cmake --build "$build"
ctest --test-dir "$build" --output-on-failure --output-junit results.xml
