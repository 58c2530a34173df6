// SPDX-License-Identifier: MIT
//
// One linear solve K u = f by conjugate gradients with multigrid, ours and PETSc's, beside contact
// with friction on the same K, the steel brick with K × 3K × K cells:
//
//     peer_multigrid [K...]     8 16 24 without any
//     peer_multigrid --rows K   the linear solves alone, as rows of ../support/precision_table.hpp
//
// The first prints comma-separated values: solver, k, unknowns, steps, cycles, processor seconds of the
// hierarchy and of everything (the hierarchy included), the relative error in the energy norm. The
// linear solves end at a relative residual of 1e-8, contact::solve (loads press, pull, lift) at a
// certified energy error of 1e-8. GAMG is given the block size and the rigid body motions, hypre's
// BoomerAMG the block size; everything else of both is PETSc's default, but for the strong threshold
// 0.5 that hypre's manual names for three dimensions. Seconds are the least of three runs. Exit status
// 1 if a linear solve has not converged, or contact with friction takes more than three times the
// seconds of our linear solve, from K = 16 on.

#include <slant/contact/solve.hpp>
#include <slant/krylov/cg.hpp>

#include <petscksp.h>
#include <fem/steel_brick.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "../support/cpu_clock.hpp"
#include "../support/precision_table.hpp"

namespace {

using vector = Eigen::VectorXd;
using sparse = Eigen::SparseMatrix<double>;
namespace contact = slant::contact;
using benchmarks::stopwatch;

double energy(sparse const& K, vector const& u) {
  return std::sqrt(u.dot(vector(K * u)));
}

/// Throws std::runtime_error for an error of PETSc.
void check(PetscErrorCode code) {
  if (code != 0) throw std::runtime_error("PETSc: error " + std::to_string(int(code)));
}

struct timed {
  vector u;
  bool converged = false;
  slant::index steps = 0, cycles = 0;
  double setup = 0, all = 0;  ///< processor seconds
  double error = 0;           ///< as certified, of contact only
};

/// The quickest of three runs: the others waited for something.
template <class Run>
timed quickest(Run const& run) {
  timed best = run();
  for (int i = 0; i < 2; ++i) {
    timed other = run();
    if (other.all < best.all) best = std::move(other);
  }
  return best;
}

/// K u = f by our CG with our multigrid.
timed by_us(sparse const& K, vector const& f, Eigen::MatrixXd const& motions) {
  stopwatch const whole;
  slant::multigrid const M(K, motions);
  double const setup = whole.seconds();
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(K);
  auto r = slant::solve(slant::cg{A, f, M}, vector(vector::Zero(f.size())),
                        slant::residual_below(1e-8) || slant::at_most(500));
  double const all = whole.seconds();
  return {r.x(), r.converged(), r.iterations(), r.iterations(), setup, all};
}
/// Contact with friction, K never factored; its hierarchy is not timed by itself.
timed with_friction(sparse const& K, contact::data<double> const& c,
                    contact::node_layout<double> const& layout) {
  contact::solve_options<double> o{.tolerance = 1e-8};
  o.layout = layout;
  o.route = contact::solution_route::iterate;
  stopwatch const whole;
  auto r = contact::solve(K, c, o);
  double const all = whole.seconds();
  return {std::move(r.u), r.converged(), r.iterations,      r.work.inner_iterations,
          std::nan(""),   all,           r.error.relative()};
}

/// K u = f by PETSc's CG, preconditioned by `type`.
timed by_petsc(sparse const& K, vector const& f, Eigen::MatrixXd const& motions, PCType type) {
  auto const n = static_cast<PetscInt>(K.rows());
  timed result{vector::Zero(n)};
  stopwatch const whole;
  // By columns is by rows, as K is symmetric. Mat and Vecs look at our memory.
  Mat A = nullptr;
  check(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, n, n, const_cast<int*>(K.outerIndexPtr()),
                                  const_cast<int*>(K.innerIndexPtr()),
                                  const_cast<double*>(K.valuePtr()), &A));
  check(MatSetOption(A, MAT_SPD, PETSC_TRUE));
  check(MatSetBlockSize(A, 3));
  std::vector<Vec> modes(static_cast<std::size_t>(motions.cols()));
  for (Eigen::Index j = 0; j < motions.cols(); ++j) {
    check(VecCreateSeqWithArray(PETSC_COMM_SELF, 3, n, motions.col(j).data(),
                                &modes[static_cast<std::size_t>(j)]));
  }
  MatNullSpace near = nullptr;
  check(MatNullSpaceCreate(PETSC_COMM_SELF, PETSC_FALSE, PetscInt(modes.size()), modes.data(),
                           &near));
  check(MatSetNearNullSpace(A, near));
  Vec b = nullptr, x = nullptr;
  check(VecCreateSeqWithArray(PETSC_COMM_SELF, 3, n, f.data(), &b));
  check(VecCreateSeqWithArray(PETSC_COMM_SELF, 3, n, result.u.data(), &x));
  KSP ksp = nullptr;
  PC pc = nullptr;
  check(KSPCreate(PETSC_COMM_SELF, &ksp));
  check(KSPSetOperators(ksp, A, A));
  check(KSPSetType(ksp, KSPCG));
  check(KSPSetNormType(ksp, KSP_NORM_UNPRECONDITIONED));
  check(KSPSetTolerances(ksp, 1e-8, 0, PETSC_DEFAULT, 500));
  check(KSPGetPC(ksp, &pc));
  check(PCSetType(pc, type));
  check(KSPSetFromOptions(ksp));
  check(KSPSetUp(ksp));
  result.setup = whole.seconds();
  check(KSPSolve(ksp, b, x));
  result.all = whole.seconds();
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  PetscInt steps = 0;
  check(KSPGetConvergedReason(ksp, &reason));
  check(KSPGetIterationNumber(ksp, &steps));
  result.converged = reason > 0;
  result.steps = result.cycles = steps;
  check(KSPDestroy(&ksp));
  check(MatDestroy(&A));
  check(MatNullSpaceDestroy(&near));
  for (Vec* v : {&b, &x}) check(VecDestroy(v));
  for (Vec& v : modes) check(VecDestroy(&v));
  return result;
}

/// A line of a linear solve by `library`, preconditioned by `type`.
void print_row(char const* library, char const* type, int k, timed const& r, double error) {
  benchmarks::precision_row row{
      .library = library, .method = type, .formulation = "K u = f by multigrid"};
  row.tolerance = 1e-8;
  row.seconds = r.all;
  row.error = error;
  row.products = double(r.steps);
  row.status = r.converged ? "converged" : "failed";
  row.print({"lift", std::to_string(k), r.u.size(), std::nan("")});
}

void print(std::string const& solver, int k, timed const& r, double error) {
  std::printf("%s,%d,%td,%td,%td,%.3f,%.3f,%.1e\n", solver.c_str(), k, r.u.size(), r.steps,
              r.cycles, r.setup, r.all, error);
  std::fflush(stdout);
}

bool measure(int k, bool as_rows) {
  auto const scene = fem::make_steel_brick({.k = k, .load = fem::brick_load::lift});
  auto const& K = scene.K;
  auto const layout = contact::layout_of(scene.mesh.nodes, scene.unknowns.first);
  auto const motions = contact::detail::rigid_motions(layout);
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(K);

  auto const ours = quickest([&] { return by_us(K, scene.f, motions); });
  slant::multigrid const M(K, motions);
  auto const exact = slant::solve(slant::cg{A, scene.f, M}, ours.u,
                                  slant::residual_below(1e-13) || slant::at_most(200));
  double const size = energy(K, exact.x());
  auto const show = [&](char const* library, char const* type, timed const& r) {
    double const error = energy(K, r.u - exact.x()) / size;
    if (as_rows) return print_row(library, type, k, r, error);
    print(std::string(library) + " " + type, k, r, error);
  };
  show("slant", "cg", ours);
  bool good = ours.converged;
  for (PCType const type : {PCGAMG, PCHYPRE}) {
    auto const r = quickest([&] { return by_petsc(K, scene.f, motions, type); });
    show("PETSc", type, r);
    good = good && r.converged;
  }
  if (as_rows) return good;
  for (auto const load : fem::brick_loads) {
    auto const loaded = fem::make_steel_brick({.k = k, .load = load});
    contact::data<double> const c{loaded.N, loaded.T, loaded.f, loaded.d, loaded.g};
    auto const r = quickest([&] { return with_friction(loaded.K, c, layout); });
    print("slant friction " + std::string(name_of(load)), k, r, r.error);
    good = good && r.converged && (k < 16 || r.all <= 3 * ours.all);
  }
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    // A process of its own needs no daemon of MPI beside it.
    setenv("OMPI_MCA_ess_singleton_isolated", "1", 1);
    check(PetscInitializeNoArguments());
    check(PetscOptionsSetValue(nullptr, "-pc_hypre_boomeramg_strong_threshold", "0.5"));
    bool const as_rows = argc > 1 && std::string_view(argv[1]) == "--rows";
    std::vector<int> sizes;
    for (int i = as_rows ? 2 : 1; i < argc; ++i) sizes.push_back(std::atoi(argv[i]));
    if (sizes.empty()) sizes = {8, 16, 24};
    if (*std::min_element(sizes.begin(), sizes.end()) < 1) {
      throw std::invalid_argument("usage: peer_multigrid [--rows] [K...], sizes >= 1");
    }
    if (!as_rows) std::printf("solver,k,unknowns,steps,cycles,setup_seconds,seconds,error\n");
    bool good = true;
    for (int const k : sizes) good = measure(k, as_rows) && good;
    return good ? EXIT_SUCCESS : EXIT_FAILURE;
  } catch (std::exception const& failure) {
    std::fprintf(stderr, "peer_multigrid: %s\n", failure.what());
    return 2;
  }
}
