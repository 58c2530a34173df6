// SPDX-License-Identifier: MIT
//
// Sums and differences of squares of products, Σ ± (m v)², to about four times the digits of the
// format relative to the largest term: all products are split without error, and three sweeps of
// exact sums move the value to the last place before the rest is added (SumK with K = 4: Ogita,
// Rump, Oishi, "Accurate sum and dot product", SIAM J. Sci. Comput. 26, 2005).
#pragma once

#include <slant/sets/detail/double_word.hpp>

#include <array>
#include <cstddef>

namespace slant::detail {

/// At most N terms.
template <class S, int N>
class exact_squares {
 public:
  /// + (m v)².
  void add(S const& m, S const& v) { put(m, v, S(1)); }
  /// − (m v)².
  void subtract(S const& m, S const& v) { put(m, v, S(-1)); }

  /// Uses the terms up.
  [[nodiscard]] double_word<S> sum() {
    for (int sweep = 0; sweep < 3; ++sweep) {
      for (std::size_t i = 1; i < count_; ++i) {
        auto const s = exact_sum(terms_[i - 1], terms_[i]);
        terms_[i - 1] = s.lo;
        terms_[i] = s.hi;
      }
    }
    double_word<S> value;
    for (std::size_t i = 0; i < count_; ++i) value = value + double_word<S>(terms_[i]);
    return value;
  }

 private:
  void put(S const& m, S const& v, S const& sign) {
    auto const mm = exact_product(m, m);
    auto const vv = exact_product(v, v);
    for (S const& a : {mm.lo, mm.hi}) {
      for (S const& b : {vv.lo, vv.hi}) {
        auto const product = exact_product<S>(a, b);
        terms_[count_++] = sign * product.lo;
        terms_[count_++] = sign * product.hi;
      }
    }
  }

  std::array<S, 8 * N> terms_;
  std::size_t count_ = 0;
};

}  // namespace slant::detail
