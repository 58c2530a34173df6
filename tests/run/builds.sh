#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# builds.sh ROOT FOLDER: ./run in a checkout with a program that takes a second to build. Eight calls at
# once build it once and all answer; the next one builds nothing; one that is killed while it builds
# leaves no process behind.
set -euo pipefail
root=$1 folder=$2/checkout
rm -rf "$folder"
mkdir -p "$folder"/{cmake,concepts,include,src,examples/from_files}
cp "$root/CMakePresets.json" "$folder"
sed 's/^install_missing() {/&\n  return 0/' "$root/run" >"$folder/run"  # a test installs nothing
chmod +x "$folder/run"
cat >"$folder/CMakeLists.txt" <<'TEXT'
cmake_minimum_required(VERSION 3.25)
project(one_program LANGUAGES NONE)
set(program "${PROJECT_BINARY_DIR}/examples/from_files")
add_custom_command(
  OUTPUT "${program}"
  COMMAND bash "${PROJECT_SOURCE_DIR}/compile.sh" "${program}"
  DEPENDS include/program.sh compile.sh
  VERBATIM)
add_custom_target(from_files DEPENDS "${program}")
TEXT
cat >"$folder/compile.sh" <<'TEXT'
here=$(dirname "$0")
echo once >>"$here/builds"
sleep "$(cat "$here/seconds")"
cp "$here/include/program.sh" "$1"
chmod +x "$1"
TEXT
printf '#!/bin/sh\necho "answer $1"\n' >"$folder/include/program.sh"
echo 1 >"$folder/seconds"

fail() {
  printf 'builds.sh: %s\n' "$1" >&2
  exit 1
}
builds() { wc -l <"$folder/builds"; }
# Of processes in the checkout, whatever they are called.
left_over() { pgrep -f "$folder/compile.sh" || true; }

for i in {1..8}; do "$folder/run" solve "$i" >"$folder/answer.$i" 2>"$folder/error.$i" & done
wait
for i in {1..8}; do
  [[ $(cat "$folder/answer.$i") == "answer $i" ]] || fail "call $i: $(cat "$folder"/{answer,error}."$i")"
done
[[ $(builds) == 1 ]] || fail "eight calls built $(builds) times"
grep -q 'builds build/release; waiting for it' "$folder"/error.* || fail 'nobody said what it waits for'

[[ $("$folder/run" solve 9) == 'answer 9' && $(builds) == 1 ]] || fail 'what is new was built again'

echo 1000 >"$folder/seconds"
touch "$folder/include/program.sh"
for signal in TERM KILL; do
  "$folder/run" solve 10 >/dev/null 2>&1 &
  for _ in {1..100}; do [[ -n $(left_over) ]] && break || sleep 0.1; done
  [[ -n $(left_over) ]] || fail 'nothing is built'
  kill -s "$signal" $!
  wait $! 2>/dev/null || true
  for _ in {1..100}; do [[ -z $(left_over) ]] && break || sleep 0.1; done
  [[ -z $(left_over) ]] || fail "after SIG$signal still at work: $(left_over)"
done
