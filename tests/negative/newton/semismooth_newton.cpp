// SPDX-License-Identifier: MIT
// case NO_FORCING_RULE: semismooth_newton: a forcing rule takes a forcing_history to a tolerance
// case WITHOUT_NEXT_LENGTH: semismooth_newton: a globalisation has first_length, accepts and next_length
// case WITHOUT_PREPARE: semismooth_newton: the linear solver must have prepare and solve.*has_prepare
// case GIVEN_AN_OPERATOR: semismooth_newton: expected a slanting function.*has_value_member
// case GIVEN_AN_OPERATOR, max-lines-gcc: 20
// case GIVEN_AN_OPERATOR, max-lines-clang: 20
// max-lines-gcc: 30
// max-lines-clang: 30
//
// A tolerance in the place of a forcing rule; a client's globalisation minus what it does after a
// refusal; a client's solver minus the state that it works in. A matrix is not a function F: for
// A y = b there is affine(A, -b).
#include <slant/slant.hpp>

struct monotone {
  int first_length() const { return 1; }
  bool accepts(auto const& p) const { return p.residual < p.residual_before; }
#ifndef WITHOUT_NEXT_LENGTH
  double next_length(auto const&) const { return 0; }
#endif
};

struct picard {
#ifndef WITHOUT_PREPARE
  int prepare(auto const&, auto const&) const { return 0; }
#endif
  template <class V>
  slant::direction_report<double> solve(auto const&, V const& f,
                                        slant::direction_request<double> const& r, V& dy,
                                        int&) const {
    dy = -f;
    return {slant::status::converged, r.residual_norm / 2, 1, 0, 0};
  }
};

auto run(Eigen::MatrixXd const& A, Eigen::VectorXd const& b) {
#ifdef GIVEN_AN_OPERATOR
  auto const F = slant::matrix(A);
#else
  auto const F = slant::affine(A, -b);
#endif
#ifdef NO_FORCING_RULE
  double const rule = 1e-3;
#else
  auto const rule = slant::fixed_forcing{.tolerance = 1e-3};
#endif
  slant::semismooth_newton const method{F, picard{}, monotone{}, rule};
  return slant::solve(method, b, slant::residual_below(1e-10)).status;
}
