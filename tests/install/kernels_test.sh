#!/bin/sh
# Installs the component `kernels` of a finished build, moves it elsewhere, and links tests/install/kernels against it. Without -fopenmp,
# fmt or HDF5: the kernels need nothing but the standard library. Then configures the preset `kernels`.
#
# Usage: kernels_test.sh BUILD_DIR SOURCE_DIR
set -eu

[ $# -eq 2 ] || { echo "usage: kernels_test.sh BUILD_DIR SOURCE_DIR" >&2; exit 2; }
build=$1
host=$2/tests/install/kernels
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

from_cache() { sed -n "s/^$1:[^=]*=//p" "$build/CMakeCache.txt"; }
cxx=$(from_cache CMAKE_CXX_COMPILER)
sanitizers=$(from_cache LANESCAPE_SANITIZE)

fail() { echo "kernels_test.sh: $1" >&2; exit 1; }
cmake --install "$build" --component kernels --prefix "$work/first" >"$work/install.log" || { cat "$work/install.log"; fail "cmake --install"; }
mv "$work/first" "$work/prefix"  # nothing may remember where it was installed
cmake -S "$host" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_CXX_COMPILER="$cxx" \
  -DCMAKE_CXX_FLAGS="${sanitizers:+-fsanitize=$sanitizers}" -DCMAKE_BUILD_TYPE=Release >"$work/configure.log" 2>&1 ||
  { cat "$work/configure.log"; fail "find_package(lanescape-kernels)"; }
cmake --build "$work/build" >"$work/build.log" 2>&1 || { cat "$work/build.log"; fail "lanescape::kernels"; }
[ "$("$work/build/kernel_host")" = kernels ] || fail "the host program fails: $("$work/build/kernel_host")"

# The preset `kernels` looks for nothing that only the rest of the library and the program need.
cd "$2"
cmake --preset kernels -B "$work/only" -G "${CMAKE_GENERATOR:-Ninja}" -DCMAKE_CXX_COMPILER="$cxx" >"$work/only.log" 2>&1 ||
  { cat "$work/only.log"; fail "cmake --preset kernels"; }
! grep -iE '^(hdf5|tomlplusplus|eigen3|cli11|nlohmann_json|kissfft|benchmark)' "$work/only/CMakeCache.txt" || fail "the preset kernels looks for the above"
