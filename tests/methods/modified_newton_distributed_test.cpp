// SPDX-License-Identifier: MIT
#include <slant/iteration/solve.hpp>
#include <slant/methods/mssn.hpp>
#include <slant/problems/separable_qp.hpp>
#include <slant/sets/contact_sets.hpp>

#include <doctest/doctest.h>

#include <array>
#include <krylov/spd_matrices.hpp>
#include <support/two_processes.hpp>

namespace modified_newton_distributed_test {

using Eigen::VectorXd;
using test::shared_matrix;
using test::shared_vector;
using test::two_processes;

TEST_CASE("two processes take the same steps and reach the solution of one") {
  // 40 unknowns ≥ 0 in uneven parts: what leaves the set in either part counts for both.
  auto const stop = slant::reduced_gradient_below(1e-10) || slant::at_most(3000);
  auto const check = [&](Eigen::Index split, auto make) {
    CAPTURE(split);
    auto const M = test::with_spectrum(test::log_spaced(40, 200), unsigned(split));
    VectorXd const b = test::random_vector(40, 5);
    auto const A = test::spd(M);
    auto const set = slant::half_lines(40);
    slant::separable_qp const qp{A, b, set};
    auto const alone = slant::solve(make(qp), VectorXd(VectorXd::Zero(40)), stop);
    REQUIRE(alone.converged());

    two_processes group;
    std::array<VectorXd, 2> parts;
    std::array<slant::index, 2> steps{};
    bool const finished = two_processes::run([&](int rank) {
      auto const first = rank == 0 ? 0 : split, count = rank == 0 ? split : 40 - split;
      shared_matrix const part_of_A{M.middleRows(first, count)};
      shared_vector const part_of_b(group, rank, b.segment(first, count));
      auto x0 = part_of_b;
      x0.local().setZero();
      auto const part_of_set = slant::half_lines(count);
      slant::separable_qp const part{part_of_A, part_of_b, part_of_set};
      auto const r = slant::solve(make(part), x0, stop);
      parts[std::size_t(rank)] = r.x().local();
      steps[std::size_t(rank)] = r.converged() ? r.iterations() : -1;
    });
    REQUIRE(finished);
    CHECK(steps[0] == steps[1]);
    CHECK(steps[0] >= 0);
    VectorXd x(40);
    x << parts[0], parts[1];
    CHECK((x - alone.x()).norm() <= 1e-8 * alone.x().norm());
  };
  for (Eigen::Index split : {20, 7}) {
    check(split, [](auto const& qp) { return slant::imssn(qp, {.step_length = 1.9}); });
    check(split, [](auto const& qp) { return slant::gimssn(qp, {.step_length = 1.9}); });
  }
}

}  // namespace modified_newton_distributed_test
