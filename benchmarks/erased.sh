#!/bin/sh
# SPDX-License-Identifier: MIT
#
# Instructions of a solve with the types of the program forgotten, beside those of the same method
# instantiated for them.
#
#     benchmarks/erased.sh PATH_TO_ERASED_PROGRAM > erased.csv
#
# Counted by callgrind: the difference between one solve and three, divided by 2. Exit status 1 if a
# ratio exceeds 1.03, or if steps, products or the solution differ in a digit.
set -eu

program=${1:?usage: erased.sh PATH_TO_ERASED_PROGRAM}

instructions() { # case, repetitions
  valgrind --tool=callgrind --callgrind-out-file=/dev/null "$program" "$1" "$2" 2>&1 >/dev/null |
    sed -n 's/.*Collected : \([0-9]*\).*/\1/p'
}

per_solve() { # case
  few=$(instructions "$1" 1)
  many=$(instructions "$1" 3)
  echo $(((many - few) / 2))
}

status=0
echo "method,templated,erased,ratio,results_agree"
for name in kprgp symmetric_newton interior_point; do
  templated=$(per_solve "$name-templated")
  erased=$(per_solve "$name-erased")
  agree=no
  [ "$("$program" "$name-templated" 1)" = "$("$program" "$name-erased" 1)" ] && agree=yes
  ratio=$(awk -v a="$erased" -v b="$templated" 'BEGIN { printf "%.4f", a / b }')
  echo "$name,$templated,$erased,$ratio,$agree"
  awk -v r="$ratio" 'BEGIN { exit !(r <= 1.03) }' || status=1
  [ "$agree" = yes ] || status=1
done
exit $status
