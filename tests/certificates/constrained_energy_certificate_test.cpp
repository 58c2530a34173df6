// SPDX-License-Identifier: MIT
#include <support/optimised.hpp>

#include <slant/certificates/constrained_energy_certificate.hpp>
#include <slant/certificates/energy_error.hpp>
#include <slant/methods/constrained_newton.hpp>
#include <slant/methods/smalse.hpp>

#include <doctest/doctest.h>
#include <Eigen/Dense>

#include <support/allocation_guard.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <methods/equality_scenes.hpp>
#include <vector>

namespace constrained_energy_certificate_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using slant::constrained_energy_certificate;
using slant::status;
using test::known_problem;
using test::sparse;
using real = long double;
using real_vector = Eigen::Matrix<real, Eigen::Dynamic, 1>;
using real_matrix = Eigen::Matrix<real, Eigen::Dynamic, Eigen::Dynamic>;

/// vᵀM⁻¹v for a definite M, by Cholesky's factorisation.
real inverse_form(real_matrix M, real_vector v) {
  real sum = 0;
  for (Eigen::Index k = 0; k < v.size(); ++k) {
    sum += v(k) * v(k) / M(k, k);
    for (Eigen::Index i = k + 1; i < v.size(); ++i) {
      real const factor = M(i, k) / M(k, k);
      v(i) -= factor * v(k);
      for (Eigen::Index j = k + 1; j < v.size(); ++j) M(i, j) -= factor * M(k, j);
    }
  }
  return sum;
}

/// √(dᵀ(A + ω Q)d) for d = x − x*, ω = ‖x‖_A²/‖x‖², in the long type.
double error_of(MatrixXd const& A, sparse const& unit_rows, VectorXd const& x,
                VectorXd const& solution) {
  real_vector const y = x.cast<real>(), d = y - solution.cast<real>();
  real_matrix const a = A.cast<real>(), N = MatrixXd(unit_rows).cast<real>();
  real const energy = d.dot(a * d), ω = y.dot(a * y) / y.squaredNorm();
  real const off = inverse_form(N * N.transpose(), N * d);
  return static_cast<double>(std::sqrt(std::fmax(energy, 0.0L) + ω * std::fmax(off, 0.0L)));
}

double energy_norm(MatrixXd const& A, VectorXd const& x) {
  real_vector const y = x.cast<real>();
  return static_cast<double>(std::sqrt(y.dot(A.cast<real>() * y)));
}

/// A program with its solution, all but b exact: entries of x*, G and bounds are multiples of 2⁻¹²,
/// sliding discs are at Pythagorean points.
struct planted {
  MatrixXd A;
  VectorXd x, b, lower, radius, e;
  sparse G;
  double lost;  // ‖·‖_{A⁻¹} of what rounding b loses

  static double grid(double v) { return std::round(4096 * v) / 4096; }

  /// n = 3 m + 2: 2 free, m half lines, m discs; the last of p > 2 rows is redundant. degenerate:
  /// share of active constraints without a force.
  planted(int m, int p, double log_condition, double degenerate, std::mt19937& random)
      : A(3 * m + 2, 3 * m + 2), x(3 * m + 2), lower(VectorXd::Zero(m)), radius(m) {
    std::normal_distribution<double> gauss;
    std::uniform_real_distribution<double> uniform(0, 1);
    int const n = 3 * m + 2;
    for (double& entry : A.reshaped()) entry = gauss(random);
    MatrixXd const Q = Eigen::HouseholderQR<MatrixXd>(A).householderQ();
    VectorXd spectrum(n);
    for (double& λ : spectrum) λ = std::pow(10, -log_condition * uniform(random));
    spectrum(0) = 1;
    spectrum(n - 1) = std::pow(10, -log_condition);
    A = Q * spectrum.asDiagonal() * Q.transpose();
    A = (0.5 * (A + A.transpose())).eval();

    real_vector force = real_vector::Zero(n);
    auto const strength = [&] { return uniform(random) < degenerate ? 0 : uniform(random); };
    for (int i = 0; i < 2; ++i) x(i) = grid(gauss(random));
    for (int i = 0; i < m; ++i) {
      bool const open = uniform(random) < 0.5;
      x(2 + i) = open ? grid(uniform(random)) + 0x1p-12 : 0;
      if (!open) force(2 + i) = strength();
      static constexpr int triples[3][3] = {{3, 4, 5}, {-12, 5, 13}, {8, -15, 17}};
      auto const& t = triples[int(3 * uniform(random))];
      double const unit = std::round(1 + 200 * uniform(random)) / 4096;
      bool const slides = uniform(random) < 0.5;
      double const share = slides ? 1 : grid(0.9 * uniform(random));
      radius(i) = unit * t[2];
      for (int j = 0; j < 2; ++j) x(2 + m + 2 * i + j) = share * unit * t[j];
      real const size = slides ? strength() : 0;
      for (int j = 0; j < 2; ++j) force(2 + m + 2 * i + j) = -size * t[j] / t[2];
    }
    MatrixXd rows(p, n);
    for (double& entry : rows.reshaped()) entry = std::round(3 * gauss(random));
    if (p > 2) rows.row(p - 1) = rows.row(0) - 2 * rows.row(1);
    G = rows.sparseView();
    e = rows * x;
    for (int i = 0; i < p; ++i) force -= real(gauss(random)) * rows.row(i).transpose().cast<real>();
    real_vector const load = A.cast<real>() * x.cast<real>() - force;
    b = load.cast<double>();
    real_vector const rounding = load - b.cast<real>();
    lost = static_cast<double>(std::sqrt(inverse_form(A.cast<real>(), rounding)));
  }
  [[nodiscard]] auto qp() const {
    return slant::separable_qp{slant::matrix<slant::self_adjoint, slant::positive_definite>(A), b,
                               slant::cartesian(slant::free_components(2), slant::half_lines(lower),
                                                slant::discs(radius))};
  }
};

TEST_CASE("claimed against true errors: planted programs, condition numbers up to 1e10") {
  std::mt19937 random(20261123);
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<double> ratios;
  int converged = 0, too_small = 0, wrong = 0, wrong_by_residuals = 0, all = 0;
  // Under sanitizers, unoptimised, each takes fifty times as long.
  int const programs = test::is_optimised ? 150 : 8;
  for (int run = 0; run < programs; ++run) {
    double const log_condition = 10 * uniform(random);
    planted const p(1 + run % 4, run % 5, log_condition, run % 3 == 0 ? 0.5 : 0, random);
    CAPTURE(run);
    auto const qp = p.qp();
    slant::equality_constraints const constraints(p.G, p.e);
    constrained_energy_certificate certificate(qp, constraints);
    double const size = energy_norm(p.A, p.x);
    auto const look = [&](VectorXd const& x) {
      double const error = error_of(p.A, constraints.unit_rows(), x, p.x);
      auto const known = certificate(x);
      ++all;
      if (known.relative() <= 1e-8 && error > 1e-7 * size) ++wrong;
      // Above the rounding of the data; late.
      double const floor = 30 * p.lost + 1e-14 * size * std::pow(10, log_condition / 2);
      if (!(error > floor) || error > 1e-2 * size) return;
      if (known.bound < 0.5 * error) ++too_small;
      ratios.push_back(known.bound / error);
    };
    for (double δ = 1e-2; δ > 1e-12; δ /= 100) {
      VectorXd x = p.x;
      for (double& entry : x) entry += δ * gauss(random);
      look(slant::project(qp.set(), x));
    }
    VectorXd const x0 = VectorXd::Zero(p.x.size());
    auto const by_error = slant::energy_error_below(1e-8, certificate);
    auto const judge = [&](auto const& r, int& claims_that_are_wrong) {
      if (!r.converged()) return;
      ++converged;
      double const error = error_of(p.A, constraints.unit_rows(), r.x(), p.x);
      if (error > 1e-7 * size) ++claims_that_are_wrong;
    };
    judge(slant::solve(slant::constrained_newton{qp, constraints}, x0,
                       by_error || slant::at_most(100), [&](auto const& s) { look(s.x); }),
          wrong);
    slant::smalse const multipliers{qp, constraints};
    judge(slant::solve(multipliers, x0, by_error || slant::at_most(300)), wrong);
    judge(slant::solve(multipliers, x0, test::accurate(1e-8)), wrong_by_residuals);
  }
  CHECK(all > 10 * programs);
  CHECK(converged >= 2.7 * programs);
  CHECK(wrong == 0);
  CHECK(too_small == 0);
  if (!test::is_optimised) return;  // too few for statistics
  CHECK(wrong_by_residuals > 3);    // what reduced gradient and feasibility say of the same runs
  REQUIRE(ratios.size() > 500);
  std::sort(ratios.begin(), ratios.end());
  CHECK(ratios[ratios.size() / 2] <= 2);
  CHECK(ratios[ratios.size() * 9 / 10] <= 20);
}

auto spd(MatrixXd const& A) {
  return slant::matrix<slant::self_adjoint, slant::positive_definite>(A);
}

/// Free components, then half lines; of the type of known_problem::qp.
auto program(MatrixXd const& A, VectorXd const& b, int free, int half) {
  return slant::separable_qp{slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(A), b,
                             slant::cartesian(slant::free_components(free), slant::half_lines(half),
                                              slant::discs(VectorXd()))};
}

/// Ends a run from zero by the error, and compares what is said with the error.
template <class Method, class QP, class C>
void check_verdict(Method const& method, QP const& qp, C const& constraints, MatrixXd const& A,
                   VectorXd const& solution) {
  auto const r = slant::solve(
      method, VectorXd(VectorXd::Zero(qp.size())),
      slant::energy_error_below(1e-8, constrained_energy_certificate{qp, constraints}) ||
          slant::at_most(400));
  CAPTURE(r.reason);
  CHECK(r.converged());
  CHECK(r.reason.starts_with("relative energy error"));
  double const error = error_of(A, constraints.unit_rows(), r.x(), solution);
  CHECK(error <= 1.1e-8 * energy_norm(A, solution));
}

TEST_CASE("constrained_newton and smalse end by the error, in any units and lengths") {
  for (auto const& [unit, length] :
       {std::array{1.0, 1.0}, std::array{1e150, 1.0}, std::array{1e-150, 1.0},
        std::array{1.0, 1e150}, std::array{1.0, 1e-150}}) {
    CAPTURE(unit);
    CAPTURE(length);
    known_problem const p(unit, known_problem::n, length);
    auto const qp = p.qp();
    auto const constraints = p.constraints();
    check_verdict(slant::constrained_newton{qp, constraints}, qp, constraints, p.A, p.x);
    check_verdict(slant::smalse{qp, constraints}, qp, constraints, p.A, p.x);
    // Of a point that is not special, to more digits than the error.
    constrained_energy_certificate certificate(qp, constraints);
    VectorXd const x =
        slant::project(qp.set(), VectorXd(p.x + 1e-5 * length * VectorXd::Ones(p.n)));
    double const error = error_of(p.A, constraints.unit_rows(), x, p.x);
    CHECK(certificate(x).bound == doctest::Approx(error).epsilon(1e-3));
  }
}

TEST_CASE("rows that depend on others, a semidefinite A, loads that bounds absorb") {
  known_problem const p(1, 21);
  MatrixXd rows(7, p.n);
  rows << p.G, 1e3 * p.G.row(1) - p.G.row(4), p.G.row(0);
  VectorXd e(7);
  e << p.e, 1e3 * p.e[1] - p.e[4], p.e[0];
  slant::equality_constraints const redundant(sparse(rows.sparseView()), e);
  auto const semidefinite = p.qp();
  check_verdict(slant::constrained_newton{semidefinite, redundant}, semidefinite, redundant, p.A,
                p.x);
  check_verdict(slant::smalse{semidefinite, redundant}, semidefinite, redundant, p.A, p.x);
  known_problem absorbed;
  absorbed.b[4] -= 1e6;
  absorbed.b[6] -= 1e5;
  auto const qp = absorbed.qp();
  auto const constraints = absorbed.constraints();
  check_verdict(slant::constrained_newton{qp, constraints}, qp, constraints, absorbed.A,
                absorbed.x);
}

TEST_CASE("where the space meets the set at a small angle, the reduced gradient says little") {
  for (double const θ : {0.3, 1e-2, 1e-4}) {
    CAPTURE(θ);
    test::wedge const w(θ);
    auto const qp = w.qp();
    VectorXd const solution{{1.0, 0.0}};
    check_verdict(slant::constrained_newton{qp, w.constraints}, qp, w.constraints, w.A, solution);
    constrained_energy_certificate certificate(qp, w.constraints);
    // On the face, at the distance 1e-6 θ from the space.
    CHECK(certificate(VectorXd{{1 + 1e-6, 0.0}}).bound == doctest::Approx(1e-6).epsilon(0.01));
    auto const slow =
        slant::solve(slant::smalse{qp, w.constraints}, VectorXd(VectorXd::Zero(2)),
                     slant::energy_error_below(1e-8, certificate) || slant::at_most(300));
    CHECK(slow.converged() == (θ == 0.3));
    CHECK((slow.converged() || (slow.x() - solution).norm() > 1e-2));
  }
}

TEST_CASE("as many equations as unknowns; a face that has lost what an equation depends on") {
  MatrixXd const root = test::random_matrix(4, 4, 5), A = root * root.transpose();
  MatrixXd const G = test::random_matrix(4, 4, 7);
  VectorXd const b = test::random_matrix(4, 1, 6), x{{1.0, 2.0, 0.5, 3.0}};
  slant::equality_constraints const all(sparse(G.sparseView()), VectorXd(G * x));
  auto const point = program(A, b, 4, 0);
  check_verdict(slant::constrained_newton{point, all}, point, all, A, x);

  // x₀ + x₁ = 1 in the quadrant; both are at their bounds where the gradient is that of x = 0.
  MatrixXd const unit = MatrixXd::Identity(2, 2);
  VectorXd const pushed{{-50.0, -100.0}};
  slant::equality_constraints const line(sparse(MatrixXd{{1.0, 1.0}}.sparseView()),
                                         VectorXd(VectorXd::Ones(1)));
  auto const corner = program(unit, pushed, 0, 2);
  constrained_energy_certificate certificate(corner, line);
  CHECK(certificate(VectorXd{{1.0, 0.0}}).bound <= 1e-15);
  CHECK(certificate(VectorXd{{0.0, 1.0}}).bound >= std::sqrt(2.0));
  CHECK(certificate(VectorXd{{0.0, 0.0}}).bound >= 1);

  // Newton's method meets such a face, and SMALSE-M takes over.
  known_problem p;
  p.G = MatrixXd::Zero(1, p.n);
  p.G(0, 4) = p.G(0, 6) = 1;
  p.e = VectorXd::Ones(1);
  p.b[4] = -100;
  p.b[6] = -50;
  p.A.row(4) = p.A.row(6) = VectorXd::Zero(p.n);
  p.A.col(4) = p.A.col(6) = VectorXd::Zero(p.n);
  p.A(4, 4) = p.A(6, 6) = 1;
  auto const qp = p.qp();
  auto const constraints = p.constraints();
  slant::constrained_newton const method{qp, constraints};
  VectorXd const x0 = VectorXd::Zero(p.n);
  auto const solved = slant::solve(method, x0, test::accurate(1e-13));
  check_verdict(method, qp, constraints, p.A, solved.x());
}

TEST_CASE("constraints that no point satisfies: nothing is claimed, however near they are") {
  for (double const gap : {1.0, 1e-4, 1e-9}) {
    CAPTURE(gap);
    known_problem p;
    p.G.row(0).setZero();
    p.G(0, 4) = p.G(0, 5) = 1;  // x₄ + x₅ < 0, both in half lines
    p.e[0] = -gap;
    auto const qp = p.qp();
    auto const constraints = p.constraints();
    constrained_energy_certificate certificate(qp, constraints);
    CHECK(std::isinf(certificate(p.x).bound));
    auto const r =
        slant::solve(slant::constrained_newton{qp, constraints}, VectorXd(VectorXd::Zero(p.n)),
                     slant::energy_error_below(1e-8, certificate) || slant::at_most(400));
    CHECK(!r.converged());
    CHECK(std::isinf(certificate(r.x()).relative()));
  }
}

TEST_CASE("an A that does not feel what x misses of G x = e: the distance counts") {
  // Two free components, A acts on the first, G on the second.
  MatrixXd const A{{1.0, 0.0}, {0.0, 0.0}};
  VectorXd const b{{1.0, 0.0}};
  slant::equality_constraints const constraints(sparse(MatrixXd{{0.0, 1.0}}.sparseView()),
                                                VectorXd(VectorXd::Ones(1)));
  auto const qp = program(A, b, 2, 0);
  constrained_energy_certificate certificate(qp, constraints);
  CHECK(certificate(VectorXd{{1.0, 1.0}}).relative() <= 1e-15);
  CHECK(certificate(VectorXd{{1.0, 1.001}}).relative() == doctest::Approx(7e-4).epsilon(0.02));
  CHECK(certificate(VectorXd{{1.001, 1.0}}).relative() == doctest::Approx(1e-3).epsilon(0.02));
  // Without a curvature along it there is no solution.
  MatrixXd const none = MatrixXd::Zero(2, 2);
  auto const falling = program(none, b, 2, 0);
  constrained_energy_certificate endless(falling, constraints);
  CHECK(std::isinf(endless(VectorXd{{1.0, 1.0}}).bound));
  double const nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isinf(certificate(VectorXd{{nan, 1.0}}).relative()));
}

TEST_CASE("with a preconditioner the same; nothing allocates") {
  std::mt19937 random(4);
  planted const p(8, 4, 4, 0, random);
  auto const qp = p.qp();
  slant::equality_constraints const constraints(p.G, p.e);
  MatrixXd inverse = p.A.inverse();
  inverse = (0.5 * (inverse + inverse.transpose())).eval();
  auto const M = spd(inverse);
  constrained_energy_certificate plain(qp, constraints);
  constrained_energy_certificate preconditioned(qp, constraints, M);
  VectorXd x = p.x;
  x(0) += 1e-6;
  auto const before = plain.applications();
  double const error = error_of(p.A, constraints.unit_rows(), x, p.x);
  CHECK(plain(x).bound == doctest::Approx(error).epsilon(0.1));
  slant::testing::allocation_guard guard;
  auto const e = preconditioned(x);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
  CHECK(e.bound == doctest::Approx(error).epsilon(0.1));
  CHECK(!e.proven);
  CHECK(plain.applications() - before <= 4 * p.x.size());
}

TEST_CASE("bad input") {
  known_problem const p;
  auto const qp = p.qp();
  auto const constraints = p.constraints();
  slant::equality_constraints const other(sparse(1, 3), VectorXd(VectorXd::Zero(1)));
  CHECK_THROWS_AS((constrained_energy_certificate{qp, other}), slant::bad_input);
  MatrixXd const three = MatrixXd::Identity(3, 3);
  auto const M = spd(three);
  CHECK_THROWS_AS((constrained_energy_certificate{qp, constraints, M}), slant::bad_input);
}

}  // namespace constrained_energy_certificate_test
