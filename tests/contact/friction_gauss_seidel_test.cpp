// SPDX-License-Identifier: MIT
#include <slant/contact/friction/friction_gauss_seidel.hpp>

#include <slant/contact/friction/verify.hpp>

#include <support/testing.hpp>
#include "contact/friction_scenes.hpp"

namespace friction_gauss_seidel_test {

using blocks = slant::contact::friction_blocks<3, double>;
using method = slant::contact::friction_gauss_seidel<3, double>;
using sweeps = slant::contact::friction_sweeps<3, double>;

static_assert(slant::iterative_method<method, VectorXd>);

TEST_CASE("Gauss–Seidel: redundant contacts, counts, and no allocation in a step") {
  auto const p = test::repeated(test::random_friction(6, 3, 0.4, 21), 3);
  blocks const b(p);
  method m(b);
  auto s = m.start(VectorXd::Zero(b.size()));
  slant::testing::allocation_guard guard;
  while (s.iteration < 200 && !s.best_error.at_most(1e-12)) m.step(s);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
  CHECK(s.best_error.at_most(1e-12));
  CHECK(slant::contact::verify(p, b.force(s.best)).relative_natural_map <= 2e-12);
  CHECK(s.sweeps == 20 * s.iteration);
  CHECK(s.evaluations == 1 + 2 * s.iteration);
  CHECK(s.block_products <= s.sweeps * b.block_count());
}

TEST_CASE("Gauss–Seidel: at a solution it rests, without progress it says so") {
  auto const c = test::single_solution_cases().back();
  blocks const b(c.problem);
  method m(b, {.patience = 5});
  auto s = m.start(b.from_force(c.r[0]));
  CHECK(s.error.at_most(1e-14));
  for (int k = 0; k < 20; ++k) m.step(s);
  CHECK(s.status == slant::status::stalled);
  CHECK(s.best_error.at_most(1e-14));
  auto const last = s.iteration;
  m.step(s);
  CHECK(s.iteration == last);
}

TEST_CASE("Gauss–Seidel: a step of no more sweeps than it is given") {
  auto const p = test::random_friction(4, 3, 0.4, 2);
  blocks const b(p);
  method m(b);
  for (slant::index const most : {1, 10, 13, 20}) {
    auto s = m.start(VectorXd::Zero(b.size()));
    m.step(s, most);
    CHECK(s.sweeps == most);
    CHECK(s.evaluations == (most <= 10 ? 2 : 3));
  }
}

TEST_CASE("Gauss–Seidel: all that changes is in the state") {
  auto const p = test::random_friction(6, 3, 0.4, 8);
  blocks const b(p);
  method const m(b);
  auto alone = m.start(VectorXd::Zero(b.size())), other = alone;
  for (int k = 0; k < 3; ++k) m.step(alone);
  for (int k = 0; k < 3; ++k) m.step(other);  // another run by the same method
  CHECK(alone.x == other.x);
  CHECK(alone.block_products == other.block_products);
}

TEST_CASE("Gauss–Seidel: bad options and starts are named") {
  auto const p = test::chain_friction(2);
  blocks const b(p);
  CHECK_THROWS_WITH_AS(method(b, {.patience = 0}), doctest::Contains("patience"), slant::bad_input);
  CHECK_THROWS_AS(static_cast<void>(method(b).start(VectorXd::Zero(5))), slant::bad_input);
}

/// After so many sweeps from zero.
VectorXd swept(blocks const& b, int times) {
  sweeps const s(b);
  auto memory = s.memory();
  VectorXd r = VectorXd::Zero(b.size());
  for (int k = 0; k < times; ++k) s.sweep(r, memory);
  return r;
}

TEST_CASE("sweeps: one contact takes one") {
  for (auto const& c : test::single_solution_cases()) {
    if (c.problem.dimension() != 3) continue;
    blocks const b(c.problem);
    CHECK((b.force(swept(b, 1)) - c.r[0]).norm() <= 1e-13 * (1 + c.r[0].norm()));
  }
}

TEST_CASE(
    "sweeps: open contacts cost nothing as neighbours, and nothing when they are passed over") {
  slant::index const m = 40;
  auto const p = test::chain_friction(m);
  blocks const b(p);
  sweeps const s(b);
  auto memory = s.memory();
  VectorXd r = VectorXd::Zero(3 * m);
  for (int k = 0; k < 5; ++k) s.sweep(r, memory);
  // Every second contact is open: all neighbours of the others.
  CHECK(s.sweep(r, memory, true) ==
        m + (m - 1));                         // diagonals, and closed neighbours of open contacts
  CHECK(s.sweep(r, memory, false) == m / 2);  // the diagonals of the closed
}

TEST_CASE("sweeps: contacts without compliance or with an indefinite block stay finite") {
  auto p = test::random_friction(3, 3, 0.5, 5);
  MatrixXd W = p.W;
  W.middleRows(3, 3).setZero();
  W.middleCols(3, 3).setZero();
  p.W = W.sparseView();
  p.q[3] = 1;  // leaves by itself
  blocks const b(p);
  sweeps const s(b);
  auto memory = s.memory();
  VectorXd r = VectorXd::Constant(9, 1.);
  for (int k = 0; k < 1000; ++k) s.sweep(r, memory);
  CHECK(slant::contact::verify(p, b.force(r)).relative_natural_map <= 1e-10);
  W.block(3, 3, 3, 3) = -Eigen::Matrix3d::Identity();
  p.W = W.sparseView();
  p.q[3] = -1;
  CHECK(swept(blocks(p), 10).allFinite());
}

TEST_CASE("sweeps: indefinite blocks with a positive diagonal are made definite") {
  Eigen::Matrix3d D = Eigen::Matrix3d::Identity();
  D(0, 1) = D(1, 0) = 5;
  auto const p = test::make_friction_problem(D, Vector3d(-1, 2, 1), VectorXd::Constant(1, 0.5));
  blocks const b(p);
  double const shift = sweeps(b).shift(0) / b.diagonal(0)(2, 2);  // in units of D
  CHECK(shift > 4);                                               // its smallest eigenvalue is −4
  CHECK(shift < 4.1);
  blocks const definite(test::chain_friction(2));
  CHECK(sweeps(definite).shift(1) == 0);
  CHECK(swept(b, 10).allFinite());
}

/// The largest violation of the law, relative to q, by the oracle.
template <int N>
double violation(Eigen::Matrix<double, N, N> const& W, Eigen::Matrix<double, N, 1> const& q,
                 double mu, Eigen::Matrix<double, N, 1> const& r) {
  auto const p = test::make_friction_problem(W, q, VectorXd::Constant(1, mu));
  return double(test::naive(p, r)[0].natural_map) / q.norm();
}

template <int N>
void check_random(bool symmetric) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  auto const number = [&](auto...) { return normal(random); };
  int slips = 0, sticks = 0, opens = 0;
  for (int k = 0; k < 2000; ++k) {
    using matrix = Eigen::Matrix<double, N, N>;
    matrix const H = matrix::NullaryExpr(number), skew = matrix::NullaryExpr(number);
    matrix W = H * H.transpose() + 0.05 * matrix::Identity();
    if (!symmetric) W += 0.1 * (skew - skew.transpose());
    Eigen::Matrix<double, N, 1> const q = Eigen::Matrix<double, N, 1>::NullaryExpr(number);
    double const mu = std::exp(normal(random));
    auto const c = slant::contact::detail::solve_one_contact<N, double>(W, q, mu, 0.);
    CHECK(violation<N>(W, q, mu, c.r) <= 1e-13 * (1 + mu) * (1 + W.norm() * c.r.norm() / q.norm()));
    (c.r(0) == 0 ? opens : c.slip > 0 ? slips : sticks) += 1;
    if (c.slip > 0) {
      // u_t = −λ r_t, from any guess.
      Eigen::Matrix<double, N, 1> const u = W * c.r + q;
      CHECK((u + c.slip * c.r).template tail<N - 1>().norm() <= 1e-10 * q.norm() * (1 + c.slip));
      auto const warm =
          slant::contact::detail::solve_one_contact<N, double>(W, q, mu, 1e6 * (1 + c.slip));
      CHECK(violation<N>(W, q, mu, warm.r) <=
            1e-13 * (1 + mu) * (1 + W.norm() * warm.r.norm() / q.norm()));
    }
  }
  CHECK(opens > 200);
  CHECK(sticks > 200);
  CHECK(slips > 200);
}

TEST_CASE("one contact: random data in the plane and in space, symmetric or not") {
  check_random<2>(true);
  check_random<2>(false);
  check_random<3>(true);
  check_random<3>(false);
}

TEST_CASE("one contact: no friction, and very much of it") {
  Eigen::Matrix3d W;
  W << 2, 0.5, 0, 0.5, 1, 0, 0, 0, 3;
  Vector3d const q(-1, 2, 3);
  auto const smooth = slant::contact::detail::solve_one_contact<3, double>(W, q, 0., 0.);
  CHECK(smooth.r == Vector3d(0.5, 0, 0));
  CHECK(smooth.slip == 0);
  auto const rough = slant::contact::detail::solve_one_contact<3, double>(W, q, 1e8, 0.);
  CHECK((W * rough.r + q)(0) == doctest::Approx(0).epsilon(1e-12));
  CHECK(violation<3>(W, q, 1e8, rough.r) <= 1e-6);  // û is as large as μ
  // Only the normal component: closed at its own impulse, open when it leaves.
  CHECK(
      slant::contact::detail::solve_one_contact<3, double>(W, Vector3d(1, 2, 3), 1., 0.).r.norm() ==
      0);
}

TEST_CASE("one contact: hardly any friction, slip λ beyond the range of squares") {
  Eigen::Matrix3d W = Eigen::Matrix3d::Identity();
  W(1, 2) = W(2, 1) = 0.5;
  for (double const mu : {1e-150, 1e-160, 1e-200, 1e-300, 1e-320}) {
    for (double const guess : {0., 1e10, 1e300}) {
      auto const c =
          slant::contact::detail::solve_one_contact<3, double>(W, Vector3d(-1, 3, 4), mu, guess);
      CHECK(c.r(0) == doctest::Approx(1));
      CHECK(std::abs(c.r(1) / mu + 0.6) <= 1e-3);  // digits of mu itself where it is subnormal
      CHECK(std::abs(c.r(2) / mu + 0.8) <= 1e-3);
      CHECK(c.slip > 1e149);
    }
  }
  // A block that is tiny: its determinant is below the range.
  auto const c = slant::contact::detail::solve_one_contact<3, double>(
      1e-170 * W, Vector3d(-1, 0.1, 0.1), 1., 0.);
  CHECK((1e-170 * W * c.r + Vector3d(-1, 0.1, 0.1)).norm() <= 1e-15);
}

}  // namespace friction_gauss_seidel_test
