#!/bin/sh
# Installs a finished build, moves it elsewhere, and runs the CI script of docs/examples/host_kernel against it. With a fault put into
# the example's kernel, the script must fail and name the case.
#
# Usage: host_kernel_test.sh BUILD_DIR SOURCE_DIR
set -eu

[ $# -eq 2 ] || { echo "usage: host_kernel_test.sh BUILD_DIR SOURCE_DIR" >&2; exit 2; }
build=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { cat "$work/ci.log"; echo "host_kernel_test.sh: $1" >&2; exit 1; }

cmake --install "$build" --prefix "$work/first" >"$work/ci.log" || fail "cmake --install"
mv "$work/first" "$work/prefix"
cp -r "$2/docs/examples/host_kernel" "$work/right"
cp -r "$work/right" "$work/wrong"
sed -i 's/own ? 0.5 : 1.0/1.0/' "$work/wrong/kernel.c"
! cmp -s "$work/right/kernel.c" "$work/wrong/kernel.c" || fail "the example's kernel has no weight to put a fault into"

export LANESCAPE_PREFIX="$work/prefix"
"$work/right/ci.sh" >"$work/ci.log" 2>&1 || fail "the example's right kernel does not pass"
grep -q 'failures="0"' "$work/right/build/results.xml" || fail "the example's CI writes no results"
! "$work/wrong/ci.sh" >"$work/ci.log" 2>&1 || fail "a kernel that counts own images twice passes"
grep -q "cases are wrong, the worst is 'lennard-jones N=" "$work/ci.log" || fail "the wrong case is not named"

# A static library has no function to call.
sed -i 's/ MODULE / STATIC /' "$work/right/CMakeLists.txt"
! "$work/right/ci.sh" >"$work/ci.log" 2>&1 || fail "a static library is accepted"
grep -q "SHARED or MODULE" "$work/ci.log" || fail "a static library is refused without its reason"
