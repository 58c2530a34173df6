#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# code_size.sh BYTES CHARACTERS OBJECT...: fails if the objects hold more bytes of code and constants, or
# a longer symbol.
set -euo pipefail
max_bytes=$1 max_characters=$2
shift 2

bytes=$(size "$@" | awk 'NR > 1 { sum += $1 } END { print sum + 0 }')
longest=$(nm --defined-only "$@" | awk '{ if (length($NF) > n) { n = length($NF); s = $NF } } END { print s }')
printf '%d bytes (at most %d), longest symbol %d characters (at most %d)\n' \
  "$bytes" "$max_bytes" "${#longest}" "$max_characters"
((bytes > 0 && bytes <= max_bytes)) || exit 1
((${#longest} > 0 && ${#longest} <= max_characters)) || { c++filt "$longest"; exit 1; }
