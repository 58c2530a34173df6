#!/bin/sh
# SPDX-License-Identifier: MIT
#
# Instructions of one application of F°(y) that followed by composition, beside those of the loop
# over the hand-derived formula.
#
#     benchmarks/slanting_composition.sh PATH_TO_PROGRAM > slanting_composition.csv
#
# Counted by callgrind, so the numbers do not depend on what else the machine does: the difference
# between 10 and 30 applications, divided by 20. Exit status 1 if a ratio exceeds 1.05.
set -eu

program=${1:?usage: slanting_composition.sh PATH_TO_PROGRAM}

instructions() { # case, applications
  valgrind --tool=callgrind --callgrind-out-file=/dev/null "$program" "$1" "$2" 2>&1 >/dev/null |
    sed -n 's/.*Collected : \([0-9]*\).*/\1/p'
}

per_application() { # case
  few=$(instructions "$1" 10)
  many=$(instructions "$1" 30)
  echo $(((many - few) / 20))
}

status=0
echo "case,hand_written,composed,ratio,results_agree"
for name in wire brick; do
  hand=$(per_application "$name-hand")
  composed=$(per_application "$name-slant")
  agree=$(awk -v a="$("$program" "$name-hand" 10)" -v b="$("$program" "$name-slant" 10)" \
    'BEGIN { d = a - b; if (d < 0) d = -d; if (a < 0) a = -a; print (a > 0 && d <= 1e-12 * a) ? "yes" : "no" }')
  ratio=$(awk -v a="$composed" -v b="$hand" 'BEGIN { printf "%.4f", a / b }')
  echo "$name,$hand,$composed,$ratio,$agree"
  awk -v r="$ratio" 'BEGIN { exit !(r <= 1.05) }' || status=1
  [ "$agree" = yes ] || status=1
done
exit $status
