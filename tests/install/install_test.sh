#!/bin/sh
# Installs a finished build into a temporary folder, moves it elsewhere, and builds tests/install against it with CMake, with
# pkg-config, with other compilers and options, and as a shared library; every installed header must also compile on its own.
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

# configure FOLDER NAME: a project that finds the package.
configure() {
  cmake -S "$1" -B "$work/$2" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_COMPILER="$cxx" -DCMAKE_C_COMPILER="$cc" \
    -DCMAKE_CXX_FLAGS="$flags" -DCMAKE_BUILD_TYPE=Release >"$work/$2.log" 2>&1 || { cat "$work/$2.log"; fail "$2: find_package(lanescape)"; }
}
configure "$host" build
cmake --build "$work/build" >"$work/build.log" 2>&1 || { cat "$work/build.log"; fail "lanescape::lanescape"; }
check_host "$work/build/host" CMake
! grep -iE '^(hdf5|tomlplusplus|eigen3|kissfft|xsimd)' "$work/build/CMakeCache.txt" || fail "a host looks for what only the library's build needs"

# What docs/HOSTS.md shows for C++.
documented=$2/docs/snippets/hosts/cpp
check_documented() {
  answer=$("$1") || fail "$2: the program fails: $answer"
  case $answer in "V = -"* | "reached, length 4."*) echo "$2: $answer" ;; *) fail "$2: the program says '$answer'" ;; esac
}
configure "$documented" documented
cmake --build "$work/documented" >"$work/documented.log" 2>&1 || { cat "$work/documented.log"; fail "docs/HOSTS.md"; }
for program in energy landscape; do check_documented "$work/documented/$program" "docs/HOSTS.md, $program"; done

description=$(find "$prefix" -name lanescape.pc)
[ -n "$description" ] || fail "lanescape.pc is not installed"
if command -v pkg-config >/dev/null; then
  export PKG_CONFIG_PATH="$(dirname "$description")${PKG_CONFIG_PATH:+:$PKG_CONFIG_PATH}"
  [ "$(pkg-config --modversion lanescape)" = "$version" ] || fail "pkg-config knows another version than $version"
  # build_host NAME COMPILER [FLAGS]. Unquoted: these are lists of arguments.
  build_host() {
    name=$1
    shift
    "$@" -std=c++20 $flags "$host/host.cpp" $(pkg-config --cflags --libs lanescape) -o "$work/$name" >"$work/$name.log" 2>&1
  }
  run_host() {
    name=$1
    build_host "$@" || { cat "$work/$name.log"; fail "$name"; }
    LD_LIBRARY_PATH=$(pkg-config --variable=libdir lanescape) check_host "$work/$name" "$name"
  }
  run_host pkg-config "$cxx"
  if [ -z "$sanitizers" ]; then
    cp -r "$documented" "$work/commands"
    (cd "$work/commands" && ./build.sh >"$work/commands.log" 2>&1) || { cat "$work/commands.log"; fail "docs/HOSTS.md, pkg-config"; }
    LD_LIBRARY_PATH=$(pkg-config --variable=libdir lanescape) check_documented "$work/commands/energy" "docs/HOSTS.md, pkg-config"
  fi
  run_host lto "$cxx" -flto -O2
  if [ -z "$sanitizers" ]; then
    for other in g++ clang++-19; do
      if command -v $other >/dev/null; then run_host $other $other; else echo "$other: skipped, it is not installed"; fi
    done
  fi
  # A standard library of another layout must be refused by the linker, not crash.
  for layout in _GLIBCXX_DEBUG _GLIBCXX_USE_CXX11_ABI=0; do
    ! build_host "$layout" "$cxx" -D$layout || fail "a host with -D$layout links"
    grep -q 'undefined.*lanescape::v0_' "$work/$layout.log" || { cat "$work/$layout.log"; fail "a host with -D$layout does not compile"; }
    echo "-D$layout: refused by the linker"
  done
else
  echo "pkg-config: skipped, it is not installed"
fi

# The shared library of the same objects: installed, or made for this test.
shared=$(find "$prefix" -name 'liblanescape.so')
folder=$(dirname "${shared:-$build/tests/install/liblanescape.so}")
"$cxx" -std=c++20 $flags -I"$prefix/include" "$host/host.cpp" -L"$folder" -llanescape -o "$work/shared"
LD_LIBRARY_PATH=$folder check_host "$work/shared" shared
foreign=$(nm -DC --defined-only "$folder/liblanescape.so" | sed 's/^[^ ]* . //; s/^\(typeinfo\|typeinfo name\|vtable\) for //' |
  grep -v '^lanescape::v0::' || true)
[ -z "$foreign" ] || fail "the shared library exports more than the facade: $foreign"
readelf -d "$folder/liblanescape.so" | grep -q "SONAME.*liblanescape.so.${version%.*}]" || fail "the shared library has no interface version"
needed=$(readelf -d "$folder/liblanescape.so" | sed -n 's/.*NEEDED.*\[\(.*\)\]/\1/p')
! echo "$needed" | grep -vE '^(lib(fmt|stdc\+\+|m|gcc_s|c|asan|ubsan|tsan|clang_rt.*)|ld-linux.*)\.so' || fail "the shared library needs the above"

program=$prefix/bin/lanescape
if [ -e "$program" ]; then
  configure "$host/program" program
  [ "$(cat "$work/program/program")" = "$program" ] || fail "lanescape::program is another file than $program"
  "$program" info >/dev/null || fail "the installed program fails"
  "$prefix/share/lanescape/plot.py" --help >/dev/null || fail "plot.py is not installed with the program, or not with all its modules"
  cmake --install "$build" --component Program --prefix "$work/alone" >/dev/null
  [ ! -e "$work/alone/include" ] || fail "component Program installs headers"
  [ -e "$work/alone/bin/lanescape" ] || fail "component Program lacks the program"
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
