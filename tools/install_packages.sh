#!/bin/sh
# Installs the Debian 12 packages that building, testing and plotting need, if any is missing. Root, or sudo.
set -eu

packages="
  g++ gfortran cmake ninja-build pkg-config
  libxsimd-dev libfmt-dev libtomlplusplus-dev nlohmann-json3-dev libcli11-dev libhdf5-dev zlib1g-dev librandom123-dev libkissfft-dev
  libeigen3-dev
  libgtest-dev libbenchmark-dev valgrind
  lammps liblammps-dev libkim-api-dev mpi-default-bin mpi-default-dev
  python3 python3-dev python3-venv python3-numpy python3-scipy python3-matplotlib python3-ase
"

missing=""
for package in $packages; do
  status=$(dpkg-query -W -f '${Status}' "$package" 2>/dev/null || true)
  [ "$status" = "install ok installed" ] || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

as_root=""
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "install_packages.sh: root or sudo is needed to install:$missing" >&2; exit 2; }
  as_root="sudo"
fi
echo "installing:$missing"
export DEBIAN_FRONTEND=noninteractive
$as_root apt-get update -qq
# shellcheck disable=SC2086  # a list of words
$as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing >/dev/null
