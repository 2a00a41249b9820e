#!/bin/sh
# Configures tests/install/subproject, a host that takes the source tree in by add_subdirectory: its build type, its flags and its
# installation remain its own, and the library is optimised all the same, for every instruction set. Nothing is compiled.
#
# Usage: subproject_test.sh BUILD_DIR SOURCE_DIR
set -eu

[ $# -eq 2 ] || { echo "usage: subproject_test.sh BUILD_DIR SOURCE_DIR" >&2; exit 2; }
build=$1
source=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

from_cache() { sed -n "s/^$1:[^=]*=//p" "$2/CMakeCache.txt"; }
fail() { echo "subproject_test.sh: $1" >&2; exit 1; }
cxx=$(from_cache CMAKE_CXX_COMPILER "$build")
cc=$(from_cache CMAKE_C_COMPILER "$build")

# configure NAME [OPTIONS]: leaves the commands of the host's own source in $own and those of the library's in $ours.
configure() {
  name=$1
  shift
  cmake -S "$source/tests/install/subproject" -B "$work/$name" -DLANESCAPE_SOURCE_DIR="$source" -DCMAKE_CXX_COMPILER="$cxx" \
    -DCMAKE_C_COMPILER="$cc" -DCMAKE_EXPORT_COMPILE_COMMANDS=ON "$@" >"$work/$name.log" 2>&1 || { cat "$work/$name.log"; fail "$name: cmake"; }
  own=$(grep '"command".* -c [^ ]*/install/host.cpp' "$work/$name/compile_commands.json")
  ours=$(grep '"command".* -c [^ ]*/\(src\|kernels\)/' "$work/$name/compile_commands.json")
}
each_has() { printf '%s\n' "$ours" | grep -v -e " $1 " >"$work/without" && fail "$2: compiled without $1: $(head -n 1 "$work/without")" || true; }

configure debug -DCMAKE_BUILD_TYPE=Debug
[ "$(from_cache CMAKE_BUILD_TYPE "$work/debug")" = Debug ] || fail "the host's build type Debug becomes another"
case $own in
  *-DNDEBUG* | *-fno-fast-math* | *" -O"*) fail "flags reach the host's own source: $own" ;;
esac
each_has -O3 Debug
each_has -fno-fast-math Debug
for name in HDF5 kissfft CLI11 nlohmann_json GTest benchmark; do
  ! grep -i "^${name}_" "$work/debug/CMakeCache.txt" || fail "a host that needs only the library looks for $name"
done
cmake --install "$work/debug" --prefix "$work/prefix" >"$work/install.log" || { cat "$work/install.log"; fail "the host's cmake --install"; }
installed=$(cd "$work/prefix" && find . -type f)
[ "$installed" = ./share/superproject/CMakeLists.txt ] || fail "the host's cmake --install installs more than its own file: $installed"

configure plain
[ -z "$(from_cache CMAKE_BUILD_TYPE "$work/plain")" ] || fail "a host without a build type gets one"
each_has -O3 "no build type"
configure own -DCMAKE_CXX_FLAGS=-O2
case $ours in
  *-O3*) fail "a host's own -O2 is changed to -O3" ;;
esac

# The name of the processor is a matter of taste.
for processor in amd64 AMD64; do
  configure $processor -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR=$processor
  for isa in sse2 avx2 avx512; do
    case $ours in
      *-DLANESCAPE_ISA=$isa*) ;;
      *) fail "processor $processor: no kernels for $isa" ;;
    esac
  done
done
