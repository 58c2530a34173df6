// SPDX-License-Identifier: MIT
//
// PETSc/TAO's solvers for bounds on a problem that bench_*_precision has exported:
//
//     peer_tao FOLDER [METHOD...] [--tolerances LIST] [--repeats N] [--limit S]
//
// METHOD: gpcg, tron, blmvm, bntr. The tolerance is gttol, ‖projected gradient‖ relative to that at
// the start, 0. Linear systems: CG, preconditioned by Jacobi for a dense A (as it is for the bodies
// of contact problems) and by incomplete Cholesky for a sparse one. Everything else is TAO's
// default. Discs are not among its sets; there it says so and is done.

#include <petsctao.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "../support/arguments.hpp"
#include "peer_case.hpp"

namespace {

using namespace benchmarks;

/// Throws std::runtime_error for an error of PETSc.
void check(PetscErrorCode code) {
  if (code != 0) throw std::runtime_error("PETSc: error " + std::to_string(int(code)));
}

/// Row by row is column by column, as A is symmetric. The Mat and Vecs look at our memory.
struct petsc_problem {
  Mat A = nullptr;
  Vec b = nullptr, image = nullptr, lower = nullptr, upper = nullptr, x = nullptr;

  explicit petsc_problem(peer_case const& c) {
    auto const n = static_cast<PetscInt>(c.size());
    if (c.is_dense) {
      check(MatCreateSeqDense(PETSC_COMM_SELF, n, n, const_cast<double*>(c.dense.data()), &A));
    } else {
      auto const& S = c.sparse;
      check(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, n, n, const_cast<int*>(S.outerIndexPtr()),
                                      const_cast<int*>(S.innerIndexPtr()),
                                      const_cast<double*>(S.valuePtr()), &A));
    }
    check(MatSetOption(A, MAT_SPD, PETSC_TRUE));
    auto const make = [&](Vec& v, Eigen::VectorXd const& from) {
      check(VecCreateSeq(PETSC_COMM_SELF, n, &v));
      double* to = nullptr;
      check(VecGetArray(v, &to));
      for (Eigen::Index i = 0; i < from.size(); ++i)
        to[i] = std::isinf(from[i]) ? std::copysign(PETSC_INFINITY, from[i]) : from[i];
      check(VecRestoreArray(v, &to));
    };
    make(b, c.problem.b);
    make(lower, c.problem.set.lower);
    make(upper, c.problem.set.upper);
    make(x, Eigen::VectorXd::Zero(c.size()));
    make(image, Eigen::VectorXd::Zero(c.size()));
  }
  petsc_problem(petsc_problem const&) = delete;
  petsc_problem& operator=(petsc_problem const&) = delete;
  ~petsc_problem() {
    MatDestroy(&A);
    for (Vec* v : {&b, &image, &lower, &upper, &x}) VecDestroy(v);
  }
};

/// q = ½ xᵀA x − bᵀx, gradient A x − b.
PetscErrorCode objective(Tao, Vec x, PetscReal* q, Vec gradient, void* context) {
  auto const* p = static_cast<petsc_problem const*>(context);
  PetscScalar xAx = 0, bx = 0;
  check(MatMult(p->A, x, p->image));
  check(VecDot(x, p->image, &xAx));
  check(VecDot(x, p->b, &bx));
  *q = xAx / 2 - bx;
  check(VecWAXPY(gradient, -1, p->b, p->image));
  return 0;
}
PetscErrorCode hessian(Tao, Vec, Mat, Mat, void*) {
  return 0;
}

/// Ends a run whose time is over, or that no longer gets any better: what it then has is what it
/// can reach, and its time should not be the limit.
struct patience {
  double deadline;
  int steps;  ///< without a smaller gradient
  double least = HUGE_VAL;
  int since = 0;
  bool late = false;
};
PetscErrorCode watch(Tao tao, void* context) {
  auto& p = *static_cast<patience*>(context);
  check(TaoDefaultConvergenceTest(tao, nullptr));
  PetscReal gradient = 0;
  check(TaoGetSolutionStatus(tao, nullptr, nullptr, &gradient, nullptr, nullptr, nullptr));
  p.since = gradient < p.least ? 0 : p.since + 1;
  p.least = std::min(p.least, gradient);
  p.late = cpu_seconds() > p.deadline;
  if (p.late || p.since > p.steps) check(TaoSetConvergedReason(tao, TAO_DIVERGED_USER));
  return 0;
}

outcome solve(peer_case const& c, TaoType type, request const& asked) {
  petsc_problem p(c);
  Tao tao = nullptr;
  check(TaoCreate(PETSC_COMM_SELF, &tao));
  check(TaoSetType(tao, type));
  check(TaoSetSolution(tao, p.x));
  check(TaoSetObjectiveAndGradient(tao, nullptr, objective, &p));
  check(TaoSetHessian(tao, p.A, p.A, hessian, &p));
  check(TaoSetVariableBounds(tao, p.lower, p.upper));
  check(TaoSetTolerances(tao, 0, 0, asked.tolerance));
  check(TaoSetMaximumIterations(tao, 100000));
  check(TaoSetMaximumFunctionEvaluations(tao, 1000000));
  patience limits{asked.deadline, std::string(type) == TAOBLMVM ? 500 : 20};
  check(TaoSetConvergenceTest(tao, watch, &limits));
  check(TaoSetFromOptions(tao));
  KSP ksp = nullptr;
  check(TaoGetKSP(tao, &ksp));
  if (ksp != nullptr) {
    PC pc = nullptr;
    check(KSPGetPC(ksp, &pc));
    check(PCSetType(pc, c.is_dense ? PCJACOBI : PCICC));
  }
  check(TaoSolve(tao));
  TaoConvergedReason reason = TAO_CONTINUE_ITERATING;
  PetscInt iterations = 0;
  check(TaoGetConvergedReason(tao, &reason));
  check(TaoGetTotalIterationNumber(tao, &iterations));
  double const* values = nullptr;
  check(VecGetArrayRead(p.x, &values));
  outcome result{Eigen::Map<Eigen::VectorXd const>(values, c.size()), iterations, "stalled"};
  check(VecRestoreArrayRead(p.x, &values));
  check(TaoDestroy(&tao));
  if (reason > 0) result.status = "converged";
  if (limits.late) result.status = "time_limit";
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    arguments const given(argc, argv, {"tolerances", "repeats", "limit"});
    if (given.words().empty()) throw std::invalid_argument("usage: peer_tao FOLDER [METHOD...]");
    peer_case const c(given.words()[0]);
    std::fprintf(stderr, "PETSc/TAO %d.%d.%d\n", PETSC_VERSION_MAJOR, PETSC_VERSION_MINOR,
                 PETSC_VERSION_SUBMINOR);
    if (c.has_discs()) {
      std::fprintf(stderr, "PETSc/TAO: has no discs among its sets, %s is left out\n",
                   c.problem.labels.scene.c_str());
      return 0;
    }
    auto how = given.how();
    how.before = c.seconds_elsewhere();
    // A process of its own needs no daemon of MPI beside it.
    setenv("OMPI_MCA_ess_singleton_isolated", "1", 1);
    for (TaoType const type : {TAOGPCG, TAOTRON, TAOBLMVM, TAOBNTR}) {
      if (!given.wants(type, 1)) continue;
      measure_method(
          {.library = "TAO", .method = type, .formulation = c.formulation()}, c.problem.labels, how,
          [&](request const& asked) { return solve(c, type, asked); },
          [&](Eigen::VectorXd const& x) { return c.error(x); },
          [] { check(PetscInitializeNoArguments()); });
    }
    given.require_known(1);
  } catch (std::exception const& failure) {
    std::fprintf(stderr, "peer_tao: %s\n", failure.what());
    return 2;
  }
}
