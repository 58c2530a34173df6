#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# What the compiler has made of programs, counted in their objects: no clock, so that the same
# compiler and flags give the same numbers on every machine.
#
#   instances.sh check  COUNTS OUTPUT PROGRAM=OBJECT[,OBJECT]…
#   instances.sh update COUNTS OUTPUT PROGRAM=OBJECT[,OBJECT]…
#
# COUNTS holds, for each program, a line
#     program  functions  bytes of code and constants  characters of the longest symbol
# and, for each template with functions in it (ten or more, for a room of tests), a line
#     program  template  functions
# with tabs between. check writes the counts of today to OUTPUT and fails if one of the three numbers
# of a program has grown by more than 3 %; it says of which templates there are more functions.
# update makes COUNTS those of today: a deliberate act, in a commit that says why.
set -euo pipefail
export LC_ALL=C

die() {
  printf 'instances.sh: %s\n' "$*" >&2
  exit 2
}
(($# >= 4)) || die "usage: instances.sh check|update COUNTS OUTPUT PROGRAM=OBJECT[,OBJECT]…"
action=$1 counts=$2 today=$3
shift 3

# Names end where the first argument list begins; of operators and conversions the word is kept.
count() {
  local program=$1
  shift
  local text longest
  text=$(size "$@" | awk 'NR > 1 { sum += $1 } END { print sum }')
  longest=$(nm --defined-only "$@" | awk '{ n = length($NF); if (n > most) most = n } END { print most }')
  local least=1
  [[ $program == test_* ]] && least=10
  nm -C --defined-only "$@" |
    awk -v program="$program" -v text="$text" -v longest="$longest" -v least="$least" '
    $2 ~ /^[TtWwuV]$/ {
      name = $0
      sub(/^[0-9a-f]* . /, "", name)
      if (name ~ /^(vtable|typeinfo|guard|construction)/) next
      ++functions
      sub(/\[abi:[a-z0-9]*\]/, "", name)
      cut = index(name, "<")
      if (cut == 0 || name ~ /^[^(]*\(/ && index(name, "(") < cut) next
      name = substr(name, 1, cut - 1)
      sub(/^.* /, "", name)
      if (name == "" || name ~ /^\(/) next
      ++of[name]
    }
    END {
      printf "%s\t%d\t%d\t%d\n", program, functions, text, longest
      for (name in of) if (of[name] >= least) printf "%s\t%s\t%d\n", program, name, of[name]
    }' | sort -t "$(printf '\t')" -k1,1 -k2,2
}

: >"$today"
for argument in "$@"; do
  [[ $argument == *=* ]] || die "expected PROGRAM=OBJECT, got $argument"
  IFS=, read -ra objects <<<"${argument#*=}"
  count "${argument%%=*}" "${objects[@]}" >>"$today"
done

if [[ $action == update ]]; then
  cp "$today" "$counts"
  exit 0
fi
[[ $action == check ]] || die "unknown action $action"

awk -F '\t' '
  pass == 1 { if (NF == 4) { for (k = 2; k <= 4; ++k) before[$1, k] = $k } else of[$1, $2] = $3; next }
  NF == 4 {
    program = $1
    what[2] = "functions"; what[3] = "bytes"; what[4] = "characters of the longest symbol"
    if (!((program, 2) in before)) {
      printf "%s: no counts yet\n", program
      failed = 1
      next
    }
    for (k = 2; k <= 4; ++k) {
      now[program, k] = $k
      if ($k > 1.03 * before[program, k]) {
        printf "%s: %s grew from %d to %d\n", program, what[k], before[program, k], $k
        failed = grown[program] = 1
      }
    }
  }
  NF == 3 { later[++n] = $0 }
  END {
    for (i = 1; i <= n; ++i) {
      split(later[i], f, "\t")
      if (grown[f[1]] && f[3] > of[f[1], f[2]])
        printf "  %s: %s has %d functions, had %d\n", f[1], f[2], f[3], of[f[1], f[2]]
    }
    exit failed
  }' pass=1 "$counts" pass=2 "$today" || {
  printf 'If that is what it takes: cmake --build … --target update_instances\n'
  exit 1
}
