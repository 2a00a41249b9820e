#!/bin/sh
# verify.sh QEMU CPU PROGRAM: `lanescape verify` on an emulated processor; exit status 77 if qemu-user is not installed.
set -eu
[ -x "$1" ] || { echo "skipped: qemu-x86_64 is not installed (Debian: qemu-user)"; exit 77; }
exec "$1" -cpu "$2" "$3" verify --threads 1 --quiet
