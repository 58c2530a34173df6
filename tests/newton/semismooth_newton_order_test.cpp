// SPDX-License-Identifier: MIT
//
// Superlinear convergence with tight inner solves, in a precision that leaves room for it.
#include <slant/iteration/solve.hpp>
#include <slant/newton/semismooth_newton.hpp>

#include <newton/newton_scene.hpp>
#include <support/testing.hpp>

namespace semismooth_newton_order_test {

using real = long double;
using vector = Eigen::Matrix<real, Eigen::Dynamic, 1>;
using matrix = Eigen::Matrix<real, Eigen::Dynamic, Eigen::Dynamic>;

/// log(e_{k+1}/e_k) / log(e_k/e_{k-1}) over the last steps whose errors are above rounding level.
std::vector<double> orders(std::vector<real> const& e) {
  std::vector<double> p;
  for (std::size_t k = 2; k < e.size(); ++k) {
    p.push_back(double(std::log(e[k] / e[k - 1]) / std::log(e[k - 1] / e[k - 2])));
  }
  return p;
}

TEST_CASE("estimated order of the last steps above 1.5") {
  constexpr int m = 12;
  for (unsigned seed : {1U, 5U, 9U}) {
    newton_scene::data const d(m, seed);
    matrix const A = d.A.cast<real>();
    vector const b = d.b.cast<real>(), zero = vector::Zero(3 * m);
    auto const definite = slant::matrix<slant::self_adjoint, slant::positive_definite>(A);
    auto const set = newton_scene::contact_set<real>(m, 1e-2);
    auto const F = slant::natural_residual(definite, b, set, real(d.ρ));
    slant::semismooth_newton const method{F, slant::by_laws{}, slant::halving_line_search{},
                                          slant::fixed_forcing{.tolerance = 1e-15}};
    auto const solution =
        slant::solve(method, zero, slant::residual_below(1e-18L) || slant::at_most(60));
    REQUIRE(solution.state.residual_norm <= 1e-17L * solution.state.residual_scale);
    std::vector<real> errors;
    auto const record = [&](auto const& s) {
      real const error = (s.x - solution.x()).norm() / solution.x().norm();
      if (error > 1e-16L && error < 0.1L) errors.push_back(error);
    };
    static_cast<void>(slant::solve(method, zero, slant::at_most(60), record));
    CAPTURE(seed);
    auto const p = orders(errors);
    REQUIRE(p.size() >= 1);
    CHECK(p.back() > 1.5);
  }
}

}  // namespace semismooth_newton_order_test
