// SPDX-License-Identifier: MIT
//
// The parameters of SSNM.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/newton/forcing.hpp>

namespace slant {

/// Where the multipliers of SSNM begin.
enum class ssnm_multipliers : unsigned char {
  zero,      ///< z = 0, whatever x is
  estimated  ///< those that x asks for, see estimated_multipliers
};

/// Options of ssnm.
template <class S>
struct ssnm_options {
  /// ρ > 0 of [T (2.8)], in units of A for half lines and intervals, of A over length for balls:
  /// the only place where the scale of A matters. [T] takes 1 with A = tridiag(−1, 2, −1).
  S rho = S(1);
  /// r_tol and c_fact of the adaptive precision [T §3.4]. Inner iterations of solvers that have any
  /// end where their residual is below tol⁽ᵏ⁾ times ‖F(y)‖.
  adaptive_precision precision{.r_tol = 0.01, .c_fact = 0.9};
  /// Not the adaptive precision but this tolerance in all steps; 0: the adaptive one.
  S inner_tolerance = S(0);
  /// tol⁽ᵏ⁾ is absolute, in units of F, as in [T]; it then depends on the units of A and b.
  bool absolute_precision = false;
  ssnm_multipliers multipliers = ssnm_multipliers::zero;

  /// Throws bad_input naming the option, its value and what was expected.
  [[gnu::cold]] void validate() const {
    if (!(rho > S(0)) || !detail::is_finite(rho)) {
      throw bad_input("rho", detail::show(rho), "a number > 0");
    }
    precision.validate();
    if (!(inner_tolerance >= S(0) && inner_tolerance < S(1))) {
      throw bad_input("inner_tolerance", detail::show(inner_tolerance), "a number in [0, 1)");
    }
  }
};

}  // namespace slant
