// SPDX-License-Identifier: MIT
#include <slant/slant.hpp>

#include <support/testing.hpp>
#include "second_differences.hpp"

namespace unconstrained_start_test {

using slant::index;

auto positive(MatrixXd a) {
  return slant::matrix<slant::self_adjoint, slant::positive_definite>(std::move(a));
}

TEST_CASE("the projection of the minimum without constraints, as accurate as asked for") {
  index const n = 12;
  MatrixXd const A = test::second_differences(n);
  VectorXd const b = VectorXd::LinSpaced(n, -1, 1);
  VectorXd const x = test::solution_of(A, b);
  auto const a = slant::counted(positive(A));
  slant::separable_qp const qp{a, b, slant::half_lines(test::zeros(n))};
  auto const exact = slant::unconstrained_start(qp, 1e-12);
  CHECK((exact.x - x.cwiseMax(0)).norm() <= 1e-10 * x.norm());
  CHECK(exact.applications == a.applications());
  CHECK(exact.applications <= n);
  auto const rough = slant::unconstrained_start(qp, 0.5);
  CHECK(rough.applications < exact.applications);
  CHECK(slant::unconstrained_start(qp, 1e-12, 3).applications == 3);
  // With A⁻¹ as preconditioner one step is enough.
  auto const inverse = positive(A.inverse());
  CHECK(slant::unconstrained_start(qp, inverse, 1e-10).applications == 1);
}

TEST_CASE("nothing to do, no curvature, numbers out of range: a point of the set all the same") {
  index const n = 4;
  auto const set = slant::half_lines(VectorXd(VectorXd::Ones(n)));
  VectorXd const zero = VectorXd::Zero(n), b = VectorXd::Ones(n);
  slant::separable_qp const no_load{positive(test::second_differences(n)), zero, set};
  CHECK(slant::unconstrained_start(no_load).x == VectorXd::Ones(n));
  CHECK(slant::unconstrained_start(no_load).applications == 0);
  slant::separable_qp const flat{slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(
                                     MatrixXd(MatrixXd::Zero(n, n))),
                                 b, set};
  CHECK(slant::unconstrained_start(flat).x == VectorXd::Ones(n));
  slant::separable_qp const huge{positive(1e-300 * test::second_differences(n)),
                                 VectorXd(1e300 * b), set};
  CHECK(slant::unconstrained_start(huge).x.allFinite());
}

TEST_CASE("bad input") {
  slant::separable_qp const qp{positive(test::second_differences(3)), VectorXd(VectorXd::Ones(3)),
                               slant::half_lines(test::zeros(3))};
  CHECK_THROWS_AS((void)slant::unconstrained_start(qp, 0.0), slant::bad_input);
  CHECK_THROWS_AS((void)slant::unconstrained_start(qp, 0.1, -1), slant::bad_input);
  CHECK_THROWS_AS((void)slant::unconstrained_start(qp, positive(test::second_differences(4))),
                  slant::bad_input);
}

TEST_CASE("steps allocate nothing: the vectors are those of the start") {
  index const n = 12;
  VectorXd const b = VectorXd::LinSpaced(n, -1, 1);
  slant::separable_qp const qp{positive(test::second_differences(n)), b,
                               slant::half_lines(test::zeros(n))};
  auto const allocations_of = [&](index most) {
    slant::testing::allocation_guard const guard;
    auto const start = slant::unconstrained_start(qp, 1e-12, most);
    auto const allocations = guard.count();
    CHECK(start.applications == most);
    return allocations;
  };
  CHECK(allocations_of(1) == allocations_of(5));
}

}  // namespace unconstrained_start_test
