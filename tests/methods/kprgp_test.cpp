// SPDX-License-Identifier: MIT
#include <slant/iteration/iterates.hpp>
#include <slant/slant.hpp>

#include <krylov/spd_matrices.hpp>
#include <oracle/certificate.hpp>
#include <oracle/dense_newton.hpp>
#include <support/minimise.hpp>
#include <support/testing.hpp>
#include "example_one.hpp"
#include "mixture.hpp"

namespace kprgp_test {

using test::mixture;

TEST_CASE("agreement with Newton's method on dense data, whatever the options") {
  for (double κ : {1.0, 30.0, 1000.0}) {
    CAPTURE(κ);
    mixture const p(κ);
    auto const reference = oracle::solve_dense(p.plain());
    auto const A = test::spd(p.A);
    auto const set = p.set();
    auto const qp = slant::separable_qp{A, p.b, set};
    for (auto const& o :
         {slant::kprgp_options<double>{}, slant::kprgp_options<double>{.proportioning = 0.01},
          slant::kprgp_options<double>{.proportioning = 100},
          slant::kprgp_options<double>{.step_factor = 0.5},
          slant::kprgp_options<double>{.refresh = 1}, slant::kprgp_options<double>{.refresh = 0}}) {
      auto const r = test::minimise(slant::kprgp{qp, o}, test::zeros(20), 1e-13, 100000);
      REQUIRE(r.converged());
      VectorXd const x = r.x();
      CHECK((x - reference.x.cast<double>()).norm() <= 1e-11 * κ * x.norm());
      CHECK(oracle::certify(p.plain(), x.cast<long double>()).energy_error < 1e-6);
    }
  }
}

TEST_CASE("without constraints kprgp is the method of conjugate gradients") {
  auto const M = test::with_spectrum(test::log_spaced(30, 100));
  VectorXd const x = test::random_vector(30), b = M * x;
  auto const A = test::spd(M);
  auto const qp = slant::separable_qp{A, b, slant::free_components(30)};
  auto const r = test::minimise(slant::kprgp{qp, {.step_length = 1.0}}, test::zeros(30), 1e-12, 60);
  REQUIRE(r.converged());
  CHECK((r.x() - x).norm() <= 1e-9 * x.norm());
  CHECK(r.state.work.operator_applications == r.iterations() + r.iterations() / 50 + 1);
  // One more computes r from x before success is claimed.
}

TEST_CASE("cones, ellipses, points and other blocks") {
  auto const M = test::with_spectrum(test::log_spaced(11, 50));
  VectorXd const b = test::random_vector(11);
  auto const A = test::spd(M);
  auto const set = slant::cartesian(slant::power(slant::second_order_cone<3>(0.3), 2),
                                    slant::ellipse<>(2.0, 0.1),
                                    slant::point<1>(Eigen::Matrix<double, 1, 1>(0.25)),
                                    slant::interval<>(0.5, 0.5), slant::ball<1>(0.0));
  auto const qp = slant::separable_qp{A, b, set};
  auto const r =
      test::minimise(slant::kprgp{qp, {.step_factor = 1.0}}, test::zeros(11), 1e-12, 20000);
  REQUIRE(r.converged());
  // Variational inequality against many feasible points: rᵀ(z − x) ≥ 0.
  VectorXd const gradient = M * r.x() - b;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    VectorXd const z = slant::project(set, VectorXd(3 * test::random_vector(11, seed)));
    CHECK(gradient.dot(z - r.x()) >= -1e-10 * gradient.norm() * (z - r.x()).norm());
  }
  CHECK(r.x()(8) == 0.25);
  CHECK(r.x()(9) == 0.5);
  CHECK(r.x()(10) == 0.0);
}

TEST_CASE("the report counts every product, and a given step length saves those for σ_max") {
  mixture const p(1000);
  auto const set = p.set();
  auto const run = [&](auto const& options) {
    auto const counting = slant::counted(test::spd(p.A));
    auto const qp = slant::separable_qp{counting, p.b, set};
    auto const r = slant::solve(slant::kprgp{qp, options}, test::zeros(20), slant::at_most(100));
    CHECK(counting.applications() ==
          r.state.work.operator_applications + r.state.work.setup_applications);
    return r.state.work;
  };
  CHECK(run(slant::kprgp_options<double>{}).setup_applications > 0);
  CHECK(run(slant::kprgp_options<double>{.step_length = 1.0}).setup_applications == 0);
}

// The parts of the reduced gradient by their definitions; x, r and scales are for gradient_point_test.
TEST_CASE("the first state is that of the projected start") {
  test::mixture const p(30);
  auto const A = test::spd(p.A);
  auto const set = p.set();
  slant::kprgp const method{slant::separable_qp{A, p.b, set}, {.step_length = 0.7}};
  VectorXd const x0 = 3 * test::random_vector(20, 11);
  auto const s = method.start(x0);
  VectorXd const r = p.A * s.x - p.b;
  CHECK(s.r.norm() <= 1);
  VectorXd const reduced = (s.x - slant::project(set, VectorXd(s.x - 0.7 * r))) / 0.7;
  CHECK((s.unit * s.reduced - reduced).norm() <= 1e-13 * r.norm());
  CHECK(s.reduced_gradient_norm == doctest::Approx(reduced.norm()).epsilon(1e-12));
  VectorXd free = reduced;
  s.face.keep(reduced, free);
  double const square = s.unit * s.unit;
  CHECK(s.φr * square == doctest::Approx(free.dot(r)).epsilon(1e-11));
  CHECK(s.βr * square == doctest::Approx((reduced - free).dot(r)).epsilon(1e-11));
  CHECK(s.iteration == 0);
  CHECK(s.status == slant::status::running);
  CHECK(s.work.operator_applications == 2);
  CHECK(method.start(VectorXd::Zero(20)).work.operator_applications == 1);
}

/// α̃ that kprgp takes for the matrix M, and the largest eigenvalue of M.
double step_times_norm(MatrixXd const& M, slant::kprgp_options<double> const& options = {}) {
  auto const A = test::spd(M);
  auto const n = M.rows();
  slant::separable_qp const qp{A, VectorXd(VectorXd::Ones(n)), slant::half_lines(n)};
  return slant::kprgp(qp, options).start(VectorXd::Zero(n)).step_length * M.operatorNorm();
}

TEST_CASE("the default step is the best of the gradient method, at most step_factor / σ_max") {
  for (double κ : {1.0, 1.5, 3.0, 10.0}) {
    MatrixXd const M = test::with_spectrum(test::log_spaced(20, κ));
    double const best = 2 / (1 + 1 / κ);
    CHECK(step_times_norm(M) == doctest::Approx(std::min(1.9, best)).epsilon(1e-10));
    CHECK(step_times_norm(M, {.step_factor = 0.5}) == doctest::Approx(0.5).epsilon(1e-10));
  }
}

auto spd(VectorXd const& d) {
  return slant::diagonal<slant::positive_definite>(VectorXd(d));
}

TEST_CASE("what the constraints absorb does not make the tolerance looser") {
  auto const stop = slant::reduced_gradient_below(1e-8) || slant::at_most(100);
  VectorXd const zero = VectorXd::Zero(2), one = VectorXd::Ones(2);
  for (double pressed : {-1.0, -1e9, -1e20}) {
    CAPTURE(pressed);
    VectorXd const b{{pressed, 1.0}};
    slant::separable_qp const qp{spd(one), b, slant::half_lines(2)};
    auto const r = slant::solve(slant::kprgp{qp}, zero, stop);
    CHECK(r.converged());
    CHECK((r.x() - VectorXd{{0.0, 1.0}}).norm() <= 1e-7);
  }
  // Nearly linear: the bounds decide, not A.
  slant::separable_qp const steep{spd(1e-9 * one), one, slant::intervals(one)};
  auto const r = slant::solve(slant::kprgp{steep}, zero, stop);
  CHECK(r.converged());
  CHECK(r.x() == one);
}

TEST_CASE("a solution next to the origin is found there, wherever the run starts") {
  VectorXd const d{{1.0, 2.0}}, zero = VectorXd::Zero(2);
  slant::separable_qp const qp{spd(d), zero, slant::half_lines(VectorXd(VectorXd::Ones(2)))};
  auto const r = test::minimise(slant::kprgp{qp}, VectorXd{{1e8, 1e8}}, 1e-12, 10);
  CHECK(r.converged());
  CHECK(r.iterations() == 0);
  CHECK(r.x() == VectorXd::Ones(2));
}

TEST_CASE("a huge bound elsewhere, or a tiny step, does not make the first point the solution") {
  VectorXd const b{{0.0, 1.0}}, one = VectorXd::Ones(2);
  slant::separable_qp const qp{spd(one), b, slant::half_lines(VectorXd{{1e20, 0.0}})};
  auto const stop = slant::reduced_gradient_below(1e-8) || slant::at_most(100);
  for (auto const& options :
       {slant::kprgp_options<double>{}, slant::kprgp_options<double>{.step_length = 1e-12}}) {
    auto const r = slant::solve(slant::kprgp{qp, options}, test::zeros(2), stop);
    CHECK(r.converged());
    CHECK(r.x()(1) == doctest::Approx(1));
  }
}

TEST_CASE("an operator that declares to be definite is never called unbounded") {
  for (double κ : {1e14, 1e16, 1e20}) {
    VectorXd const b = VectorXd::Ones(2);
    slant::separable_qp const qp{spd(VectorXd{{κ, 1.0}}), b, slant::free_components(2)};
    auto const r = test::minimise(slant::kprgp{qp}, test::zeros(2), 1e-12, 100);
    CHECK(r.converged());
    CHECK(r.x()(0) == doctest::Approx(1 / κ));
    CHECK(r.x()(1) == doctest::Approx(1));
  }
}

TEST_CASE("a kernel is told from a soft direction by A, not by the step length asked for") {
  auto const A = slant::declare<slant::self_adjoint, slant::positive_semidefinite>(
      slant::diagonal(VectorXd{{1.0, 1e-7}}));
  VectorXd const b = VectorXd::Ones(2);
  slant::separable_qp const qp{A, b, slant::half_lines(2)};
  for (double step : {1.0, 1e-6, 1e-10}) {
    auto const r =
        test::minimise(slant::kprgp{qp, {.step_length = step}}, test::zeros(2), 1e-8, 100);
    CHECK(r.converged());
    CHECK(r.x()(1) == doctest::Approx(1e7));
  }
}

TEST_CASE("an eigenvalue whose reciprocal is no number is refused by name") {
  VectorXd const one = VectorXd::Ones(1);
  slant::separable_qp const qp{spd(1e-310 * one), one, slant::intervals(one)};
  CHECK(SLANT_COMPLAINT(slant::kprgp(qp).start(one)) ==
        "A: got largest eigenvalue 1e-310, expected one whose reciprocal is a finite number > 0");
}

// Discs beside free components, A singular, b not in its range: a long way along the discs.
auto discs_beside_free_components() {
  return slant::cartesian(slant::discs(VectorXd(VectorXd::Ones(4))), slant::free_components(4));
}
struct slow_problem {
  MatrixXd M;
  VectorXd b;
  explicit slow_problem(unsigned seed) {
    VectorXd spectrum = VectorXd::Zero(12);
    spectrum.head(8) = test::log_spaced(8, 25);
    M = test::with_spectrum(spectrum, seed);
    VectorXd const x = test::random_vector(12, seed),
                   p = slant::project(discs_beside_free_components(), x);
    b = M * p + 0.1 * (x - p);
    VectorXd const y = test::random_vector(12, seed + 500);
    VectorXd const kernel = y - test::least_squares(M, M * y);
    b += 1e-3 * b.norm() / kernel.norm() * kernel;
  }
};

TEST_CASE("slow is not stalled: q still falls where the reduced gradient does not") {
  slow_problem const p(20);
  auto const A =
      slant::declare<slant::self_adjoint, slant::positive_semidefinite>(slant::matrix(p.M));
  slant::separable_qp const qp{A, p.b, discs_beside_free_components()};
  auto const q_after = [&](slant::index steps) {
    auto const r = test::minimise(slant::kprgp{qp}, test::zeros(12), 1e-10, steps);
    CHECK(r.status == slant::status::iteration_limit);
    VectorXd const x = r.x();
    return 0.5 * x.dot(p.M * x) - p.b.dot(x);
  };
  CHECK(q_after(6000) < q_after(2000));
}

double q_of(MatrixXd const& A, VectorXd const& b, VectorXd const& x) {
  return x.dot(0.5 * (A * x) - b);
}

/// Does q fall by the factor of [K Theorem 1] in every step? Returns the number of steps seen.
template <class Method>
int check_decrease(Method const& method, MatrixXd const& M, VectorXd const& b, VectorXd const& x0,
                   VectorXd const& solution, double η) {
  double const q_min = q_of(M, b, solution);
  double const gap0 = q_of(M, b, x0) - q_min;
  double last = gap0;
  int seen = 0;
  for (auto const& s : slant::iterates(method, x0)) {
    double const gap = q_of(M, b, s.x) - q_min;
    if (!(gap > 1e-12 * gap0)) break;  // rounding errors of q
    if (seen > 0) CHECK(gap <= η * last);
    last = gap;
    ++seen;
  }
  return seen;
}

TEST_CASE("AS-S: the decrease of q of Theorem 1, discs and intervals") {
  test::example_one<double> const p;
  test::example_one_solution<double> const solution;
  auto const qp = slant::separable_qp{p.a(), p.b, p.set()};
  MatrixXd const M = p.A;
  VectorXd const σ = test::eigenvalues_of(M);
  auto const box = slant::intervals(VectorXd(VectorXd::Constant(12, 1.5)));
  auto const plane = slant::separable_qp{p.a(), p.b, box};
  oracle::dense_qp plain{M, p.b.cast<long double>(), {}, {}};
  for (Eigen::Index i = 0; i < 12; ++i) plain.intervals.push_back({i, -1.5, 1.5});
  VectorXd const corner = oracle::solve_dense(plain).x.cast<double>();
  for (double Γ : {0.5, 1.0, 3.0}) {
    for (double β : {0.5, 1.0, 1.9}) {
      CAPTURE(Γ);
      CAPTURE(β);
      double const α = β / σ(11), Γ_max = std::max(Γ, 1 / Γ);
      double const η = 1 - α * σ(0) / (2 + 2 * Γ_max * Γ_max);
      slant::kprgp_options<double> const o{.proportioning = Γ, .step_length = α};
      CHECK(check_decrease(slant::as_s(qp, o), M, p.b, p.zero(), solution.x, η) > 5);
      CHECK(check_decrease(slant::as_s(plane, o), M, p.b, p.zero(), corner, η) > 1);
      CHECK(check_decrease(slant::kprgp{plane, o}, M, p.b, p.zero(), corner, η) > 1);
    }
  }
}

TEST_CASE("a block on its boundary that the gradient pulls inside is free for AS-S at once") {
  VectorXd const b{{3.0, 1.0}};
  MatrixXd const M{{2.0, 1.0}, {1.0, 2.0}};
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(M);
  auto const set = slant::half_lines(2);
  auto const qp = slant::separable_qp{A, b, set};
  VectorXd const zero = VectorXd::Zero(2);
  auto const first_step = [&](auto const& method) {
    auto s = method.start(zero);
    method.step(s);
    return s.last_step;
  };
  CHECK(first_step(slant::as_s(qp)) == slant::kprgp_step::conjugate_gradient);
  CHECK(first_step(slant::kprgp{qp}) == slant::kprgp_step::proportioning);
}

TEST_CASE("blocks are released only from (nearly) the minimum on the face") {
  auto const M = test::with_spectrum(test::log_spaced(20, 100));
  VectorXd const b = 3 * test::random_vector(20, 5);
  auto const A = test::spd(M);
  auto const qp = slant::separable_qp{A, b, slant::half_lines(20)};
  oracle::dense_qp plain{M, b.cast<long double>(), {}, {}};
  for (Eigen::Index i = 0; i < 20; ++i) plain.intervals.push_back({i, 0});
  VectorXd const reference = oracle::solve_dense(plain).x.cast<double>();
  for (double δ : {0.5, 1e-2, 1e-8}) {
    CAPTURE(δ);
    slant::qpc const method{qp, {.face_accuracy = δ}};
    auto s = method.start(VectorXd::Ones(20));
    int releases = 0, faces = 0;
    for (int k = 0; k < 500 && s.reduced_gradient_norm > 1e-10 * s.gradient_scale; ++k) {
      double const φ = s.φr, β = s.βr, first = s.φr_at_restart;
      VectorXd const before = s.x;
      auto const face = s.face;
      method.step(s);
      if (s.last_step != slant::kprgp_step::conjugate_gradient) ++faces;
      if (s.last_step != slant::kprgp_step::proportioning) continue;
      ++releases;
      CHECK(φ <= δ * δ * std::max(first, β));
      // q is as small as it gets without releasing anything, up to that accuracy.
      VectorXd free_gradient = M * before - b;
      face.keep(free_gradient, free_gradient);
      CHECK(free_gradient.squaredNorm() <=
            1.0001 * s.unit * s.unit * δ * δ * std::max(first, β) + 1e-24 * b.squaredNorm());
    }
    CHECK(releases > 0);
    CHECK(faces > releases);
    CHECK((s.x - reference).norm() <= 1e-8 * reference.norm());
  }
}

/// β for gradients r at x, with r̃ for the step length α.
template <class Set>
VectorXd kkt(Set const& set, VectorXd const& x, VectorXd const& r, double α = 0.1) {
  slant::face<double> const face(set, x);
  VectorXd const reduced = (x - slant::project(set, VectorXd(x - α * r))) / α;
  VectorXd β(x.size());
  face.keep_complement(reduced, β);
  slant::kkt_vector(set, face, x, r, reduced, β);
  return β;
}

TEST_CASE("on a circle: r + ‖r‖ x/‖x‖, zero exactly where r points inwards along the normal") {
  auto const set = slant::discs(VectorXd(VectorXd::Constant(1, 2.0)));
  VectorXd const x{{2.0, 0.0}};
  CHECK(kkt(set, x, VectorXd{{0.0, 3.0}}) == VectorXd{{3.0, 3.0}});
  CHECK(kkt(set, x, VectorXd{{-5.0, 0.0}}) == VectorXd{{0.0, 0.0}});
  CHECK(kkt(set, x, VectorXd{{5.0, 0.0}}) == VectorXd{{10.0, 0.0}});
  // −β halves the angle between −x, inwards, and −r.
  VectorXd const r{{1.0, -2.0}}, β = kkt(set, x, r);
  CHECK(β.dot(x) / x.norm() == doctest::Approx(β.dot(r) / r.norm()));
}

TEST_CASE("on bounds: twice the gradient where it releases, zero where it presses") {
  auto const set = slant::cartesian(slant::half_lines(2), slant::intervals(VectorXd{{1.0, 1.0}}));
  VectorXd const x{{0.0, 0.0, 1.0, -1.0}};
  CHECK(kkt(set, x, VectorXd{{-3.0, 3.0, 2.0, -2.0}}) == VectorXd{{-6.0, 0.0, 4.0, -4.0}});
  CHECK(kkt(set, x, VectorXd{{3.0, -3.0, -2.0, 2.0}}) == VectorXd{{0.0, -6.0, 0.0, 0.0}});
}

TEST_CASE("free blocks get nothing, points and apexes keep the reduced gradient") {
  auto const set = slant::cartesian(slant::discs(VectorXd{{0.0, 1.0}}), slant::free_components(1),
                                    slant::power(slant::second_order_cone<3>(1.0), 1));
  VectorXd x = VectorXd::Zero(8), r(8);
  r << 1, 2, 3, 4, 5, 0.5, 0.25, -6;
  VectorXd const β = kkt(set, x, r);
  CHECK(β.head(5) == VectorXd::Zero(5));
  VectorXd const reduced = (x - slant::project(set, VectorXd(x - 0.1 * r))) / 0.1;
  CHECK(β.tail(3) == reduced.tail(3));
  CHECK(β.tail(3).norm() > 0);
}

TEST_CASE("curved boundaries other than circles, at any scale") {
  for (double t : {1.0, std::ldexp(1.0, 500), std::ldexp(1.0, -500)}) {
    auto const set = slant::power(slant::ellipse<>(3.0 * t, 1.0 * t), 1);
    double const angle = 0.7;
    VectorXd const x{{3 * t * std::cos(angle), t * std::sin(angle)}};
    VectorXd normal{{std::cos(angle) / 3, std::sin(angle)}};
    normal.normalize();
    VectorXd const r{{0.3, -1.0}};
    CHECK((kkt(set, x, r, 0.1 * t) - (r + r.norm() * normal)).norm() <= 1e-14);
    CHECK(kkt(set, x, VectorXd(-2 * normal), 0.1 * t).norm() <= 1e-13);
  }
}

}  // namespace kprgp_test
