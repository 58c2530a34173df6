// SPDX-License-Identifier: MIT
//
// SMALSE-M asks its archetypes for nothing more than the concepts name.
#include <slant/iteration/solve.hpp>
#include <slant/iteration/stopping.hpp>
#include <slant/methods/smalse.hpp>
#include <slant/testing/archetypes.hpp>

#include <doctest/doctest.h>

namespace smalse_archetypes_test {

namespace archetype = slant::testing::archetype;
using Eigen::VectorXd;

/// The vectors whose entries have a given sum.
struct of_given_sum {
  archetype::vector point;  // next to 0
  archetype::psd_operator Q, P;

  of_given_sum(Eigen::Index n, double sum)
      : point(VectorXd::Constant(n, sum / double(n))),
        Q(Eigen::MatrixXd::Constant(n, n, 1.0 / double(n))),
        P(Eigen::MatrixXd::Identity(n, n) - Eigen::MatrixXd::Constant(n, n, 1.0 / double(n))) {}
  [[nodiscard]] Eigen::Index size() const { return point.local().size(); }
  [[nodiscard]] archetype::psd_operator range_projector() const { return Q; }
  [[nodiscard]] archetype::psd_operator kernel_projector() const { return P; }
  [[nodiscard]] archetype::vector const& nearest() const { return point; }
};

TEST_CASE("operator, vector, set and affine space that can do the least") {
  archetype::psd_operator const A(
      Eigen::MatrixXd{{2.0, 1.0, 0.0}, {1.0, 2.0, 0.0}, {0.0, 0.0, 1.0}});
  archetype::vector const b(VectorXd{{3.0, -3.0, 0.0}});
  archetype::basic_active_set_set<VectorXd> const set(3);
  auto const qp = slant::separable_qp{A, b, set};
  of_given_sum const constraints(3, 3.0);
  auto const r =
      slant::solve(slant::smalse{qp, constraints}, archetype::vector(VectorXd{{1.0, 1.0, 1.0}}),
                   (slant::reduced_gradient_below(1e-11) && slant::feasibility_below(1e-11)) ||
                       slant::at_most(100));
  REQUIRE(r.converged());
  // x_1 = 0, x_0 + x_2 = 3, 2 x_0 - 3 = x_2.
  CHECK(r.x().local()(0) == doctest::Approx(2.0));
  CHECK(r.x().local()(1) == 0.0);
  CHECK(r.x().local()(2) == doctest::Approx(1.0));
}

}  // namespace smalse_archetypes_test
