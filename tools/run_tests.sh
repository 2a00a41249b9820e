#!/bin/sh
# Installs what is missing, builds everything and runs the fast tests.
set -eu
cd "$(dirname "$0")/.."

tools/install_packages.sh
cmake --preset release -DLANESCAPE_BUILD_TESTS=ON -DLANESCAPE_BUILD_BENCHMARKS=ON
cmake --build --preset release
ctest --preset fast --parallel "$(nproc)"
