#!/bin/sh
# With pkg-config in place of CMake.
set -eu
c++ -std=c++20 energy.cpp $(pkg-config --cflags --libs lanescape) -o energy
