// SPDX-License-Identifier: MIT
#include <slant/slant.hpp>

#include <support/minimise.hpp>
#include <support/testing.hpp>

namespace lorentz_pairs_test {

/// min ½(x² + 1.06 y²) − bᵀx over the unit disc, by the radius as a function of the multiplier.
VectorXd on_the_circle(VectorXd const& b) {
  double low = 0, high = b.norm();
  VectorXd x = b;
  for (int k = 0; k < 200; ++k) {
    double const ν = (low + high) / 2;
    x = VectorXd{{b(0) / (1 + ν), b(1) / (1.06 + ν)}};
    (x.norm() > 1 ? low : high) = ν;
  }
  return x;
}

TEST_CASE("a disc whose solution lies aside of the way to it: 15 steps from anywhere") {
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(
      MatrixXd{{1.0, 0.0}, {0.0, 1.06}});
  auto const set = slant::discs(VectorXd{{1.0}});
  for (double const size : {1.01, 1.5, 2.0, 3.0, 1e3}) {
    CAPTURE(size);
    VectorXd const b = size * VectorXd{{0.6, 0.8}};
    slant::separable_qp const qp{A, b, set};
    for (double const far : {0.0, 1e8}) {
      auto const r =
          test::minimise(slant::interior_point{qp}, VectorXd(far * VectorXd{{1.0, 0.3}}), 1e-6, 40);
      CHECK(r.converged());
      CHECK(r.iterations() <= 18);
      CHECK((r.x() - on_the_circle(b)).norm() <= 2e-6);
    }
  }
}

template <class Block, class X>
void check_form(Block const& block, X const& x) {
  static_assert(slant::lorentz_block<Block>);
  auto const p = block.lorentz_point(x);
  auto const tail = p.tail(p.size() - 1);
  CHECK(block.inequality(x)(0) == doctest::Approx(tail.squaredNorm() - p(0) * p(0)));
  X const d = X::LinSpaced(x.size(), 0.1, 0.2);
  CHECK((block.lorentz_point(X(x + d)) - p - block.lorentz_matrix() * d).norm() <= 1e-14);
}

TEST_CASE("sections of the Lorentz cone: the first inequality is its determinant") {
  check_form(slant::ball<2>(3.0), Vector2d(0.5, -1.0));
  check_form(slant::ellipse<>(3.0, 0.5), Vector2d(0.5, -0.1));
  check_form(slant::second_order_cone<3>(0.3), Vector3d(2.0, 0.1, 0.2));
  Eigen::Matrix2d const turn{{0.6, -0.8}, {0.8, 0.6}};
  check_form(slant::shifted(slant::rotated(slant::scaled(0.25, slant::ellipse<>(3.0, 0.5)), turn),
                            Vector2d(1.0, 2.0)),
             Vector2d(1.1, 2.05));
  // Its sides are flat: two multipliers do.
  static_assert(!slant::lorentz_block<slant::plane_cone<>>);
}

}  // namespace lorentz_pairs_test
