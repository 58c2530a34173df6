// SPDX-License-Identifier: MIT
//
// Restriction to some of the components: R gathers, Rᵀ scatters, R Rᵀ = I.
//
//     auto R = slant::restriction(n, {1, 4, 5});     // y = (x₁, x₄, x₅)
//     auto A_FF = slant::restricted(A, free);        // R A Rᵀ, keeps definiteness
//     A_FF.assign(other);                            // no allocation up to the reserved capacity
#pragma once

#include <slant/base/sizes.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/capabilities.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/operators/composition.hpp>
#include <slant/operators/matrix.hpp>
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

  /// Throws bad_input unless the components are different numbers in [0, n). Room is reserved for
  /// n components, so that assign never allocates.
  restriction(index n, auto const& components) {
    if (n < 0) throw bad_input("n", detail::show(n), "a size >= 0");
    taken_.assign(static_cast<std::size_t>(n), 0);
    components_.reserve(taken_.size());
    assign(components);
  }
  restriction(index n, std::initializer_list<index> components)
      : restriction(n, std::vector<index>(components)) {}

  /// Replaces the components by those of a range of integers, without allocating. Throws bad_input
  /// unless they are different numbers in [0, cols()); the list is then as before.
  void assign(auto const& components) {
    require_valid(components);
    components_.clear();
    for (auto const& c : components) components_.push_back(static_cast<index>(c));
  }

  [[nodiscard]] index rows() const noexcept { return static_cast<index>(components_.size()); }
  [[nodiscard]] index cols() const noexcept { return static_cast<index>(taken_.size()); }
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
  void require_valid(auto const& components) {
    index position = 0, offender = 0;
    char const* expectation = nullptr;
    for (auto const& c : components) {
      offender = static_cast<index>(c);
      bool const exists = offender >= 0 && offender < cols();
      if (!exists || taken_[static_cast<std::size_t>(offender)] != 0) {
        expectation = exists ? "different components"
                             : "a component of the vector (>= 0 and less than its size)";
        break;
      }
      taken_[static_cast<std::size_t>(offender)] = 1;
      ++position;
    }
    index unmark = position;  // the marks are only needed while checking
    for (auto const& c : components) {
      if (unmark-- == 0) break;
      taken_[static_cast<std::size_t>(c)] = 0;
    }
    if (expectation != nullptr) {
      throw bad_input("components", detail::show(offender), expectation).at(position);
    }
  }

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

  std::vector<index> components_;
  std::vector<unsigned char> taken_;  // all zero between calls; its size is the full size
};

/// y = R A Rᵀ x: the congruence with R, whose components may change, and which knows its diagonal
/// and columns. A is `Operator const&` (referenced) or an operator type (owned).
template <class A>
class restricted_operator {
  using part = std::remove_cvref_t<A>;

  [[nodiscard]] auto congruence() const { return slant::congruence(r_, a_.get()); }

 public:
  static constexpr law_set laws = detail::restricted_laws(laws_of<A>);

  /// A is square of size r.cols(); slant::restricted checks it.
  restricted_operator(held<A> a, restriction r) : a_(std::move(a)), r_(std::move(r)) {}

  [[nodiscard]] index rows() const noexcept { return r_.rows(); }
  [[nodiscard]] index cols() const noexcept { return r_.rows(); }
  /// R.
  [[nodiscard]] restriction const& components() const noexcept { return r_; }
  /// Other components from now on; as restriction::assign. Workspaces stay valid.
  void assign(auto const& components) { r_.assign(components); }

  [[nodiscard]] auto workspace(detail::accepted_by<part> auto const& x) const {
    return congruence().workspace(x);
  }
  void apply(detail::accepted_by<part> auto const& x, auto& y, auto& w) const {
    congruence().apply(x, y, w);
  }
  template <detail::accepted_by<part> X, class Y, class W>
  void apply_add(scalar_t<X> α, X const& x, Y& y, W& w) const {
    congruence().apply_add(α, x, y, w);
  }

  [[nodiscard]] auto adjoint_workspace(detail::accepted_by_adjoint_of<part> auto const& x) const {
    return congruence().adjoint_workspace(x);
  }
  void apply_adjoint(detail::accepted_by_adjoint_of<part> auto const& x, auto& y, auto& w) const {
    congruence().apply_adjoint(x, y, w);
  }
  template <detail::accepted_by_adjoint_of<part> X, class Y, class W>
  void apply_adjoint_add(scalar_t<X> α, X const& x, Y& y, W& w) const {
    congruence().apply_adjoint_add(α, x, y, w);
  }

  template <class D>
    requires has_diagonal<part, plain_t<D>>
  void diagonal(D& d) const {
    auto full = slant::like(d, r_.cols());
    a_.get().diagonal(full);
    r_.apply(full, d);
  }
  template <class Y>
    requires has_columns<part, plain_t<Y>>
  void columns(index first, Y& y) const {
    plain_t<Y> full(r_.cols(), 1);
    for (index j = 0; j < y.cols(); ++j) {
      a_.get().columns(r_.component(first + j), full);
      auto column = y.middleCols(j, 1);
      r_.apply(full, column);
    }
  }

 private:
  held<A> a_;
  restriction r_;
};

/// R A Rᵀ for the given components. Throws bad_input if A is not square, or as restriction does.
template <operand A, class Components>
[[nodiscard]] auto restricted(A&& a, Components const& components) {
  held<part_t<A>> part{slant::as_operator(std::forward<A>(a))};
  detail::require_square("A", part.get());
  restriction r(part.get().rows(), components);
  return restricted_operator<part_t<A>>{std::move(part), std::move(r)};
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
