// SPDX-License-Identifier: MIT
//
// Classical Newton: the smooth special case, its rates, and the ways in which it fails.
#include <slant/slant.hpp>
#include <slant/testing/archetypes.hpp>

#include <newton/newton_scene.hpp>
#include <support/testing.hpp>

namespace semismooth_newton_test {

namespace archetype = slant::testing::archetype;
constexpr int m = 8;
constexpr double smallest_radius = 1e-3;

/// One equation with the derivative given.
template <class Value, class Derivative>
auto equation(Value value, Derivative derivative) {
  return slant::smooth(
      1, 1, [value](auto const& y, auto& f) { f[0] = value(y[0]); },
      [derivative](auto const& y) { return MatrixXd(MatrixXd::Constant(1, 1, derivative(y[0]))); });
}

VectorXd number(double y) {
  return VectorXd::Constant(1, y);
}

/// Errors ‖y⁽ᵏ⁾ − root‖ of a run, those at rounding level left out.
template <class Method>
std::vector<double> errors(Method const& method, VectorXd const& y0, VectorXd const& root,
                           int steps, double floor) {
  std::vector<double> e;
  auto s = method.start(y0);
  for (int k = 0; k <= steps && s.status == slant::status::running; ++k) {
    double const error = (s.x - root).norm();
    if (error <= floor) break;
    e.push_back(error);
    method.step(s);
  }
  return e;
}

/// (y₁² + y₂² − 2, y₁ − y₂ + c (y₁³ − y₂³)) = 0 at (1, 1).
auto curve() {
  return slant::smooth(
      2, 2,
      [](auto const& y, auto& f) {
        f << y[0] * y[0] + y[1] * y[1] - 2,
            y[0] - y[1] + (y[0] * y[0] * y[0] - y[1] * y[1] * y[1]) / 4;
      },
      [](auto const& y) {
        return MatrixXd{{2 * y[0], 2 * y[1]}, {1 + 0.75 * y[0] * y[0], -1 - 0.75 * y[1] * y[1]}};
      });
}

TEST_CASE("quadratic convergence: e⁺ ≤ c e² in each step, five steps to the last digits") {
  slant::semismooth_newton const method{curve()};
  auto const e = errors(method, VectorXd{{2.0, 0.7}}, VectorXd::Ones(2), 10, 1e-15);
  REQUIRE(e.size() >= 4);
  REQUIRE(e.size() <= 6);
  for (std::size_t k = 1; k < e.size(); ++k) CHECK(e[k] <= 1.0 * e[k - 1] * e[k - 1] + 4e-16);
  auto const r = slant::solve(method, VectorXd{{2.0, 0.7}}, slant::residual_below(1e-14));
  CHECK(r.converged());
  CHECK((r.x() - VectorXd::Ones(2)).norm() <= 2e-14);
  CHECK(r.state.work.factorizations == r.iterations());
  CHECK(r.state.work.operator_applications == 1 + r.iterations());
  CHECK(r.state.trials == 1);
  CHECK(r.state.length == 1);
}

TEST_CASE("√|y| sign y is not slantly differentiable: Newton goes to and fro, and says so") {
  auto const F = equation([](double y) { return std::copysign(std::sqrt(std::abs(y)), y); },
                          [](double y) { return 0.5 / std::sqrt(std::abs(y)); });
  auto const r = slant::solve(
      slant::semismooth_newton{F, slant::by_laws{}, slant::full_step{}, slant::fixed_forcing{}},
      number(0.25), slant::residual_below(1e-10) || slant::at_most(1000));
  CHECK(r.status == slant::status::stalled);
  CHECK(r.state.failure == slant::newton_failure::no_progress);
  CHECK(r.reason == "the residual has not fallen for many steps");
  CHECK(std::abs(r.x()[0]) == 0.25);
  CHECK(r.iterations() == 102);  // the first value, then 100 that are no smaller, and one more
}

TEST_CASE("a singular F° is a breakdown with a reason, whatever the solver") {
  auto const F = slant::smooth(
      2, 2, [](auto const& y, auto& f) { f << y[0] * y[0] - 1, y[1] * y[1] - 1; },
      [](auto const& y) {
        return MatrixXd{{2 * y[0], 0.0}, {0.0, 2 * y[1]}};
      });
  VectorXd const y0{{0.0, 2.0}};
  auto const stop = slant::residual_below(1e-10) || slant::at_most(50);
  auto const check = [](auto const& r) {
    CHECK(r.status == slant::status::breakdown);
    CHECK(r.state.failure == slant::newton_failure::no_direction);
    CHECK(r.reason.find("F° may be singular") != std::string::npos);
    CHECK(r.x().allFinite());
  };
  check(slant::solve(slant::semismooth_newton{F}, y0, stop));
  // No direction is a direction of length 0, but no success.
  check(slant::solve(slant::semismooth_newton{F}, y0, slant::step_below(1e-3)));
  // Half of F can be reduced, which is direction enough for an inexact Newton method.
  slant::semismooth_newton const inexact{F, slant::bicgstab_solver{}};
  CHECK(slant::solve(inexact, y0, stop).converged());
  check(slant::solve(inexact, test::zeros(2), stop));
}

TEST_CASE("steps out of the domain: a breakdown, or shortened") {
  auto const F = equation([](double y) { return std::log(y); }, [](double y) { return 1 / y; });
  auto const stop = slant::residual_below(1e-12) || slant::at_most(50);
  auto const full = slant::solve(slant::semismooth_newton{F, slant::by_laws{}, slant::full_step{}},
                                 number(3), stop);
  CHECK(full.status == slant::status::breakdown);
  CHECK(full.state.failure == slant::newton_failure::not_finite);
  CHECK(full.x() == number(3));
  auto const r = slant::solve(slant::semismooth_newton{F}, number(3), stop);
  CHECK(r.converged());
  CHECK(r.x()[0] == doctest::Approx(1).epsilon(1e-12));
}

TEST_CASE("no acceptable length, and the last digits") {
  auto const no_root = equation([](double y) { return y * y + 1; }, [](double y) { return 2 * y; });
  auto const r = slant::solve(slant::semismooth_newton{no_root}, number(3),
                              slant::residual_below(1e-10) || slant::at_most(500));
  CHECK(!r.converged());
  CHECK((r.state.failure == slant::newton_failure::no_length ||
         r.state.failure == slant::newton_failure::no_direction ||
         r.state.failure == slant::newton_failure::no_digits));
  // More than the precision has to give is asked for.
  auto const cubic =
      equation([](double y) { return y * y * y - 2; }, [](double y) { return 3 * y * y; });
  auto const exact =
      slant::solve(slant::semismooth_newton{cubic, slant::by_laws{}, slant::full_step{}}, number(1),
                   slant::residual_below(0.0) || slant::at_most(500));
  CHECK(exact.iterations() < 12);
  CHECK(exact.x()[0] == doctest::Approx(std::cbrt(2.0)).epsilon(1e-15));
  CHECK((exact.converged() || exact.state.failure == slant::newton_failure::no_digits));
}

TEST_CASE("the scale of the residual: ‖F(0)‖, so that a good start is not asked for more") {
  slant::semismooth_newton const method{curve()};
  auto const near = method.start(VectorXd{{1.0, 1.0 + 1e-9}});
  CHECK(near.residual_scale == 2);
  CHECK(near.work.setup_applications == 1);
  CHECK(method.start(test::zeros(2)).work.setup_applications == 0);
  // F(0) = ∞: nothing to be measured by.
  auto const F =
      equation([](double y) { return 1 / y - 2; }, [](double y) { return -1 / (y * y); });
  CHECK(slant::semismooth_newton{F}.start(number(4)).residual_scale == 1.75);
}

TEST_CASE("the size of steps, for rules that go by it [T (SSNM)]") {
  slant::semismooth_newton const method{curve(), slant::by_laws{}, slant::halving_line_search{},
                                        slant::adaptive_precision{.r_tol = 0.01}};
  auto s = method.start(VectorXd{{2.0, 0.7}});
  CHECK(!(s.step_norm < std::numeric_limits<double>::infinity()));
  while (s.status == slant::status::running && s.iteration < 4) {
    VectorXd const before = s.x;
    method.step(s);
    CHECK(s.step_norm == doctest::Approx((s.x - before).norm()));
    CHECK(s.x_norm == s.x.norm());
  }
  auto const r =
      slant::solve(method, VectorXd{{2.0, 0.7}}, slant::step_below(1e-6) || slant::at_most(20));
  CHECK(r.converged());
  CHECK((r.x() - VectorXd::Ones(2)).norm() <= 1e-11);  // the error is the square of the step

  // A shortened step says nothing: what counts is the whole one; of a longer one, what was gone.
  auto const F =
      equation([](double y) { return std::atan(y); }, [](double y) { return 1 / (1 + y * y); });
  slant::semismooth_newton const damped{F};
  auto t = damped.start(number(3));
  damped.step(t);
  REQUIRE(t.length < 1);
  CHECK(t.step_norm == doctest::Approx(10 * std::atan(3.0)));
  struct double_step : slant::full_step {
    [[nodiscard]] static int first_length() { return 2; }
  };
  slant::semismooth_newton const twice{F, slant::by_laws{}, double_step{}};
  auto u = twice.start(number(0.5));
  twice.step(u);
  CHECK(u.step_norm == doctest::Approx(std::abs(u.x[0] - 0.5)));
}

TEST_CASE("a copied state goes on as the original does; a state at rest stays as it is") {
  slant::semismooth_newton const method{curve()};
  auto s = method.start(VectorXd{{2.0, 0.7}});
  method.step(s);
  auto copy = s;
  for (int k = 0; k < 3; ++k) {
    method.step(s);
    method.step(copy);
  }
  CHECK(copy.x == s.x);
  CHECK(copy.work == s.work);
  s.status = slant::status::interrupted;
  VectorXd const before = s.x;
  method.step(s);
  CHECK(s.x == before);
  CHECK(s.iteration == copy.iteration);
}

TEST_CASE("bad input is named") {
  auto const wide = slant::smooth(
      1, 2, [](auto const&, auto& f) { f[0] = 0; }, [](auto const&) { return MatrixXd(1, 2); });
  CHECK_THROWS_WITH_AS(slant::semismooth_newton{wide}, "F.rows(): got 1, expected F.cols() 2",
                       slant::bad_input);
  auto const F = curve();
  slant::semismooth_newton const method{F};
  CHECK(SLANT_COMPLAINT(method.start(test::zeros(3))) == "x0: got 3, expected F.cols() 2");
  CHECK_THROWS_AS(static_cast<void>(method.start(VectorXd{{std::nan(""), 0.0}})), slant::bad_input);
  auto const pole = equation([](double y) { return 1 / y; }, [](double y) { return -1 / (y * y); });
  CHECK_THROWS_AS(static_cast<void>(slant::semismooth_newton{pole}.start(number(0))),
                  slant::bad_input);
  CHECK_THROWS_AS((slant::semismooth_newton{F, slant::by_laws{}, slant::full_step{},
                                            slant::fixed_forcing{.tolerance = 2}}),
                  slant::bad_input);
}

TEST_CASE("a function, its operator and a vector that can do the least") {
  archetype::slanting_function const F(3);  // |y| + y/2: zero at y = 0 only
  auto const r =
      slant::solve(slant::semismooth_newton{F}, archetype::vector(VectorXd{{1.0, 2.0, 5.0}}),
                   slant::residual_below(1e-12) || slant::at_most(20));
  using solver = decltype(slant::semismooth_newton{F})::solver_for<archetype::vector>;
  static_assert(std::is_same_v<solver, slant::bicgstab_solver>);
  CHECK(r.converged());
  CHECK(r.x().local().norm() <= 1e-12);
}

TEST_CASE("a scalar without silent conversions gives the bits of double") {
  using S = archetype::scalar;
  using vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
  newton_scene::data const d(4);
  auto const strictly = [](double v) { return S(v); };
  matrix const strict = d.A.unaryExpr(strictly);
  vector const b = d.b.unaryExpr(strictly), zero = d.zero().unaryExpr(strictly);
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(strict);
  auto const F = slant::natural_residual(A, b, newton_scene::contact_set<S>(4, 1e-2), S(d.ρ));
  auto const definite = d.definite();
  auto const G = slant::natural_residual(definite, d.b, newton_scene::contact_set(4, 1e-2), d.ρ);
  auto const r = slant::solve(slant::semismooth_newton{F}, zero,
                              slant::residual_below(S(1e-12)) || slant::at_most(40));
  auto const expected = slant::solve(slant::semismooth_newton{G}, d.zero(),
                                     slant::residual_below(1e-12) || slant::at_most(40));
  REQUIRE(r.converged());
  CHECK(r.iterations() == expected.iterations());
  VectorXd const x = r.x().unaryExpr([](S const& x_i) { return x_i.value(); });
  CHECK((x - expected.x()).norm() <= 1e-12 * expected.x().norm());
}

TEST_CASE("bad starts: far away, infeasible, random") {
  newton_scene::data const d(m);
  auto const A = d.definite();
  auto const F =
      slant::natural_residual(A, d.b, newton_scene::contact_set(m, smallest_radius), d.ρ);
  auto const stop = slant::residual_below(1e-10) || slant::at_most(200);
  VectorXd const solution = slant::solve(slant::semismooth_newton{F}, d.zero(), stop).x();
  for (double size : {1.0, 1e3, 1e10}) {
    for (unsigned seed : {1U, 2U, 3U}) {
      VectorXd const x0 = size * slanting_support::random_vector(3 * m, seed);
      auto const r = slant::solve(slant::semismooth_newton{F}, x0, stop);
      CAPTURE(size);
      CHECK(r.converged());
      CHECK((r.x() - solution).norm() <= 1e-8 * solution.norm());
      CHECK(r.state.residual_scale == slant::norm(slant::evaluate(F, d.zero())));
    }
  }
}

TEST_CASE("slip bounds of zero and infinity: points and free pairs") {
  newton_scene::data const d(4);
  auto const A = d.definite();
  auto const set =
      slant::cartesian(slant::power(slant::half_line<>{}, 4),
                       slant::power(slant::ball<2>{}, VectorXd{{0.0, infinity, 0.5, 0.0}}));
  auto const F = slant::natural_residual(A, d.b, set, d.ρ);
  auto const stop = slant::residual_below(1e-13) || slant::at_most(60);
  auto const check = [&](auto const& method) {
    auto const r = slant::solve(method, d.zero(), stop);
    REQUIRE(r.converged());
    VectorXd const x = r.x(), force = d.A * x - d.b;
    CHECK(x.segment<2>(4).norm() <= 1e-12);
    CHECK(x.segment<2>(10).norm() <= 1e-12);
    CHECK(force.segment<2>(6).norm() <= 1e-11);
    CHECK(x.segment<2>(8).norm() <= 0.5 * (1 + 1e-12));
  };
  check(slant::semismooth_newton{F});
  check(slant::semismooth_newton{F, slant::direct_solver{}});
  // Weak contact: bounds that are active without a force.
  auto const G = slant::natural_residual(A, d.zero(), set, d.ρ);
  auto const r =
      slant::solve(slant::semismooth_newton{G}, slanting_support::random_vector(12, 3), stop);
  CHECK(r.converged());
  CHECK(r.x().norm() <= 1e-12);
}

TEST_CASE("all solvers and globalisations find the same solution") {
  newton_scene::data const d(m);
  auto const A = d.definite();
  auto const set = newton_scene::contact_set(m, smallest_radius);
  auto const F = slant::natural_residual(A, d.b, set, d.ρ);
  auto const stop = slant::residual_below(1e-14) || slant::at_most(60);
  auto const reference = slant::solve(slant::semismooth_newton{F}, d.zero(), stop);
  REQUIRE(reference.converged());
  // Something of everything: free and active bounds, sticking and sliding discs.
  auto const G = F.slant(reference.x());
  auto const& state = slant::slant_of_projection(G);
  int free = 0, sticking = 0;
  for (int i = 0; i < m; ++i) {
    free += state.part<0>().block(i)(0, 0) > 0;
    sticking += state.part<1>().block(i) == MatrixXd(MatrixXd::Identity(2, 2));
  }
  REQUIRE((free > 0 && free < m && sticking < m));

  auto const check = [&](auto const& method) {
    auto const r = slant::solve(method, d.zero(), stop);
    CHECK(r.converged());
    CHECK(r.iterations() <= 20);
    CHECK((r.x() - reference.x()).norm() <= 1e-12 * reference.x().norm());
  };
  check(slant::semismooth_newton{F, slant::symmetrized_cg{}});
  check(slant::semismooth_newton{F, slant::bicgstab_solver{}});
  check(slant::semismooth_newton{F, slant::direct_solver{}});
  check(slant::semismooth_newton{F, slant::by_laws{}, slant::halving_line_search{},
                                 slant::adaptive_precision{}});
  check(slant::semismooth_newton{F, slant::direct_solver{}, slant::full_step{}});
}

TEST_CASE("units do not matter: powers of two give the same bits") {
  newton_scene::data const d(m);
  auto const A = d.definite();
  auto const F =
      slant::natural_residual(A, d.b, newton_scene::contact_set(m, smallest_radius), d.ρ);
  auto const stop = slant::residual_below(1e-12) || slant::at_most(60);
  auto const reference = slant::solve(slant::semismooth_newton{F}, d.zero(), stop);
  REQUIRE(reference.converged());
  for (int of_A : {0, 400, -400}) {
    for (int of_x : {0, 400, -400}) {
      MatrixXd const matrix = std::ldexp(1.0, of_A) * d.A;
      VectorXd const b = std::ldexp(1.0, of_A) * (std::ldexp(1.0, of_x) * d.b);
      auto const B = slant::matrix<slant::self_adjoint, slant::positive_definite>(matrix);
      auto const set = newton_scene::contact_set(m, smallest_radius, std::ldexp(1.0, of_x));
      auto const H = slant::natural_residual(B, b, set, std::ldexp(d.ρ, -of_A));
      auto const r = slant::solve(slant::semismooth_newton{H}, d.zero(), stop);
      CAPTURE(of_A);
      CAPTURE(of_x);
      CHECK(r.converged());
      CHECK(r.state.work == reference.state.work);
      CHECK(VectorXd(std::ldexp(1.0, -of_x) * r.x()) == reference.x());
    }
  }
}

/// A problem whose first step from zero has to be shortened, whatever the solver.
struct scene {
  scene()
      : A(slant::counted(d.definite())),
        F(slant::natural_residual(A, d.b, newton_scene::contact_set(m, 1.5), d.ρ)) {}
  using counted_type = decltype(slant::counted(std::declval<newton_scene::data>().definite()));
  using function_type = decltype(slant::natural_residual(
      std::declval<counted_type const&>(), VectorXd(), newton_scene::contact_set(1, 1.0), 1.0));

  newton_scene::data d{m};
  counted_type A;
  function_type F;
};

/// Steps until the residual is small; each is shown to check(state before, state, products).
template <class Method, class Check>
void run(scene const& p, Method const& method, VectorXd const& x0, Check check) {
  p.A.reset_counts();
  auto s = method.start(x0);
  CHECK(p.A.applications() == 1 + s.work.setup_applications);
  while (s.status == slant::status::running && s.residual_norm > 1e-12 * s.residual_scale &&
         s.iteration < 40) {
    auto const before = s;
    auto const products = p.A.applications();
    method.step(s);
    check(before, s, p.A.applications() - products);
    CHECK(p.A.applications() == s.work.operator_applications + s.work.setup_applications);
  }
  CHECK(s.residual_norm <= 1e-12 * s.residual_scale);
}

TEST_CASE(
    "symmetrized_cg: one for F, one for the right-hand side, one an iteration, one a halving") {
  scene const p;
  slant::index halvings = 0, inner = 0;
  run(p, slant::semismooth_newton{p.F}, p.d.zero(),
      [&](auto const& before, auto const& s, slant::index products) {
        CHECK(products == 1 + s.inner_iterations + s.trials);
        CHECK(s.work.inner_iterations == before.work.inner_iterations + s.inner_iterations);
        CHECK(s.length == std::ldexp(1.0, int(1 - s.trials)));
        halvings += s.trials - 1;
        inner += s.inner_iterations;
      });
  CHECK(halvings > 0);
  CHECK(inner > 10);
}

TEST_CASE("inexact steps cost less than accurate ones") {
  scene const p;
  auto const stop = slant::residual_below(1e-10) || slant::at_most(60);
  auto const products = [&](auto const& rule) {
    auto const r = slant::solve(
        slant::semismooth_newton{p.F, slant::by_laws{}, slant::halving_line_search{}, rule},
        p.d.zero(), stop);
    CHECK(r.converged());
    return r.state.work.operator_applications;
  };
  auto const accurate = products(slant::fixed_forcing{.tolerance = 1e-12});
  CHECK(products(slant::eisenstat_walker{}) < 0.7 * double(accurate));
  CHECK(products(slant::adaptive_precision{}) < accurate);
}

TEST_CASE("no step allocates, shortened ones included") {
  scene const p;
  auto const check = [&](auto const& method) {
    auto s = method.start(p.d.zero());
    slant::index halvings = 0;
    slant::testing::allocation_guard const guard;
    while (s.status == slant::status::running && s.residual_norm > 1e-10 * s.residual_scale) {
      method.step(s);
      halvings += s.trials - 1;
    }
    auto const allocations = guard.count();
    CHECK(allocations == 0);
    CHECK(s.iteration > 3);
    CHECK(halvings > 0);
  };
  check(slant::semismooth_newton{p.F});
  check(slant::semismooth_newton{p.F, slant::bicgstab_solver{}, slant::halving_line_search{},
                                 slant::eisenstat_walker{.η_first = 0.1}});
}

}  // namespace semismooth_newton_test
