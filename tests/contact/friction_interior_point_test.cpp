// SPDX-License-Identifier: MIT
#include <slant/contact/friction/friction_interior_point.hpp>

#include <slant/contact/friction/verify.hpp>
#include <slant/io/friction_folder.hpp>

#include <support/testing.hpp>
#include "contact/friction_scenes.hpp"
#include "support/folders.hpp"

namespace friction_interior_point_test {

using options = slant::contact::friction_interior_options<double>;
using real = long double;
template <int N>
using blocks = slant::contact::friction_blocks<N, double>;
template <int N>
using method = slant::contact::friction_interior_point<N, double>;
template <int N>
using algebra = slant::detail::lorentz_algebra<N, double>;
template <int N>
using scaling = slant::contact::detail::lorentz_scaling<N, double>;
template <int N>
using wide = Eigen::Matrix<real, N, 1>;
template <int N>
using wide_block = Eigen::Matrix<real, N, N>;

static_assert(slant::iterative_method<method<3>, VectorXd>);

struct outcome {
  VectorXd r, inside;
  slant::contact::friction_error<double> error;
  slant::index steps, factorizations, sparse, evaluations;
};

template <int N>
outcome run(test::friction_problem const& p, double tolerance, options const& o) {
  blocks<N> const b(p);
  method<N> const m(b, o);
  auto s = m.start(VectorXd::Zero(b.size()));
  while (s.status == slant::status::running && s.iteration < 300 &&
         !s.best_error.at_most(tolerance)) {
    m.step(s);
  }
  auto const& lu = s.lu.work();
  return {b.force(s.best),   b.force(s.x), s.best_error, s.iteration,
          lu.factorizations, lu.sparse,    s.evaluations};
}
outcome run(test::friction_problem const& p, double tolerance, options o = {}) {
  o.small = std::min(o.small, tolerance / 100);
  return p.dimension() == 2 ? run<2>(p, tolerance, o) : run<3>(p, tolerance, o);
}

TEST_CASE("interior point: every state of one contact, in any units") {
  auto cases = test::single_solution_cases();
  cases.push_back(test::redundant_case());
  for (auto const& c : cases) {
    CAPTURE(c.name);
    for (double const compliance : {1., 1e100, 1e-100}) {
      for (double const velocity : {1., 1e100, 1e-100}) {
        auto p = c.problem;
        p.W *= compliance;
        p.q *= velocity;
        auto const s = run(p, 1e-11);
        CHECK(s.error.at_most(1e-11));
        CHECK(s.steps <= 40);
        CHECK(s.evaluations == 1 + s.steps);
        VectorXd const r = s.r * (compliance / velocity);
        if (!c.infinitely_many) CHECK((r - c.r[0]).norm() <= 1e-8 * (1 + r.norm()));
        // Never on the boundary: strictly positive, and within the cone.
        for (slant::index i = 0; i < p.contacts(); ++i) {
          CHECK(s.inside[i * p.dimension()] > 0);
          CHECK(s.inside.segment(i * p.dimension() + 1, p.dimension() - 1).stableNorm() <=
                p.mu[i] * s.inside[i * p.dimension()] * (1 + 1e-14));
        }
      }
    }
  }
}

TEST_CASE("interior point: contacts of simulations, by the independent check") {
  for (auto const* name : {"FC3D_Example1", "FrictionContact3D_RR_1c",
                           "GFC3D_Example00_badly_scaled", "GFC3D_TwoRods1", "Rover4396",
                           "Rover4609", "Rover11035", "Confeti-ex13-4contact-Fc3D-SBM"}) {
    CAPTURE(name);
    auto const p = slant::read_friction_problem(test::data("friction") / name);
    auto const s = run(p, 1e-8);
    CHECK(s.error.at_most(1e-8));
    auto const check = slant::contact::verify(p, s.r);
    CHECK(check.unit_free_map <= 1.01e-8);  // what its states measure; solve_friction looks further
    CHECK(check.unit_free_penetration <= 1.01e-8);
  }
}

TEST_CASE("interior point: contacts with and without friction, friction of any size") {
  auto p = test::random_friction(10, 3, 0.5, 11);
  for (slant::index i = 0; i < 10; i += 2) p.mu[i] = 0;
  auto const s = run(p, 1e-11);
  CHECK(s.error.at_most(1e-11));
  for (slant::index i = 0; i < 10; i += 2) CHECK(s.r.segment<2>(3 * i + 1).isZero(0));
  for (double const mu : {1e-200, 1e-9, 10., 1e4}) {
    CAPTURE(mu);
    auto const one = test::make_friction_problem(Eigen::Matrix3d::Identity(), Vector3d(-1, 1, 0),
                                                 VectorXd::Constant(1, mu));
    auto const r = run(one, 1e-8);
    CHECK(r.error.at_most(1e-8));
    CHECK((r.r - Vector3d(1, mu > 1 ? -1 : -mu, 0)).norm() <= 1e-7);
  }
}

TEST_CASE("interior point: a full matrix takes no memory after the first step, a sparse stays so") {
  auto const p = test::random_friction(12, 3, 0.4, 3);
  blocks<3> const b(p);
  method<3> const m(b);
  auto s = m.start(VectorXd::Zero(b.size()));
  m.step(s);
  slant::testing::allocation_guard guard;
  for (int k = 0; k < 5; ++k) m.step(s);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
  CHECK(s.iteration == 6);
  CHECK(s.lu.work().factorizations == 6);
  CHECK(s.lu.work().rows == 6 * 36);
  CHECK(s.lu.work().sparse == 0);
  auto const chain = run(test::chain_friction(60), 1e-10);
  CHECK(chain.error.at_most(1e-10));
  CHECK(chain.sparse == chain.factorizations);
  CHECK(chain.factorizations == chain.steps);
}

TEST_CASE("interior point: without a solution it ends, and rests") {
  auto const p = test::no_solution_case(3).problem;
  blocks<3> const b(p);
  method<3> const m(b, {.patience = 5});
  auto s = m.start(VectorXd::Zero(3));
  for (int k = 0; k < 300; ++k) m.step(s);
  auto const last = s.iteration;
  m.step(s);
  CHECK(s.iteration == last);
  CHECK(last < 300);
  CHECK((s.status == slant::status::stalled || s.status == slant::status::breakdown));
}

TEST_CASE("interior point: no contacts, bad options and starts") {
  auto const none = run<3>(test::friction_problem{}, 1e-8, {});
  CHECK(none.r.size() == 0);
  auto const p = test::chain_friction(2);
  blocks<3> const b(p);
  auto const bad = [&](options const& o, char const* name) {
    CHECK_THROWS_WITH_AS(method<3>(b, o), doctest::Contains(name), slant::bad_input);
  };
  bad({.small = 0}, "small");
  bad({.patience = 0}, "patience");
  CHECK_THROWS_AS(static_cast<void>(method<3>(b).start(VectorXd::Zero(5))), slant::bad_input);
}

template <int N>
real naive_determinant(wide<N> const& x) {
  return x[0] * x[0] - x.template tail<N - 1>().squaredNorm();
}
template <int N>
wide_block<N> signs() {
  wide_block<N> J = -wide_block<N>::Identity();
  J(0, 0) = 1;
  return J;
}
/// TᵀT of x and s: the symmetric matrix η (2 w wᵀ − J), det w = 1, that takes x to s.
template <int N>
wide_block<N> naive_scaling(wide<N> const& x, wide<N> const& s) {
  real const X = std::sqrt(naive_determinant<N>(x)), S = std::sqrt(naive_determinant<N>(s));
  wide<N> const x1 = x / X, s1 = s / S;
  wide<N> const w = (s1 + signs<N>() * x1) / std::sqrt(2 + 2 * x1.dot(s1));
  return S / X * (2 * w * w.transpose() - signs<N>());
}
template <int N>
wide_block<N> T_of(scaling<N> const& p) {
  return (p.U() * p.Σ().asDiagonal() * p.V().transpose()).template cast<real>();
}
template <int N>
double largest(wide_block<N> const& m) {
  return double(m.cwiseAbs().maxCoeff());
}

template <int N>
void check_laws(scaling<N> const& p, double tolerance) {
  auto const J = signs<N>(), one = wide_block<N>(wide_block<N>::Identity());
  auto const T = T_of<N>(p);
  wide<N> const x = p.x().template cast<real>(), s = p.s().template cast<real>();
  wide<N> const λ = p.λ().template cast<real>();
  CHECK(λ[0] > λ.template tail<N - 1>().norm());
  CHECK(double((T * x - λ).norm()) <= tolerance * double(T.norm() * x.norm()));
  CHECK(double((T.transpose() * λ - s).norm()) <= tolerance * double(T.norm() * λ.norm()));
  CHECK(std::abs(double(x.dot(s) / λ.squaredNorm()) - 1) <= tolerance);
  // T is of the group of L: T J Tᵀ = η J, with η² the ratio of the determinants of s and x.
  auto const η = std::pow(T.determinant(), real(2) / N);
  auto const U = wide_block<N>(p.U().template cast<real>());
  auto const V = wide_block<N>(p.V().template cast<real>());
  CHECK(largest<N>(T * J * T.transpose() - η * J) <= tolerance * double(T.squaredNorm()));
  CHECK(largest<N>(U.transpose() * U - one) <= 1e-15);
  CHECK(largest<N>(V.transpose() * V - one) <= 1e-15);
  CHECK(p.Σ()[0] * p.Σ()[1] == doctest::Approx(double(η)).epsilon(tolerance));
}

template <int N>
void check_steps() {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  using part = typename scaling<N>::part;
  for (int k = 0; k < 40; ++k) {
    scaling<N> p(std::exp(3 * normal(random)), std::exp(3 * normal(random)));
    for (int step = 0; step < 4; ++step) {
      part const dx = part::NullaryExpr([&](auto) { return normal(random); });
      part const ds = part::NullaryExpr([&](auto) { return normal(random); });
      double const t = std::min(1., 0.7 * p.length(dx, ds));
      auto const T = T_of<N>(p);
      wide<N> const x =
          p.x().template cast<real>() + T.inverse() * wide<N>((t * dx).template cast<real>());
      wide<N> const s =
          p.s().template cast<real>() + T.transpose() * wide<N>((t * ds).template cast<real>());
      p.move(t * dx, t * ds);
      CHECK(double((p.x().template cast<real>() - x).norm() / x.norm()) <= 1e-12);
      CHECK(double((p.s().template cast<real>() - s).norm() / s.norm()) <= 1e-12);
      auto const M = naive_scaling<N>(x, s);
      auto const G = T_of<N>(p);
      CHECK(largest<N>(G.transpose() * G - M) <= 1e-11 * largest<N>(M));
      CHECK(double((M * x - s).norm()) <= 1e-14 * double(M.norm() * x.norm()));
      check_laws<N>(p, 1e-12);
    }
  }
}

TEST_CASE("lorentz scaling: steps, laws and TᵀT against the closed form in long double") {
  check_steps<2>();
  check_steps<3>();
}

TEST_CASE("lorentz scaling: at a multiple of the unit, at any scale") {
  for (double const scale : {1e-100, 1., 1e100}) {
    scaling<3> const p(4 * scale, 9 * scale);
    CHECK((p.λ() - 6 * scale * Vector3d::UnitX()).norm() <= 1e-15 * scale * 6);
    CHECK((p.x() - 4 * scale * Vector3d::UnitX()).norm() <= 1e-15 * scale * 4);
    CHECK((p.s() - 9 * scale * Vector3d::UnitX()).norm() <= 1e-15 * scale * 9);
    CHECK((p.Σ() - Vector3d::Constant(1.5)).norm() <= 1e-15);
    CHECK(p.x().tail<2>() == Vector2d::Zero());
    // 6 of them down the axis, and no end up.
    Vector3d const up = scale * Vector3d::UnitX();
    CHECK(p.length(-up, up) == doctest::Approx(6).epsilon(1e-14));
    CHECK(std::isinf(p.length(up, up)));
  }
}

TEST_CASE("lorentz scaling: x and s go to opposite sides of the boundary, and λ stays inside") {
  scaling<3> p(1, 1);
  Vector3d const ray(1, 0.6, 0.8), opposite(1, -0.6, -0.8);
  for (int k = 0; k < 30; ++k) {  // what is left of x is along one ray, of s along the other
    Vector3d const dx = 0.1 * ray - 0.9 * p.λ(), ds = 0.1 * opposite - 0.9 * p.λ();
    double const t = std::min(1., 0.9 * p.length(dx, ds));
    p.move(t * dx, t * ds);
    // x and s as vectors have lost their digits by now; what T is made of has not.
    CHECK(p.λ()[0] > 1.01 * p.λ().tail<2>().norm());
    CHECK((p.U().transpose() * p.U() - Eigen::Matrix3d::Identity()).norm() <= 1e-15);
    CHECK((p.V().transpose() * p.V() - Eigen::Matrix3d::Identity()).norm() <= 1e-15);
    CHECK(p.Σ()[0] * p.Σ()[1] == doctest::Approx(p.Σ()[2] * p.Σ()[2]).epsilon(1e-14));
  }
  CHECK(p.Σ()[0] > 1e6 * p.Σ()[1]);
  CHECK(p.x().allFinite());
}

template <int N>
void check_algebra() {
  std::mt19937 random(6);
  std::normal_distribution<double> normal;
  using part = typename scaling<N>::part;
  auto const number = [&](auto) { return normal(random); };
  part e = part::Zero();
  e[0] = 1;
  for (int k = 0; k < 50; ++k) {
    part x = part::NullaryExpr(number), y = part::NullaryExpr(number);
    x[0] = x.template tail<N - 1>().norm() + std::abs(x[0]) + 0.1;  // inside
    part const xy = algebra<N>::product(x, y);
    CHECK((xy - algebra<N>::product(y, x)).norm() <= 1e-15 * xy.norm());
    CHECK((algebra<N>::product(x, e) - x).norm() <= 1e-15 * x.norm());
    CHECK((algebra<N>::quotient(xy, x) - y).norm() <= 1e-11 * (1 + y.norm()));
    auto const d = naive_determinant<N>(x.template cast<real>());
    CHECK(algebra<N>::determinant(x) == doctest::Approx(double(d)).epsilon(1e-14));
    // x ∘ J x = det(x) e.
    CHECK((algebra<N>::product(x, algebra<N>::reflected(x)) - double(d) * e).norm() <=
          1e-14 * x.squaredNorm());
    // 2 v vᵀ − J keeps determinants if det v = 1, and is symmetric.
    part const v = x / std::sqrt(algebra<N>::determinant(x));
    auto const H = algebra<N>::hyperbolic(v);
    CHECK(H == H.transpose());
    CHECK(std::abs(algebra<N>::determinant(part(H * y)) - algebra<N>::determinant(y)) <=
          1e-13 * H.squaredNorm() * y.squaredNorm());
  }
}

TEST_CASE("lorentz algebra: unit, inverse, determinant, hyperbolic reflections") {
  check_algebra<2>();
  check_algebra<3>();
}

}  // namespace friction_interior_point_test
