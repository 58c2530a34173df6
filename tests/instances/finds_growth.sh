#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# finds_growth.sh OBJECT FOLDER: instances.sh accepts what it has counted itself, refuses each number
# that has grown by more than 3 %, names a template that is new, and a program without counts.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
object=$1 folder=$2
mkdir -p "$folder"

fail() {
  printf 'finds_growth.sh: %s\n' "$1" >&2
  exit 1
}
# check COUNTS: what instances.sh says of the object beside these counts; empty if nothing.
check() {
  "$here/instances.sh" check "$1" "$folder/today.txt" "program=$object" 2>&1 || true
}

"$here/instances.sh" update "$folder/counts.txt" "$folder/today.txt" "program=$object"
[[ -z $(check "$folder/counts.txt") ]] || fail 'the same counts are refused'

less() {  # less COLUMN SHARE: the counts of a program that had been smaller
  awk -F '\t' -v OFS='\t' -v column="$1" -v share="$2" \
    'NF == 4 { $column = int($column * share) } { print }' "$folder/counts.txt" >"$folder/less.txt"
}
for column in 2 3 4; do
  less "$column" 0.98
  [[ -z $(check "$folder/less.txt") ]] || fail "2 % in column $column are refused"
  less "$column" 0.95
  [[ $(check "$folder/less.txt") == *'program: '*' grew from '* ]] || fail "5 % in column $column pass"
done

less 2 0.5
template=$(awk -F '\t' 'NF == 3 { print $2; exit }' "$folder/counts.txt")
grep -vF "$(printf '\t%s\t' "$template")" "$folder/less.txt" >"$folder/without.txt"
[[ $(check "$folder/without.txt") == *"$template has "*', had 0'* ]] || fail "$template is not named"
: >"$folder/empty.txt"
[[ $(check "$folder/empty.txt") == *'program: no counts yet'* ]] || fail 'no counts, no complaint'
