#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# Runs the benchmarks; `./run bench` builds them and then comes here.
#
#   benchmarks/run_all.sh [--only NAME]… [--output FOLDER]
#   benchmarks/run_all.sh --list | --help
#
#   composition         instructions of composed operators, beside loops written by hand
#   slanting            instructions of F°(y) by the chain rule, beside hand-derived formulas
#   erased              instructions of methods on any_qp, beside the same method on the given types
#   compile_time        seconds and memory of the compiler for a few includes
#   projections         largest error of the projections at a million points each
#   example_1           products of KPRGP for eleven Γ, beside the printed ones
#   wire                active constraints of the wire, beside the printed ones
#   brick               error of KPRGP against work: the steel brick, three sizes, three loads
#   newton_brick        products of Newton's methods on the brick until the energy error is 1e-8
#   newton_wire         Newton steps on the wire, from zero and by nested iteration
#   newton_floor        the accuracy at which the symmetric Newton method stalls, against κ(A)
#   digits              digits of the solutions that rounding leaves, method by method, against κ(A)
#   interior_brick      products of the interior-point method until the energy error is 1e-6
#   interior_condition  condition of its systems with and without preconditioner
#   interior_crossover  lift to the last digits: interior point, then the symmetric Newton method
#   projector_steps     CG steps with and without the conjugate projector, brick refined
#   projector_contact   the Schur complement contact algorithm on the brick without friction
#   projector_search    the same on stacks of bricks: rules for leaving and entering constraints
#   projector_threads   seconds with one and with two threads (with OpenMP), and whether bits agree
#   total_feti          Total-FETI: outer and inner steps on 2 to 64 subdomains
#   condensation        a frictional contact problem over one linear solve, brick k = 8, 12, 16, 24
#   certificates        claimed over true error, what a certificate costs, and contact::solve beside
#                       the lines of an expert: bricks k = 4, 6, 8, 12; generic programs
#   load_steps          twenty load steps against the first one and against cold solves
#   coulomb             Coulomb friction on the brick against Tresca's problem at its slip bounds
#   coulomb_models      the same on two bricks and two plates, friction coefficients 0 to 2
#   multilevel          bricks with and without friction by multigrid, and one linear solve
#   multilevel_large    the same with 135000 and 313632 unknowns, K factored for one linear solve only
#   multilevel_huge     one load with 1037232 and 2433600 unknowns, seconds and memory (5 GB)
#   multilevel_linear   contact with friction beside one linear solve with the multigrid of PETSc, if found
#   robustness          the same where multigrid has a hard time; with a mesh of Gmsh if that is found
#   stability           every method on every adversity, judged in quadruple precision
#   random_programs     every method on 3300 random programs, judged in quadruple precision
#   active_sets         products of KPRGP, AS-S, QPQ, QPC, MSSN, IMSSN, GIMSSN on the brick
#   friction            Coulomb friction problems of the folder $SLANT_FRICTION, each by each method
#   friction_variants   the same with other coefficients and velocities: default, interior point
#   precision           time against error of all methods, and of other libraries that are found
#   growth              time and memory against the size of the brick (both: precision.sh)
#
# RESULTS.md shows the last two, friction.md the two before; SLANT_PUBLISH=1 copies them and the figure
# to benchmarks/, and the figure and the tables of stability and random_programs to docs/.
#
# FOLDER is out/bench. Each writes NAME.csv into it; summary.md shows all tables that are there.
# Exit status 1 if one of them fails or misses a limit that it knows.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
here=$root/benchmarks
tree=${SLANT_BUILD_DIR:-$root/build/bench}
programs=$tree/benchmarks
all=(composition slanting erased compile_time projections example_1 wire brick newton_brick newton_wire
  newton_floor digits interior_brick interior_condition interior_crossover projector_steps
  projector_contact projector_search projector_threads total_feti active_sets condensation
  certificates load_steps coulomb coulomb_models multilevel multilevel_large multilevel_huge
  multilevel_linear robustness stability random_programs friction friction_variants precision growth)

# A second thread of the BLAS has nothing to do in a sweep with one right-hand side.
export OPENBLAS_NUM_THREADS=${OPENBLAS_NUM_THREADS:-1}
# A processor that is newer than OpenBLAS gets kernels of 2004, and direct solves take twice as long.
for core in avx512f:SKYLAKEX avx2:HASWELL; do
  if [[ -z ${OPENBLAS_CORETYPE-} ]] && grep -qsw "${core%:*}" /proc/cpuinfo; then
    export OPENBLAS_CORETYPE=${core#*:}
  fi
done
# Processor seconds are those of all threads, and CHOLMOD takes all there are.
export OMP_THREAD_LIMIT=${OMP_THREAD_LIMIT:-1}
export SLANT_BUILD_DIR=$tree
export LC_ALL=C

die() {
  printf 'run_all.sh: %s\n' "$*" >&2
  exit 2
}

# usage: the comment above, without its marks.
usage() {
  sed -n '/^#   benchmarks/,/^set -/{ /^set -/d; s/^# \{0,1\}//; p; }' "${BASH_SOURCE[0]}"
}

output=$root/out/bench
case ${1-} in
  --help | -h)
    usage
    exit 0
    ;;
  --list)
    printf '%s\n' "${all[@]}"
    exit 0
    ;;
esac
chosen=()
while (($# > 0)); do
  (($# > 1)) || die "unknown option or missing value: $1"
  case $1 in
    --only)
      [[ " ${all[*]} " == *" $2 "* ]] || die "no benchmark $2; there are ${all[*]}"
      chosen+=("$2")
      ;;
    --output) output=$2 ;;
    *) die "unknown option $1" ;;
  esac
  shift 2
done
if ((${#chosen[@]} == 0)); then chosen=("${all[@]}"); fi
mkdir -p "$output"

# program NAME: the path of a benchmark.
program() {
  [[ -x $programs/bench_$1 ]] || die "$programs/bench_$1 is not built; use ./run bench"
  printf '%s' "$programs/bench_$1"
}

run_composition() { "$here/composition.sh" "$(program composition)" >"$output/composition.csv"; }
run_slanting() {
  "$here/slanting_composition.sh" "$(program slanting_composition)" >"$output/slanting.csv"
}
run_erased() { "$here/erased.sh" "$(program erased)" >"$output/erased.csv"; }
run_compile_time() { "$here/compile_time.sh" --output "$output"; }
run_projections() { "$(program projection_errors)" >"$output/projections.csv"; }
run_example_1() { "$(program kprgp_products)" example_1 >"$output/example_1.csv"; }
run_newton_brick() { "$(program newton_products)" brick >"$output/newton_brick.csv"; }
run_newton_wire() { "$(program newton_products)" wire >"$output/newton_wire.csv"; }
run_newton_floor() { "$(program newton_floor)" >"$output/newton_floor.csv"; }
run_digits() { "$(program digits)" >"$output/digits.csv"; }
run_interior_brick() { "$(program interior_point)" brick >"$output/interior_brick.csv"; }
run_interior_condition() { "$(program interior_point)" condition >"$output/interior_condition.csv"; }
run_interior_crossover() { "$(program interior_point)" crossover >"$output/interior_crossover.csv"; }
run_projector_steps() { "$(program projector)" steps >"$output/projector_steps.csv"; }
run_projector_contact() { "$(program projector)" contact >"$output/projector_contact.csv"; }
run_projector_search() { "$(program projector)" search 3 5 >"$output/projector_search.csv"; }
run_projector_threads() {  # threads that wait must not keep a core from those that work
  env -u OMP_THREAD_LIMIT OMP_WAIT_POLICY=passive "$(program projector)" threads 4 6 8 10 12 \
    >"$output/projector_threads.csv"
}
run_active_sets() { "$(program active_set_products)" brick >"$output/active_sets.csv"; }
run_condensation() { "$(program condensation)" 8 12 16 24 >"$output/condensation.csv"; }
run_certificates() { "$(program certificates)" >"$output/certificates.csv"; }
run_load_steps() { "$(program load_steps)" >"$output/load_steps.csv"; }
run_coulomb() { "$(program coulomb)" brick >"$output/coulomb.csv"; }
run_coulomb_models() { "$(program coulomb)" models >"$output/coulomb_models.csv"; }
run_total_feti() { "$(program total_feti)" >"$output/total_feti.csv"; }
run_robustness() {
  local mesh=$output/holed_brick.msh files=()
  if gmsh -3 -format msh2 -setnumber h 0.08 -o "$mesh" "$here/holed_brick.geo" >"$mesh.log" 2>&1
  then files=("$mesh"); fi
  "$(program robustness)" 12 "${files[@]}" >"$output/robustness.csv"
}
# friction_problems NAME ARGUMENT…: NAME.csv of the folder $SLANT_FRICTION, and the page.
friction_problems() {
  if [[ -z ${SLANT_FRICTION:-} ]]; then
    printf 'nothing to do: SLANT_FRICTION names no folder of problems (W.mtx, q.txt, mu.txt each)\n'
    return 0
  fi
  local name=$1 status=0
  shift
  "$(program friction)" "$SLANT_FRICTION" "$@" >"$output/$name.csv" || status=$?
  [[ -s $output/$name.csv ]] || return "$status"
  [[ -s $output/friction.csv ]] || return "$status"
  describe_machine >"$output/machine.md"
  python3 "$here/friction.py" "$output" || return 1
  printf 'page: %s\n' "$output/friction.md"
  if [[ ${SLANT_PUBLISH:-0} == 1 ]]; then cp "$output/friction.md" "$here/"; fi
  return "$status"
}
run_friction() { friction_problems friction; }
run_friction_variants() {
  friction_problems friction_variants coulomb interior_point --variants yes --rank 0
}
run_precision() { "$here/precision.sh" precision "$programs" "$output"; }
run_growth() { "$here/precision.sh" growth "$programs" "$output"; }
run_multilevel() { "$(program multilevel)" 8 12 16 >"$output/multilevel.csv"; }
run_multilevel_large() {
  "$(program multilevel)" --no-dual 24 32 >"$output/multilevel_large.csv"
}
run_multilevel_huge() {  # a process each, for its memory
  "$(program multilevel)" --no-direct --load lift 48 >"$output/multilevel_huge.csv" &&
    "$(program multilevel)" --no-direct --load lift 64 | tail -n +2 >>"$output/multilevel_huge.csv"
}
run_multilevel_linear() {
  if [[ ! -x $programs/peer_multigrid ]]; then
    printf 'nothing to do: PETSc was not found\n'
    return 0
  fi
  "$programs/peer_multigrid" 8 16 24 32 >"$output/multilevel_linear.csv"
}
run_wire() { "$(program kprgp_products)" wire 256 >"$output/wire.csv"; }
run_brick() {
  local status=0
  "$(program kprgp_products)" brick 4 6 8 >"$output/brick.csv" || status=$?
  draw_brick
  return "$status"
}

# Work and precision: relative energy error against the seconds of the iteration.
draw_brick() {
  command -v gnuplot >/dev/null || return 0
  gnuplot <<PLOT
set terminal pngcairo size 1200,420
set output "$output/brick.png"
set datafile separator ","
set logscale xy
set format "10^{%L}"
set xlabel "seconds of the iteration"
set ylabel "relative error in the energy norm"
set key left bottom
set multiplot layout 1,3
do for [load in "press pull lift"] {
  set title load
  plot for [k in "4 6 8"] "$output/brick.csv" skip 1 \
    using (strcol(1) eq load && strcol(2) eq k ? \$9 : NaN):10 with linespoints title "k = ".k
}
PLOT
}

# Runs that said `converged` with an error above 30 times what is allowed make the status 1.
run_stability() {
  local status=0
  rm -f "$output"/stability_*.csv  # parts of another run
  "$(program stability)" >"$output/stability.csv" 2>"$output/stability.txt" || status=$?
  tabulate_stability || status=$?
  draw_stability
  return "$status"
}
run_random_programs() {
  local status=0
  rm -f "$output"/random_programs_*.csv
  "$(program random_programs)" >"$output/random_programs.csv" 2>"$output/random_programs.txt" ||
    status=$?
  tabulate_stability || status=$?
  return "$status"
}

# Tables and summary line of what of the two is there.
tabulate_stability() {
  local page=()
  if [[ ${SLANT_PUBLISH:-0} == 1 ]]; then page=("$root/docs/stability.md"); fi
  python3 "$here/stability.py" "$output" ${page[@]+"${page[@]}"}
}

# The error reached against the condition number, for each tolerance.
draw_stability() {
  command -v gnuplot >/dev/null || return 0
  gnuplot <<PLOT
set terminal pngcairo size 1200,560 enhanced
set output "$output/stability.png"
set datafile separator ","
set logscale xy
set format "10^{%L}"
set xlabel "{/Symbol k} of the equilibrated matrix" offset 0,0.6
set ylabel "relative energy error"
set xrange [0.8:1e15]
set yrange [1e-17:1e3]
set key below Left reverse samplen 2
eps = 2.0**-52
is_double(method) = !strstrt(method, "float") && !strstrt(method, "long_double")
is_at(t) = strcol(9) eq "zero" && column(10) < 1.1 * t && column(10) > 0.9 * t && is_double(strcol(8))
set multiplot layout 1,2
do for [i in "8 15"] {
  t = 10.0**(-i)
  set title "tolerance 1e-".i.(i eq "15" ? ", below what is attainable" : "")
  plot \
    "$output/stability.csv" skip 1 using (is_at(t) && strcol(12) ne "right" && \
      strcol(12) ne "wrong" && strcol(12) ne "unclaimed" ? column(5) : NaN):13 \
      with points pt 7 ps 0.35 lc rgb "#b8b8b8" title "stopped, and said so", \
    "" skip 1 using (is_at(t) && (strcol(12) eq "right" || \
      strcol(12) eq "unclaimed") ? column(5) : NaN):13 \
      with points pt 7 ps 0.35 lc rgb "#2a7f3f" title "accurate", \
    "" skip 1 using (is_at(t) && strcol(12) eq "wrong" ? column(5) : NaN):13 \
      with points pt 7 ps 0.45 lc rgb "#c0282d" title "converged, and wrong", \
    eps * x with lines lc rgb "black" title "{/Symbol ek}", \
    eps * sqrt(x) with lines dt 2 lc rgb "black" title "{/Symbol e}{/Symbol \326}{/Symbol k}", \
    t with lines dt 3 lc rgb "black" notitle
}
PLOT
  printf 'figure: %s\n' "$output/stability.png"
  if [[ ${SLANT_PUBLISH:-0} == 1 ]]; then cp "$output/stability.png" "$root/docs/"; fi
}

# --- summary --------------------------------------------------------------------------------------

# macros HEADER NAME...: values of macros, joined by dots; nothing if the header is not there.
macros() {
  local header=$1 name values=()
  shift
  local text
  text=$(printf '#include <%s>\n' "$header" |
    g++ "@$tree/compile_flags.rsp" -I/usr/include/suitesparse -x c++ -E -dM - 2>/dev/null) ||
    return 0
  for name in "$@"; do
    values+=("$(awk -v n="$name" '$2 == n { gsub(/"/, "", $3); print $3 }' <<<"$text")")
  done
  local IFS=.
  printf '%s' "${values[*]}"
}

compilers() {
  local version
  printf 'g++\n'
  for version in 22 21 20 19 18 17 16; do
    if command -v "clang++-$version" >/dev/null; then
      printf 'clang++-%s\n' "$version"
      return
    fi
  done
}

describe_machine() {
  local compiler
  printf '| | |\n|---|---|\n'
  printf '| processor | %s, %s cores |\n' \
    "$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo 2>/dev/null | head -n 1)" "$(nproc --all)"
  for compiler in $(compilers); do
    printf '| %s | %s |\n' "$compiler" "$("$compiler" --version | head -n 1)"
  done
  printf '| Eigen | %s |\n' \
    "$(macros Eigen/Core EIGEN_WORLD_VERSION EIGEN_MAJOR_VERSION EIGEN_MINOR_VERSION)"
  printf '| Boost | %s |\n' "$(macros boost/version.hpp BOOST_LIB_VERSION | tr _ .)"
  printf '| CHOLMOD | %s |\n' \
    "$(macros cholmod.h CHOLMOD_MAIN_VERSION CHOLMOD_SUB_VERSION CHOLMOD_SUBSUB_VERSION)"
  printf '| build | %s, OPENBLAS_NUM_THREADS=%s, OPENBLAS_CORETYPE=%s |\n' \
    "$(sed -n 's/^CMAKE_CXX_FLAGS_RELEASE:[^=]*=//p' "$tree/CMakeCache.txt" 2>/dev/null)" \
    "$OPENBLAS_NUM_THREADS" "${OPENBLAS_CORETYPE-}"
}

# table: comma-separated values from standard input as a table of Markdown.
table() {
  awk -F, '{
    line = "|"; rule = "|"
    for (i = 1; i <= NF; i++) { line = line " " $i " |"; rule = rule "---|" }
    if (NR == 1) gsub(/_/, " ", line)
    print line
    if (NR == 1) print rule
  }'
}

# section NAME TITLE [FILTER...]: the table of NAME.csv, if it is there, perhaps only some rows.
section() {
  local name=$1 title=$2
  shift 2
  [[ -s $output/$name.csv ]] || return 0
  printf '\n## %s\n\n`./run bench --only %s`\n\n' "$title" "$name"
  if (($# == 0)); then set -- cat; fi
  "$@" <"$output/$name.csv" | table
}

# For each load and size the first row that is within 1e-6 of the reference.
accurate_rows() { awk -F, 'NR == 1 || ($10 <= 1e-6 && !seen[$1, $2]++)'; }

write_summary() {
  printf '# Benchmarks\n\n'
  describe_machine
  section composition "Instructions of one application"
  section slanting "Instructions of one application of F°(y)"
  section erased "Instructions of a solve with the types of the program forgotten"
  section compile_time "Compile time"
  section projections "Accuracy of projections"
  section example_1 "Example 1: products of KPRGP, relative reduced gradient 1e-6"
  section wire "Wire: active constraints, relative reduced gradient 1e-9"
  section newton_brick "Brick: products until the relative energy error is at most 1e-8"
  section newton_wire "Wire: Newton steps to a relative reduced gradient of 1e-10"
  section newton_floor "Where the symmetric Newton method stalls, in multiples of the rounding of its terms"
  section digits "Digits that rounding leaves, by random rounding"
  section interior_brick "Interior point: brick, relative energy error 1e-6, beside [K] Table 3"
  section interior_condition "Interior point: condition numbers along the iteration"
  section interior_crossover "Interior point, then symmetric Newton: lift to the last digits"
  section projector_steps "Conjugate projector: steps of conjugate gradients, relative residual 1e-8"
  section projector_contact "Schur complement contact algorithm: brick without friction, 1e-9"
  section projector_search "Schur complement contact algorithm: three bricks, rules for the active set"
  section projector_threads "Schur complement contact algorithm: four bricks, threads"
  section active_sets "Products of the published active set methods"
  section total_feti "Total-FETI, H/h = 4, relative accuracy 1e-10"
  section condensation "Contact with friction over one linear solve: brick, relative energy error at most 1e-8"
  section certificates "Certificates: claimed over true error, share of a solve, and an expert's lines"
  section load_steps "Twenty load steps, relative energy error 1e-8"
  section coulomb "Coulomb friction 0.3: products until the relative energy error is at most 1e-8"
  section coulomb_models "The same on two bricks and two plates"
  section multilevel "Multigrid: bricks with and without friction, processor seconds, tolerance 1e-8"
  section multilevel_large "Multigrid: the same, larger"
  section multilevel_huge "Multigrid: one load, seconds and memory"
  section multilevel_linear "Multigrid: contact with friction beside one linear solve with the same K"
  section robustness "Multigrid: contact with friction where it has a hard time"
  section friction "Coulomb friction problems of other people's simulations, natural map over |q| at most 1e-8"
  section brick "Brick: work until the relative energy error is at most 1e-6" accurate_rows
}

# The page of precision and growth, from what has been measured.
write_results() {
  [[ -s $output/precision.csv || -s $output/growth.csv ]] || return 0
  describe_machine >"$output/machine.md"
  local python=python3
  if /usr/bin/python3 -c 'import matplotlib' 2>/dev/null; then python=/usr/bin/python3; fi
  "$python" "$here/results.py" "$output" || return 0
  printf '\nresults: %s\n' "$output/RESULTS.md"
  [[ ${SLANT_PUBLISH:-0} == 1 ]] || return 0
  for file in RESULTS.md precision.png precision.csv growth.csv; do
    if [[ -s $output/$file ]]; then cp "$output/$file" "$here/"; fi
  done
}

status=0
for name in "${chosen[@]}"; do
  printf '\n=== %s ===\n' "$name"
  if ! "run_$name"; then
    printf 'run_all.sh: %s failed or missed a limit\n' "$name" >&2
    status=1
  fi
done
write_summary >"$output/summary.md"
printf '\nsummary: %s\n' "$output/summary.md"
write_results
exit "$status"
