// SPDX-License-Identifier: MIT
#include "mixture.hpp"

#include <slant/iteration/solve.hpp>
#include <slant/krylov/cg.hpp>
#include <slant/methods/kprgp.hpp>

#include <doctest/doctest.h>

#include <array>
#include <support/two_processes.hpp>

namespace kprgp_distributed_test {

using Eigen::VectorXd;
using test::shared_matrix;
using test::shared_vector;
using test::two_processes;

/// x, status and steps of one process.
struct outcome {
  VectorXd x;
  slant::status status = slant::status::running;
  slant::index iterations = 0;
};

/// Runs method(A, b, rank) with the first `split` unknowns on one process, the rest on the other.
template <class Run>
VectorXd together(Eigen::MatrixXd const& M, VectorXd const& b, Eigen::Index split, Run run) {
  two_processes group;
  std::array<outcome, 2> results;
  bool const finished = two_processes::run([&](int rank) {
    auto const first = rank == 0 ? 0 : split, count = rank == 0 ? split : b.size() - split;
    shared_matrix const A{M.middleRows(first, count)};
    shared_vector const part(group, rank, b.segment(first, count));
    auto const r = run(A, part, rank);
    results[std::size_t(rank)] = {r.x().local(), r.status, r.iterations()};
  });
  REQUIRE(finished);
  CHECK(results[0].status == slant::status::converged);
  CHECK(results[1].status == slant::status::converged);
  CHECK(results[0].iterations == results[1].iterations);
  VectorXd x(b.size());
  x << results[0].x, results[1].x;
  return x;
}

TEST_CASE("two processes take the same steps and reach the solution of one") {
  // 40 unknowns ≥ 0 in uneven parts: the constraints of either part end a step for both.
  for (Eigen::Index split : {20, 7, 33}) {
    CAPTURE(split);
    auto const M = test::with_spectrum(test::log_spaced(40, 200), unsigned(split));
    VectorXd const b = test::random_vector(40, 5);
    auto const A = test::spd(M);
    auto const stop = slant::reduced_gradient_below(1e-10) || slant::at_most(3000);
    auto const alone = slant::solve(slant::kprgp{slant::separable_qp{A, b, slant::half_lines(40)}},
                                    VectorXd(VectorXd::Zero(40)), stop);
    auto const x =
        together(M, b, split, [&](auto const& part_of_A, auto const& part_of_b, int rank) {
          auto x0 = part_of_b;
          x0.local().setZero();
          slant::kprgp_options<double> options;
          options.spectrum.seed = 1 + unsigned(rank);
          auto const set = slant::half_lines(part_of_A.rows());
          return slant::solve(slant::kprgp{slant::separable_qp{part_of_A, part_of_b, set}, options},
                              x0, stop);
        });
    CHECK((x - alone.x()).norm() <= 1e-8 * alone.x().norm());
  }
}

TEST_CASE("conjugate gradients too") {
  auto const M = test::with_spectrum(test::log_spaced(30, 100));
  VectorXd const b = test::random_vector(30, 5);
  auto const x = together(M, b, 11, [](auto const& A, auto const& part_of_b, int) {
    auto x0 = part_of_b;
    x0.local().setZero();
    return slant::solve(slant::cg{A, part_of_b}, x0,
                        slant::residual_below(1e-12) || slant::at_most(100));
  });
  CHECK((M * x - b).norm() <= 1e-11 * b.norm());
}

}  // namespace kprgp_distributed_test
