// SPDX-License-Identifier: MIT
//
// Operators as they are written on paper:
//
//     A + B,  A - B,  -A,  A * B,  2.0 * A,  A * 2.0,  A / 2.0,  adjoint(A),  inverse(A)
//     A * x                                                              see applied.hpp
//
// Found by argument-dependent lookup where one side is an operator of slant or an expression; the
// other side may be an operator from anywhere or an Eigen matrix, which become letters without a
// name. Two Eigen objects are Eigen's, a slanting function is slanting/arithmetic.hpp's.
#pragma once

#include <slant/concepts/slanting_function.hpp>
#include <slant/operators/declare.hpp>
#include <slant/operators/sum.hpp>

#include <ostream>
#include <string>

namespace slant {

/// An operator that is no Eigen object and no slanting function.
template <class A>
concept linear_term = expression<A> || (!eigen_matrix<A> && !slanting_map<A> && operand<A>);

namespace expr {

/// An Eigen matrix, not a column.
template <class A>
concept matrix_factor = eigen_matrix<A> && (std::remove_cvref_t<A>::ColsAtCompileTime != 1);

/// The two sides of + − *: at least one is ours.
template <class A, class B>
concept sides = (linear_term<A> && (linear_term<B> || matrix_factor<B>)) ||
                (matrix_factor<A> && linear_term<B>);

}  // namespace expr

/// A B. @throws bad_input if the sizes do not fit, a name stands for two objects, or a number in
/// front has not the sign that the laws need; so do the others.
template <class A, class B>
  requires expr::sides<A, B>
[[nodiscard]] auto operator*(A&& a, B&& b) {
  return expr::product_of(expr::as_expression(std::forward<A>(a)),
                          expr::as_expression(std::forward<B>(b)));
}
template <class A, class B>
  requires expr::sides<A, B>
[[nodiscard]] auto operator+(A&& a, B&& b) {
  return expr::sum_of(expr::as_expression(std::forward<A>(a)),
                      expr::as_expression(std::forward<B>(b)));
}
template <class A, class B>
  requires expr::sides<A, B>
[[nodiscard]] auto operator-(A&& a, B&& b) {
  return expr::sum_of(expr::as_expression(std::forward<A>(a)),
                      expr::negative_of(expr::as_expression(std::forward<B>(b))));
}
template <linear_term A>
[[nodiscard]] auto operator-(A&& a) {
  return expr::negative_of(expr::as_expression(std::forward<A>(a)));
}
template <linear_term A>
[[nodiscard]] auto operator+(A&& a) {
  return expr::as_expression(std::forward<A>(a));
}
template <class S, linear_term A>  // the operator is asked first: a number may not be complete yet
  requires expr::number_in_front<S>
[[nodiscard]] auto operator*(S const& c, A&& a) {
  return expr::multiple_of(expr::as_number(c), expr::as_expression(std::forward<A>(a)));
}
template <linear_term A, expr::number_in_front S>
[[nodiscard]] auto operator*(A&& a, S const& c) {
  return expr::multiple_of(expr::as_number(c), expr::as_expression(std::forward<A>(a)));
}
template <linear_term A, expr::number_in_front S>
[[nodiscard]] auto operator/(A&& a, S const& c) {
  return expr::multiple_of(expr::reciprocal_number(expr::as_number(c)),
                           expr::as_expression(std::forward<A>(a)));
}

/// Asserts that the columns of B are linearly independent.
/// @throws bad_input if there are more columns than rows.
template <adjoint_operand B>
  requires(expr::is_letter<std::remove_cvref_t<B>>)
[[nodiscard]] auto full_column_rank(B&& b) {
  if (b.cols() > b.rows()) {
    throw bad_input("B", detail::show(b.rows()) + " x " + detail::show(b.cols()),
                    "at most as many columns as rows");
  }
  return full_row_rank(b.adjoint()).adjoint();
}

/// The expression as one letter, which is not taken apart any more.
template <expression A>
[[nodiscard]] auto verbatim(A a) {
  return expr::make_letter<expr::nameless{}>(std::move(a));
}

/// The formula alone: B K⁻¹ Bᵀ + 0.001 I; of what is no formula its kind: block_operator.
template <linear_term A>
[[nodiscard]] std::string to_string(A const& a) {
  if constexpr (expr::decorates<A>) {
    return slant::to_string(a.get());
  } else {
    std::string out;
    expr::print_part(a, out);
    return out;
  }
}

/// B K⁻¹ Bᵀ + 0.001 I   (600 × 600, spd)
template <linear_term A>
std::ostream& operator<<(std::ostream& out, A const& a) {
  return out << slant::to_string(a) << "   (" << a.rows() << " × " << a.cols() << ", "
             << expr::laws_text(laws_of<A>) << ")";
}

}  // namespace slant
