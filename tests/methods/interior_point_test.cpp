// SPDX-License-Identifier: MIT
#include <slant/slant.hpp>
#include "scales.hpp"

#include <krylov/spd_matrices.hpp>
#include <support/minimise.hpp>
#include <support/testing.hpp>
#include "example_one.hpp"
#include "second_differences.hpp"

namespace interior_point_test {

TEST_CASE(
    "Example 1: the solution, products counted, every iterate in the interior, no allocation") {
  test::example_one<double> const p;
  auto const A = slant::counted(p.a());
  auto const set = p.set();
  slant::separable_qp const qp{A, p.b, set};
  slant::interior_point const method{qp};
  auto s = method.start(p.zero());
  // The length of the data. A knows its diagonal, and the middle of all discs is 0.
  CHECK(s.work.setup_applications == 1);
  CHECK(A.applications() == 1);
  while (s.status == slant::status::running && s.reduced_gradient_norm > 1e-10 * s.gradient_scale) {
    CHECK(test::allocations_of([&] { method.step(s); }) == 0);
    CHECK(A.applications() == 1 + s.work.operator_applications);
    CHECK(s.work.operator_applications == s.work.inner_iterations);  // none besides those of CG
    for (Eigen::Index i = 0; i < 6; ++i)
      CHECK(s.x(i) * s.x(i) + s.x(i + 6) * s.x(i + 6) < p.g(i) * p.g(i));
    CHECK(s.multipliers.minCoeff() > 0);
    CHECK(s.slacks.minCoeff() > 0);
    REQUIRE(s.iteration < 40);
  }
  CHECK((s.unit * s.r - (p.A * s.x - p.b)).norm() <= 1e-13 * p.b.norm());
  CHECK(method.refresh(s));
  CHECK_FALSE(method.refresh(s));
  test::example_one_solution<double> const exact;
  CHECK((s.x - exact.x).norm() <= 1e-9 * exact.x.norm());
  CHECK(slant::solve(method, p.zero(), slant::step_below(1e-8) || slant::at_most(60)).converged());
}

/// A block of every kind, and images of some: 30 unknowns.
auto every_kind() {
  Eigen::Matrix2d const turn{{0.6, -0.8}, {0.8, 0.6}};
  return slant::cartesian(
      slant::half_lines(VectorXd{{0.0, -1.0, 0.5, -infinity}}), slant::interval<>(-0.1, 0.2),
      slant::interval<>(0.3, infinity), slant::discs<slant::planar>(VectorXd{{0.5, infinity, 2.0}}),
      slant::ellipse<>(2.0, 0.1), slant::power(slant::second_order_cone<3>(0.5), 2),
      slant::shifted(slant::rotated(slant::ellipse<>(1.0, 0.3), turn), Vector2d(1.0, 1.0)),
      slant::scaled(0.25, slant::ball<3>(1.0)), slant::point<2>(Vector2d(0.7, -0.2)),
      slant::free_components(3));
}

TEST_CASE("a product of all blocks: that of the symmetric Newton method, digits as promised") {
  auto const set = every_kind();
  slant::index const n = slant::dimension_of(set);
  for (unsigned seed = 1; seed <= 4; ++seed) {
    CAPTURE(seed);
    auto const A = test::spd(test::with_spectrum(test::log_spaced(n, 100), seed));
    VectorXd const b = 2 * test::random_vector(n, seed + 10);
    slant::separable_qp const qp{A, b, set};
    for (double size : {0.0, 1e3}) {
      CAPTURE(size);
      VectorXd const x0 = size * test::random_vector(n, 5);
      auto const exact = test::minimise(slant::symmetric_newton{qp}, x0, 1e-13, 200);
      REQUIRE(exact.converged());
      auto const r = test::minimise(slant::interior_point{qp}, x0, 1e-10, 60);
      CHECK(r.converged());
      CHECK((r.x() - exact.x()).norm() <= 1e-7 * exact.x().norm());
      CHECK(set.contains(r.x()));
      auto const& s = r.state;
      CHECK(s.multipliers.minCoeff() >= 0);
      CHECK(s.slacks.minCoeff() > 0);
      if (size > 0) continue;
      // The reduced gradient falls as fast as the products: centred by c = 1/5, ϑ falls by 5 in a
      // step; 6 digits take 9 steps, and one more is granted.
      auto const rough = test::minimise(slant::interior_point{qp}, x0, 1e-4, 60);
      CHECK(rough.converged());
      CHECK(r.iterations() - rough.iterations() <= 10);
    }
  }
}

TEST_CASE(
    "free blocks have no multiplier and no slack, points and infinite bounds count for nothing") {
  auto const set = every_kind();
  slant::barrier<double> const barrier(set);
  // half lines 4, intervals 2 · 2, discs 3, ellipse 1, cones 2 · 2, image 1, ball 1
  CHECK(barrier.rows() == 18);
  CHECK(slant::barrier<double>(slant::free_components(7)).rows() == 0);
  static_assert(slant::free_space<2>::inequalities == 0);
  static_assert(
      decltype(slant::cartesian(slant::free_space<2>{}, slant::ball<2>{}))::inequalities == 1);
  slant::index const n = slant::dimension_of(set);
  auto const A = test::spd(test::with_spectrum(test::log_spaced(n, 10)));
  VectorXd const b = test::random_vector(n);
  slant::separable_qp const qp{A, b, set};
  slant::interior_point const method{qp};
  auto s = method.start(test::zeros(n));
  CHECK(s.constraints == 15);
  for (int k = 0; k < 5; ++k) method.step(s);
  CHECK((s.multipliers.array() == 0).count() == 3);
  CHECK(s.x.segment(n - 5, 2) == Vector2d(0.7, -0.2));
}

TEST_CASE("cones: apex, mantle and interior; at an angle, no axis leads from the apex inside") {
  auto const check = [](auto const& set, MatrixXd const& M, unsigned seed) {
    auto const A = test::spd(M);
    slant::separable_qp const qp{A, VectorXd(test::random_vector(M.rows(), seed)), set};
    VectorXd const zero = VectorXd::Zero(M.rows());
    auto const exact = test::minimise(slant::symmetric_newton{qp}, zero, 1e-13, 300);
    REQUIRE(exact.converged());
    auto const r = test::minimise(slant::interior_point{qp}, zero, 1e-9, 80);
    CHECK(r.converged());
    CHECK((r.x() - exact.x()).norm() <= 1e-6 * exact.x().norm());
  };
  for (double μ : {1e-3, 0.5, 1.0, 30.0}) {
    CAPTURE(μ);
    check(slant::power(slant::second_order_cone<3>(μ), 8),
          test::with_spectrum(test::log_spaced(24, 30), 7), 21);
  }
  Eigen::Matrix2d const turn(Eigen::Rotation2Dd(0.785).matrix());
  check(slant::power(slant::rotated(slant::second_order_cone<2>(0.3), turn), 4),
        test::with_spectrum(test::log_spaced(8, 10), 3), 4);
}

/// x ≥ lower for the first unknowns, |x| ≤ width for the next, the others free.
auto program(MatrixXd const& M, VectorXd const& b, VectorXd const& lower, VectorXd const& width) {
  return slant::separable_qp{
      test::spd(M), b,
      slant::cartesian(slant::half_lines(lower), slant::intervals(width),
                       slant::free_components(b.size() - lower.size() - width.size()))};
}
VectorXd const none;

/// Half lines and free components; A is a stiff string, whose diagonal says little.
struct problem {
  static constexpr Eigen::Index n = 60;
  MatrixXd M = test::second_differences(n);
  VectorXd b = VectorXd::LinSpaced(n, -0.1, 0.3);

  [[nodiscard]] auto qp() const { return program(M, b, test::zeros(n / 2), none); }
};

auto const accurate = slant::reduced_gradient_below(1e-9) || slant::at_most(60);

TEST_CASE("M = diag(A)⁻¹ is what the method does without M") {
  problem const p;
  VectorXd const zero = VectorXd::Zero(p.n);
  VectorXd const inverse_diagonal = VectorXd::Constant(p.n, 0.5);
  auto const jacobi =
      slant::diagonal<slant::self_adjoint, slant::positive_definite>(inverse_diagonal);
  auto const plain = slant::solve(slant::interior_point{p.qp()}, zero, accurate);
  auto const same = slant::solve(slant::interior_point{p.qp(), jacobi}, zero, accurate);
  REQUIRE(plain.converged());
  REQUIRE(same.converged());
  CHECK(same.iterations() == plain.iterations());
  CHECK(same.state.work.operator_applications == plain.state.work.operator_applications);
  CHECK((same.x() - plain.x()).norm() <= 1e-9 * plain.x().norm());
}

TEST_CASE("M = A⁻¹: without constraints one product solves, with them some do what took many") {
  problem const p;
  VectorXd const zero = VectorXd::Zero(p.n);
  auto const inverse = slant::inverse(slant::dense_ldlt(p.M));
  auto const at_once =
      slant::solve(slant::interior_point{program(p.M, p.b, none, none), inverse}, zero, accurate);
  CHECK(at_once.converged());
  CHECK(at_once.state.work.inner_iterations <= 2);
  CHECK((p.M * at_once.x() - p.b).norm() <= 1e-9 * p.b.norm());

  auto const plain = slant::solve(slant::interior_point{p.qp()}, zero, accurate);
  auto const fast = slant::solve(slant::interior_point{p.qp(), inverse}, zero, accurate);
  REQUIRE(plain.converged());
  REQUIRE(fast.converged());
  CHECK(3 * fast.state.work.operator_applications < plain.state.work.operator_applications);
  CHECK((fast.x() - plain.x()).norm() <= 1e-7 * plain.x().norm());
}

TEST_CASE("a preconditioner of another size is named") {
  problem const p;
  auto const small = slant::identity(3);
  CHECK_THROWS_WITH_AS(slant::interior_point(p.qp(), small),
                       "rows of the preconditioner: got 3, expected size 60", slant::bad_input);
}

/// A string, soft where it is free and held tight in a narrow slit where it is pushed: the forces
/// of the start, taken from the mean of all gradients, are too small to keep a Newton step inside.
TEST_CASE("forces that are too small at the start are raised") {
  Eigen::Index const n = 200, bounded = 20;
  MatrixXd M = test::second_differences(n);
  M.diagonal().setConstant(2.0001);
  M.bottomRightCorner(n - bounded, n - bounded) *= 1e-3;
  M(bounded - 1, bounded) = M(bounded, bounded - 1) = -1e-3;
  VectorXd b = VectorXd::Constant(n, 0.01);
  for (Eigen::Index i = 0; i < bounded; ++i) b(i) = std::pow(10, double(i) / double(bounded));
  auto const qp = [&] { return program(M, b, none, VectorXd::Constant(bounded, 1e-4)); };
  VectorXd const zero = VectorXd::Zero(n);
  auto const solution = slant::solve(slant::interior_point{qp()}, zero, accurate);
  REQUIRE(solution.converged());
  auto const on_the_way = slant::reduced_gradient_below(1e-4) || slant::at_most(60);
  auto const raised = slant::solve(slant::interior_point{qp()}, zero, on_the_way);
  REQUIRE(raised.converged());
  CHECK(raised.state.raises == 1);
  // 10 steps and 248 products with the forces of the start.
  CHECK(raised.iterations() <= 8);
  CHECK(raised.state.work.operator_applications <= 235);
  // All are pushed to the end of their slit.
  for (Eigen::Index i = 0; i < bounded; ++i) CHECK(solution.x()(i) == doctest::Approx(1e-4));
}

/// Half lines, intervals, discs and two free unknowns: 12 of them, all lengths in units of t.
struct twelve_unknowns {
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
  return SLANT_COMPLAINT(slant::interior_point{qp}.start(zero()));
}

TEST_CASE("an empty interior: the block, and what to use instead") {
  std::string const words =
      " of the set: got no point inside that f(x) tells, expected points with f(x) < 0, which an "
      "interval between neighbouring numbers or a cone with friction coefficient 0 does not have; "
      "another method takes it (symmetric_newton, kprgp)";
  twelve_unknowns p;
  p.above(1) = std::nextafter(p.below(1), 1.0);  // two numbers, none between them
  CHECK(refusal(p) == "block 4" + words);
  p.above(1) = infinity;
  p.below(1) = -infinity;
  CHECK(refusal(p) == "nothing thrown");
}

TEST_CASE("a slip bound 0 and an interval with equal ends are held") {
  twelve_unknowns p;
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
    twelve_unknowns p;
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
    twelve_unknowns const p{.t = std::ldexp(1.0, length)};
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
  twelve_unknowns const p;
  auto const qp = p.qp();
  auto const r = test::minimise(slant::interior_point{qp}, zero(), 0.0, 300);
  CHECK(r.status == slant::status::stalled);
  CHECK(r.state.reduced_gradient_norm <= 2e-14 * (p.b.norm() + p.A.norm() * r.x().norm()));
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
  auto const endless = run(M);
  CHECK(endless.status == slant::status::unbounded);
  VectorXd const d = endless.state.step;
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

TEST_CASE("no minimum: along free unknowns, over a large kernel, beside constraints") {
  auto const judge = [](MatrixXd const& H, VectorXd const& b, auto const& set) {
    auto const qp = semidefinite(H, b, set);
    auto const r = test::minimise(slant::interior_point{qp}, test::zeros(b.size()), 1e-10, 50);
    CHECK(r.status == slant::status::unbounded);
    VectorXd const d = r.state.step.normalized();
    CHECK((H * d).norm() <= 1e-7 * H.norm());
    CHECK(d.dot(b) > 0);
  };
  VectorXd const k = test::random_vector(6).normalized();
  judge(MatrixXd::Identity(6, 6) - k * k.transpose(), VectorXd::Ones(6), slant::free_components(6));
  MatrixXd B(40, 5);
  for (int j = 0; j < 5; ++j) B.col(j) = test::random_vector(40, 30U + static_cast<unsigned>(j));
  MatrixXd const product = B * B.transpose();
  judge((product + product.transpose()) / 2, VectorXd::Ones(40), slant::free_components(40));
  judge(MatrixXd(VectorXd{{0, 4, 0}}.asDiagonal()), VectorXd{{-2, 1, 2}},
        slant::cartesian(slant::half_lines(1), slant::free_components(2)));
  judge(MatrixXd(VectorXd{{1, 0, 0}}.asDiagonal()), VectorXd{{2, -3, 3}}, slant::half_lines(3));
}

TEST_CASE("programs of any rank with discs and cones: solved where Newton's method does") {
  std::mt19937 random(21);
  std::normal_distribution<double> normal;
  auto const number = [&] { return normal(random); };
  int open = 0;
  for (int k = 0; k < test::effort(400, 60); ++k) {
    constexpr int n = 12;
    int const rank = 1 + int(random() % n);
    MatrixXd const B = MatrixXd::NullaryExpr(n, rank, number), H = B * B.transpose();
    VectorXd const b = 3 * B * VectorXd::NullaryExpr(rank, number);
    VectorXd const radii = VectorXd::NullaryExpr(
        3, [&] { return random() % 5 == 0 ? 0.0 : std::pow(10.0, double(random() % 7) - 3); });
    VectorXd const μ = VectorXd::NullaryExpr(2, [&] { return 0.1 + double(random() % 10); });
    auto const set = slant::cartesian(slant::discs(radii), slant::friction_cones<3>(μ));
    auto const qp = semidefinite(H, b, set);
    auto const r = test::minimise(slant::interior_point{qp}, test::zeros(n), 1e-8, 200);
    CHECK(r.status != slant::status::breakdown);
    auto const other = slant::symmetric_newton{qp};
    open += !r.converged() && test::minimise(other, test::zeros(n), 1e-8, 2000).converged();
  }
  CHECK(open <= 3);  // none where it was measured
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
  twelve_unknowns p;
  p.b.setZero();
  p.lower.setConstant(-1);
  p.below(1) = -1;
  auto const qp = p.qp();
  auto const r = test::minimise(slant::interior_point{qp}, zero(), 1e-10, 5);
  CHECK(r.converged());
  CHECK(r.iterations() == 0);
  twelve_unknowns free;
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

}  // namespace interior_point_test
