// SPDX-License-Identifier: MIT
#include <slant/slant.hpp>

#include <krylov/spd_matrices.hpp>
#include <support/minimise.hpp>
#include <support/testing.hpp>
#include "scales.hpp"

namespace interior_point_statuses_test {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Half lines, intervals, discs and two free unknowns: 12 of them, all lengths in units of t.
struct problem {
  double t = 1;
  VectorXd lower = t * VectorXd{{0.0, -1.0, 0.5}};
  VectorXd below = t * VectorXd{{-0.3, 0.1, -1.0}}, above = t * VectorXd{{0.2, 0.4, infinity}};
  VectorXd g = t * VectorXd{{0.5, 2.0}};
  MatrixXd A = test::with_spectrum(test::log_spaced(12, 100), 3);
  VectorXd b = t * 2 * test::random_vector(12, 9);

  [[nodiscard]] auto set() const {
    return slant::cartesian(slant::half_lines(lower), slant::intervals(below, above),
                            slant::discs(g), slant::free_components(2));
  }
  [[nodiscard]] auto qp(double stiffness = 1) const {
    return slant::separable_qp{test::spd(MatrixXd(stiffness * A)), VectorXd(stiffness * b), set()};
  }
};

VectorXd zero() {
  return VectorXd::Zero(12);
}

template <class Problem>
std::string refusal(Problem const& p) {
  auto const qp = p.qp();
  return test::complaint([&] { static_cast<void>(slant::interior_point{qp}.start(zero())); });
}

TEST_CASE("an empty interior: the block, and what to use instead") {
  std::string const words =
      " of the set: got no point inside that f(x) tells, expected points with f(x) < 0, which an "
      "interval between neighbouring numbers or a cone with friction coefficient 0 does not have; "
      "another method takes it (symmetric_newton, kprgp)";
  problem p;
  p.above(1) = std::nextafter(p.below(1), 1.0);  // two numbers, none between them
  CHECK(refusal(p) == "block 4" + words);
  p.above(1) = infinity;
  p.below(1) = -infinity;
  CHECK(refusal(p) == "nothing thrown");
}

TEST_CASE("a slip bound 0 and an interval with equal ends are held") {
  problem p;
  p.g(1) = 0;
  p.above(1) = p.below(1);
  auto const qp = p.qp();
  auto const r = test::minimise(slant::interior_point{qp}, zero(), 1e-9, 60);
  auto const exact = test::minimise(slant::symmetric_newton{qp}, zero(), 1e-13, 100);
  CHECK(r.converged());
  CHECK((r.x() - exact.x()).norm() <= 1e-7 * exact.x().norm());
  MatrixXd const inverse = p.A.inverse();
  auto const M = test::spd(MatrixXd((inverse + inverse.transpose()) / 2));
  auto const fast = test::minimise(slant::interior_point{qp, M}, zero(), 1e-9, 60);
  CHECK(fast.converged());
  CHECK((fast.x() - exact.x()).norm() <= 1e-7 * exact.x().norm());
  for (VectorXd const& x : {r.x(), fast.x()}) {
    CHECK(x(4) == p.below(1));
    CHECK(x.segment<2>(8).norm() == 0);
  }
}

TEST_CASE("a nearly empty interior: the same solution as another method's") {
  for (double tiny : {1e-6, 1e-12, 1e-15}) {
    CAPTURE(tiny);
    problem p;
    p.g(0) = tiny;
    p.above(0) = p.below(0) + tiny;
    auto const qp = p.qp();
    auto const exact = test::minimise(slant::symmetric_newton{qp}, zero(), 1e-13, 100);
    auto const r = test::minimise(slant::interior_point{qp}, zero(), 1e-9, 100);
    REQUIRE(exact.converged());
    CHECK((r.x() - exact.x()).norm() <= 1e-7 * exact.x().norm());
    CHECK((r.converged() || r.status == slant::status::stalled));
    CHECK(std::string(r.reason).size() > 10);
    CHECK(r.x().segment<2>(6).norm() < tiny);
    CHECK(r.x()(3) > p.below(0));
    CHECK(r.x()(3) < p.above(0));
  }
}

TEST_CASE("scales from 1e-100 to 1e100 give the same bits") {
  auto const solve_in = [](int stiffness, int length) {
    problem const p{.t = std::ldexp(1.0, length)};
    auto const qp = p.qp(std::ldexp(1.0, stiffness));
    auto r = test::minimise(slant::interior_point{qp}, zero(), 1e-10, 60);
    for (int i = 0; i < 3; ++i) {
      CHECK(r.x()(i) > p.lower(i));
      CHECK(r.x()(3 + i) > p.below(i));
      CHECK(r.x()(3 + i) < p.above(i));
    }
    r.state.x /= p.t;
    return r;
  };
  constexpr int far = 332;
  test::check_scales(solve_in, far, far / 2);
}

TEST_CASE("all digits: stalled at the floor, in the interior") {
  problem const p;
  auto const qp = p.qp();
  auto const r = test::minimise(slant::interior_point{qp}, zero(), 0.0, 300);
  CHECK(r.status == slant::status::stalled);
  double const ε = std::numeric_limits<double>::epsilon();
  CHECK(r.state.reduced_gradient_norm <= 100 * ε * (p.b.norm() + p.A.norm() * r.x().norm()));
  for (int i = 0; i < 3; ++i) CHECK(r.x()(i) > p.lower(i));
}

/// A program of which no more is known than that A is semidefinite.
template <class Set>
auto semidefinite(MatrixXd const& M, VectorXd const& b, Set const& set) {
  return slant::separable_qp{slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(M), b,
                             set};
}

TEST_CASE("a semidefinite A: with a minimum, and without") {
  VectorXd const b = VectorXd::Ones(2), lower = VectorXd::Zero(2);
  auto const set = slant::half_lines(lower);
  auto const run = [&](MatrixXd const& M) {
    auto const qp = semidefinite(M, b, set);
    return test::minimise(slant::interior_point{qp}, lower, 1e-10, 300);
  };
  auto const r = run(MatrixXd{{1.0, 1.0}, {1.0, 1.0}});
  CHECK(r.converged());
  CHECK(r.x().sum() == doctest::Approx(1.0));
  MatrixXd const M{{1.0, -1.0}, {-1.0, 1.0}};
  auto const none = run(M);
  CHECK(none.status == slant::status::unbounded);
  VectorXd const d = none.state.step;
  CHECK((M * d).norm() <= 1e-7 * d.norm());
  CHECK(b.dot(d) > 0);
  CHECK(d.minCoeff() >= 0);
}

TEST_CASE("two forces that grow against each other: unbounded, in a few steps") {
  // u <= 0.5 and -u <= -0.6 of a spring, and a force that is given.
  VectorXd const v{{0.5, -0.5, 0.5}}, b{{0.0, 0.1, 0.0}};
  MatrixXd const M = v * v.transpose();
  auto const set = slant::intervals(VectorXd{{0.0, 0.0, 0.3}}, VectorXd{{infinity, infinity, 0.3}});
  auto const qp = semidefinite(M, b, set);
  auto const r = test::minimise(slant::interior_point{qp}, test::zeros(3), 1e-10, 300);
  CHECK(r.status == slant::status::unbounded);
  CHECK(r.state.step(0) == doctest::Approx(r.state.step(1)));
  CHECK(r.iterations() <= 16);
  CHECK(r.state.work.operator_applications <= 60);
}

TEST_CASE("programs with a minimum, of any rank, are not called unbounded, and none takes long") {
  for (unsigned seed = 1; seed < 400; seed += 2) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform(0, 1);
    int const n = 2 + int(random() % 20), rank = int(random() % unsigned(n + 1));
    MatrixXd B = MatrixXd::NullaryExpr(n, std::max(1, rank), [&] { return normal(random); });
    for (int j = 0; j < B.cols(); ++j) B.col(j) *= std::pow(10, -4 * uniform(random) * (seed % 3));
    MatrixXd const product = B * B.transpose(), A = (product + product.transpose()) / 2;
    VectorXd const x = VectorXd::NullaryExpr(n, [&] { return std::max(0.0, normal(random)); });
    VectorXd const r = VectorXd::NullaryExpr(n, [&] { return uniform(random); });
    VectorXd const b = A * x - (x.array() > 0).select(0, r);
    CAPTURE(seed);
    auto const set = slant::half_lines(n);
    auto const qp = semidefinite(A, b, set);
    auto const run = test::minimise(slant::interior_point{qp}, test::zeros(n), 1e-8, 3000);
    // Where all of x is positive b lies in the range of A, but for its rounding errors.
    VectorXd const noise = 4e-16 * (A.cwiseAbs() * x + b.cwiseAbs());
    bool const is_unclear = b.dot(run.state.step) <= noise.dot(run.state.step.cwiseAbs());
    CHECK((run.status != slant::status::unbounded || is_unclear));
    CHECK(run.iterations() <= 400);
  }
}

TEST_CASE("no minimum along unknowns without constraint: the direction at which CG ends") {
  // A is the projection along a random unit vector k, b has a part along k, everything is free.
  VectorXd const k = test::random_vector(6).normalized();
  MatrixXd const M = MatrixXd::Identity(6, 6) - k * k.transpose();
  VectorXd const b = VectorXd::Ones(6);
  auto const set = slant::free_components(6);
  auto const qp = semidefinite(M, b, set);
  auto const r = test::minimise(slant::interior_point{qp}, test::zeros(6), 1e-10, 50);
  CHECK(r.status == slant::status::unbounded);
  VectorXd const d = r.state.step.normalized();
  CHECK((M * d).norm() <= 1e-7);
  CHECK(d.sum() > 0);
}

TEST_CASE("no minimum over a large kernel, seen through rounding") {
  MatrixXd B(40, 5);
  for (int j = 0; j < 5; ++j) B.col(j) = test::random_vector(40, 30U + static_cast<unsigned>(j));
  MatrixXd const product = B * B.transpose(), M = (product + product.transpose()) / 2;
  VectorXd const b = VectorXd::Ones(40);
  auto const set = slant::free_components(40);
  auto const qp = semidefinite(M, b, set);
  auto const r = test::minimise(slant::interior_point{qp}, test::zeros(40), 1e-10, 50);
  CHECK(r.status == slant::status::unbounded);
}

TEST_CASE("a semidefinite A whose kernel holds the first gradient up to rounding") {
  // b lies in the kernel of A but for rounding; half lines bound the descent along it from above.
  VectorXd const k = -VectorXd::LinSpaced(5, 1.0, 2.0).normalized();
  MatrixXd const M = MatrixXd::Identity(5, 5) - k * k.transpose();
  auto const set = slant::half_lines(VectorXd::Constant(5, -3.0).eval());
  auto const qp = semidefinite(M, k, set);
  auto const r = test::minimise(slant::interior_point{qp}, test::zeros(5), 1e-9, 60);
  CHECK(r.converged());
  auto const exact = test::minimise(slant::symmetric_newton{qp}, test::zeros(5), 1e-12, 200);
  REQUIRE(exact.converged());
  auto const q = [&](VectorXd const& x) { return x.dot(M * x) / 2 - k.dot(x); };
  CHECK(q(r.x()) == doctest::Approx(q(exact.x())).epsilon(1e-7));
}

TEST_CASE("nothing to do: solved at the start, no constraint at all") {
  problem p;
  p.b.setZero();
  p.lower.setConstant(-1);
  p.below(1) = -1;
  auto const qp = p.qp();
  auto const r = test::minimise(slant::interior_point{qp}, zero(), 1e-10, 5);
  CHECK(r.converged());
  CHECK(r.iterations() == 0);
  problem free;
  free.lower.setConstant(-infinity);
  free.below.setConstant(-infinity);
  free.above.setConstant(infinity);
  free.g.setConstant(infinity);
  auto const at_ease = free.qp();
  auto const unconstrained = test::minimise(slant::interior_point{at_ease}, zero(), 1e-12, 50);
  CHECK(unconstrained.converged());
  CHECK(unconstrained.state.constraints == 0);
  CHECK((free.A * unconstrained.x() - free.b).norm() <= 1e-11 * free.b.norm());
}

}  // namespace interior_point_statuses_test
