#!/bin/sh
# With pkg-config in place of CMake.
set -eu
gfortran $(pkg-config --variable=fortran_source lanescape-c) energy.f90 $(pkg-config --libs lanescape-c) -o energy
