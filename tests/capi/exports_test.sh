#!/bin/sh
# The library for C exports exactly the functions that its headers declare.
#
# Usage: exports_test.sh LIBRARY HEADERS NM
set -eu

[ $# -eq 3 ] || { echo "usage: exports_test.sh LIBRARY HEADERS NM" >&2; exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
sed -nE 's/^(lanescape_status|const char\*|int) (lanescape_[a-z_]+)\(.*/\2/p' "$2/lanescape.h" "$2/dynamics.h" "$2/listed_potential.h" "$2/shortening.h" "$2/states.h" | sort >"$work/declared"
"$3" -D --defined-only "$1" | sed 's/.* //' | sort >"$work/exported"
[ -s "$work/declared" ] || { echo "exports_test.sh: no functions are found in the headers of $2" >&2; exit 1; }
diff "$work/declared" "$work/exported" || { echo "exports_test.sh: < is declared and not exported, > is exported and not declared" >&2; exit 1; }
echo "$(wc -l <"$work/exported") functions"
