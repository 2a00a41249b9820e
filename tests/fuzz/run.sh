#!/bin/sh
# run.sh TARGET SECONDS: builds the preset fuzz and lets libFuzzer feed the target; exit status 77 if its compiler is not installed. What
# breaks the target, and the corpus that has grown, lie in build/fuzz/TARGET.
set -eu
target="$1"
seconds="$2"
if ! command -v clang++-19 >/dev/null; then
  echo "skipped: clang 19 is not installed (Debian: clang-19 libclang-rt-19-dev)"
  exit 77
fi
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz
folder="build/fuzz/corpora/$target"
build/fuzz/tests/fuzz/fuzz_write_corpus "$target" "$folder/corpus"
# HDF5 1.10 loses memory where an object header is damaged.
options="-detect_leaks=1"
case "$target" in *_content) options="-detect_leaks=0" ;; esac
exec "build/fuzz/tests/fuzz/fuzz_$target" "$options" -timeout=10 -rss_limit_mb=2048 -max_len=40000 -print_final_stats=1 \
  -max_total_time="$seconds" -artifact_prefix="$folder/" "$folder/corpus"
