// SPDX-License-Identifier: MIT
#include <slant/methods/solve_program.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/problems/separable_qp.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>

#include <doctest/doctest.h>
#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <optional>
#include <oracle/random_programs.hpp>
#include <string>
#include <support/program_sets.hpp>

namespace solve_program_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Half lines and discs around a known solution: pressed, open, sliding and sticking nodes, with
/// the stiffness of the nodes from 1 to `contrast`.
struct known_program {
  MatrixXd A;
  VectorXd b, g, x;

  known_program(int m, double contrast) {
    int const n = 3 * m;
    A = MatrixXd::Constant(n, n, 0.1) + MatrixXd::Identity(n, n);
    VectorXd s(n);
    for (int i = 0; i < m; ++i) {
      double const size = std::exp2(std::round(std::log2(contrast) * i / (2.0 * (m - 1))));
      s(i) = s(m + 2 * i) = s(m + 2 * i + 1) = size;
    }
    A = (s.asDiagonal() * A * s.asDiagonal()).eval();
    g = VectorXd::Ones(m);
    x.resize(n);
    VectorXd force = VectorXd::Zero(n);
    for (int i = 0; i < m; ++i) {
      bool const open = i % 2 == 0, slides = i % 3 == 0;
      x(i) = open ? 0 : 1;
      force(i) = open ? s(i) : 0;
      x.segment<2>(m + 2 * i) << (slides ? 1 : 0.25), 0;
      if (slides) force(m + 2 * i) = -s(i);
    }
    b = A * x - force;
  }
  [[nodiscard]] auto program() const {
    return slant::separable_qp{slant::matrix<slant::self_adjoint, slant::positive_definite>(A), b,
                               slant::cartesian(slant::half_lines(g.size()), slant::discs(g))};
  }
  [[nodiscard]] double error(VectorXd const& y) const {
    VectorXd const e = y - x;
    return std::sqrt(e.dot(A * e) / x.dot(A * x));
  }
};

TEST_CASE("solve(qp, tolerance): the error that is asked for, and what is said of it") {
  known_program const p(6, 1);
  auto const qp = p.program();
  for (double const tolerance : {1e-2, 1e-6, 1e-12}) {
    auto const run = slant::solve(qp, tolerance);
    CHECK(run.converged());
    CHECK_FALSE(run.scaled);
    CHECK(p.error(run.x()) <= tolerance);
    CHECK(p.error(run.x()) <= 2 * run.error.relative() + 1e-15);
    CHECK(run.reason.find("relative energy error") != std::string::npos);
    CHECK(run.work.operator_applications > run.iterations());
  }
  CHECK_THROWS_AS((void)slant::solve(qp, -1.0), slant::bad_input);
  CHECK_THROWS_AS((void)slant::solve(qp, 1e-8, -1), slant::bad_input);
  CHECK(slant::solve(qp, 1e-8, 1).status == slant::status::iteration_limit);
}

TEST_CASE(
    "solve(qp, tolerance): stiffness of the blocks over twelve orders of magnitude is scaled") {
  known_program const p(6, 1e12);
  auto const run = slant::solve(p.program(), 1e-9);
  CHECK(run.converged());
  CHECK(run.scaled);
  CHECK(p.error(run.x()) <= 1e-9);
  CHECK(run.iterations() <= 30);
}

TEST_CASE("solve(qp, M, tolerance): a preconditioner saves applications") {
  known_program const p(8, 16);
  MatrixXd const inverse = p.A.inverse();
  auto const qp = p.program();
  auto const M = slant::matrix<slant::self_adjoint, slant::positive_definite>(
      MatrixXd(0.5 * (inverse + inverse.transpose())));
  auto const run = slant::solve(qp, M, 1e-10);
  CHECK(run.converged());
  CHECK(p.error(run.x()) <= 1e-10);
  CHECK(run.work.operator_applications <= slant::solve(qp, 1e-10).work.operator_applications);
}

TEST_CASE("solve(qp, 1e-8): hard programs, degenerate and singular ones, tiny ones") {
  for (auto const suite : {oracle::program_suite::nasty, oracle::program_suite::degenerate,
                           oracle::program_suite::tiny}) {
    for (std::uint64_t k = 0; k < 40; ++k) {
      CAPTURE(int(suite));
      CAPTURE(k);
      auto const p = oracle::make_program(suite, k);
      auto const set = test::set_of(p);
      auto const A = slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(p.A);
      slant::separable_qp const qp{A, p.b, set};
      auto const run = slant::solve(qp, 1e-8);
      CHECK(run.converged());
      auto const exact = p.definite ? oracle::exact_solution(p) : std::nullopt;
      if (exact) {
        double const error = oracle::energy_error(p, run.x(), *exact);
        CHECK(error <= 2e-8);
        CHECK(error <= 5 * run.error.relative() + 1e-13);
      } else {
        CHECK(std::min(oracle::relative_residual(p, run.x()) / 1e-8,
                       oracle::floors_above(p, run.x()) / 10) <= 30);
      }
    }
  }
}

TEST_CASE("solve(qp, 0): the digits that there are, as `stalled`") {
  known_program const p(4, 1);
  auto const run = slant::solve(p.program(), 0.0);
  CHECK((run.status == slant::status::stalled || run.error.bound == 0));
  CHECK(p.error(run.x()) <= 1e-14);
}

}  // namespace solve_program_test
