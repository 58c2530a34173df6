// SPDX-License-Identifier: MIT
//
// Steps to the boundary of a set against bisection in 50 digits.
#pragma once

#include <doctest/doctest.h>
#include <Eigen/Core>

#include <limits>

#include "oracle/naive_projections.hpp"
#include "oracle/precise.hpp"

namespace oracle {

/// Error in ulp of set.step_to_boundary(x, d), for x of the size `size` and any d of the size 1;
/// member(z) says in 50 digits whether z is in the set. 0 if x is not.
template <class Set, class Member, int N>
double step_error(Set const& set, Member const& member, Eigen::Matrix<double, N, 1> const& x,
                  Eigen::Matrix<double, N, 1> const& d, double size) {
  using wide = Eigen::Matrix<float_50, N, 1>;
  wide const from = widen<float_50>(x), along = widen<float_50>(d);
  if (!member(from)) return 0;
  double const α = set.step_to_boundary(x, d);
  float_50 const unit(size);
  float_50 const exact =
      naive::exit_step<float_50>(member, from, wide(along * unit), float_50(1e40)) * unit;
  if (exact < 0) {  // for ever inside
    CHECK(α == std::numeric_limits<double>::infinity());
    return 0;
  }
  return ulp_distance<double>(α, exact);
}

}  // namespace oracle
