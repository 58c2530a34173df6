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

namespace slant::testing {

/// One doctest CHECK, with each broken law and the numbers that show it. `prototype` is any vector
/// of the kind the operator works on.
template <class A, slant::vector V = Eigen::VectorXd>
  requires linear_operator<A, V>
void check_operator_laws(A const& a, V const& prototype = V(),
                         operator_law_options const& options = {}) {
  auto const text = listed(operator_breaches(a, prototype, options));
  CHECK_MESSAGE(text.empty(), "broken laws:\n", text);
}

/// As above, for operators on Eigen::VectorXd.
template <class A>
  requires linear_operator<A, Eigen::VectorXd>
void check_operator_laws(A const& a, operator_law_options const& options) {
  slant::testing::check_operator_laws(a, Eigen::VectorXd(), options);
}

// --- conjugacy laws ------------------------------------------------------------------------------
//
//     slant::testing::check_operator_laws(Q);      // Q² = Q, the adjoint
//     slant::testing::check_conjugacy_laws(Q, K);  // K Q = QᵀK Q = QᵀK

/// The same for a conjugate projector.
template <class Q, class K, slant::vector V = Eigen::VectorXd>
  requires has_adjoint<Q, V> && linear_operator<Q, V> && linear_operator<K, V>
void check_conjugacy_laws(Q const& q, K const& k, V const& prototype = V(),
                          operator_law_options const& options = {}) {
  auto const text = listed(conjugacy_breaches(q, k, prototype, options));
  CHECK_MESSAGE(text.empty(), "broken laws:\n", text);
}

}  // namespace slant::testing
