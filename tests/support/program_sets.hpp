// SPDX-License-Identifier: MIT
//
// The constraints of a random_program as a set of the library, of one type for all programs.
#pragma once

#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>
#include <slant/sets/ellipse.hpp>

#include <oracle/random_programs.hpp>

namespace test {

/// In the order of the unknowns of the program; parts may be empty. S: double or float.
template <class S = double>
[[nodiscard]] auto set_of(oracle::random_program const& p) {
  using vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  auto const rounded = [](Eigen::VectorXd const& v) { return vector(v.cast<S>()); };
  return slant::cartesian(
      slant::half_lines(rounded(p.lower)), slant::intervals(rounded(p.left), rounded(p.right)),
      slant::discs(rounded(p.radius)),
      slant::power(slant::ellipse<S>{}, rounded(p.first_axis), rounded(p.second_axis)),
      slant::friction_cones<3>(rounded(p.mu)), slant::free_components<S>(p.free_unknowns));
}

}  // namespace test
