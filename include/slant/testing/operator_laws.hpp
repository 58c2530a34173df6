// SPDX-License-Identifier: MIT
//
// The laws of operators as a check for doctest suites:
//
//     TEST_CASE("my operator keeps its word") {
//       slant::testing::check_operator_laws(my_laplacian(100));
//     }
//
// What is sampled is described in operator_breaches.hpp.
#pragma once

#include <slant/testing/operator_breaches.hpp>

#include <doctest/doctest.h>

#include <string>

namespace slant::testing {

/// One doctest CHECK, with each broken law and the numbers that show it. `prototype` is any vector
/// of the kind the operator works on.
template <class A, slant::vector V = Eigen::VectorXd>
  requires linear_operator<A, V>
void check_operator_laws(A const& a, V const& prototype = V(),
                         operator_law_options const& options = {}) {
  std::string text;
  for (auto const& broken : operator_breaches(a, prototype, options)) {
    text += broken.law + " (" + broken.evidence + ")\n";
  }
  CHECK_MESSAGE(text.empty(), "broken laws:\n", text);
}

/// As above, for operators on Eigen::VectorXd.
template <class A>
  requires linear_operator<A, Eigen::VectorXd>
void check_operator_laws(A const& a, operator_law_options const& options) {
  slant::testing::check_operator_laws(a, Eigen::VectorXd(), options);
}

}  // namespace slant::testing
