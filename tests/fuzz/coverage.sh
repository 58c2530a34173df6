#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
#   tests/fuzz/coverage.sh BUILD [INPUTS]
#
# The share of the readers and of the checks of data that inputs of the fuzzers reach, by file. BUILD
# holds fuzzers compiled with -fprofile-instr-generate -fcoverage-mapping; INPUTS has a folder
# corpus/<target> for each, and maybe found/<target>: by default those that are kept beside this
# file. `./run fuzz --coverage` does all of that. LLVM_VERSION: of llvm-profdata and llvm-cov.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
build=$1
inputs=${2:-$here}
suffix=${LLVM_VERSION:+-$LLVM_VERSION}

profiles=$(mktemp -d)
trap 'rm -rf "$profiles"' EXIT
objects=()
for program in "$build"/tests/fuzz/fuzz_*; do
  target=${program##*/fuzz_}
  shopt -s nullglob
  kept=("$inputs/corpus/$target"/* "$inputs/found/$target"/*)
  shopt -u nullglob
  printf '%s: %s inputs\n' "$target" "${#kept[@]}"
  # In lots: an argument list has an end.
  for ((i = 0; i < ${#kept[@]}; i += 500)); do
    LLVM_PROFILE_FILE="$profiles/$target-%p.profraw" "$program" "${kept[@]:i:500}" >/dev/null 2>&1 ||
      printf '%s: an input fails\n' "$target" >&2
  done
  objects+=(${objects[0]:+-object} "$program")
done
"llvm-profdata$suffix" merge -sparse "$profiles"/*.profraw -o "$profiles/all"

contact=$root/include/slant/contact
"llvm-cov$suffix" report -instr-profile="$profiles/all" "${objects[@]}" \
  "$root"/include/slant/io/*.hpp \
  "$contact"/{contact_data,friction_law,load_stepper,friction/friction_problem}.hpp |
  awk '
    /\.hpp/ { name = $1; sub(/.*\//, "", name) }
    /\.hpp|^TOTAL/ {
      if ($1 == "TOTAL") name = "all"
      printf "%-26s regions %4d of %4d (%s)   lines %4d of %4d (%s)\n",
             name, $2 - $3, $2, $4, $8 - $9, $8, $10
    }'
