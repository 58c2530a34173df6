// SPDX-License-Identifier: MIT
//
// Methods do not know units, and what they call converged is the solution, wherever data and starts
// are in the range of double.
#include <slant/slant.hpp>

#include <support/minimise.hpp>
#include <support/testing.hpp>
#include "mixture.hpp"
#include "scales.hpp"

namespace scales_test {

/// make(program) is the method; far: up to which exponents the data stay in range.
template <class S, class Make>
void check(double tolerance, int far, Make const& make) {
  using vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
  test::mixture const p(100);
  auto const solve_in = [&](int stiffness, int length) {
    auto const s = std::ldexp(S(1), stiffness), t = std::ldexp(S(1), length);
    matrix const scaled = s * p.A.cast<S>();
    vector const b = s * t * p.b.cast<S>(), lower = t * p.lower.cast<S>(), g = t * p.g.cast<S>();
    auto const A = test::spd(scaled);
    auto const set =
        slant::cartesian(slant::half_lines(lower), slant::discs(g), slant::free_components<S>(6));
    auto r = test::minimise(make(slant::separable_qp{A, b, set}), vector(vector::Zero(20)),
                            S(tolerance), 2000);
    r.state.x /= t;
    return r;
  };
  test::check_scales(solve_in, far, far);
}

TEST_CASE_TEMPLATE("kprgp: huge and tiny scales change nothing but the scale", S, double, float) {
  // 1e±150 for double: nothing but the data themselves, A x and b, must be in range.
  constexpr int far = std::numeric_limits<S>::max_exponent / 2 - 14;
  check<S>(1e-5, far, [](auto const& qp) { return slant::kprgp(qp); });
}

TEST_CASE("so do the modified Newton methods, QPQ and QPC, and the symmetric Newton method") {
  check<double>(1e-5, 400, [](auto const& qp) { return slant::imssn(qp); });
  check<double>(1e-5, 400, [](auto const& qp) { return slant::gimssn(qp); });
  check<double>(1e-5, 400, [](auto const& qp) { return slant::qpq(qp); });
  check<double>(1e-5, 400, [](auto const& qp) { return slant::qpc(qp); });
  check<double>(1e-10, 498, [](auto const& qp) { return slant::symmetric_newton(qp); });
}

using slant::status;

/// f(report) of both methods from x0, over x ≥ 0.
template <class F>
void with_both(MatrixXd const& A, VectorXd const& b, VectorXd const& x0, F const& f) {
  auto const a = slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(A);
  auto const set = slant::half_lines<double>(b.size());
  slant::separable_qp const qp{a, b, set};
  auto const stop = slant::reduced_gradient_below(1e-8) || slant::at_most(300);
  f(slant::solve(slant::kprgp{qp}, x0, stop));
  f(slant::solve(slant::symmetric_newton{qp}, x0, stop));
}

TEST_CASE("A, b and starts of 1e-300 to 1e300: converged only at the solution, never unbounded") {
  MatrixXd const A{{2.0, 1.0}, {1.0, 2.0}};
  VectorXd const b{{1.0, -4.0}}, x{{0.5, 0.0}};
  int runs = 0, solved = 0;
  for (int of_A = -1000; of_A <= 1000; of_A += 250) {
    for (int of_b = -1000; of_b <= 1000; of_b += 250) {
      int const of_x = of_b - of_A;
      if (std::abs(of_x) > 1000) continue;
      for (int far : {-1, 0, 50, 500, 1000, 1500, 1900}) {
        if (of_x + far > 1000 || of_b + far > 1000) continue;
        CAPTURE(of_A);
        CAPTURE(of_b);
        CAPTURE(far);
        double const size = far < 0 ? 0 : std::ldexp(1.0, of_x + far);
        with_both(std::ldexp(1.0, of_A) * A, std::ldexp(1.0, of_b) * b, VectorXd::Constant(2, size),
                  [&](auto const& r) {
                    ++runs;
                    CAPTURE(r.reason);
                    CHECK(r.status != status::unbounded);
                    VectorXd const found = std::ldexp(1.0, -of_x) * r.x();
                    if (r.converged()) CHECK((found - x).norm() <= 1e-7);
                    // 1e±150 and all that comes of it.
                    int const most = std::max({std::abs(of_A), std::abs(of_b), std::abs(far)});
                    if (most <= 500) CHECK(r.converged());
                    solved += r.converged();
                  });
      }
    }
  }
  CHECK(solved >= 95 * runs / 100);
}

TEST_CASE("solutions below the smallest number: what KPRGP hands back is computed from x") {
  MatrixXd const A{
      {1.8125, -0.9375, 0.9375}, {-0.9375, 0.8125, -0.5625}, {0.9375, -0.5625, 0.8125}};
  VectorXd const b{{std::ldexp(1.0, -646), -std::ldexp(1.0, -968), 0.0}};
  with_both(std::ldexp(1.0, 426) * A, b, VectorXd::Zero(3), [&](auto const& r) {
    // The least step of x changes A x by a part of b: 6 units are not the solution.
    VectorXd const y = std::ldexp(1.0, 536) * (std::ldexp(1.0, 536) * r.x());
    VectorXd const g = A * y - std::ldexp(1.0, 646) * b;  // 426 + 646 = 1072
    VectorXd const reduced = (y.array() > 0).select(g, g.cwiseMin(0));
    if (r.converged()) CHECK(reduced.norm() <= 1e-7);
  });
}

}  // namespace scales_test
