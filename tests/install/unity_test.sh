#!/bin/sh
# Compiles the library, kernels apart, inside a host that asks for unity builds: names in unnamed namespaces must not meet.
#
# Usage: unity_test.sh BUILD_DIR SOURCE_DIR
set -eu

[ $# -eq 2 ] || { echo "usage: unity_test.sh BUILD_DIR SOURCE_DIR" >&2; exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cxx=$(sed -n 's/^CMAKE_CXX_COMPILER:[^=]*=//p' "$1/CMakeCache.txt")
cmake -S "$2/tests/install/subproject" -B "$work" -DLANESCAPE_SOURCE_DIR="$2" -DCMAKE_CXX_COMPILER="$cxx" -DCMAKE_CXX_FLAGS=-O0 \
  -DCMAKE_UNITY_BUILD=ON -DLANESCAPE_WERROR=ON
cmake --build "$work" --target lanescape_objects
