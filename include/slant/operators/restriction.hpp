// SPDX-License-Identifier: MIT
//
// Restriction to some of the components: R gathers, Rᵀ scatters, R Rᵀ = I.
//
//     auto R = slant::restriction(n, {1, 4, 5});     // y = (x₁, x₄, x₅)
//     auto A_FF = slant::restricted(A, free);        // R A Rᵀ, keeps definiteness
#pragma once

#include <slant/base/matrix_entries.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/capabilities.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/operators/product.hpp>

#include <cstddef>
#include <initializer_list>
#include <type_traits>
#include <utility>
#include <vector>

namespace slant {

/// y = R x: y_i = x_{c_i} for the components c.
class restriction {
 public:
  static constexpr bool full_row_rank = true;

  /// Throws bad_input unless the components are different numbers in [0, n).
  restriction(index n, auto const& components) : n_(n) {
    if (n < 0) throw bad_input("n", detail::show(n), "a size >= 0");
    std::vector<bool> taken(static_cast<std::size_t>(n), false);
    for (auto const& c : components) {
      auto const next = static_cast<index>(c);
      bool const exists = next >= 0 && next < n;
      if (!exists || taken[static_cast<std::size_t>(next)]) {
        throw bad_input("components", detail::show(next),
                        exists ? "different components"
                               : "a component of the vector (>= 0 and less than its size)")
            .at(rows());
      }
      taken[static_cast<std::size_t>(next)] = true;
      components_.push_back(next);
    }
  }
  restriction(index n, std::initializer_list<index> components)
      : restriction(n, std::vector<index>(components)) {}

  [[nodiscard]] index rows() const noexcept { return static_cast<index>(components_.size()); }
  [[nodiscard]] index cols() const noexcept { return n_; }
  [[nodiscard]] index component(index i) const { return components_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] std::vector<index> const& components() const noexcept { return components_; }

  void apply(has_local auto const& x, auto& y) const {
    each(x, y, [](auto const& from, auto& to) { to = from; });
  }
  template <has_local X, class Y>
  void apply_add(scalar_t<X> α, X const& x, Y& y) const {
    each(x, y, [&](auto const& from, auto& to) { to += α * from; });
  }
  void apply_adjoint(has_local auto const& x, auto& y) const {
    vectors::set_zero(y);
    each(y, x, [](auto& to, auto const& from) { to = from; });
  }
  template <has_local X, class Y>
  void apply_adjoint_add(scalar_t<X> α, X const& x, Y& y) const {
    each(y, x, [&](auto& to, auto const& from) { to += α * from; });
  }

 private:
  /// f(full component c_i, short component i) for all i and all right-hand sides.
  void each(auto& full, auto& shorter, auto f) const {
    auto&& a = slant::local(full);
    auto&& b = slant::local(shorter);
    for (index j = 0; j < a.cols(); ++j) {
      for (index i = 0; i < rows(); ++i) f(entry(a, component(i), j), entry(b, i, j));
    }
  }
  template <class M>
  static decltype(auto) entry(M& m, index i, index j) {
    if constexpr (std::is_const_v<M>) {
      return m.coeff(i, j);
    } else {
      return m.coeffRef(i, j);
    }
  }

  index n_;
  std::vector<index> components_;
};

/// R A Rᵀ for the given components: a congruence. Throws bad_input if A is not square, or as
/// restriction does.
template <operand A, class Components>
[[nodiscard]] auto restricted(A&& a, Components const& components) {
  detail::require_square("A", a);
  restriction r(a.rows(), components);
  return slant::congruence(std::move(r), std::forward<A>(a));
}
template <operand A>
[[nodiscard]] auto restricted(A&& a, std::initializer_list<index> components) {
  return slant::restricted<A, std::initializer_list<index>>(std::forward<A>(a), components);
}

// --- slice ---------------------------------------------------------------------------------------
//
// Consecutive components of a vector: S gathers a segment, Sᵀ puts it back among zeros, S Sᵀ = I.
// For unknowns that come in blocks, y = (x, λ, μ). Other than with restriction(), no list of
// components is kept, and a product A S hands the segment to A without copying it.

/// y = (x_first, …, x_{first + count − 1}) of n components. Made by slant::slice.
class slice_operator {
 public:
  static constexpr bool full_row_rank = true;

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

  void apply(has_local auto const& x, auto& y) const { slant::local(y) = segment(x); }
  template <has_local X, class Y>
  void apply_add(scalar_t<X> α, X const& x, Y& y) const {
    slant::local(y) += α * segment(x);
  }
  void apply_adjoint(has_local auto const& x, auto& y) const {
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
