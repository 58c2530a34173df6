// SPDX-License-Identifier: MIT
#include <slant/iteration/solve.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/problems/separable_qp.hpp>
#include <slant/sets/contact_sets.hpp>

#include <doctest/doctest.h>

#include <array>
#include <krylov/spd_matrices.hpp>
#include <support/two_processes.hpp>

namespace symmetric_newton_distributed_test {

using Eigen::VectorXd;
using test::shared_matrix;
using test::shared_vector;
using test::two_processes;

TEST_CASE("two processes take the same Newton steps and reach the solution of one") {
  // 20 discs in uneven parts, some of them sliding in each.
  auto const stop = slant::reduced_gradient_below(1e-11) || slant::at_most(100);
  VectorXd const radii = VectorXd::LinSpaced(20, 0.1, 1.5), b = 3 * test::random_vector(40, 5);
  for (Eigen::Index blocks : {10, 3}) {
    CAPTURE(blocks);
    auto const M = test::with_spectrum(test::log_spaced(40, 200), unsigned(blocks));
    slant::separable_qp const qp{test::spd(M), b, slant::discs(radii)};
    auto const alone =
        slant::solve(slant::symmetric_newton{qp}, VectorXd(VectorXd::Zero(40)), stop);
    REQUIRE(alone.converged());
    REQUIRE(alone.state.face.curved_count() >= 5);

    two_processes group;
    std::array<VectorXd, 2> parts;
    std::array<slant::index, 2> steps{};
    bool const finished = two_processes::run([&](int rank) {
      auto const first = rank == 0 ? 0 : blocks, count = rank == 0 ? blocks : 20 - blocks;
      shared_matrix const part_of_A{M.middleRows(2 * first, 2 * count)};
      shared_vector const part_of_b(group, rank, b.segment(2 * first, 2 * count));
      auto x0 = part_of_b;
      x0.local().setZero();
      auto const part_of_set = slant::discs(VectorXd(radii.segment(first, count)));
      slant::separable_qp const part{part_of_A, part_of_b, part_of_set};
      auto const r = slant::solve(slant::symmetric_newton{part}, x0, stop);
      parts[std::size_t(rank)] = r.x().local();
      steps[std::size_t(rank)] = r.converged() ? r.iterations() : -1;
    });
    REQUIRE(finished);
    CHECK(steps[0] == steps[1]);
    CHECK(steps[0] >= 0);
    VectorXd x(40);
    x << parts[0], parts[1];
    CHECK((x - alone.x()).norm() <= 1e-9 * alone.x().norm());
  }
}

}  // namespace symmetric_newton_distributed_test
