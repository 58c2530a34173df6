// SPDX-License-Identifier: MIT
#include <slant/contact/friction/friction_newton.hpp>

#include <Eigen/Dense>

#include <doctest/doctest.h>

#include <cmath>

namespace block_lu_test {

using lu = slant::contact::detail::block_lu<2, double>;

/// A row of blocks coupled to their neighbours, or all to all.
struct matrix {
  slant::index rows;
  bool full;
  double corner = 4;

  template <class Put>
  void assemble(Put const& put) const {
    for (slant::index i = 0; i < rows; ++i) {
      for (slant::index j = 0; j < rows; ++j) {
        if (!full && std::abs(i - j) > 1) continue;
        Eigen::Matrix2d b;
        b << 0.5, 0.1 * double(i % 3), -0.2, 0.3 * double(j % 2);
        b /= double(rows);
        if (i == j) b.diagonal().setConstant(i == 0 ? corner : 4);
        put(i, j, b);
      }
    }
  }
  [[nodiscard]] Eigen::MatrixXd dense() const {
    Eigen::MatrixXd m = Eigen::MatrixXd::Zero(2 * rows, 2 * rows);
    assemble([&](auto i, auto j, auto const& b) { m.block<2, 2>(2 * i, 2 * j) = b; });
    return m;
  }
  [[nodiscard]] bool factor(lu& f) const {
    return f.factor(rows, full ? rows * rows : 3 * rows - 2, [&](auto put) { assemble(put); });
  }
};

TEST_CASE("LU of blocks: small or full ones dense, others sparse, one after the other") {
  lu f;
  for (matrix const m : {matrix{3, true}, {60, false}, {40, true}, {10, false}, {60, false}}) {
    REQUIRE(m.factor(f));
    CHECK(f.is_sparse() == (m.rows == 60));
    Eigen::VectorXd const x = Eigen::VectorXd::LinSpaced(2 * m.rows, -1, 2);
    Eigen::VectorXd const b = m.dense() * x;
    Eigen::VectorXd solution;
    CHECK(f.solve(b, solution));
    CHECK((solution - x).norm() <= 1e-13 * x.norm());
    CHECK(!f.solve(Eigen::VectorXd::Constant(2 * m.rows, std::nan("")), solution));
  }
}

TEST_CASE("LU of blocks: entries that are no numbers, and singular matrices, are refused") {
  lu f;
  CHECK(!matrix{3, true, std::nan("")}.factor(f));
  CHECK(!matrix{60, false, std::nan("")}.factor(f));
  auto const nothing = [](auto put) { put(0, 0, Eigen::Matrix2d::Zero().eval()); };
  CHECK(!f.factor(1, 1, nothing));
  CHECK(!f.factor(60, 1, nothing));
}

}  // namespace block_lu_test
