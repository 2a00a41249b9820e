#!/bin/sh
# With pkg-config in place of CMake.
set -eu
cc energy.c $(pkg-config --cflags --libs lanescape-c) -o energy
