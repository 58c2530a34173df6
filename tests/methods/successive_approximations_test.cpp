// SPDX-License-Identifier: MIT
//
// Obstacles that move with the solution: min ½ xᵀA x − bᵀx over x ≥ l, l = S x, a quasi-variational
// inequality whose answer is found besides by relaxation to the last digits.
#include <slant/slant.hpp>

#include <support/testing.hpp>

namespace successive_approximations_test {

constexpr Eigen::Index n = 12;

MatrixXd laplacian() {
  MatrixXd A = 2.2 * MatrixXd::Identity(n, n);
  for (Eigen::Index i = 0; i + 1 < n; ++i) A(i, i + 1) = A(i + 1, i) = -1;
  return A;
}

/// x ≥ rate · (x of the other end) − 1.
struct moving_obstacle {
  using vector_type = VectorXd;
  using scalar = double;
  using operator_type = decltype(slant::counted(
      slant::matrix<slant::self_adjoint, slant::positive_definite>(std::declval<MatrixXd>())));
  using set_type = decltype(slant::half_lines(VectorXd()));

  double rate, unit;
  operator_type A{
      slant::counted(slant::matrix<slant::self_adjoint, slant::positive_definite>(laplacian()))};
  VectorXd b;
  set_type set;
  slant::separable_qp<operator_type const&, VectorXd const&, set_type const&> qp_;

  explicit moving_obstacle(double r, double u = 1)
      : rate(r),
        unit(u),
        b(-unit * VectorXd::LinSpaced(n, 0.2, 2)),
        set(slant::half_lines(test::zeros(n))),
        qp_(A, b, set) {}

  [[nodiscard]] auto const& qp() const { return qp_; }
  [[nodiscard]] slant::index parameter_count() const { return n; }
  void guess(VectorXd const& x, VectorXd& l) const { parameters(x, x, l); }
  void parameters(VectorXd const& x, VectorXd const&, VectorXd& l) const {
    for (Eigen::Index i = 0; i < n; ++i) l(i) = rate * x(n - 1 - i) - unit;
  }
  void assign(VectorXd& l) { set.update(l); }

  /// Projected Gauss–Seidel with the obstacle of the last sweep, until nothing changes.
  [[nodiscard]] VectorXd by_relaxation() const {
    MatrixXd const M = laplacian();
    VectorXd x = VectorXd::Zero(n), l(n);
    for (int outer = 0; outer < 400; ++outer) {
      parameters(x, x, l);
      for (int sweep = 0; sweep < 400; ++sweep) {
        for (Eigen::Index i = 0; i < n; ++i) {
          double const rest = b(i) - M.row(i).dot(x) + M(i, i) * x(i);
          x(i) = std::max(l(i), rest / M(i, i));
        }
      }
    }
    return x;
  }
};

auto newton(moving_obstacle const& family) {
  return [&family](double goal) {
    slant::symmetric_newton_options<double> o;
    o.forcing.goal = goal;
    return slant::symmetric_newton{family.qp(), o};
  };
}
auto stop(double tolerance) {
  return slant::reduced_gradient_below(tolerance) || slant::at_most(200);
}

TEST_CASE("the solution of the problem that belongs to it, at any scale") {
  VectorXd const expected = moving_obstacle(0.5).by_relaxation();
  for (double const unit : {1.0, 1e-150, 1e150}) {
    CAPTURE(unit);
    moving_obstacle family(0.5, unit);
    slant::successive_approximations const method(family, newton(family));
    auto const r = slant::solve(method, test::zeros(n), stop(1e-12));
    REQUIRE(r.converged());
    CHECK((r.x() / unit - expected).norm() <= 1e-10 * expected.norm());
    CHECK(r.state.work.inner_iterations > 0);
  }
}

TEST_CASE("any inner method whose states keep the gradient") {
  moving_obstacle family(0.5);
  auto const kprgp = [&](double) { return slant::kprgp{family.qp()}; };
  slant::successive_approximations const method(family, kprgp);
  auto const r = slant::solve(method, test::zeros(n), stop(1e-11));
  REQUIRE(r.converged());
  CHECK((r.x() - family.by_relaxation()).norm() <= 1e-9);
}

TEST_CASE("a secant step: exact for one unknown at any scale, none without a difference") {
  for (double const unit : {1.0, 1e-150, 1e150}) {
    for (double const rate : {0.8, -3.0}) {
      slant::secant_mixing<VectorXd> mixing(VectorXd(1), 1);
      auto const f = [&](VectorXd const& p) { return VectorXd((rate - 1) * (p.array() - unit)); };
      VectorXd const zero = test::zeros(1);
      VectorXd p(1), next(1);
      CHECK_FALSE(mixing.mix(zero, f(zero), 0.5, p));
      CHECK(p == 0.5 * f(zero));
      CHECK(mixing.mix(p, f(p), 0.5, next));
      CHECK(std::abs(next[0] - unit) <= 1e-14 * unit);
      CHECK_FALSE(mixing.mix(zero, f(p), 1.0, next));  // Δf = 0
      mixing.forget();
      CHECK_FALSE(mixing.mix(zero, f(zero), 1.0, next));
    }
  }
}

TEST_CASE("acceleration: no more steps than the plain iteration") {
  for (double const rate : {0.7, -0.8}) {
    CAPTURE(rate);
    auto const steps = [&](bool secant) {
      moving_obstacle family(rate);
      slant::successive_options<double> const o{.secant = secant};
      slant::successive_approximations const method(family, newton(family), o);
      auto const r = slant::solve(method, test::zeros(n), stop(1e-12));
      CHECK(r.converged());
      return r.iterations();
    };
    CHECK(steps(true) <= steps(false));
  }
}

TEST_CASE("parameters that do not depend on x: one problem, and no product more than that takes") {
  moving_obstacle family(0);
  double const goal = 1e-10;
  slant::successive_options<double> o;
  o.forcing.goal = goal;
  slant::successive_approximations const method(family, newton(family), o);
  auto const r = slant::solve(method, test::zeros(n), stop(goal));
  CHECK(r.converged());
  CHECK(r.iterations() == 1);
  auto const one = slant::solve(newton(family)(goal), test::zeros(n), stop(goal));
  CHECK(r.state.work.operator_applications == one.state.work.operator_applications);
}

TEST_CASE("a first guess that was P of the start, but does not stay, is not solved to the end") {
  moving_obstacle family(0.5);
  double const goal = 1e-10;
  slant::successive_options<double> o;
  o.forcing.goal = goal;
  auto const kprgp = [&](double) { return slant::kprgp{family.qp()}; };
  slant::successive_approximations const method(family, kprgp, o);
  auto s = method.start(VectorXd::Zero(n));
  method.step(s);
  CHECK(s.status == slant::status::running);
  CHECK(s.inner.reduced_gradient_norm <= o.forcing.η_first * s.reduced_gradient_norm);
  VectorXd l(n);
  moving_obstacle guessed(0.5);  // the problem of that guess
  guessed.guess(VectorXd::Zero(n), l);
  guessed.assign(l);
  auto const one = slant::solve(slant::kprgp{guessed.qp()}, test::zeros(n), stop(goal));
  REQUIRE(one.converged());
  CHECK(2 * s.inner_iterations <= one.iterations());
  // The family is left with P(x).
  family.parameters(s.x, s.x, l);
  CHECK(l == s.image);
}

TEST_CASE("products are counted, and iterations do not allocate") {
  moving_obstacle family(0.5);
  slant::successive_approximations const method(family, newton(family));
  auto s = method.start(VectorXd::Zero(n));
  method.step(s);
  slant::testing::allocation_guard guard;
  for (int i = 0; i < 4; ++i) method.step(s);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
  CHECK(family.A.applications() == s.work.operator_applications + s.work.setup_applications);
}

TEST_CASE("no contraction and no solution in reach: stalled or at the limit, never converged") {
  moving_obstacle family(3);
  slant::successive_options<double> const o{.secant = false};
  slant::successive_approximations const method(family, newton(family), o);
  auto const r = slant::solve(method, VectorXd(VectorXd::Ones(n)), stop(1e-10));
  if (r.converged()) {
    VectorXd l(n);
    family.parameters(r.x(), r.x(), l);
    CHECK((r.x() - l).minCoeff() >= -1e-8);
  } else {
    CHECK(r.status != slant::status::running);
  }
}

TEST_CASE("goes on from a solution after the data have changed") {
  moving_obstacle family(0.5);
  slant::successive_approximations const method(family, newton(family));
  auto s = method.start(VectorXd::Zero(n));
  auto rule = stop(1e-12);
  CHECK(slant::detail::run_to_end(method, s, rule).how == slant::status::converged);
  auto const spent = s.work;
  family.b *= 1.01;
  VectorXd const x = s.x;
  method.resume(s, x);
  CHECK(s.iteration == 0);
  CHECK(slant::detail::run_to_end(method, s, rule).how == slant::status::converged);
  CHECK(s.work.operator_applications < spent.operator_applications);
  CHECK((s.x - family.by_relaxation()).norm() <= 1e-10);
}

struct inner_state {};
using state = slant::successive_state<inner_state, VectorXd>;

TEST_CASE("what a status means here; where the inner method is to blame, its own") {
  state s{};
  CHECK(s.status == slant::status::running);
  s.status = slant::status::converged;
  CHECK(s.reason() == "x solves the problem that belongs to it");
  s.status = slant::status::stalled;
  CHECK(s.reason() == "the fixed point iteration gets no nearer");
  s.status = slant::status::unbounded;
  for (auto const inner : {slant::status::unbounded, slant::status::breakdown}) {
    s.inner_status = inner;
    CHECK(s.reason() == "the inner method reports: " + std::string(slant::to_string(inner)));
  }
}

}  // namespace successive_approximations_test
