// SPDX-License-Identifier: MIT
#include <slant/contact/friction/friction_blocks.hpp>
#include <slant/contact/friction/verify.hpp>

#include <support/testing.hpp>
#include "contact/friction_scenes.hpp"

namespace friction_blocks_test {

template <int N>
using blocks = slant::contact::friction_blocks<N, double>;

/// ‖natural map‖ / ‖q‖ in long double.
double naive_error(test::friction_problem const& p, VectorXd const& r) {
  oracle::friction_real sum = 0;
  for (auto const& c : test::naive(p, r)) sum += c.natural_map * c.natural_map;
  return double(std::sqrt(sum)) / p.q.norm();
}

/// What the blocks measure at r.
slant::contact::friction_error<double> error_at(test::friction_problem const& p,
                                                VectorXd const& r) {
  blocks<3> const b(p);
  VectorXd const x = b.from_force(r);
  VectorXd u(x.size());
  b.velocity(x, u);
  return b.error(x, u);
}

TEST_CASE("blocks: products and errors are those of the dense problem in the units of the data") {
  auto const check = [&]<int N>(test::friction_problem p, double compliance, double velocity) {
    p.W *= compliance;
    p.q *= velocity;
    blocks<N> const b(p);
    CHECK(b.q().cwiseAbs().maxCoeff() >= 1);
    CHECK(b.q().cwiseAbs().maxCoeff() < 2);
    VectorXd const r = p.q.cwiseAbs() / p.W.coeff(0, 0);
    VectorXd const scaled = b.from_force(r);
    CHECK((b.force(scaled) - r).norm() == 0);
    VectorXd u(r.size());
    b.velocity(scaled, u);
    CHECK((b.speed(u) - (MatrixXd(p.W) * r + p.q)).norm() <= 1e-13 * b.speed(u).norm());
    CHECK(b.error(scaled, u).plain == doctest::Approx(naive_error(p, r)).epsilon(1e-10));
  };
  auto const plane = test::random_friction(4, 2, 0.4, 1),
             space = test::random_friction(5, 3, 0.7, 2);
  check.operator()<2>(plane, 1, 1);
  check.operator()<3>(space, 1, 1);
  check.operator()<3>(space, 1e3, 1e-9);
  check.operator()<3>(space, 1e-3, 1e120);
}

TEST_CASE("blocks: the scaled error is that of verify and knows no units, rounding is told apart") {
  auto const p = test::random_friction(5, 3, 0.7, 3);
  auto const verified = [&](test::friction_problem const& problem, VectorXd const& r) {
    auto const e = error_at(problem, r);
    auto const check = slant::contact::verify(problem, r);
    CHECK(e.scaled == doctest::Approx(check.unit_free_map).epsilon(1e-10));
    CHECK(e.penetration == doctest::Approx(check.unit_free_penetration).epsilon(1e-10));
    return e;
  };
  VectorXd const r = p.q.cwiseAbs();
  double const expected = verified(p, r).scaled;
  for (double const unit : {1e150, 1e-150, 1e10}) {
    auto scaled = p;
    scaled.W *= unit;
    CHECK(verified(scaled, r / unit).scaled == doctest::Approx(expected).epsilon(1e-12));
  }
  VectorXd d = VectorXd::Ones(15);
  for (slant::index i = 3; i < 9; ++i) d[i] = i < 6 ? 1e-8 : 1e8;
  auto other = p;
  other.W = MatrixXd(d.asDiagonal() * p.W * d.asDiagonal()).sparseView();
  other.q = d.cwiseProduct(p.q);
  CHECK(verified(other, r.cwiseQuotient(d)).scaled == doctest::Approx(expected).epsilon(1e-12));
  // r = 1e20 in units of u: its rounding alone is 1e4 |q|.
  auto tiny = p;
  tiny.W *= 1e-20;
  CHECK(verified(tiny, r * 1e20).floor > 1e3);
  using error = slant::contact::friction_error<double>;
  CHECK(error{1e-9, 1e3, 1e4, 0}.at_most(1e-8));
  CHECK(error{1e-9, 1e5, 1e4, 0}.at_most(1e-8));
  CHECK(!error{1e-7, 1e-9, 1e4, 0}.at_most(1e-8));
}

TEST_CASE("blocks: contacts of very different stiffness are measured by units of their own") {
  VectorXd d(6), r(6);
  d << 1, 1, 1, 1e-18, 1e-18, 1e-18;
  auto p = test::make_friction_problem(
      d.asDiagonal().toDenseMatrix(), (VectorXd(6) << -1, 0.1, 0.7, -1e-9, 1e-10, 7e-10).finished(),
      Vector2d(2, 2));
  r = -p.q.cwiseQuotient(d);
  CHECK(error_at(p, r).at_most(1e-14));
  CHECK(error_at(p, (1 + 1e-6) * r).worst() > 1e-7);
  VectorXd wrong = r;
  wrong.tail<3>() *= 1 + 1e-6;  // a velocity of 1e-15
  CHECK(error_at(p, wrong).worst() > 1e-7);
  // Forces in a kernel of W are not seen, but their rounding is.
  p = test::repeated(test::make_friction_problem(Eigen::Matrix3d::Identity(),
                                                 Vector3d(-1, 0.1, 0.7), VectorXd::Constant(1, 2)),
                     2);
  r << 1, -0.1, -0.7, 0, 0, 0;
  CHECK(error_at(p, r).at_most(1e-14));
  r *= 1e17;
  r.tail<3>() -= r.head<3>();
  CHECK(error_at(p, r).scaled > 1);
}

TEST_CASE("blocks: penetration counts however large μ is, and rounding is no sliding") {
  auto const at = [](double mu, Vector3d const& r) {
    return error_at(test::make_friction_problem(Eigen::Matrix3d::Identity(), Vector3d(-1, 1, 0),
                                                VectorXd::Constant(1, mu)),
                    r);
  };
  auto const none = at(1e9, Vector3d::Zero());
  CHECK(none.scaled <= 1e-8);  // the natural map alone
  CHECK(none.penetration == doctest::Approx(std::sqrt(0.5)));
  CHECK(none.worst() == none.penetration);
  CHECK(!none.at_most(1e-8));
  CHECK(at(1e9, Vector3d(1, -1, 0)).at_most(1e-15));
  CHECK(at(1e9, Vector3d(1, -1 + 1e-15, 0)).at_most(1e-14));
  CHECK(!at(1e9, Vector3d(1, -1 + 1e-12, 0)).at_most(1e-8));
}

TEST_CASE("blocks: a NaN in an error is not hidden") {
  using error = slant::contact::friction_error<double>;
  for (auto const& e :
       {error{quiet_nan, 0, 0, 0}, error{0, quiet_nan, 0, 0}, error{0, quiet_nan, quiet_nan, 0},
        error{0, 0, 0, quiet_nan}, error{quiet_nan, 1, 0, 1}}) {
    CHECK(std::isnan(e.worst()));
    CHECK(!e.at_most(1));
  }
  CHECK(error{1, 2, 3, 0.5}.worst() == 1);
  CHECK(error{1, 4, 3, 0.5}.worst() == 1);
  CHECK(error{1, 4, 3, 5}.worst() == 5);
}

TEST_CASE("blocks: those without an entry are left out, nothing is allocated afterwards") {
  auto const p = test::chain_friction(20);
  blocks<3> const b(p);
  CHECK(b.block_count() == 20 + 2 * 19);
  VectorXd r = VectorXd::Ones(60), u(60);
  slant::testing::allocation_guard guard;
  b.velocity(r, u);
  auto const e = b.error(r, u);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
  CHECK(e.plain > 0);
}

}  // namespace friction_blocks_test
