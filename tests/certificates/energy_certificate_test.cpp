// SPDX-License-Identifier: MIT
#include <slant/slant.hpp>
#include <slant/testing/archetypes.hpp>

#include <support/minimise.hpp>
#include <support/testing.hpp>
#include "made_programs.hpp"

namespace energy_certificate_test {

TEST_CASE("with A⁻¹ itself the bound is never below the error, and near the solution close to it") {
  std::mt19937 random(2026);
  std::normal_distribution<double> gauss;
  int close = 0, all = 0;
  for (int run = 0; run < 60; ++run) {
    auto const p = test::make_program(1 + run % 5, 8.0 * (run % 7) / 6, random);
    auto const qp = test::program(p);
    auto const M = slant::matrix<slant::self_adjoint, slant::positive_definite>(p.inverse);
    slant::energy_certificate certificate(qp, slant::dominates_inverse(M));
    for (double δ = 1; δ > 1e-13; δ /= 100) {
      VectorXd x = p.solution;
      for (double& entry : x) entry += δ * gauss(random);
      // Steps of the projected gradient method, which put the point on its face.
      for (int step = 0; step < 3; ++step)
        x = slant::project(qp.set(), VectorXd(x - p.A * x + p.b));
      VectorXd const y = slant::project(qp.set(), x);
      double const error = test::energy_norm(p.A, y - p.solution);
      auto const known = certificate(x);
      CHECK(known.bound * (1 + 1e-9) + 2 * p.lost >= error);
      // With larger condition numbers three steps do not find the face.
      if (run % 7 <= 2 && δ < 1e-3 && error > 100 * p.lost) {
        ++all;
        close += known.bound <= 30 * error ? 1 : 0;
      }
    }
  }
  CHECK(all > 50);
  CHECK(close >= 0.9 * all);
}

TEST_CASE("without A⁻¹ conjugate gradients estimate the same") {
  std::mt19937 random(11);
  std::normal_distribution<double> gauss;
  for (int run = 0; run < 20; ++run) {
    auto const p = test::make_program(2 + run % 3, 4.0 * (run % 4) / 3, random);
    auto const qp = test::program(p);
    auto const M = slant::matrix<slant::self_adjoint, slant::positive_definite>(p.inverse);
    slant::energy_certificate by_inverse(qp, slant::dominates_inverse(M));
    slant::energy_certificate by_cg(qp);
    VectorXd x = p.solution;
    for (double& entry : x) entry += 1e-3 * gauss(random);
    auto const bound = by_inverse(x), estimate = by_cg(x);
    CHECK_FALSE(estimate.proven);
    CHECK(estimate.bound <= 2 * bound.bound);
    VectorXd const nearest = slant::project(qp.set(), x);
    CHECK(estimate.bound >= 0.5 * test::energy_norm(p.A, nearest - p.solution));
    CHECK(estimate.size == doctest::Approx(bound.size).epsilon(1e-12));
  }
}

TEST_CASE("at the end of a run the estimate is the error, whatever the tolerance was") {
  std::mt19937 random(3);
  int sharp = 0, all = 0;
  for (int run = 0; run < 40; ++run) {
    auto const p = test::make_program(2 + run % 4, 6.0 * (run % 7) / 6, random);
    auto const qp = test::program(p);
    slant::energy_certificate certificate(qp);
    for (double const tolerance : {1e-2, 1e-4, 1e-6, 1e-9}) {
      auto const r =
          test::minimise(slant::symmetric_newton{qp}, test::zeros(p.b.size()), tolerance, 300);
      double const error = test::energy_norm(p.A, r.x() - p.solution);
      if (!(error > 100 * p.lost)) continue;
      auto const e = certificate(r.x());
      CHECK(e.bound >= 0.4 * error);
      if (tolerance > 1e-4) continue;  // before, the face may be another one
      ++all;
      sharp += e.bound <= 3 * error ? 1 : 0;
    }
  }
  CHECK(all > 20);
  CHECK(sharp >= 0.95 * all);
}

TEST_CASE("A singular: the error is known where the constraints hold what A does not") {
  // Two springs between three points, the first at most at 1, the last at least at 0.
  MatrixXd const A{{1.0, -1.0, 0.0}, {-1.0, 2.0, -1.0}, {0.0, -1.0, 1.0}};
  VectorXd const b{{2.0, -1.0, -1.0}};
  VectorXd const lower{{-10.0, -10.0, 0.0}};
  slant::separable_qp const qp{slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(A),
                               b, slant::half_lines(lower)};
  // b sums to 0: every x* = (3, 1, 0) + c with c ≥ 0 is a solution, at the same energy.
  VectorXd const solution{{3.0, 1.0, 0.0}};
  slant::energy_certificate certificate(qp);
  for (double const δ : {1e-3, 1e-6, 1e-10}) {
    VectorXd const x = solution + δ * VectorXd{{1.0, -2.0, 0.5}} + VectorXd::Constant(3, 0.7);
    double const error = test::energy_norm(A, x - solution);
    auto const e = certificate(x);
    CHECK(e.bound >= 0.9 * error);
    CHECK(e.bound <= 2 * error);
  }
  CHECK(certificate(solution).bound <= 1e-14);
  CHECK(std::isinf(certificate(VectorXd(solution.array() + 1e15)).bound));  // rounding, all of it
  // A b that no constraint holds: there is no solution, and nothing is claimed.
  VectorXd const pulled{{2.0, -1.0, 0.0}};
  slant::separable_qp const endless{qp.a(), pulled, slant::half_lines(lower)};
  CHECK(std::isinf(slant::energy_certificate(endless)(solution).bound));
}

/// A matrix that gives no entries.
struct opaque {
  using scalar = double;
  static constexpr slant::law_set laws =
      slant::laws<slant::self_adjoint, slant::positive_semidefinite>;
  MatrixXd const* a;
  [[nodiscard]] slant::index rows() const { return a->rows(); }
  [[nodiscard]] slant::index cols() const { return a->cols(); }
  void apply(VectorXd const& x, VectorXd& y) const { y.noalias() = *a * x; }
};

TEST_CASE("unknowns in units of their own, 1e8 to either side, do not hide the error") {
  int const n = 12;
  VectorXd units(n), rest(n);
  MatrixXd alike(n, n);
  for (int i = 0; i < n; ++i) {
    units(i) = std::pow(10.0, 8.0 * std::sin(1.7 * i));
    // Small where the gradient is in large units, as methods leave it that look at its norm.
    rest(i) = units(i) > 1 ? 1e-10 : 1e-3;
    for (int j = 0; j < n; ++j) alike(i, j) = (i == j ? 1 : 0) + 0.3 / (1 + std::abs(i - j));
  }
  MatrixXd const A = units.asDiagonal() * alike * units.asDiagonal();
  VectorXd const solution = units.cwiseInverse(), b = A * solution;
  VectorXd const scaled = alike.ldlt().solve(rest), error = scaled.cwiseQuotient(units);
  double const truth = std::sqrt(scaled.dot(rest));
  auto const free = slant::free_components<double>(n);
  auto const M = slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(A);
  slant::separable_qp const known(M, b, free);
  slant::separable_qp const hidden(opaque{&A}, b, free);
  slant::energy_certificate of_known(known);
  slant::energy_certificate of_hidden(hidden);
  CHECK(of_known(solution + error).bound == doctest::Approx(truth).epsilon(0.2));
  CHECK(of_hidden(solution + error).bound == doctest::Approx(truth).epsilon(0.2));
  VectorXd nowhere = solution;
  nowhere(3) = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isinf(of_known(nowhere).relative()));
}

TEST_CASE("a disc that the gradient leaves after the Newton step, along what A hardly resists") {
  // Weak along (0, 1, 1), which diag(A) does not show. At x the gradient presses (x₀, x₁) against
  // the unit disc; after the step of x₂ it pulls it inside, up to the middle.
  double const ε = 1e-9, pull = 1e-9;
  MatrixXd const A{{1.0, 0.0, 0.0}, {0.0, 1.0, ε - 1}, {0.0, ε - 1, 1.0}};
  VectorXd const x{{0.0, 1.0, 0.0}}, g{{0.0, -0.1 * pull, 1.1 * pull}}, b = A * x - g;
  VectorXd const radius = VectorXd::Ones(1);
  slant::separable_qp const qp{
      slant::matrix<slant::self_adjoint, slant::positive_definite>(A), b,
      slant::cartesian(slant::discs(radius), slant::free_components<double>(1))};
  slant::energy_certificate certificate(qp);
  double const error = pull / std::sqrt(2 * ε);  // √(gᵀA⁻¹g) to six digits
  CHECK(certificate(x).bound >= 0.5 * error);
  CHECK(certificate(x).bound <= 10 * error);
}

TEST_CASE("in any units, also where energies leave the range of the numbers") {
  std::mt19937 random(21);
  auto const p = test::make_program(3, 2, random);
  std::normal_distribution<double> gauss;
  VectorXd noise(p.b.size());
  for (double& entry : noise) entry = gauss(random);
  // A of 2ᵃ, x of 2ᵗ.
  auto const bounds = [&](int a, int t) {
    test::made_program q = p;
    q.A *= std::ldexp(1.0, a);
    q.inverse *= std::ldexp(1.0, -a);
    q.b *= std::ldexp(1.0, a + t);
    q.g *= std::ldexp(1.0, t);
    VectorXd const x = std::ldexp(1.0, t) * (p.solution + 0.1 * noise);
    auto const qp = test::program(q);
    auto const M = slant::matrix<slant::self_adjoint, slant::positive_definite>(q.inverse);
    slant::energy_certificate estimate(qp);
    slant::energy_certificate bound(qp, slant::dominates_inverse(M));
    auto const semidefinite = slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(q.A);
    slant::separable_qp const weaker{semidefinite, q.b, qp.set()};
    CHECK(slant::energy_certificate(weaker)(x).bound == doctest::Approx(estimate(x).bound));
    double const unit = std::ldexp(1.0, a / 2) * std::ldexp(1.0, t);
    return std::pair(estimate(x).bound / unit, bound(x).bound / unit);
  };
  auto const [estimate, bound] = bounds(0, 0);
  for (auto const& [a, t] :
       {std::pair(500, -500), std::pair(-500, 500), std::pair(-300, -380), std::pair(300, 380),
        std::pair(0, -520), std::pair(0, 500), std::pair(-900, 0), std::pair(900, 0)}) {
    CAPTURE(a);
    CAPTURE(t);
    auto const there = bounds(a, t);
    CHECK(there.first == doctest::Approx(estimate).epsilon(1e-6));
    CHECK(there.second == doctest::Approx(bound).epsilon(1e-6));
  }
}

TEST_CASE("a disc that is all but a point hides nothing of the others") {
  std::mt19937 random(3);
  auto p = test::make_program(3, 2, random);
  auto const M = slant::matrix<slant::self_adjoint, slant::positive_definite>(p.inverse);
  for (double const g : {0.0, 1e-150, 1e-160, 1e-250}) {
    p.g(1) = g;
    auto const qp = test::program(p);
    slant::energy_certificate bound(qp, slant::dominates_inverse(M));
    auto const r = test::minimise(slant::symmetric_newton{qp}, VectorXd(p.b), 1e-12, 100);
    CHECK(bound(r.x()).relative() <= 1e-8);
  }
}

TEST_CASE("numbers that can do no more than the concept of a scalar asks for") {
  using S = slant::testing::archetype::scalar;
  using vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  vector const d = vector::Constant(2, S(2)), b = vector::Constant(2, S(1));
  auto const A = slant::diagonal<slant::positive_definite>(d);
  auto const set = slant::half_lines<S>(2);
  slant::separable_qp const qp{A, b, set};
  slant::energy_certificate certificate(qp);
  auto const e = certificate(vector(vector::Constant(2, S(0.75))));
  // x* = ½: ‖x − x*‖_A = ¼ √2 √2
  CHECK(e.bound > S(0.499));
  CHECK(e.bound < S(1));
}

TEST_CASE("relative errors: of a solution that is zero, of one about which nothing is known") {
  CHECK(slant::energy_error<double>{.bound = 0, .size = 0}.relative() == 0);
  CHECK(slant::energy_error<double>{.bound = 1, .size = 3, .proven = true}.relative() == 0.5);
  CHECK(slant::energy_error<double>{.bound = 1, .size = 3}.relative() == 1);
  CHECK(std::isinf(slant::energy_error<double>{.bound = 2, .size = 1}.relative()));
  // An estimate just below the size at a point 1e13 solutions away: nothing is known.
  CHECK(std::isinf(slant::energy_error<double>{.bound = 1 - 1e-6, .size = 1}.relative()));
  CHECK(std::isinf(slant::estimated_error<double>(true, 0, 1e20, 1, 0).relative()));
  CHECK(slant::energy_error<double>{.bound = 2, .size = 1}.sentence() ==
        "relative energy error inf (2 at a point of energy norm 1), estimated");
  CHECK(std::isnan(slant::error_bound_of_root(quiet_nan, 0.0)));
  CHECK(slant::error_bound_of_root(infinity, infinity) == infinity);
  CHECK(slant::error_bound_of_root(0.0, 2.0) == doctest::Approx(2));
  CHECK(slant::error_bound_of_root(1e-200, 1e-150) >= 1e-150);
  CHECK(slant::error_bound_of_root(1e200, 1e150) >= 1e200);
}

TEST_CASE("energy_error_below: kprgp stops by the error, asked only where it may say yes") {
  std::mt19937 random(5);
  auto const p = test::make_program(4, 3, random);
  auto const qp = test::program(p);
  auto const M = slant::matrix<slant::self_adjoint, slant::positive_definite>(p.inverse);
  slant::energy_certificate certificate(qp, slant::dominates_inverse(M));
  int asked = 0;
  auto const count = [&](VectorXd const& x) {
    ++asked;
    return certificate(x);
  };
  VectorXd const x0 = VectorXd::Zero(p.b.size());
  auto const run = slant::solve(slant::kprgp{qp}, x0,
                                slant::energy_error_below(1e-9, count) || slant::at_most(20000));
  CHECK(run.status == slant::status::converged);
  CHECK(run.reason.find("relative energy error") != std::string::npos);
  CHECK(test::energy_norm(p.A, run.x() - p.solution) <= 1e-9 * test::energy_norm(p.A, p.solution));
  CHECK(asked < 12);
  CHECK(asked < run.iterations());
}

TEST_CASE("energy_error_below: what the certificate denies is no success") {
  std::mt19937 random(5);
  auto const p = test::make_program(2, 1, random);
  auto const qp = test::program(p);
  auto const hopeless = [](VectorXd const&) {
    return slant::energy_error<double>{.bound = 0.5, .size = 1};
  };
  auto const run = slant::solve(slant::kprgp{qp}, test::zeros(p.b.size()),
                                slant::energy_error_below(1e-6, hopeless) || slant::at_most(5000));
  CHECK(run.status != slant::status::converged);
  CHECK_THROWS_AS(slant::energy_error_below(-1.0, hopeless), slant::bad_input);
  CHECK_THROWS_AS(slant::energy_error_below(1.5, hopeless), slant::bad_input);
}

}  // namespace energy_certificate_test
