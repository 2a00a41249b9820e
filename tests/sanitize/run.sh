#!/bin/sh
# run.sh PRESET: builds the preset and runs its fast tests; exit status 77 if its compiler is not installed.
set -eu
preset="$1"
if [ "$preset" != kernels ] && ! command -v clang++-19 >/dev/null; then
  echo "skipped: clang 19 is not installed (Debian: clang-19 libclang-rt-19-dev)"
  exit 77
fi
cmake --preset "$preset" -DLANESCAPE_BUILD_BENCHMARKS=OFF
cmake --build --preset "$preset"
ctest --preset "$preset"
