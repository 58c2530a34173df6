// SPDX-License-Identifier: MIT
#include <slant/contact/friction/friction_newton.hpp>

#include <slant/contact/friction/verify.hpp>

#include <support/testing.hpp>
#include "contact/friction_scenes.hpp"

namespace friction_newton_test {

using blocks = slant::contact::friction_blocks<3, double>;
using newton = slant::contact::friction_newton<3, double>;
using lu = slant::contact::detail::block_lu<2, double>;

template <int N>
void check_differences() {
  using part = Eigen::Matrix<double, N, 1>;
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  auto const number = [&](auto...) { return normal(random); };
  int smooth = 0, open = 0;
  for (int k = 0; k < 400; ++k) {
    part const r = part::NullaryExpr(number), u = part::NullaryExpr(number);
    part const dr = part::NullaryExpr(number), du = part::NullaryExpr(number);
    double const mu = std::exp(normal(random)), ρ = std::exp(normal(random)), h = 1e-6;
    slant::contact::detail::friction_map<N, double> f, ahead, behind;
    f.look(mu, ρ, r, u, true);
    ahead.look(mu, ρ, part(r + h * dr), part(u + h * du), true);
    behind.look(mu, ρ, part(r - h * dr), part(u - h * du), true);
    if (f.open) {
      ++open;
      CHECK(f.B.norm() == 0);
      CHECK(f.F == r);
    }
    // Kinks between the two points are seen by the derivatives, which jump there.
    if ((ahead.B - behind.B).norm() > 1e-3 || (ahead.A - behind.A).norm() > 1e-3) continue;
    ++smooth;
    part const difference = (ahead.F - behind.F) / (2 * h);
    part const derivative = f.A * dr + f.B * du;
    CHECK((difference - derivative).norm() <= 1e-5 * (1 + derivative.norm()));
  }
  CHECK(smooth > 350);
  CHECK(open > 50);
}

TEST_CASE("maps of one contact: derivatives against differences") {
  check_differences<2>();
  check_differences<3>();
}

TEST_CASE("maps of one contact: the natural map is that of the oracle") {
  auto const p = test::random_friction(1, 3, 0.6, 8);
  Vector3d const r(0.3, 0.4, -0.2);
  Vector3d const u = p.W * r + p.q;
  slant::contact::detail::friction_map<3, double> f;
  f.look(0.6, 1., r, u, false);
  CHECK(f.F.norm() == doctest::Approx(double(test::naive(p, r)[0].natural_map)).epsilon(1e-12));
}

TEST_CASE("Newton: few steps near a solution, sparse or dense") {
  auto const p = test::chain_friction(60);
  blocks const b(p);
  newton n(b);
  VectorXd r = VectorXd::Zero(b.size());
  n.begin(r);
  for (int k = 0; k < 15 && n.residual_norm() > 1e-13; ++k) CHECK(n.advance(r, 0));
  CHECK(slant::contact::verify(p, b.force(r)).relative_natural_map <= 1e-12);
  CHECK(n.steps() <= 12);
  CHECK(n.factored().factorizations == n.steps());
  CHECK(n.factored().sparse > 0);  // three diagonals: never a full matrix
  // Every second contact is open, and in no system after the first.
  CHECK(n.factored().rows < 60 * 3 + (n.steps() - 1) * (30 * 3 + 1));
}

TEST_CASE("Newton: a singular system has a direction if damped, one of no use is refused") {
  auto const p = test::repeated(test::random_friction(20, 3, 0.4, 2), 2);
  blocks const b(p);
  newton n(b);
  VectorXd r = VectorXd::Zero(b.size());
  for (slant::index i = 0; i < b.contacts(); ++i) r[3 * i] = 1;  // all stick
  double const before = n.begin(r);
  CHECK(n.advance(r, 1e-6));
  CHECK(n.residual_norm() < before);
  VectorXd bad = VectorXd::Constant(b.size(), std::nan(""));
  n.begin(bad);
  CHECK(!n.advance(bad, 1e-6));
}

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
  [[nodiscard]] MatrixXd dense() const {
    MatrixXd m = MatrixXd::Zero(2 * rows, 2 * rows);
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
    auto const before = f.work().sparse;
    REQUIRE(m.factor(f));
    CHECK(f.work().sparse - before == (m.rows == 60 ? 1 : 0));
    VectorXd const x = VectorXd::LinSpaced(2 * m.rows, -1, 2);
    VectorXd const b = m.dense() * x;
    VectorXd solution;
    CHECK(f.solve(b, solution));
    CHECK((solution - x).norm() <= 1e-13 * x.norm());
    CHECK(!f.solve(VectorXd::Constant(2 * m.rows, std::nan("")), solution));
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

}  // namespace friction_newton_test
