// SPDX-License-Identifier: MIT
//
// Numbers with many digits, exact conversion to them, and the distance to an exact result in ulp.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>

#include <Eigen/Core>

#include <limits>

namespace oracle {

template <unsigned digits>
using binary_float = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<digits>,
                                                   boost::multiprecision::et_off>;

using float_50 = binary_float<50>;
using float_100 = binary_float<100>;

template <class Real, class S, int N>
Eigen::Matrix<Real, N, 1> widen(Eigen::Matrix<S, N, 1> const& x) {
  Eigen::Matrix<Real, N, 1> wide;
  for (int i = 0; i < N; ++i) wide(i) = Real(x(i));
  return wide;
}

/// |computed − exact| in units of the last place that a number of type S has at `exact`. Below
/// `smallest` (the smallest normal number of S, by default) the unit stays constant.
template <class S, class Real>
double ulp_distance(S const& computed, Real const& exact,
                    Real const& smallest = Real((std::numeric_limits<S>::min)())) {
  if (!(computed == computed)) return std::numeric_limits<double>::infinity();
  Real const size = exact < 0 ? Real(-exact) : exact;
  int e = 0;
  static_cast<void>(frexp(size > smallest ? size : smallest, &e));
  Real const ulp = ldexp(Real(1), e - std::numeric_limits<S>::digits);
  return static_cast<double>(abs(Real(computed) - exact) / ulp);
}

/// Largest ulp_distance of a component.
template <class S, int N, class Real>
double ulp_distance(Eigen::Matrix<S, N, 1> const& computed, Eigen::Matrix<Real, N, 1> const& exact,
                    Real const& smallest = Real((std::numeric_limits<S>::min)())) {
  double largest = 0;
  for (int i = 0; i < N; ++i) {
    double const distance = ulp_distance<S, Real>(computed(i), exact(i), smallest);
    if (!(distance <= largest)) largest = distance;
  }
  return largest;
}

}  // namespace oracle
