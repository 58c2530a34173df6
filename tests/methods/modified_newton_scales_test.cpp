// SPDX-License-Identifier: MIT
//
// MSSN, IMSSN, GIMSSN, QPQ and QPC do not know units.
#include "mixture.hpp"

#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/methods/mssn.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <utility>

namespace modified_newton_scales_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST_CASE("huge and tiny scales change nothing but the scale") {
  test::mixture const p(100);
  auto const check = [&](auto make) {
    auto const solve_in = [&](int stiffness, int length) {
      double const s = std::ldexp(1.0, stiffness), t = std::ldexp(1.0, length);
      MatrixXd const scaled = s * p.A;
      VectorXd const b = s * t * p.b, lower = t * p.lower, g = t * p.g;
      auto const A = test::spd(scaled);
      auto const set =
          slant::cartesian(slant::half_lines(lower), slant::discs(g), slant::free_components(6));
      auto r = slant::solve(make(slant::separable_qp{A, b, set}), VectorXd(VectorXd::Zero(20)),
                            slant::reduced_gradient_below(1e-5) || slant::at_most(2000));
      r.state.x /= t;
      return r;
    };
    auto const plain = solve_in(0, 0);
    REQUIRE(plain.converged());
    for (auto const& [stiffness, length] :
         {std::pair{400, 0}, {-400, 0}, {0, 400}, {0, -400}, {400, -400}, {-400, -400}}) {
      CAPTURE(stiffness);
      CAPTURE(length);
      auto const r = solve_in(stiffness, length);
      CHECK(r.status == plain.status);
      CHECK(r.state.work == plain.state.work);
      CHECK(r.x() == plain.x());
    }
  };
  check([](auto const& qp) { return slant::mssn(qp); });
  check([](auto const& qp) { return slant::imssn(qp); });
  check([](auto const& qp) { return slant::gimssn(qp); });
  check([](auto const& qp) { return slant::qpq(qp); });
  check([](auto const& qp) { return slant::qpc(qp); });
}

}  // namespace modified_newton_scales_test
