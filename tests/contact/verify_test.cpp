// SPDX-License-Identifier: MIT
//
// The checker against the law written naively in long double, on solutions known in closed form,
// and on each kind of mistake.

#include <oracle/naive_friction.hpp>
#include <slant/contact/friction/verify.hpp>
#include <support/friction_cases.hpp>
#include <support/testing.hpp>

namespace verify_test {

using namespace test::evaluated;
using slant::contact::contact_state;
using slant::contact::friction_problem;
using slant::contact::verify;
constexpr double eps = std::numeric_limits<double>::epsilon();

/// A random problem of m contacts; W = H Hᵀ of full rank, forces of all three states and none.
struct random_case {
  random_case(unsigned seed, int dimension, int m) : random(seed), d(dimension) {
    MatrixXd const H = matrix(d * m, d * m + 2);
    p.W = MatrixXd(H * H.transpose()).sparseView();
    p.q = matrix(d * m, 1);
    p.mu.resize(m);
    for (int i = 0; i < m; ++i) p.mu[i] = std::pow(10, number() * 2);
    p.mu[0] = 0;
    r = matrix(d * m, 1);
    for (int i = 0; i < m; i += 2) r[i * d] = std::abs(r[i * d]) * 3;
  }
  double number() { return std::uniform_real_distribution<double>(-1, 1)(random); }
  MatrixXd matrix(int rows, int cols) {
    return MatrixXd::NullaryExpr(rows, cols, [&] { return number(); });
  }

  std::mt19937 random;
  int d;
  friction_problem<> p{};
  VectorXd r{};
};

TEST_CASE("verify: the figures of a naive implementation") {
  for (int const d : {2, 3}) {
    for (unsigned seed = 0; seed < 20; ++seed) {
      random_case const c(seed, d, 7);
      auto const got = verify(c.p, c.r);
      auto const expected =
          oracle::naive_friction(MatrixXd(c.p.W).cast<long double>(), c.p.q.cast<long double>(),
                                 c.p.mu.cast<long double>(), c.r.cast<long double>());
      // All terms are sums of products of numbers up to 20, times μ up to 100.
      double const close = 1e-12;
      long double squares = 0, cone = 0, dual = 0, power = 0, propulsion = 0, dissipation = 0;
      for (std::size_t i = 0; i < expected.size(); ++i) {
        auto const& e = expected[i];
        auto const& g = got.contacts[i];
        CHECK(std::abs(g.natural_map - double(e.natural_map)) < close * (1 + g.natural_map));
        CHECK(std::abs(g.outside_cone - double(e.outside_cone)) < close);
        CHECK(std::abs(g.outside_dual - double(e.outside_dual)) < close);
        CHECK(std::abs(g.penetration - double(e.penetration)) < close);
        CHECK(std::abs(g.complementarity - double(e.complementarity)) <
              close * (1 + g.complementarity));
        CHECK(std::abs(g.dissipation - double(e.dissipation)) < close);
        squares += e.natural_map * e.natural_map;
        cone = std::max(cone, e.outside_cone);
        dual = std::max(dual, e.outside_dual);
        power = std::max(power, e.complementarity);
        propulsion = std::max(propulsion, -e.dissipation);
        dissipation += e.dissipation;
      }
      double const r_norm = c.r.norm(), q_norm = c.p.q.norm();
      auto const same = [](double a, long double b) {
        return a == doctest::Approx(double(b)).epsilon(1e-12);
      };
      CHECK(same(got.natural_map, std::sqrt(squares)));
      CHECK(same(got.relative_natural_map, std::sqrt(squares) / q_norm));
      CHECK(same(got.outside_cone.value, cone));
      CHECK(same(got.outside_cone.relative, cone / r_norm));
      CHECK(same(got.outside_dual.value, dual));
      CHECK(same(got.outside_dual.relative, dual / q_norm));
      CHECK(same(got.complementarity.value, power));
      CHECK(same(got.complementarity.relative, power / r_norm / q_norm));
      CHECK(same(got.propulsion.value, propulsion));
      CHECK(same(got.propulsion.relative, propulsion / r_norm / q_norm));
      CHECK(std::abs(got.dissipation - double(dissipation)) < 1e-11);
      CHECK(got.open + got.stick + got.slip == 7);
      auto const at = [&](auto const& worst) {
        return worst.contact < 0 ? slant::contact::contact_check<double>{}
                                 : got.contacts[std::size_t(worst.contact)];
      };
      CHECK(at(got.outside_cone).outside_cone == got.outside_cone.value);
      CHECK(at(got.outside_dual).outside_dual == got.outside_dual.value);
      CHECK(same(at(got.complementarity).complementarity, power));
      CHECK(same(-at(got.propulsion).dissipation, propulsion));
    }
  }
}

TEST_CASE("verify: solutions are solutions, and their states are told") {
  for (auto const& c : test::solvable_cases()) {
    CAPTURE(c.name);
    for (auto const& r : c.r) {
      auto const check = verify(c.problem, r);
      CHECK(check.natural_map <= 2 * check.rounding);
      CHECK(check.relative_natural_map <= 10 * eps);
      CHECK(check.outside_cone.relative <= eps);
      CHECK(check.outside_dual.relative <= 4 * eps);
      CHECK(check.complementarity.relative <= 4 * eps);
      CHECK(check.propulsion.relative <= eps);
      CHECK(check.dissipation >= 0);
    }
    if (c.r.size() > 1) continue;
    auto const state = verify(c.problem, c.r[0]).contacts[0].state;
    bool const open = c.name.find("open") != std::string::npos;
    bool const stick = c.name.find("stick") != std::string::npos;
    CHECK(state == (open    ? contact_state::open
                    : stick ? contact_state::stick
                            : contact_state::slip));
  }
  auto const three = test::three_solutions_case();
  CHECK(verify(three.problem, three.r[0]).open == 1);
  CHECK(verify(three.problem, three.r[1]).slip == 1);
  CHECK(verify(three.problem, three.r[2]).stick == 1);
}

TEST_CASE("verify: each kind of mistake shows where it belongs") {
  using test::numbers;
  auto const slip = test::space_contact({10, -3, -4}, {0, 3, 4}, 0.5);
  auto const check = [&](VectorXd const& r) { return verify(slip, r); };
  SUBCASE("too much friction") {
    auto const c = check(numbers({10, -6, -8}));
    CHECK(c.outside_cone.value == doctest::Approx(5 / std::sqrt(1.25)));
    CHECK(c.outside_cone.contact == 0);
  }
  SUBCASE("a contact that pulls") {
    auto const c = check(numbers({-1, 0, 0}));
    CHECK(c.outside_cone.value == 1);
    CHECK(c.outside_cone.relative == 1);
  }
  SUBCASE("no force, so one body enters the other") {
    auto const c = check(numbers({0, 0, 0}));
    CHECK(c.outside_cone.value == 0);
    CHECK(c.complementarity.value == 0);
    CHECK(c.outside_dual.value > 0.1 * slip.q.norm());
    CHECK(c.penetration.value == -slip.q[0]);
    CHECK(c.penetration.contact == 0);
    CHECK(c.natural_map > 0.1 * slip.q.norm());
  }
  SUBCASE("too much force, so they separate under it") {
    auto const c = check(numbers({20, -6, -8}));
    CHECK(c.outside_dual.value == 0);
    CHECK(c.outside_cone.value == 0);
    CHECK(c.complementarity.value > 1);
  }
  SUBCASE("friction in a wrong direction: some of it is not used, all of it drives") {
    // q such that the velocity stays (0, 3, 4).
    auto const turned = test::space_contact({10, -5, 0}, {0, 3, 4}, 0.5);
    auto const c = verify(turned, numbers({10, -5, 0}));
    CHECK(c.outside_cone.value == 0);
    CHECK(c.outside_dual.value == 0);
    CHECK(c.complementarity.value == doctest::Approx(0.5 * 10 * 5 - 15));
    CHECK(c.propulsion.value == 0);
    auto const driven = test::space_contact({10, 3, 4}, {0, 3, 4}, 0.5);
    auto const d = verify(driven, numbers({10, 3, 4}));
    CHECK(d.propulsion.value == doctest::Approx(25));
    CHECK(d.dissipation == doctest::Approx(-25));
    CHECK(d.complementarity.value == doctest::Approx(50));
  }
  SUBCASE("what has no solution is not verified by anything") {
    auto const none = test::no_solution_case().problem;
    for (int i = 0; i <= 400; ++i) {
      double const normal = std::pow(10, i / 40. - 5);
      for (double const side : {-1., -0.5, 0., 0.5, 1.})
        CHECK(verify(none, numbers({normal, side * normal})).relative_natural_map > 0.1);
    }
  }
}

TEST_CASE("verify: any unit") {
  random_case const c(3, 3, 5);
  auto const plain = verify(c.p, c.r);
  for (int const forces : {-500, 0, 500}) {
    for (int const velocities : {-500, 0, 500}) {
      auto p = c.p;
      p.W *= std::ldexp(1, velocities - forces);
      p.q *= std::ldexp(1, velocities);
      auto const other =
          verify(p, VectorXd(c.r * std::ldexp(1, forces)), std::ldexp(1, forces - velocities));
      CHECK(other.natural_map == std::ldexp(plain.natural_map, forces));
      CHECK(other.rounding == std::ldexp(plain.rounding, forces));
      CHECK(other.relative_natural_map == plain.relative_natural_map);
      CHECK(other.outside_cone.relative == plain.outside_cone.relative);
      CHECK(other.outside_dual.relative == plain.outside_dual.relative);
      CHECK(other.complementarity.relative == plain.complementarity.relative);
      CHECK(other.propulsion.relative == plain.propulsion.relative);
      CHECK(other.slip == plain.slip);
    }
  }
}

TEST_CASE(
    "verify: the unit-free natural map is that of W in units of one, whatever the units are") {
  random_case const c(4, 3, 5);
  // w = 1 at each contact: there √w r and u/√w are r and u.
  VectorXd d(c.r.size());
  for (Eigen::Index i = 0; i < 5; ++i) {
    double const w = MatrixXd(c.p.W).block(3 * i, 3 * i, 3, 3).cwiseAbs().maxCoeff();
    d.segment(3 * i, 3).setConstant(1 / std::sqrt(w));
  }
  auto const in_units = [&](VectorXd const& D) {
    auto p = c.p;
    p.W = MatrixXd(D.asDiagonal() * c.p.W * D.asDiagonal()).sparseView();
    p.q = D.cwiseProduct(c.p.q);
    return p;
  };
  auto const one = verify(in_units(d), VectorXd(c.r.cwiseQuotient(d)));
  auto const same = [&](slant::contact::friction_check<double> const& other) {
    CHECK(other.unit_free_map == doctest::Approx(one.relative_natural_map).epsilon(1e-12));
    CHECK(other.unit_free_rounding == doctest::Approx(one.relative_rounding).epsilon(1e-12));
    CHECK(other.worst.contact == one.worst.contact);
    CHECK(other.worst.value == doctest::Approx(one.worst.value).epsilon(1e-12));
    CHECK(other.contacts[std::size_t(other.worst.contact)].unit_free_map == other.worst.value);
    CHECK(other.unit_free_penetration == doctest::Approx(one.unit_free_penetration).epsilon(1e-12));
  };
  same(one);
  same(verify(c.p, c.r));
  for (double const s : {1e6, 1e-6, 1e150, 1e-150}) {
    auto p = c.p;
    p.W *= s;
    same(verify(p, VectorXd(c.r / s)));
    p = c.p;
    p.q *= s;
    same(verify(p, VectorXd(c.r * s)));
    for (Eigen::Index i = 0; i < 5; ++i) {
      VectorXd D = VectorXd::Ones(c.r.size());
      D.segment(3 * i, 3).setConstant(s > 1 ? 1e8 : 1e-8);
      same(verify(in_units(D), VectorXd(c.r.cwiseQuotient(D))));
    }
  }
  // The measure of the literature sees nothing of a wrong force there, or nothing else.
  auto p = test::plane_contact(1e-150, 0, 1e-150, -1, 0.5, 1);
  auto const wrong = verify(p, VectorXd(test::numbers({2e150, 0})));
  CHECK(wrong.unit_free_map > 0.4);
  CHECK(wrong.relative_rounding > 1e100);
  CHECK(wrong.unit_free_rounding < 1e-14);
  // A contact that its own force does not move has the units of the others.
  p.W.coeffRef(0, 0) = p.W.coeffRef(1, 1) = 0;
  CHECK(verify(p, VectorXd(test::numbers({0, 0}))).unit_free_penetration > 0.8);
}

TEST_CASE("verify: extreme coefficients") {
  for (double const mu : {1e-200, 1e-9, 1e9, 1e200}) {
    auto const p = test::plane_contact(1, 0, 1, -1, 0.5, mu);
    // It slips for the small ones, r_t = −μ, and sticks for the large ones.
    auto const c = verify(p, test::numbers({1, mu < 1 ? -mu : -0.5}));
    CHECK(c.relative_natural_map <= 2 * eps);
    CHECK((mu < 1 ? c.slip : c.stick) == 1);
    // A large coefficient does not hide that nothing is held.
    auto const free = verify(p, test::numbers({0, 0}));
    CHECK(free.penetration.value == 1);
    CHECK(free.penetration.relative == doctest::Approx(1 / std::sqrt(1.25)));
    CHECK(free.outside_dual.value == doctest::Approx(mu < 1 ? 1 : 1 / mu));
    // Without any friction force the rest of the law is violated by μ |u_t| r_n, if at all.
    auto const none = verify(p, test::numbers({1, 0}));
    CHECK(none.complementarity.value == doctest::Approx(0.5 * mu));
    CHECK(std::isfinite(none.natural_map));
  }
}

TEST_CASE("verify: forces that are far larger than what they resist") {
  // W h = 0 for h on the boundary of the cone, inside and outside: no force along h resists q.
  for (double const size : {1e3, 1e8, 1e16, 1e24}) {
    for (auto const& h : {test::numbers({2, 1}), test::numbers({2, 2}), test::numbers({2, 4})}) {
      Vector2d const across(h[1], -h[0]);
      auto const p = test::make_friction_problem(across * across.transpose(),
                                                 test::numbers({-1, 0}), test::numbers({1}));
      auto const check = verify(p, VectorXd(size * h));
      CHECK(check.penetration.value == 1);
      CHECK(check.relative_natural_map > 0.5);
      CHECK((check.relative_rounding > 1e-8) == (size > 1e7));
    }
  }
}

TEST_CASE("verify: bad input, NaN and nothing at all") {
  auto const p = test::plane_contact(1, 0, 1, -1, 0, 0.5);
  CHECK_THROWS_WITH_AS((void)verify(p, test::numbers({1})), "r: got 1, expected size 2",
                       slant::bad_input);
  CHECK_THROWS_WITH_AS((void)verify(p, test::numbers({1, 0}), 0.),
                       "rho: got 0, expected a finite number > 0", slant::bad_input);
  auto wrong = p;
  wrong.mu[0] = -1;
  CHECK_THROWS_AS((void)verify(wrong, test::numbers({1, 0})), slant::bad_input);

  random_case const c(1, 3, 4);
  VectorXd r = c.r;
  r[4] = quiet_nan;
  auto const check = verify(c.p, r);
  CHECK(std::isnan(check.natural_map));
  CHECK(std::isnan(check.outside_cone.value));
  CHECK(check.outside_cone.contact == 1);
  CHECK(std::isnan(check.complementarity.relative));

  // Where nothing moves (W = 0, q = 0) every force is a solution; an infinite one is no force.
  auto unmoved = p;
  unmoved.W.setZero();
  unmoved.q.setZero();
  CHECK(verify(unmoved, test::numbers({1, 0.5})).unit_free_map == 0);
  CHECK(std::isnan(verify(unmoved, test::numbers({infinity, 0})).unit_free_map));
  CHECK(std::isnan(verify(unmoved, test::numbers({infinity, 0})).relative_natural_map));

  friction_problem<> const empty;
  auto const nothing = verify(empty, VectorXd());
  CHECK(nothing.natural_map == 0);
  CHECK(nothing.relative_natural_map == 0);
  CHECK(nothing.outside_cone.contact == -1);

  // q = 0: at rest without forces; any other force moves something.
  auto still = p;
  still.q.setZero();
  CHECK(verify(still, test::numbers({0, 0})).relative_natural_map == 0);
  CHECK(std::isinf(verify(still, test::numbers({1, 0})).relative_natural_map));
}

}  // namespace verify_test
