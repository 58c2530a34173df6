// SPDX-License-Identifier: MIT
//
// Consecutive components of a vector: S gathers a segment, Sᵀ puts it back among zeros, S Sᵀ = I.
// For unknowns that come in blocks, y = (x, λ, μ). Other than with restriction(), no list of
// components is kept, and a product A S hands the segment to A without copying it.
#pragma once

#include <slant/concepts/capabilities.hpp>
#include <slant/concepts/vector_algebra.hpp>
#include <slant/operators/detail/checks.hpp>

#include <type_traits>

namespace slant {

/// y = (x_first, …, x_{first + count − 1}) of n components. Made by slant::slice.
class slice_operator {
 public:
  /// Throws bad_input unless first, count >= 0 and first + count <= n.
  slice_operator(index n, index first, index count) : n_(n), first_(first), count_(count) {
    if (n < 0) throw bad_input("n", detail::show(n), "a size >= 0");
    if (first < 0 || first > n) {
      throw bad_input("first", detail::show(first), "a number in [0, " + detail::show(n) + "]");
    }
    if (count < 0 || count > n - first) {
      throw bad_input("count", detail::show(count),
                      "a number in [0, " + detail::show(n - first) + "]");
    }
  }

  [[nodiscard]] index rows() const noexcept { return count_; }
  [[nodiscard]] index cols() const noexcept { return n_; }
  [[nodiscard]] index first() const noexcept { return first_; }

  /// The segment of x itself, a view; writable if x is.
  template <class X>
    requires has_local<std::remove_const_t<X>>
  [[nodiscard]] auto segment(X& x) const {
    return slant::local(x).middleRows(first_, count_);
  }

  template <has_local X, class Y>
  void apply(X const& x, Y& y) const {
    slant::local(y) = segment(x);
  }
  template <has_local X, class Y>
  void apply_add(scalar_t<X> α, X const& x, Y& y) const {
    slant::local(y) += α * segment(x);
  }
  template <has_local X, class Y>
  void apply_adjoint(X const& x, Y& y) const {
    vectors::set_zero(y);
    segment(y) = slant::local(x);
  }
  template <has_local X, class Y>
  void apply_adjoint_add(scalar_t<X> α, X const& x, Y& y) const {
    segment(y) += α * slant::local(x);
  }

 private:
  index n_;
  index first_;
  index count_;
};

/// `count` components of n from component `first` on. Throws bad_input unless they exist.
[[nodiscard]] inline slice_operator slice(index n, index first, index count) {
  return {n, first, count};
}

}  // namespace slant
