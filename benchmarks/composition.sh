#!/bin/sh
# SPDX-License-Identifier: MIT
#
# Instructions of one application of a composed operator, by the named factories (slant) and as an
# expression, beside those of the loop written by hand.
#
#     benchmarks/composition.sh PATH_TO_COMPOSITION_PROGRAM > composition.csv
#
# Counted by callgrind, so the numbers do not depend on what else the machine does: the difference
# between 10 and 30 applications, divided by 20. Exit status 1 if a ratio exceeds 1.02.
set -eu

program=${1:?usage: composition.sh PATH_TO_COMPOSITION_PROGRAM}

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
for name in congruence sum; do
  hand=$(per_application "$name-hand")
  for spelling in slant expression; do
    composed=$(per_application "$name-$spelling")
    agree=$(awk -v a="$("$program" "$name-hand" 10)" -v b="$("$program" "$name-$spelling" 10)" \
      'BEGIN { d = a - b; if (d < 0) d = -d; if (a < 0) a = -a; print (d <= 1e-12 * a) ? "yes" : "no" }')
    ratio=$(awk -v a="$composed" -v b="$hand" 'BEGIN { printf "%.4f", a / b }')
    echo "$name $spelling,$hand,$composed,$ratio,$agree"
    awk -v r="$ratio" 'BEGIN { exit !(r <= 1.02) }' || status=1
    [ "$agree" = yes ] || status=1
  done
done
exit $status
