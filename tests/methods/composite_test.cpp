// SPDX-License-Identifier: MIT
//
// q + φ with functions that are no indicators. References: the dual problem min ½ (b − v)ᵀA⁻¹(b − v)
// over v ∈ Λ by KPRGP, whose x = A⁻¹(b − v) minimises q + σ_Λ; and the optimality conditions,
// written down by hand.
#include <slant/slant.hpp>

#include <krylov/spd_matrices.hpp>
#include <support/minimise.hpp>
#include <support/testing.hpp>

namespace composite_test {

using slant::support;

/// 24 unknowns: a box, discs (one of radius 0), balls in space, a half line, which bounds from above.
struct scene {
  MatrixXd A;
  VectorXd b = 3 * test::random_vector(24, 5);
  VectorXd w{{0.5, 2.0, 0.1, 1.0}};
  VectorXd g{{0.5, 0.0, 2.0, 1.0}};

  explicit scene(double κ, unsigned seed = 1)
      : A(test::with_spectrum(test::log_spaced(24, κ), seed)) {}

  [[nodiscard]] auto set() const {
    return slant::cartesian(slant::intervals(w), slant::discs(g),
                            slant::power(slant::ball<3>(0.7), 2), slant::half_lines(2),
                            slant::power(slant::ellipse(2.0, 0.25), 2));
  }
  /// From the dual problem.
  [[nodiscard]] VectorXd solution() const {
    MatrixXd const inverse = A.inverse();
    auto const S = test::spd(MatrixXd((inverse + inverse.transpose()) / 2));
    auto const Λ = set();
    slant::separable_qp const dual{S, VectorXd(inverse * b), Λ};
    auto const v = test::minimise(slant::kprgp{dual}, test::zeros(24), 1e-14, 200000);
    return inverse * (b - v.x());
  }
};

TEST_CASE("q + σ: the solution of the dual problem, in a few superlinear steps") {
  for (double const κ : {30.0, 1e3, 1e5}) {
    for (unsigned seed = 1; seed <= 4; ++seed) {
      CAPTURE(κ);
      CAPTURE(seed);
      scene const s(κ, seed);
      VectorXd const exact = s.solution();
      auto const A = test::spd(s.A);
      auto const φ = support(s.set());
      slant::separable_qp const program{A, s.b, φ};
      for (double const size : {0.0, 10.0, 1e8}) {
        VectorXd const x0 = size * test::random_vector(24, seed + 90);
        auto const r =
            test::minimise(slant::symmetric_newton{program}, x0, κ > 1e4 ? 1e-10 : 1e-12, 80);
        CAPTURE(size);
        CHECK(r.converged());
        CHECK((r.x() - exact).norm() <= 1e-10 * κ * exact.norm());
        CHECK(r.iterations() <= (κ > 1e4 ? 60 : 40));
      }
      auto const slow =
          test::minimise(slant::forward_backward{program}, test::zeros(24), 1e-10, 50000);
      CHECK(slow.converged());
      CHECK((slow.x() - exact).norm() <= 1e-9 * κ * exact.norm());
    }
  }
}

TEST_CASE("no stall while the envelope falls: ‖F‖ may rise on the way") {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    CAPTURE(seed);
    auto const A = test::spd(test::with_spectrum(test::log_spaced(20, 1e6), seed));
    VectorXd const b = test::random_vector(20, seed + 40);
    slant::separable_qp const program{A, b, slant::half_lines(20)};
    slant::symmetric_newton_options<double> impatient;
    impatient.patience = 1;
    auto const r =
        test::minimise(slant::envelope_newton{program, impatient}, test::zeros(20), 1e-10, 300);
    CHECK(r.converged());
  }
}

TEST_CASE("sets and functions side by side: normal gaps and friction") {
  Index const m = 8;
  MatrixXd const M = test::with_spectrum(test::log_spaced(3 * m, 200), 3);
  auto const A = test::spd(M);
  VectorXd const b = 2 * test::random_vector(3 * m, 8);
  VectorXd const g = VectorXd::LinSpaced(m, 0, 4);
  auto const φ = slant::separable_sum(slant::half_lines(m), support(slant::discs(g)));
  slant::separable_qp const program{A, b, φ};
  auto const r = test::minimise(slant::symmetric_newton{program}, test::zeros(3 * m), 1e-13, 60);
  REQUIRE(r.converged());
  VectorXd const force = b - M * r.x();  // ∈ ∂φ(x)
  double const size = b.norm();
  Index sticks = 0, slides = 0, touches = 0;
  for (Index i = 0; i < m; ++i) {
    double const x = r.x()[i], f = force[i];
    CHECK(x >= 0);
    CHECK(f <= 1e-11 * size);
    CHECK(std::abs(x * f) <= 1e-11 * size);
    touches += x == 0;
    Vector2d const u = r.x().segment<2>(m + 2 * i), t = force.segment<2>(m + 2 * i);
    CHECK(t.norm() <= g[i] + 1e-11 * size);
    CHECK(std::abs(t.dot(u) - g[i] * u.norm()) <= 1e-11 * size);
    (u.norm() == 0 ? sticks : slides) += 1;
  }
  CHECK(sticks > 0);
  CHECK(slides > 0);
  CHECK(touches > 0);
}

TEST_CASE("the same steps as Newton's method for the natural residual") {
  scene const p(100);
  auto const A = test::spd(p.A);
  auto const φ = support(p.set());
  slant::separable_qp const program{A, p.b, φ};
  VectorXd const x0 = VectorXd::Zero(24);
  slant::symmetric_newton_options<double> exact;
  exact.forcing = {.γ = 1e-14, .exponent = 2, .η_max = 1e-14, .η_first = 1e-14};
  exact.step_length = 0.9 / p.A.operatorNorm();
  slant::symmetric_newton const method{program, exact};
  auto s = method.start(x0);
  slant::semismooth_newton const generic{slant::natural_residual(A, p.b, φ, s.step_length),
                                         slant::direct_solver{}};
  test::check_same_steps(method, s, generic, s.y);
}

TEST_CASE("units do not matter, steps do not allocate, products are counted") {
  scene const p(100);
  VectorXd const exact = p.solution();
  for (double const unit : {1e-120, 1.0, 1e120}) {
    for (double const length : {1e-20, 1.0, 1e20}) {
      CAPTURE(unit);
      CAPTURE(length);
      auto const A = slant::counted(test::spd(MatrixXd(p.A * (unit / length))));
      VectorXd const b = p.b * unit, w = p.w * unit, g = p.g * unit;
      auto const φ = slant::separable_sum(
          support(slant::intervals(w)), support(slant::discs(g)),
          support(slant::power(slant::ball<3>(0.7 * unit), 2)), support(slant::half_lines(2)),
          support(slant::power(slant::ellipse(2.0 * unit, 0.25 * unit), 2)));
      slant::separable_qp const program{A, b, φ};
      slant::symmetric_newton const method{program};
      auto s = method.start(test::zeros(24));
      for (int k = 0; k < 40 && s.status == slant::status::running; ++k) {
        auto const before = A.applications();
        std::size_t allocations = 0;
        {
          slant::testing::allocation_guard const guard;
          method.step(s);
          allocations = guard.count();
        }
        CHECK(allocations == 0);
        CHECK(A.applications() - before == s.inner_iterations + (k == 0 ? 2 : 1));
        if (s.reduced_gradient_norm <= 1e-12 * s.gradient_scale) break;
      }
      CHECK((s.x / length - exact).norm() <= 1e-9 * exact.norm());
    }
  }
}

/// M = A⁻¹ that knows A with an error of the size `roughness`.
struct rough_inverse {
  using scalar = double;
  static constexpr slant::law_set laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
  static constexpr double roughness = 1e-4;

  MatrixXd inverse, rough;

  explicit rough_inverse(MatrixXd const& A)
      : inverse(MatrixXd::Identity(A.rows(), A.rows())), rough(A) {
    double const size = A.cwiseAbs().maxCoeff() * 1e-5;
    rough = (A / size).array().round() * size;
  }
  [[nodiscard]] Index rows() const { return rough.rows(); }
  [[nodiscard]] Index cols() const { return rough.rows(); }
  template <class X, class Y>
  void apply(X const& x, Y& y) const {
    y = inverse * x;
  }
  struct workspace_type {
    VectorXd last;
  };
  template <class X>
  [[nodiscard]] workspace_type workspace(X const&) const {
    return {VectorXd::Zero(rows())};
  }
  template <class X, class Y>
  void apply(X const& x, Y& y, workspace_type& w) const {
    y = inverse * x;
    w.last = y;
  }
  template <class X, class Y>
  void multiply_roughly(X const& x, Y& y, workspace_type&) const {
    y = rough * x;
  }
  template <class X, class Y>
  void multiply_last_roughly(X const&, Y& y, workspace_type& w) const {
    y = rough * w.last;
  }
};

TEST_CASE("products that M knows roughly: used where they are good enough, and only there") {
  for (double const κ : {10.0, 1e6}) {
    CAPTURE(κ);
    scene const p(κ);
    auto const Λ = p.set();
    auto const A = slant::counted(test::spd(p.A));
    slant::separable_qp const program{A, p.b, support(Λ)};
    rough_inverse const M(p.A);
    static_assert(slant::multiplies_roughly<rough_inverse, VectorXd>);
    slant::envelope_newton const method{program, M};
    auto s = method.start(test::zeros(24));
    auto const before = A.applications();
    for (int k = 0; k < 100 && s.status == slant::status::running; ++k) {
      method.step(s);
      if (s.reduced_gradient_norm <= 1e-11 * s.gradient_scale) break;
    }
    VectorXd const exact = p.solution();
    CHECK((s.x - exact).norm() <= 1e-11 * κ * exact.norm());
    CHECK(s.roughly == (κ < 1e3));
    if (s.roughly) CHECK(A.applications() - before == s.iteration + 1 + s.descents);
  }
}

TEST_CASE("the certificate: never below the error by more than it may be, and not far above it") {
  double worst = 0;
  for (double const κ : {30.0, 1e4, 1e7}) {
    for (unsigned seed = 1; seed <= 3; ++seed) {
      scene const p(κ, seed);
      auto const A = test::spd(p.A);
      auto const φ = support(p.set());
      slant::separable_qp const program{A, p.b, φ};
      slant::symmetric_newton const method{program};
      auto const end = test::minimise(method, test::zeros(24), 1e-14, 200);
      VectorXd const exact = end.x();
      slant::energy_certificate certificate(program);
      auto s = method.start(test::zeros(24));
      for (int k = 0; k < 40 && s.status == slant::status::running; ++k) {
        method.step(s);
        VectorXd const e = s.x - exact;
        double const truth = std::sqrt(e.dot(p.A * e)) / std::sqrt(exact.dot(p.A * exact));
        if (truth < 1e-10) break;
        double const claimed = certificate(s.x).relative();
        CAPTURE(κ);
        CAPTURE(truth);
        CAPTURE(claimed);
        CHECK(claimed >= 0.5 * truth);
        if (truth < 1e-3) worst = std::max(worst, claimed / truth);
      }
    }
  }
  CHECK(worst <= 100);
}

TEST_CASE("forward–backward: the projected gradient method, options, and what it refuses") {
  scene const p(100);
  auto const A = test::spd(p.A);
  auto const Λ = p.set();
  slant::separable_qp const qp{A, p.b, Λ};
  VectorXd const x0 = VectorXd::Zero(24);
  auto const reference = test::minimise(slant::kprgp{qp}, x0, 1e-13, 5000);
  auto const stop = slant::reduced_gradient_below(1e-11) || slant::at_most(20000);
  auto const fast = slant::solve(slant::forward_backward{qp}, x0, stop);
  auto const slow = slant::solve(slant::forward_backward{qp, {.extrapolate = false}}, x0, stop);
  for (auto const& r : {fast, slow}) {
    CHECK(r.converged());
    CHECK((r.x() - reference.x()).norm() <= 1e-8 * reference.x().norm());
    CHECK(r.state.work.operator_applications <= r.iterations() + 2);
  }
  CHECK(fast.iterations() < slow.iterations());

  CHECK(test::complaint([&] {
          slant::forward_backward{qp, {.step_length = -1.0}};
        }) == "step_length: got -1, expected a finite number > 0");
  CHECK(SLANT_COMPLAINT(slant::separable_qp{A, p.b, support(slant::intervals(p.w))})
            .find("dimension of the function: got 4") != std::string::npos);
}

/// ½ c max(0, −x)², a spring that pulls back from below 0: an own block, no support function.
struct spring {
  static constexpr int dimension = 1;
  using point = Eigen::Matrix<double, 1, 1>;
  double c = 2;

  [[nodiscard]] point prox(double ρ, point const& z) const {
    return point(z[0] < 0 ? z[0] / (1 + ρ * c) : z[0]);
  }
  [[nodiscard]] double value(point const& x) const { return x[0] < 0 ? c / 2 * x[0] * x[0] : 0.0; }
  [[nodiscard]] point slant(double ρ, point const& z) const {
    return point(z[0] < 0 ? 1 / (1 + ρ * c) : 1.0);
  }
};

TEST_CASE("a function of one's own, certified") {
  MatrixXd const M = test::with_spectrum(test::log_spaced(6, 50), 2);
  auto const A = test::spd(M);
  VectorXd const b = test::random_vector(6, 3);
  auto const φ =
      slant::separable_sum(spring{}, spring{5}, support(slant::intervals(VectorXd::Ones(2))),
                           spring{0.1}, slant::half_line<>{});
  auto const run = slant::solve(slant::minimise(slant::quadratic(A, b) + φ), 1e-10);
  REQUIRE(run.converged());
  VectorXd const force = b - M * run.x();
  double const c[] = {2, 5, 0, 0, 0.1};
  for (Index i : {0, 1, 4})
    CHECK(std::abs(force[i] - std::min(c[i] * run.x()[i], 0.0)) <= 1e-8 * b.norm());
}

TEST_CASE("singular A: as many zeros as it takes, by Newton's method as by forward–backward") {
  MatrixXd const M = [] {
    MatrixXd m(20, 60);
    for (Index j = 0; j < 60; ++j) m.col(j) = test::random_vector(20, unsigned(100 + j));
    return m;
  }();
  MatrixXd const gram = M.transpose() * M;
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(gram);
  VectorXd sparse = VectorXd::Zero(60);
  sparse[3] = 2;
  sparse[17] = -1;
  sparse[40] = 3;
  VectorXd const b = gram * sparse;
  for (double const μ : {0.5, 2.0}) {
    VectorXd const w = VectorXd::Constant(60, μ);
    slant::separable_qp const program{A, b, support(slant::intervals(w))};
    VectorXd const x0 = VectorXd::Zero(60);
    auto const r = test::minimise(slant::symmetric_newton{program}, x0, 1e-9, 300);
    auto const slow = test::minimise(slant::forward_backward{program}, x0, 1e-10, 50000);
    CAPTURE(μ);
    CHECK(r.converged());
    REQUIRE(slow.converged());
    CHECK((r.x() - slow.x()).norm() <= 1e-6 * slow.x().norm());
    CHECK((r.x().array() != 0.0).count() < 20);
    auto const run = slant::solve(program, 1e-8);
    CHECK(run.converged());
    CHECK((M * (run.x() - slow.x())).norm() <= 1e-8 * (M * slow.x()).norm());
  }
}

/// m bounds, some of them infinite, and m weights of norms around a known x: pressed, open, sliding
/// and sticking, stiffness over six orders of magnitude and `zeros` motions without, in units of each
/// block up to 10^±spread.
struct known_problem {
  MatrixXd A;
  VectorXd b, lower, g, x;

  known_problem(int m, double spread, int zeros, unsigned seed) : lower(m), g(m), x(3 * m) {
    VectorXd eigenvalues = test::log_spaced(3 * m, 1e6);
    eigenvalues.head(zeros).setZero();
    A = test::with_spectrum(eigenvalues, seed);
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> draw(0, 1);
    VectorXd force = VectorXd::Zero(3 * m), unit(3 * m);
    for (int i = 0; i < m; ++i) {
      bool const bounded = draw(generator) < 0.8, touches = bounded && draw(generator) < 0.5;
      lower[i] = bounded ? draw(generator) - 0.5 : -std::numeric_limits<double>::infinity();
      x[i] = touches ? lower[i] : (bounded ? lower[i] : 0) + draw(generator);
      if (touches) force[i] = draw(generator);
      double const angle = 6 * draw(generator);
      Vector2d const direction(std::cos(angle), std::sin(angle));
      bool const sticks = draw(generator) < 0.5;
      g[i] = draw(generator) < 0.1 ? 0 : draw(generator);
      x.segment<2>(m + 2 * i) = sticks ? Vector2d::Zero() : Vector2d(draw(generator) * direction);
      force.segment<2>(m + 2 * i) = -g[i] * (sticks ? draw(generator) : 1) * direction;
      unit[i] = std::pow(10, spread * (2 * draw(generator) - 1));
      unit.segment<2>(m + 2 * i).setConstant(std::pow(10, spread * (2 * draw(generator) - 1)));
    }
    b = unit.cwiseProduct(A * x - force);
    A = (unit.asDiagonal() * A * unit.asDiagonal()).eval();
    x = x.cwiseQuotient(unit);
    lower = lower.cwiseQuotient(unit.head(m));
    for (int i = 0; i < m; ++i) g[i] *= unit[m + 2 * i];
  }
};

TEST_CASE("a function that falls for ever ends as stalled") {
  MatrixXd M = MatrixXd::Zero(2, 2);
  M(0, 0) = 1;
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(M);
  VectorXd const b = VectorXd::Ones(2);
  auto const φ = support(slant::power(slant::interval<double>(-0.5, 0.5), 2));
  slant::separable_qp const program{A, b, φ};
  auto const r = test::minimise(slant::envelope_newton{program}, test::zeros(2), 1e-10, 1000);
  CHECK(r.status == slant::status::stalled);
}

TEST_CASE("solve(problem, tolerance): right on random problems, in any units, with a singular A") {
  slant::index plain = 0;
  for (auto const& [spread, zeros] : {std::pair(0.0, 0), std::pair(4.0, 0), std::pair(0.0, 2)}) {
    slant::index applications = 0;
    for (unsigned seed = 1; seed <= 30; ++seed) {
      known_problem const p(3 + static_cast<int>(seed % 8), spread, zeros, seed);
      auto const pressure = slant::half_lines(p.lower);
      auto const discs = slant::discs(p.g);
      auto const φ = slant::separable_sum(pressure, support(discs));
      auto const solved = [&](auto const& A) {
        return slant::solve(slant::minimise(slant::quadratic(A, p.b) + φ), 1e-8);
      };
      auto const run =
          zeros == 0
              ? solved(test::spd(p.A))
              : solved(slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(p.A));
      CAPTURE(spread);
      CAPTURE(zeros);
      CAPTURE(seed);
      CAPTURE(run.reason);
      VectorXd const e = run.x() - p.x;
      CHECK(run.converged());
      CHECK(std::sqrt(std::abs(e.dot(p.A * e))) <= 1e-8 * std::sqrt(p.x.dot(p.A * p.x)));
      applications += run.work.operator_applications;
    }
    if (plain == 0) plain = applications;
    CHECK(applications <= 2 * plain);
  }
}

}  // namespace composite_test
