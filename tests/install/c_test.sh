#!/bin/sh
# Installs the component C of a finished build into a temporary folder, moves it elsewhere, and builds and runs docs/snippets/hosts
# against it: projects in C and in Fortran alone, and commands with pkg-config.
#
# Usage: c_test.sh BUILD_DIR SOURCE_DIR
set -eu

[ $# -eq 2 ] || { echo "usage: c_test.sh BUILD_DIR SOURCE_DIR" >&2; exit 2; }
build=$1
hosts=$2/docs/snippets/hosts
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

from_cache() { sed -n "s/^$1:[^=]*=//p" "$build/CMakeCache.txt"; }
cc=$(from_cache CMAKE_C_COMPILER)
cxx=$(from_cache CMAKE_CXX_COMPILER)
version=$(from_cache CMAKE_PROJECT_VERSION)
[ -z "$(from_cache LANESCAPE_SANITIZE)" ] || { echo "c_test.sh: skipped, C programs do not link the sanitizers' libraries"; exit 77; }

fail() { echo "c_test.sh: $1" >&2; exit 1; }
logged() {
  log=$1
  shift
  "$@" >"$work/$log.log" 2>&1 || { cat "$work/$log.log" >&2; fail "$log: $*"; }
}
energy=""
# check_programs FOLDER NAME: the energy is the same in every language.
check_energy() {
  answer=$("$1/energy") || fail "$2: the program fails"
  case $answer in "V = -"*) ;; *) fail "$2: the program says '$answer'" ;; esac
  [ "${energy:-$answer}" = "$answer" ] || fail "$2: '$answer' is another energy than '$energy'"
  energy=$answer
  echo "$2: $answer"
}
check_landscape() {
  answer=$("$1/landscape") || fail "$2: the program of the landscape fails"
  case $answer in "reached, length 4."*) ;; *) fail "$2: the program of the landscape says '$answer'" ;; esac
  echo "$2: $answer"
}

logged install cmake --install "$build" --component C --prefix "$work/first"
mv "$work/first" "$work/prefix"  # no file may contain the original prefix
prefix=$work/prefix
[ -z "$(find "$prefix" -name '*.hpp' -o -name '*.a')" ] || fail "component C installs more than the library for C"
! grep -rIl "$work/first" "$prefix" || fail "the above name the original prefix"
library=$(find "$prefix" -name liblanescape_c.so)
readelf -d "$library" | grep -q "SONAME.*liblanescape_c.so.${version%.*}]" || fail "the library for C has no interface version"

languages=c
if command -v gfortran >/dev/null; then languages="c fortran"; else echo "Fortran: skipped, gfortran is not installed"; fi
for language in $languages; do
  logged "configure_$language" cmake -S "$hosts/$language" -B "$work/$language" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_BUILD_TYPE=Release
  ! grep -q '^CMAKE_CXX_COMPILER:' "$work/$language/CMakeCache.txt" || fail "$language: a C++ compiler is looked for"
  logged "build_$language" cmake --build "$work/$language"
  check_energy "$work/$language" "CMake, $language"
  check_landscape "$work/$language" "CMake, $language"
done

# With pkg-config alone, and in C++ without exceptions.
command -v pkg-config >/dev/null || { echo "pkg-config: skipped, it is not installed"; exit 0; }
export PKG_CONFIG_PATH="$(dirname "$(find "$prefix" -name lanescape-c.pc)")"
[ "$(pkg-config --modversion lanescape-c)" = "$version" ] || fail "pkg-config knows another version than $version"
export LD_LIBRARY_PATH="$(dirname "$library")"
for language in $languages; do
  cp -r "$hosts/$language" "$work/commands_$language"
  (cd "$work/commands_$language" && logged "commands_$language" ./build.sh)
  check_energy "$work/commands_$language" "pkg-config, $language"
done
mkdir "$work/cxx"
logged cxx "$cxx" -x c++ -std=c++20 -fno-exceptions -fno-rtti "$hosts/c/energy.c" $(pkg-config --cflags --libs lanescape-c) -o "$work/cxx/energy"
check_energy "$work/cxx" "C++ without exceptions"

for header in lanescape.h dynamics.h engine.h listed_potential.h shortening.h states.h; do
  echo "#include <lanescape/$header>" >"$work/header.c"
  logged "$header" "$cc" -std=c11 -pedantic -Wall -Wextra -Werror -I"$prefix/include" -fsyntax-only "$work/header.c"
  logged "$header" "$cxx" -x c++ -std=c++11 -pedantic -Wall -Wextra -Werror -I"$prefix/include" -fsyntax-only "$work/header.c"
done
