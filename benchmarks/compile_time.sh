#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# What including the library costs: processor seconds and peak memory of the compiler for a few
# translation units, medians of five runs.
#
#   benchmarks/compile_time.sh [--output FOLDER] [--runs N] [--compiler g++]…
#
# Prints a table, writes compile_time.csv into FOLDER (default out/bench) and exits with status 1 if
# one of the limits is exceeded:
#   one set, such as <slant/sets/ball.hpp>   at most 1.3 times <Eigen/Core>
#   <slant/slant.hpp>                        at most 2 times <Eigen/Sparse>
#   first_steps with the headers it needs    at most 6 times <Eigen/Sparse>
#   the same with slant::compiled            at most 3.6 times <Eigen/Sparse>
#   a contact client with slant::compiled    at most 6 times <Eigen/Sparse>
# Without --compiler g++ is asked, and the newest clang++ from version 16 on, if there is one.
# Processor time, not elapsed time, so that other work on the machine disturbs little; the runs go
# round the list, so that a slow minute does not meet one row only.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
output=$root/out/bench
runs=5
compilers=()
while (($# > 0)); do
  case $1 in
    --output) output=$2 ;;
    --runs) runs=$2 ;;
    --compiler) compilers+=("$2") ;;
    *)
      printf 'compile_time.sh: unknown option %s\n' "$1" >&2
      exit 2
      ;;
  esac
  shift 2
done
if ((${#compilers[@]} == 0)); then
  compilers=(g++)
  for version in 22 21 20 19 18 17 16; do
    if command -v "clang++-$version" >/dev/null; then
      compilers+=("clang++-$version")
      break
    fi
  done
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$output"

# The include folders are those that CMake found; -O2 as in the release preset.
tree=${SLANT_BUILD_DIR:-$root/build/release}
if [[ ! -e $tree/compile_flags.rsp ]]; then
  cmake -S "$root" --preset release >&2
fi
flags=("@$tree/compile_flags.rsp" "-I$root/examples" -O2)

sets=()
for name in ball ellipse free_space half_line interval point second_order_cone; do
  sets+=("slant/sets/$name.hpp")
done
# first_steps with the umbrella header, and with the headers that it needs; clients with the headers
# alone, and as programs that link slant::compiled.
names=(empty Eigen/Core "${sets[@]}" Eigen/Sparse slant/slant.hpp slant/contact/contact.hpp
  examples/wire examples/first_steps examples/first_steps/compiled
  needed/first_steps needed/first_steps/compiled
  client/methods client/methods/compiled client/contact client/contact/compiled)
needed=(problems/any_qp factorizations/dense_ldlt iteration/solve methods/symmetric_newton operators/operators
  operators/restriction sets/contact_sets sets/syntax)
for name in "${names[@]}"; do
  file=$work/${name//\//_}.cpp
  case ${name%/compiled} in
    empty) : >"$file" ;;
    client/*) printf '#include "%s"\n' "$root/tests/compiled/$(cut -d/ -f2 <<<"$name").cpp" >"$file" ;;
    examples/*) printf '#include "%s"\n' "$root/${name%/compiled}/main.cpp" >"$file" ;;
    needed/*)
      printf '#include <slant/%s.hpp>\n' "${needed[@]}" >"$file"
      # What is compiled are the methods of erased programs.
      grep -v 'slant/slant.hpp' "$root/examples/first_steps/main.cpp" |
        if [[ $name == */compiled ]]; then sed 's/slant::separable_qp{A, b, Λ}/slant::erased(&)/'; else cat; fi >>"$file"
      ;;
    *) printf '#include <%s>\n' "$name" >"$file" ;;
  esac
done

# compile COMPILER NAME RUNS_FILE; NAME/compiled as a program that links slant::compiled.
compile() {
  local unit=$work/${2//\//_} own=()
  if [[ $2 == */compiled ]]; then
    own=("-DSLANT_COMPILED=$(printf '#include <Eigen/Core>\nEIGEN_MAX_ALIGN_BYTES\n' |
      "$1" "${flags[@]}" -x c++ -E -P - | tail -n 1)")
  fi
  /usr/bin/time -q -f '%U %S %M' -o "$work/time" "$1" "${flags[@]}" "${own[@]}" -c "$unit.cpp" \
    -o "$unit.o"
  awk '{ printf "%.3f %.1f\n", $1 + $2, $3 / 1024 }' "$work/time" >>"$3"
}

# median COLUMN FILE
median() { cut -d' ' -f"$1" "$2" | sort -n | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }
ratio() { awk -v a="$1" -v b="$2" 'BEGIN { printf "%.2f", a / b }'; }

status=0
# limit NAME REFERENCE MOST
limit() {
  local value verdict=kept
  value=$(ratio "${seconds[$1]}" "${seconds[$2]}")
  if awk -v a="$value" -v b="$3" 'BEGIN { exit !(a > b) }'; then
    verdict=exceeded
    status=1
  fi
  printf '%s: %s times %s, limit %s: %s\n' "$1" "$value" "$2" "$3" "$verdict"
}

csv=$output/compile_time.csv
printf 'compiler,translation_unit,seconds,peak_mebibytes,over_eigen_core,over_eigen_sparse\n' >"$csv"
for compiler in "${compilers[@]}"; do
  rm -f "$work"/*.runs
  for ((run = 1; run <= runs; run++)); do
    for name in "${names[@]}"; do compile "$compiler" "$name" "$work/${name//\//_}.runs"; done
  done

  declare -A seconds=() memory=()
  for name in "${names[@]}"; do
    seconds[$name]=$(median 1 "$work/${name//\//_}.runs")
    memory[$name]=$(median 2 "$work/${name//\//_}.runs")
  done

  printf '%s, -O2, median of %d runs\n\n' "$("$compiler" --version | head -n 1)" "$runs"
  printf '%-34s %8s %9s %13s %15s\n' 'translation unit' seconds MiB '/ Eigen/Core' '/ Eigen/Sparse'
  for name in "${names[@]}"; do
    over_core=$(ratio "${seconds[$name]}" "${seconds[Eigen/Core]}")
    over_sparse=$(ratio "${seconds[$name]}" "${seconds[Eigen/Sparse]}")
    printf '%-34s %8s %9s %13s %15s\n' "$name" "${seconds[$name]}" "${memory[$name]}" \
      "$over_core" "$over_sparse"
    printf '%s,%s,%s,%s,%s,%s\n' "${compiler##*/}" "$name" "${seconds[$name]}" "${memory[$name]}" \
      "$over_core" "$over_sparse" >>"$csv"
  done
  printf '\n'
  for name in "${sets[@]}"; do limit "$name" Eigen/Core 1.3; done
  limit slant/slant.hpp Eigen/Sparse 2
  limit needed/first_steps Eigen/Sparse 6
  limit needed/first_steps/compiled Eigen/Sparse 3.6
  limit client/contact/compiled Eigen/Sparse 6
  printf '\n'
done
exit "$status"
