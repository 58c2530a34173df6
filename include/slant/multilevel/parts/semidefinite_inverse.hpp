// SPDX-License-Identifier: MIT
//
// The inverse of a small symmetric positive semidefinite matrix on the unknowns that it can tell
// apart, by the sweeps of Gauss and Jordan [Goodnight 1979]: unknown c with the pivot d = a_cc,
//
//     a_ij ← a_ij − a_ic a_cj / d,     a_ic ← a_ic / d,     a_cc ← −1/d,
//
// leaves −A⁻¹ in the end. An unknown whose pivot cannot be told from zero is left out: the result is
// the inverse of a principal submatrix and 0 in the other rows and columns. It is symmetric,
// semidefinite, and a generalised inverse of A.
#pragma once

#include <slant/concepts/scalar.hpp>

namespace slant::detail {

/// a (n × n, by columns, symmetric) becomes its inverse. Unknown c is left out unless its pivot
/// exceeds least[c] ≥ 0. Returns the least of pivot / scale[c], of those with scale[c] > 0.
template <int N, class S>
S invert_semidefinite(S* a, S const* least, S const* scale) {
  bool kept[N];
  S lowest(1);
  for (int c = 0; c < N; ++c) {
    S const d = a[c * N + c];
    if (scale[c] > S(0) && d < lowest * scale[c]) lowest = d / scale[c];
    kept[c] = d > least[c];
    if (!kept[c]) {
      for (int i = 0; i < N; ++i) a[c * N + i] = a[i * N + c] = S(0);
      continue;
    }
    S const inverse = S(1) / d;
    S column[N];
    for (int i = 0; i < N; ++i) column[i] = a[c * N + i];
    for (int j = 0; j < N; ++j) {
      S const factor = column[j] * inverse;
      for (int i = 0; i < N; ++i) a[j * N + i] -= column[i] * factor;
    }
    for (int i = 0; i < N; ++i) a[c * N + i] = a[i * N + c] = column[i] * inverse;
    a[c * N + c] = -inverse;
  }
  for (int k = 0; k < N * N; ++k) a[k] = -a[k];
  return lowest;
}

}  // namespace slant::detail
