// SPDX-License-Identifier: MIT
//
// Derivatives that come as Eigen matrices, wrapped without looking at their entries: a NaN that
// shows up in an iteration is not bad input, it is for the method to report.
#pragma once

#include <slant/operators/as_operator.hpp>

#include <type_traits>
#include <utility>

namespace slant::detail {

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

}  // namespace slant::detail
