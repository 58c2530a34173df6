// SPDX-License-Identifier: MIT
#include <slant/slanting/coulomb_law.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "slanting_support.hpp"

namespace coulomb_law_test {

using slanting_support::dense;
using slanting_support::dense_slant;
using slanting_support::random_vector;

/// (a, b) ↦ (a + c b², a b).
struct quadratic {
  using scalar = double;
  static constexpr int dimension = 2;
  double c = 1;
  [[nodiscard]] quadratic with(double value) const {
    if (!(value >= 0)) throw slant::bad_input("c", slant::detail::show(value), "a number >= 0");
    return {value};
  }
  [[nodiscard]] Vector2d value(Vector2d const& y) const {
    return {y(0) + c * y(1) * y(1), y(0) * y(1)};
  }
  [[nodiscard]] Eigen::Matrix2d slant(Vector2d const& y) const {
    Eigen::Matrix2d g;
    g << 1, 2 * c * y(1), y(1), y(0);
    return g;
  }
};

TEST_CASE("blockwise: values, block diagonal derivative, laws") {
  auto const f = slant::blockwise(quadratic{}, VectorXd{{2.0, 3.0}});
  CHECK(f.rows() == 4);
  CHECK(f.block(1).c == 3);
  VectorXd const y{{1.0, 2.0, 3.0, -1.0}};
  CHECK(slant::evaluate(f, y) == VectorXd{{9.0, 2.0, 6.0, -3.0}});
  MatrixXd expected = MatrixXd::Zero(4, 4);
  expected.block<2, 2>(0, 0) << 1, 8, 2, 1;
  expected.block<2, 2>(2, 2) << 1, -6, -1, 3;
  CHECK(dense_slant(f, y) == expected);
  slant::testing::check_slanting_laws(f, y, test::zeros(4));
  auto const g = f.slant(y);
  slant::testing::check_operator_laws(g);  // the adjoint among them
  static_assert(!slant::declares_self_adjoint<decltype(g)>);
}

TEST_CASE("blockwise: new parameters and renewal in place allocate nothing") {
  auto f = slant::blockwise(quadratic{}, VectorXd{{2.0, 3.0}});
  VectorXd const y = random_vector(4, 1), c{{5.0, 7.0}};
  VectorXd v(4);
  auto w = slant::workspace(f, y);
  auto g = f.slant(VectorXd::Zero(4).eval());
  CHECK(test::allocations_of([&] {
          f.update(c);
          slant::evaluate(f, y, v, w);
          slant::update_slant(f, y, g, w);
        }) == 0);
  auto const again = slant::blockwise(quadratic{}, c);
  CHECK(v == slant::evaluate(again, y));
  CHECK(dense(g, y) == dense_slant(again, y));
}

TEST_CASE("blockwise: the block to blame is named") {
  CHECK(SLANT_COMPLAINT(slant::blockwise(quadratic{}, VectorXd{{2.0, -3.0}})) ==
        "c[1]: got -3, expected a number >= 0");
}

}  // namespace coulomb_law_test
