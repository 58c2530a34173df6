// SPDX-License-Identifier: MIT
//
// Operators that have a cheaper twin of lower precision.
//
// Intuition. An operator that is limited by the reading of its entries is applied in half the time
// if they are kept as floats. Inner iterations, whose result is a direction and not yet the
// solution, can work with that: whoever takes the step computes the residual with the operator
// itself.
//
// Minimal definition. rounded(): an operator of the same size, on the same vectors, with the same
// laws up to its precision. It owns what it needs; making it may take as long as an application.
//
// Law. ‖rounded(A) x − A x‖ is a few units of the lower precision times ‖A‖ ‖x‖, or times √κ(A)
// more where A is applied by its factors. Methods do not rely on it: they look at what comes out.
//
// Models. slant::condensed_operator<double>; slant::counted passes it on.
#pragma once

#include <slant/concepts/linear_operator.hpp>

namespace slant {

template <class A, class V>
concept has_rounded = requires(A const& a) {
  { a.rounded() } -> linear_operator<V>;
};

}  // namespace slant
