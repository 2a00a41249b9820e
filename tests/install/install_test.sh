#!/bin/sh
# Installs a finished build into a temporary folder, moves it elsewhere, and builds tests/install against it with CMake and with
# pkg-config; every installed header must also compile on its own.
#
# Usage: install_test.sh BUILD_DIR SOURCE_DIR
set -eu

[ $# -eq 2 ] || { echo "usage: install_test.sh BUILD_DIR SOURCE_DIR" >&2; exit 2; }
build=$1
host=$2/tests/install
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

from_cache() { sed -n "s/^$1:[^=]*=//p" "$build/CMakeCache.txt"; }
cxx=$(from_cache CMAKE_CXX_COMPILER)
cc=$(from_cache CMAKE_C_COMPILER)
version=$(from_cache CMAKE_PROJECT_VERSION)
sanitizers=$(from_cache LANESCAPE_SANITIZE)
flags=${sanitizers:+-fsanitize=$sanitizers}

fail() { echo "install_test.sh: $1" >&2; exit 1; }
check_host() {
  answer=$("$1") || fail "$2: the host program fails: $answer"
  [ "$answer" = "lanescape $version" ] || fail "$2: the host program says '$answer', expected is version $version"
  echo "$2: $answer"
}

cmake --install "$build" --prefix "$work/first" >"$work/install.log" || { cat "$work/install.log"; fail "cmake --install"; }
mv "$work/first" "$work/prefix"  # no file may contain the original prefix
prefix=$work/prefix

cmake -S "$host" -B "$work/build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_COMPILER="$cxx" -DCMAKE_CXX_FLAGS="$flags" \
  -DCMAKE_BUILD_TYPE=Release >"$work/configure.log" 2>&1 || { cat "$work/configure.log"; fail "find_package(lanescape)"; }
cmake --build "$work/build" >"$work/build.log" 2>&1 || { cat "$work/build.log"; fail "lanescape::lanescape"; }
check_host "$work/build/host" CMake

description=$(find "$prefix" -name lanescape.pc)
[ -n "$description" ] || fail "lanescape.pc is not installed"
if command -v pkg-config >/dev/null; then
  export PKG_CONFIG_PATH="$(dirname "$description")${PKG_CONFIG_PATH:+:$PKG_CONFIG_PATH}"
  [ "$(pkg-config --modversion lanescape)" = "$version" ] || fail "pkg-config knows another version than $version"
  # Unquoted: these are lists of arguments.
  "$cxx" -std=c++20 $flags "$host/host.cpp" $(pkg-config --cflags --libs lanescape) -o "$work/host"
  LD_LIBRARY_PATH=$(pkg-config --variable=libdir lanescape) check_host "$work/host" pkg-config
else
  echo "pkg-config: skipped, it is not installed"
fi

headers=$(cd "$prefix/include" && find lanescape -name '*.h' -o -name '*.hpp')
[ -n "$headers" ] || fail "no headers are installed"
for header in $headers; do
  echo "#include <$header>" | "$cxx" -std=c++20 -Wall -Wextra -Werror -I"$prefix/include" -fsyntax-only -x c++ - || fail "$header in C++"
  case $header in
    *.h) echo "#include <$header>" | "$cc" -std=c11 -Wall -Wextra -Werror -I"$prefix/include" -fsyntax-only -x c - || fail "$header in C" ;;
  esac
  echo "$header: compiles on its own"
done
