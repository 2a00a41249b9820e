#!/bin/sh
# Installs the component `kernels` of a finished build and links tests/install/kernels against it, without -fopenmp, fmt or HDF5:
# the kernels need only the standard library.
#
# Usage: kernels_test.sh BUILD_DIR SOURCE_DIR
set -eu

[ $# -eq 2 ] || { echo "usage: kernels_test.sh BUILD_DIR SOURCE_DIR" >&2; exit 2; }
build=$1
host=$2/tests/install/kernels
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() { echo "kernels_test.sh: $1" >&2; exit 1; }
cxx=$(sed -n 's/^CMAKE_CXX_COMPILER:[^=]*=//p' "$build/CMakeCache.txt")
cmake --install "$build" --component kernels --prefix "$work/prefix" >"$work/install.log" || { cat "$work/install.log"; fail "cmake --install"; }
cmake -S "$host" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_CXX_COMPILER="$cxx" -DCMAKE_BUILD_TYPE=Release \
  >"$work/configure.log" 2>&1 || { cat "$work/configure.log"; fail "find_package(lanescape-kernels)"; }
cmake --build "$work/build" >"$work/build.log" 2>&1 || { cat "$work/build.log"; fail "lanescape::kernels"; }
[ "$("$work/build/kernel_host")" = kernels ] || fail "the host program fails: $("$work/build/kernel_host")"

# The preset `kernels` must configure even if these packages are missing.
cmake -S "$2" -B "$work/only" -G "${CMAKE_GENERATOR:-Ninja}" -DCMAKE_CXX_COMPILER="$cxx" -DLANESCAPE_KERNELS_ONLY=ON -DLANESCAPE_ISAS=native \
  -DCMAKE_DISABLE_FIND_PACKAGE_HDF5=ON -DCMAKE_DISABLE_FIND_PACKAGE_tomlplusplus=ON -DCMAKE_DISABLE_FIND_PACKAGE_CLI11=ON \
  -DCMAKE_DISABLE_FIND_PACKAGE_nlohmann_json=ON >"$work/only.log" 2>&1 || { cat "$work/only.log"; fail "LANESCAPE_KERNELS_ONLY"; }
grep -q KISSFFT "$work/only/CMakeCache.txt" && fail "LANESCAPE_KERNELS_ONLY looks for kissfft"
exit 0
