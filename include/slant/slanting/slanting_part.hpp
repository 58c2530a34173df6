// SPDX-License-Identifier: MIT
//
// What compositions of slanting functions ask of their parts, how they keep vectors and derivatives, and
// how functions are written.
//
// Lifetime, for all of slant/slanting. A composition references the functions, operators, sets and
// vectors that were passed as lvalues and owns those passed as rvalues: a part of type T is `T
// const&` in the first case, T in the second. An operator F°(y) owns what
// depends on y and refers to F for the rest (the matrix A of an affine part, say), so it must not
// outlive F: `auto G = (f + g).slant(y)` is a mistake, `auto F = f + g; auto G = F.slant(y)` is
// not.
#pragma once

#include <slant/base/held.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/member_names.hpp>
#include <slant/concepts/slanting_function.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/operators/text.hpp>

#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace slant {

/// A slanting function as far as can be known before the vectors are: what factories ask of their
/// arguments.
template <class F>
concept slanting_part =
    has_rows<std::remove_cvref_t<F>> && has_cols<std::remove_cvref_t<F>> &&
    has_value_member<std::remove_cvref_t<F>> && has_slant_member<std::remove_cvref_t<F>>;

}  // namespace slant

namespace slant::detail {

/// Vectors are kept like any part; expressions are evaluated, lest they refer to what is gone.
template <class C>
inline constexpr bool is_plain_vector =
    std::is_same_v<plain_t<std::remove_cvref_t<C>>, std::remove_cvref_t<C>>;

template <class C>
using kept_vector_t =
    std::conditional_t<is_plain_vector<C>, kept_t<C>, plain_t<std::remove_cvref_t<C>>>;

/// The vector itself, or the value of an expression.
template <class C>
[[nodiscard]] decltype(auto) plain_vector(C&& c) {
  if constexpr (is_plain_vector<C>) {
    return std::forward<C>(c);
  } else {
    return plain_t<std::remove_cvref_t<C>>(c);
  }
}

[[gnu::cold]] inline void require_equal_sizes(std::string_view name, index got, index expected,
                                              std::string_view what) {
  if (got != expected) {
    throw bad_input(name, std::to_string(got),
                    std::to_string(expected).append(" (").append(what).append(")"));
  }
}

/// Throws unless the vector called `name` has n finite entries.
template <class C>
void require_offset(std::string_view name, C const& c, index n) {
  require_equal_sizes(std::string(name).append(".size()"), slant::local(c).size(), n,
                      "the number of values");
  check_finite(name, c);
}

// --- derivative ----------------------------------------------------------------------------------
//
// Derivatives that come as Eigen matrices, wrapped without looking at their entries: a NaN that
// shows up in an iteration is not bad input, it is for the method to report.

/// The operator itself, or an operator with the asserted laws that owns the matrix.
template <law_set L, operand D>
[[nodiscard]] auto derivative_operator(D&& d) {
  if constexpr (eigen_matrix<D>) {
    using matrix_type = typename std::remove_cvref_t<D>::PlainObject;
    return matrix_operator<matrix_type, L>(held<matrix_type>(matrix_type(std::forward<D>(d))));
  } else {
    return std::remove_cvref_t<D>(std::forward<D>(d));
  }
}

/// What F(y) looks like.
struct written {
  std::string text{};
  bool is_sum = false;

  /// In parentheses where A F(y) would read as a sum or a difference.
  [[nodiscard]] std::string as_factor() const {
    return is_sum || text.starts_with("−") ? "(" + text + ")" : text;
  }
  /// + term, or its minus for a sign that is there.
  void append(written const& term, bool first) {
    std::string_view const minus = "−";
    if (first) {
      *this = term;
    } else if (term.text.starts_with(minus)) {
      text += " − " + term.text.substr(minus.size());
    } else {
      text += " + " + term.text;
    }
    is_sum = is_sum || !first;
  }
};

/// F(y) by the function's own write(y), else by its symbol or type.
template <class F>
[[nodiscard]] written write(F const& f, written const& y) {
  if constexpr (requires { f.write(y); }) {
    return f.write(y);
  } else {
    return {std::string(expr::symbol_of<F>()) + "(" + y.text + ")", false};
  }
}

}  // namespace slant::detail
