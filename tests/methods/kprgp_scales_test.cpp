// SPDX-License-Identifier: MIT
#include "mixture.hpp"
#include "scales.hpp"

#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <utility>

namespace kprgp_scales_test {

using test::mixture;

TEST_CASE_TEMPLATE("huge and tiny scales change nothing but the scale", S, double, float) {
  mixture const p(100);
  using vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> const M = p.A.cast<S>();
  auto const solve_in = [&](int stiffness, int length) {
    auto const s = std::ldexp(S(1), stiffness), t = std::ldexp(S(1), length);
    Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> const scaled = s * M;
    vector const b = s * t * p.b.cast<S>(), lower = t * p.lower.cast<S>(), g = t * p.g.cast<S>();
    auto const A = test::spd(scaled);
    auto const set =
        slant::cartesian(slant::half_lines(lower), slant::discs(g), slant::free_components<S>(6));
    auto const qp = slant::separable_qp{A, b, set};
    auto r = slant::solve(slant::kprgp{qp}, vector(vector::Zero(20)),
                          slant::reduced_gradient_below(S(1e-5)) || slant::at_most(2000));
    r.state.x /= t;
    return r;
  };
  // 1e±150 for double: nothing but the data themselves, A x and b, must be in range.
  constexpr int far = std::numeric_limits<S>::max_exponent / 2 - 14;
  test::check_scales(solve_in, far, far);
}

}  // namespace kprgp_scales_test
