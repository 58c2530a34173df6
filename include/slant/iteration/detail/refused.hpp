// SPDX-License-Identifier: MIT
//
// One mistake, one complaint. A method or a problem whose arguments lack something is another
// specialisation of its class template, which says so in a static_assert and accepts everything
// from there on: its members are declared and never defined, so whatever is done with it later,
// solve(…) included, adds no errors to the first.
//
// Rejected: constraints on the class alone. Its arguments are deduced, and of a failed deduction
// g++ 12 tells 40 to 55 lines about deduction guides around the one that matters; clang 16 leaves
// that one out.
#pragma once

#include <slant/concepts/linear_operator.hpp>
#include <slant/iteration/report.hpp>

#include <concepts>
#include <type_traits>

namespace slant::detail {

/// Base of everything that was refused.
struct refused {};

/// The complaint was made already.
template <class T> concept was_refused = std::derived_from<T, refused>;

/// Operator, vector, set or face of which nothing is asked. Nothing of it is defined.
struct beyond_question {
  static constexpr law_set laws{~0U};
  index rows() const;
  index cols() const;
  index size() const;
  void apply(auto const& x, auto& y) const;
  void apply_adjoint(auto const& x, auto& y) const;
  void solve(auto const& b, auto& x) const;
  void project(auto const& x, auto& y) const;
  bool contains(auto const& x) const;
  double step_to_boundary(auto const& x, auto const& d) const;
  void keep(auto const& x, auto& y) const;
};

/// The argument T if it is to be asked, else one that has every answer: what depends on an argument
/// that was refused already is not refused as well.
template <bool Asked, class T>
using asked_t = std::conditional_t<Asked, T, beyond_question>;

/// The scalar of V as a member; of what is no vector, double.
template <class V>
struct scalar_of {
  using scalar = double;
};
template <vector V>
struct scalar_of<V> {
  using scalar = scalar_t<V>;
};

/// What states have in common.
template <class X, class S>
struct common_state {
  X x;
  S residual_norm, residual_scale, reduced_gradient_norm, gradient_scale;
  index iteration;
  slant::status status;
  slant::work work;
};

/// A state for vectors V; if those are what was refused, for numbers.
template <class V>
struct refused_state : common_state<double, double> {};
template <vector V>
struct refused_state<V> : common_state<V, scalar_t<V>> {};

struct no_options {};

/// A method that was refused. State and Options, if given, are those it would have had.
template <class V, class State = refused_state<V>, class Options = no_options>
class refused_method : public refused {
 public:
  using state_type = std::conditional_t<vector<V>, State, refused_state<V>>;

  template <class... Arguments>
  explicit refused_method(Arguments const&...);
  template <class Problem>
  refused_method(Problem const&, Options const&);
  state_type start(auto const& x0) const;
  void step(state_type& s) const;
};

}  // namespace slant::detail
