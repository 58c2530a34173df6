// SPDX-License-Identifier: MIT
#include <slant/iteration/solve.hpp>
#include <slant/methods/interior_point.hpp>
#include <slant/sets/contact_sets.hpp>
#include <slant/testing/archetypes.hpp>

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <krylov/spd_matrices.hpp>
#include <support/two_processes.hpp>

namespace interior_point_vectors_test {

using Eigen::VectorXd;
using test::shared_matrix;
using test::shared_vector;
using test::two_processes;

TEST_CASE("archetypes: the least that operator and vector can do") {
  namespace archetype = slant::testing::archetype;
  Eigen::MatrixXd const M{{4.0, 1.0}, {1.0, 4.0}};
  archetype::psd_operator const A(M);
  archetype::vector const b(VectorXd{{8.0, 8.0}}), zero(VectorXd::Zero(2));
  auto const set = slant::discs(VectorXd{{1.0}});
  slant::separable_qp const qp{A, b, set};
  auto const r = slant::solve(slant::interior_point{qp}, zero,
                              slant::reduced_gradient_below(1e-10) || slant::at_most(50));
  REQUIRE(r.converged());
  CHECK((r.x().local() - VectorXd{{std::sqrt(0.5), std::sqrt(0.5)}}).norm() <= 1e-9);
}

TEST_CASE("two processes take the steps of one") {
  VectorXd const radii = VectorXd::LinSpaced(20, 0.1, 1.5), b = 3 * test::random_vector(40, 5);
  auto const M = test::with_spectrum(test::log_spaced(40, 200), 3);
  // The diagonal is estimated by other signs in each part: steps agree, their digits do not.
  auto const stop = slant::reduced_gradient_below(1e-9) || slant::at_most(60);
  slant::separable_qp const qp{test::spd(M), b, slant::discs(radii)};
  auto const alone = slant::solve(slant::interior_point{qp}, VectorXd(VectorXd::Zero(40)), stop);
  REQUIRE(alone.converged());
  two_processes group;
  std::array<VectorXd, 2> parts;
  std::array<slant::index, 2> steps{}, constraints{};
  bool const finished = two_processes::run([&](int rank) {
    auto const first = rank == 0 ? 0 : 13, count = rank == 0 ? 13 : 7;
    shared_matrix const part_of_A{M.middleRows(2 * first, 2 * count)};
    shared_vector const part_of_b(group, rank, b.segment(2 * first, 2 * count));
    auto x0 = part_of_b;
    x0.local().setZero();
    auto const part_of_set = slant::discs(VectorXd(radii.segment(first, count)));
    slant::separable_qp const part{part_of_A, part_of_b, part_of_set};
    auto const r = slant::solve(slant::interior_point{part}, x0, stop);
    parts[std::size_t(rank)] = r.x().local();
    steps[std::size_t(rank)] = r.converged() ? r.iterations() : -1;
    constraints[std::size_t(rank)] = r.state.constraints;
  });
  REQUIRE(finished);
  CHECK(steps[0] == steps[1]);
  CHECK(steps[0] >= 0);
  CHECK(constraints[0] == 20);
  VectorXd x(40);
  x << parts[0], parts[1];
  CHECK((x - alone.x()).norm() <= 1e-7 * alone.x().norm());
}

}  // namespace interior_point_vectors_test
