// SPDX-License-Identifier: MIT
//
// Methods do not know units.
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

}  // namespace scales_test
