#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# Time against error and growth with the size, ours beside other libraries, one thread each:
#
#   benchmarks/precision.sh precision|growth PROGRAMS OUTPUT
#
# PROGRAMS is the folder of bench_contact_precision and, where their libraries are, of peer_tao,
# peer_ipopt and peer_multigrid; OUTPUT/precision.csv or OUTPUT/growth.csv is written. The peers read what our
# programs export. One that is not there costs a line "not found" in OUTPUT/peers_*.txt. Debian
# packages: petsc-dev, coinor-libipopt-dev, python3-cvxopt, python3-numpy, python3-siconos.
#
#   SLANT_SCENES="lift:8 wire:256"   other scenes          SLANT_SIZES="4 8"   other sizes (growth)
#   Bricks of more than 20 cells are not factored but for the linear solve, those of more than 32
#   not even for that.
#   SLANT_LIMIT=10 (growth: 60), SLANT_PEER_LIMIT=60   seconds of a run, ours and others
#   SLANT_PEERS=0                    ours only            SLANT_PEERS_UP_TO=12   with up to this size
set -euo pipefail

mode=$1 programs=$2 output=$3
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
limit=${SLANT_LIMIT:-10}
peer_limit=${SLANT_PEER_LIMIT:-60}
table=$output/$mode.csv
sayings=$output/peers_$mode.txt
# Threads that wait for each other would make some of these programs many times slower.
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1 OMP_THREAD_LIMIT=1 MKL_NUM_THREADS=1

usual_scenes="lift:8 lift:12 lift:16 lift:32 lift:48 press:8 pull:8 plates:40 wire:256 stokes:1
  torsion:100"
tolerances=1e-2,1e-4,1e-6,1e-8,1e-10,1e-12
# Rows of peers cost little on small scenes; where they fall short of an error they get a chance.
peer_tolerances=1e-2,1e-4,1e-6,1e-8,1e-9,1e-10,1e-11,1e-12
growth_methods="multigrid multigrid_nested condensed_newton symmetric_newton_lumped symmetric_newton_dirichlet interior_then_newton"
growth_tolerances=1e-6,1e-8,1e-10
growth_peer_tolerances=1e-6,1e-9,1e-11
growth_peers_up_to=${SLANT_PEERS_UP_TO:-12}

mkdir -p "$output"
: >"$sayings"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
status=0

# note TEXT...: a line of peers_*.txt, once.
note() { grep -qxF "$*" "$sayings" || printf '%s\n' "$*" | tee -a "$sayings" >&2; }

# python_with MODULE: a python3 that has it and numpy.
python_with() {
  local each
  for each in python3 /usr/bin/python3; do
    if "$each" -c "import numpy, $1" 2>/dev/null; then
      printf '%s' "$each"
      return
    fi
  done
}

# peer NAME COMMAND...: rows of a peer; what it says of itself goes to peers_*.txt.
peer() {
  local name=$1 said
  shift
  said=$(mktemp)
  timeout 1800 "$@" --limit "$peer_limit" 2>"$said" >>"$table" || note "$name: ended with status $?"
  while IFS= read -r line; do note "$line"; done < <(grep -E '^[A-Z][A-Za-z/]+ [0-9?]|left out' "$said")
  rm -f "$said"
}

peers() { # peers TOLERANCES: all of them on what is in $folder/problem, if anything is
  local name module python
  [[ ${SLANT_PEERS:-1} != 0 && -d $folder/problem ]] || return 0
  for name in tao ipopt; do
    if [[ -x $programs/peer_$name ]]; then
      peer "$name" "$programs/peer_$name" "$folder/problem" --tolerances "$1"
    else
      note "$name: not found"
    fi
  done
  for module in cvxopt siconos; do
    python=$(python_with "$module")
    if [[ -n $python ]]; then
      peer "$module" "$python" "$here/peers/${module}_peer.py" "$folder/problem" --tolerances "$1"
    else
      note "$module: not found"
    fi
  done
}

# ours SCENE SIZE OPTION...: our rows, and the problem for the peers.
ours() {
  local program=$programs/bench_contact_precision factors=()
  case $1 in
    wire | stokes | torsion | bearing | *_obstacle) program=$programs/bench_separable_precision ;;
    lift | press | pull)
      if (($2 > 32)); then
        factors=(--factors none)
      elif (($2 > 20)); then
        factors=(--factors linear)
      fi
      ;;
  esac
  printf '%s %s %s\n' "$mode" "$1" "$2" >&2
  rm -rf "$folder/problem"
  "$program" "$@" "${factors[@]}" --header 0 --limit "$limit" --export "$folder/problem" >>"$table" ||
    status=1
}

printf '%s\n' "scene,size,unknowns,library,method,formulation,tolerance,seconds,error,products,\
memory_mib,linear_solve_seconds,status" >"$table"
case $mode in
  precision)
    for each in ${SLANT_SCENES:-$usual_scenes}; do
      ours "${each%:*}" "${each#*:}" --tolerances "$tolerances"
      peers "$peer_tolerances"
    done
    ;;
  growth)
    limit=${SLANT_LIMIT:-60}
    for k in ${SLANT_SIZES:-4 8 12 16 20 24 32 48}; do
      # shellcheck disable=SC2086  # a list of words
      ours lift "$k" $growth_methods --tolerances "$growth_tolerances" --repeats 3
      if ((k <= growth_peers_up_to)); then peers "$growth_peer_tolerances"; fi
      if [[ -x $programs/peer_multigrid ]]; then
        "$programs/peer_multigrid" --rows "$k" >>"$table" || note "multigrid: ended with status $?"
      else
        note "multigrid: not found"
      fi
    done
    ;;
  *)
    printf 'precision.sh: got %s, expected precision or growth\n' "$mode" >&2
    exit 2
    ;;
esac
exit "$status"
