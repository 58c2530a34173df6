// SPDX-License-Identifier: MIT
#include <slant/contact/certificate.hpp>
#include <slant/contact/dual.hpp>
#include <slant/contact/preconditioners.hpp>
#include <slant/contact/solve.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/factorizations/ldlt.hpp>
#include <slant/methods/interior_point.hpp>
#include <support/testing.hpp>
#include "scenes.hpp"

namespace certificate_test {

/// Throws if K is not positive definite.
constexpr auto be_definite = [](auto const& K) { (void)slant::factorize(K); };

/// A brick with a reference solution, and the certificate of points beside it.
struct certified_scene {
  fem::contact_scene<3> scene;
  contact::data<double> data;
  decltype(slant::factorize(std::declval<Eigen::SparseMatrix<double> const&>())) factor;
  contact::certificate<double> certificate;
  oracle::contact_reference reference;
  decltype(slant::cartesian(slant::half_lines(slant::index(1)), slant::discs(VectorXd()))) set;

  explicit certified_scene(fem::steel_brick_options const& o)
      : scene(fem::make_steel_brick(o)),
        data(test::contact_data(scene)),
        factor(slant::factorize(scene.K)),
        certificate(scene.K, data),
        reference(test::reference(scene.K, data)),
        set(slant::cartesian(slant::half_lines(data.nodes()), slant::discs(data.g))) {}

  auto solver() const { return contact::solver(factor); }
  bool prove() { return certificate.prove(solver(), be_definite); }
  VectorXd displacement(VectorXd const& λ) const {
    VectorXd load = data.f - data.N.transpose() * λ.head(data.nodes()) -
                    data.T.transpose() * λ.tail(data.T.rows());
    VectorXd u(load.size());
    solver()(load, u);
    return u;
  }
  slant::energy_error<double> operator()(VectorXd λ, VectorXd& u, double goal = 1e-8) {
    u = displacement(slant::project(set, λ));
    return certificate(set, λ, u, goal, solver());
  }
  double error(VectorXd const& u) const {
    VectorXd const e = u - reference.u;
    return std::sqrt(e.dot(scene.K * e));
  }
};

/// λ* off by δ, then three steps of the projected gradient method, which put it on its face.
VectorXd near_solution(certified_scene const& s, double δ, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> gauss;
  VectorXd λ = s.reference.multipliers();
  double const size = λ.cwiseAbs().maxCoeff();
  for (double& entry : λ) entry += δ * size * gauss(random);
  λ = slant::project(s.set, λ);
  double const step = 0.3 * s.scene.K.diagonal().mean() / 10;
  for (int k = 0; k < 3; ++k) {
    VectorXd const u = s.displacement(λ);
    VectorXd g(λ.size());
    g << s.data.d - s.data.N * u, -(s.data.T * u);
    λ = slant::project(s.set, VectorXd(λ - step * g));
  }
  return λ;
}

/// ‖u‖_K with sums in quadruple precision.
double energy_norm(Eigen::SparseMatrix<double> const& K, VectorXd const& u) {
  __extension__ using quad = __float128;
  quad sum = 0;
  for (Eigen::Index j = 0; j < K.outerSize(); ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator k(K, j); k; ++k)
      sum += quad(u(k.row())) * quad(k.value()) * quad(u(j));
  }
  return std::sqrt(double(sum));
}

TEST_CASE("a proven bound is never below the error, and not far above it") {
  for (auto const load : fem::brick_loads) {
    certified_scene s({.k = 2, .load = load});
    REQUIRE(s.prove());
    // λ_min(K) by the power method on K⁻¹ from the other side.
    VectorXd x = VectorXd::Ones(s.data.f.size()), y(x.size());
    for (int k = 0; k < 60; ++k) {
      s.solver()(x, y);
      x = y / y.norm();
    }
    double const smallest = x.dot(s.scene.K * x);
    CHECK(s.certificate.smallest_eigenvalue() <= smallest * (1 + 1e-9));
    CHECK(s.certificate.smallest_eigenvalue() >= smallest / 100);
    for (double const δ : {1e-1, 1e-3, 1e-6, 1e-9, 0.0}) {
      VectorXd u;
      auto const e = s(near_solution(s, δ, 3), u);
      double const error = s.error(u), slack = 2 * s.reference.energy_error * e.size;
      CHECK(e.proven);
      CHECK(e.bound >= error - slack);
      CHECK(e.bound <= 60 * (error + slack));
      CHECK(e.size == doctest::Approx(std::sqrt(u.dot(s.scene.K * u))));
    }
  }
}

TEST_CASE("slender and thin bodies: the certificate sees what the reduced gradient does not") {
  for (auto const& [length, height] : {std::pair(300.0, 1.0), std::pair(3.0, 1e-3)}) {
    certified_scene s({.k = 1, .load = fem::brick_load::lift, .size = Vector3d(length, 1, height)});
    REQUIRE(s.prove());
    for (double const δ : {1e-2, 1e-5, 1e-8}) {
      VectorXd u;
      auto const e = s(near_solution(s, δ, 8), u, 1e-12);
      CHECK(e.bound >= s.error(u) - 2 * s.reference.energy_error * e.size);
      CHECK(e.proven);
      CHECK(e.size <= energy_norm(s.scene.K, u) * (1 + 1e-15));
      CHECK(e.size >= energy_norm(s.scene.K, u) * (1 - 1e-9));
    }
  }
}

TEST_CASE(
    "an estimate takes the place of the bound where it is smaller, and then nothing is proven") {
  certified_scene s({.k = 2, .load = fem::brick_load::lift});
  REQUIRE(s.prove());
  VectorXd u;
  auto const e = s(near_solution(s, 1e-7, 3), u);
  REQUIRE(e.proven);
  double const error = s.error(u);
  auto same = s.certificate.estimated(2 * e.bound);
  CHECK(same.bound == e.bound);
  CHECK(same.proven);
  for (double const nothing : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
    CHECK(s.certificate.estimated(nothing).bound == e.bound);
    CHECK(s.certificate.sharpened(nothing).bound == e.bound);
  }
  // The ‖d‖ that would show a goal shows it; d itself has the norm that the bound was made of.
  double const goal = 0.9 * e.relative(), δ = s.certificate.norm_for(goal);
  REQUIRE(δ > 0);
  auto const sharp = s.certificate.sharpened(δ);
  CHECK_FALSE(sharp.proven);
  CHECK(sharp.relative() <= goal * (1 + 1e-6));
  CHECK(s.certificate.extended_norm(s.certificate.rest()) >= δ);
  auto const known = s.certificate.estimated(error);
  CHECK(known.bound == doctest::Approx(error).epsilon(1e-6));
}

TEST_CASE("u is refined where the solve with K is too rough for the goal, and only there") {
  certified_scene s({.k = 1, .load = fem::brick_load::lift});
  VectorXd const λ = s.reference.multipliers();
  VectorXd u;
  (void)s(λ, u);
  CHECK(s.certificate.solves() == 1);
  // A solver with four digits.
  auto const rough = [&](VectorXd const& load, VectorXd& x) {
    s.solver()(load, x);
    for (slant::index i = 0; i < x.size(); ++i) x(i) *= 1 + 1e-4 * double(i % 3 - 1);
  };
  VectorXd v(u.size()), μ = λ;
  VectorXd const load = s.data.f - s.data.N.transpose() * λ.head(s.data.nodes()) -
                        s.data.T.transpose() * λ.tail(s.data.T.rows());
  rough(load, v);
  auto const before = s.certificate.solves();
  auto const e = s.certificate(s.set, μ, v, 1e-9, rough);
  CHECK(s.certificate.solves() - before >= 2);
  CHECK(e.relative() <= 1e-9);
  CHECK(s.error(v) <= e.bound + 2 * s.reference.energy_error * e.size);
}

TEST_CASE("nothing is called proven that is not: dependent rows, sets by projection, no λ_min(K)") {
  auto scene = fem::make_steel_brick({.k = 1, .load = fem::brick_load::press});
  auto data = test::contact_data(scene);
  auto const factor = slant::factorize(scene.K);
  auto const solve = contact::solver(factor);
  // Rows that are not orthogonal.
  Eigen::SparseMatrix<double> N = data.N;
  N.coeffRef(0, 0) += 0.5;
  data.N = N;
  contact::certificate<double> skew(scene.K, data);
  REQUIRE(skew.prove(solve, be_definite));
  auto const set = slant::cartesian(slant::half_lines(data.nodes()), slant::discs(data.g));
  VectorXd λ = VectorXd::Zero(3 * data.nodes()), u = VectorXd::Zero(data.f.size());
  auto const e = skew(set, λ, u, 1e-8, solve);
  CHECK_FALSE(e.proven);
  CHECK(std::isfinite(e.bound));

  for (double const guess : {0.0, infinity, quiet_nan})
    CHECK(contact::smallest_eigenvalue_bound(scene.K, guess, [](auto const&) {}) == 0);
  CHECK(contact::smallest_eigenvalue_bound(sparse(-scene.K), 1.0, be_definite) == 0);
  // A guess that is too large is made smaller until the matrix is definite.
  double const bound =
      contact::smallest_eigenvalue_bound(scene.K, 1e3 * scene.K.diagonal().maxCoeff(), be_definite);
  CHECK(bound > 0);
}

/// One contact node on three springs, whose solution is known in closed form.
struct one_node {
  Eigen::SparseMatrix<double> K{3, 3};
  contact::data<double> data{};
  long double u[3], λ[3];

  one_node(double normal, double tangential, Vector3d const& f, double d, double g) {
    for (int j = 0; j < 3; ++j) K.insert(j, j) = j == 0 ? normal : tangential;
    data.N.resize(1, 3);
    data.N.insert(0, 0) = 1;
    data.T.resize(2, 3);
    data.T.insert(0, 1) = 1;
    data.T.insert(1, 2) = 1;
    data.f = f;
    data.d = VectorXd::Constant(1, d);
    data.g = VectorXd::Constant(1, g);
    using real = long double;
    real const pull = std::sqrt(real(f(1)) * f(1) + real(f(2)) * f(2));
    real const slides = pull > g ? (pull - g) / pull : real(0);
    u[0] = std::min<real>(real(f(0)) / normal, d);
    λ[0] = u[0] < d ? real(0) : f(0) - normal * u[0];
    for (int j = 1; j < 3; ++j) {
      u[j] = slides * f(j) / tangential;
      λ[j] = (pull > g ? real(g) / pull : real(1)) * f(j);
    }
  }
  /// ‖v − u*‖_K, and ‖u*‖_K for v = 0.
  long double error(VectorXd const& v) const {
    long double sum = 0;
    for (int j = 0; j < 3; ++j) sum += K.coeff(j, j) * (v(j) - u[j]) * (v(j) - u[j]);
    return std::sqrt(sum);
  }
};

TEST_CASE("a proven bound counts its own rounding errors: at solutions rounded to the last digit") {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(0.1, 10), sign(-10, 10);
  // Without the terms that rounding may take, 31 of the first 20000 were below, by up to four
  // times.
  int below = 0, proven = 0;
  double sum = 0;
  int const runs = test::effort(20000, 2000);
  for (int run = 0; run < runs; ++run) {
    double const normal = uniform(random), tangential = uniform(random);
    Vector3d const f(sign(random), sign(random), sign(random));
    double const pull = std::hypot(f(1), f(2));
    double const g = run % 3 == 0   ? pull * (1 - 1e-9 * uniform(random))
                     : run % 3 == 1 ? pull / 2
                                    : uniform(random);
    one_node const s(normal, tangential, f, uniform(random) / 10, g);
    auto const factor = slant::ldlt<double>(s.K);
    contact::certificate<double> certificate(s.K, s.data);
    certificate.prove(contact::solver(factor), [](auto const& K) { (void)slant::ldlt<double>(K); });
    auto const set = slant::cartesian(slant::half_lines(slant::index(1)), slant::discs(s.data.g));
    VectorXd u(3), λ(3);
    for (int j = 0; j < 3; ++j) {
      u(j) = double(s.u[j]);
      λ(j) = double(s.λ[j]);
    }
    auto const e = certificate(set, λ, u, 1e-8, contact::solver(factor));
    long double const size = s.error(VectorXd::Zero(3)), slack = 1e-18L * size;
    proven += e.proven ? 1 : 0;
    below += e.bound < s.error(u) - slack ? 1 : 0;
    if (run % 3 == 1) sum += e.relative();
  }
  CHECK(proven == runs);
  CHECK(below == 0);
  CHECK(sum / (runs / 3 + 1) <= 100 * std::numeric_limits<double>::epsilon());
}

/// A bar of 100 springs k, the first held by soft·k, under the force F at its first node, with one
/// contact at its free end.
struct bar {
  Eigen::SparseMatrix<double> K;
  contact::data<double> data;

  bar(double k, double soft, double F, double gap) : K(k * test::springs(100, soft, 0)) {
    int const n = 100;
    data.N.resize(1, n);
    data.N.insert(0, n - 1) = 1;
    data.T.resize(0, n);
    data.f = VectorXd::Zero(n);
    data.f(0) = F;
    data.d = VectorXd::Constant(1, gap);
  }
};

TEST_CASE("gaps are energies: where these underflow or overflow the bound is the same") {
  auto const bound = [](double k, double F, double h) {
    bar s(k, 1, F, 2 * F / k);
    slant::ldlt<double> const factor(s.K);
    contact::certificate<double> certificate(s.K, s.data);
    REQUIRE(certificate.prove(contact::solver(factor),
                              [](auto const& K) { (void)slant::ldlt<double>(K); }));
    VectorXd λ = VectorXd::Constant(1, h * F), u(100), load = s.data.f;
    load(99) -= λ(0);
    contact::solver(factor)(load, u);
    auto const e = certificate(slant::half_lines(1), λ, u, 1e-8, contact::solver(factor));
    CHECK(e.proven);
    return e.relative();
  };
  for (double const h : {1e-3, 1e-6}) {
    double const there = bound(1, 1, h);
    CHECK(there >= 10 * h);  // ‖λ − λ*‖_A = h √100
    double const big = std::ldexp(1.0, 400);
    CHECK(bound(big, 1 / big, h) == doctest::Approx(there));
    CHECK(bound(1 / big, big, h) == doctest::Approx(there));
    CHECK(bound(1, 1 / big, h) == doctest::Approx(there));
  }
}

TEST_CASE("K symmetric up to rounding only: the proof is of its symmetric part") {
  bar s(1, 1e-8, 1, 1e300);
  for (int i = 0; i < 99; ++i) s.K.coeffRef(i + 1, i) *= 1 - 1e-16;
  s.data.f.setOnes();
  Eigen::SparseMatrix<double> const whole =
      0.5 * (s.K + Eigen::SparseMatrix<double>(s.K.transpose()));
  slant::ldlt<double> const factor(s.K), symmetric(whole);
  contact::certificate<double> certificate(s.K, s.data);
  REQUIRE(certificate.prove(contact::solver(factor),
                            [](auto const& K) { (void)slant::ldlt<double>(K); }));
  VectorXd λ = VectorXd::Zero(1), u(100), exact(100);
  contact::solver(factor)(s.data.f, u);
  contact::solver(symmetric)(s.data.f, exact);
  auto const e = certificate(slant::half_lines(1), λ, u, 1e-12, contact::solver(factor));
  VectorXd const off = u - exact;
  CHECK(e.bound >= std::sqrt(off.dot(whole * off)));
  CHECK(e.relative() <= 1e-3);
}

TEST_CASE("sizes that do not fit are refused before anything is read") {
  bar const s(1, 1, 1, 1);
  auto const refused = [&](auto change, char const* message) {
    contact::data<double> c = s.data;
    change(c);
    CHECK_THROWS_WITH_AS(contact::certificate<double>(s.K, c), message, slant::bad_input);
  };
  refused([](auto& c) { c.N.resize(1, 400); },
          "columns of N: got 400, expected the size of f, 100");
  refused([](auto& c) { c.d.resize(0); }, "d: got 0, expected one gap per row of N, 1");
  contact::certificate<double> certificate(s.K, s.data);
  CHECK_THROWS_AS((void)certificate.extended_norm(VectorXd(3)), slant::bad_input);
  CHECK_THROWS_AS(certificate.set_positions(VectorXd(3)), slant::bad_input);
}

TEST_CASE("units do not matter; a scene without load is exact; NaN is no bound") {
  certified_scene s({.k = 1, .load = fem::brick_load::press});
  VectorXd u;
  VectorXd const λ = near_solution(s, 1e-4, 5);
  auto const one = s(λ, u);
  for (double const unit : {0x1p-200, 0x1p200}) {
    auto data = s.data;
    data.f *= unit;
    data.g *= unit;
    contact::certificate<double> scaled(s.scene.K, data);
    auto const set = slant::cartesian(slant::half_lines(data.nodes()), slant::discs(data.g));
    VectorXd μ = unit * λ, v = s.displacement(slant::project(s.set, λ)) * unit;
    auto const other = scaled(set, μ, v, 1e-8, s.solver());
    CHECK(other.relative() == doctest::Approx(one.relative()).epsilon(1e-6));
  }
  VectorXd broken = λ;
  broken(0) = std::numeric_limits<double>::quiet_NaN();
  auto const nothing = s(broken, u);
  CHECK_FALSE(nothing.relative() <= 1);

  auto idle = s.data;
  idle.f.setZero();
  contact::certificate<double> of_idle(s.scene.K, idle);
  VectorXd zero = VectorXd::Zero(λ.size()), rest = VectorXd::Zero(u.size());
  CHECK(of_idle(s.set, zero, rest, 1e-8, s.solver()).relative() == 0);
}

TEST_CASE("interior points are judged by what lies on the face: 200 products to an error of 1e-8") {
  for (int const k : {4, 5, 7}) {
    if (k > test::effort(7, 4)) continue;
    for (auto const load : fem::brick_loads) {
      CAPTURE(k);
      CAPTURE(fem::name_of(load));
      auto const scene = fem::make_steel_brick({.k = k, .load = load});
      auto const data = test::contact_data(scene);
      auto const factor = slant::factorize(scene.K);
      contact::dual const dual(contact::friction_disc{}, factor, data);
      auto const qp = dual.qp();
      auto const M = contact::lumped_preconditioner(scene.K, dual.constraints());
      contact::certificate<double> certificate(scene.K, data);
      contact::newton_certificate by_newton(qp, M, certificate);
      VectorXd λ, u;
      double without = 0;
      auto const error_of = [&](VectorXd const& x) {
        λ = x;
        u = dual.displacement(λ);
        auto const e = certificate(dual.set(), λ, u, 1e-8, contact::solver(factor));
        without = e.relative();
        return by_newton(λ);
      };
      auto const run = slant::solve(
          slant::interior_point{qp, M, {.inner_share = 0.3}}, VectorXd::Zero(qp.size()).eval(),
          slant::energy_error_below(1e-8, error_of) || slant::at_most(60));
      REQUIRE(run.converged());
      CHECK(run.state.work.operator_applications <= 200);
      // The gap alone, whose root goes with √ϑ where the error goes with ϑ, asks for many more.
      CHECK(without > 1e-7);
      auto const exact =
          contact::solve(contact::friction_disc{}, scene.K, data, {.tolerance = 1e-12});
      double const error = oracle::energy_error(scene.K, u, exact.u);
      CHECK(error <= 1e-8);
      CHECK(error_of(run.x()).relative() >= error);
    }
  }
}

}  // namespace certificate_test
