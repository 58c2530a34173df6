// SPDX-License-Identifier: MIT
//
// The laws of operators, convex sets, functions with a proximal map and slanting functions, as
// checks for doctest suites. What is sampled is described in the headers of breaches, which need no
// test framework.
#pragma once

#include <slant/testing/function_breaches.hpp>
#include <slant/testing/operator_breaches.hpp>
#include <slant/testing/set_breaches.hpp>
#include <slant/testing/slanting_breaches.hpp>

#include <doctest/doctest.h>

#include <vector>

namespace slant::testing {

namespace detail {

/// One doctest CHECK, with each broken law and the numbers that show it.
inline void expect_none(std::vector<breach> const& breaches) {
  auto const text = listed(breaches);
  CHECK_MESSAGE(text.empty(), "broken laws:\n", text);
}

}  // namespace detail

/// The laws of an operator: check_operator_laws(my_laplacian(100)). `prototype` is any vector of
/// the kind the operator works on; see operator_breaches.hpp.
template <class A, slant::vector V = Eigen::VectorXd>
  requires linear_operator<A, V>
void check_operator_laws(A const& a, V const& prototype = V(),
                         operator_law_options const& options = {}) {
  detail::expect_none(operator_breaches(a, prototype, options));
}
/// As above, for operators on Eigen::VectorXd.
template <class A>
  requires linear_operator<A, Eigen::VectorXd>
void check_operator_laws(A const& a, operator_law_options const& options) {
  detail::expect_none(operator_breaches(a, Eigen::VectorXd(), options));
}

/// Those of a conjugate projector besides, K Q = QᵀK Q = QᵀK.
template <class Q, class K, slant::vector V = Eigen::VectorXd>
  requires has_adjoint<Q, V> && linear_operator<Q, V> && linear_operator<K, V>
void check_conjugacy_laws(Q const& q, K const& k, V const& prototype = V(),
                          operator_law_options const& options = {}) {
  detail::expect_none(conjugacy_breaches(q, k, prototype, options));
}

/// The laws of a convex set. Arguments as for set_breaches: the set, a vector of the kind it takes
/// if that is no Eigen vector, options; see set_breaches.hpp.
template <class C, class... Rest>
void check_set_laws(C const& set, Rest const&... rest) {
  detail::expect_none(set_breaches(set, rest...));
}

/// The same for a function with a proximal map; see function_breaches.hpp.
template <class F>
void check_function_laws(F const& φ, set_options const& options = {}) {
  detail::expect_none(function_breaches(φ, options));
}

/// The laws of a slanting function at each of some points:
/// check_slanting_laws(my_function{…}, at_a_kink, somewhere_else). What is sampled, and what no
/// sample can see, is described in slanting_breaches.hpp. One doctest CHECK per point, with each
/// broken law and the numbers that show it.
template <class F, vector... V>
  requires(slanting_function<F, V> && ...)
void check_slanting_laws(F const& f, V const&... points) {
  auto const check = [&](auto const& y) {
    auto const text = listed(slanting_breaches(f, y));
    CHECK_MESSAGE(text.empty(), "broken at ", slant::local(y).transpose(), ":\n", text);
  };
  (check(points), ...);
}

}  // namespace slant::testing
