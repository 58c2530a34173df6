// SPDX-License-Identifier: MIT
//
// Affine functions y ↦ A y + c and linear ones y ↦ A y, from any linear operator.
//
//     auto gradient = slant::affine(A, -b);     // ∇q(x) = A x − b
#pragma once

#include <slant/base/vector_algebra.hpp>
#include <slant/operators/identity.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/slanting/assembled_operator.hpp>
#include <slant/slanting/slanting_part.hpp>

#include <utility>

namespace slant {

/// F(y) = A y, F° = A. A is `Operator const&` (referenced) or an operator type (owned).
template <class A>
class linear_map : public slanting_base {
  using operator_type = std::remove_cvref_t<A>;
  using view = detail::operator_view<operator_type>;

 public:
  explicit linear_map(held<A> a) : a_(std::move(a)) {}

  [[nodiscard]] index rows() const { return a_.get().rows(); }
  [[nodiscard]] index cols() const { return a_.get().cols(); }
  /// A.
  [[nodiscard]] operator_type const& matrix() const noexcept { return a_.get(); }

  template <class Y>
  [[nodiscard]] auto workspace(Y const& y) const {
    return slant::workspace(a_.get(), y);
  }
  template <class Y, class V, class W>
    requires linear_operator<operator_type, plain_t<Y>>
  void value(Y const& y, V& v, W& w) const {
    slant::apply(a_.get(), y, v, w);
  }
  /// A itself, by reference: it lives as long as this function.
  template <class Y>
    requires linear_operator<operator_type, plain_t<Y>>
  [[nodiscard]] view slant(Y const&) const {
    return view(a_.get());
  }
  template <class Y>
  void slant(Y const&, view& g) const {
    g = view(a_.get());
  }

 private:
  held<A> a_;
};

/// F(y) = A y + c, F° = A. A and C are `T const&` (referenced) or plain types (owned).
template <class A, class C>
class affine_map : public slanting_base {
  using vector_type = std::remove_cvref_t<C>;

 public:
  affine_map(linear_map<A> a, held<C> c) : linear_(std::move(a)), c_(std::move(c)) {}

  [[nodiscard]] index rows() const { return linear_.rows(); }
  [[nodiscard]] index cols() const { return linear_.cols(); }
  /// A.
  [[nodiscard]] auto const& matrix() const noexcept { return linear_.matrix(); }
  /// c.
  [[nodiscard]] vector_type const& offset() const noexcept { return c_.get(); }

  template <class Y>
  [[nodiscard]] auto workspace(Y const& y) const {
    return linear_.workspace(y);
  }
  template <class Y, class V, class W>
    requires(has_workspace_value<linear_map<A>, plain_t<Y>> &&
             std::same_as<scalar_t<Y>, scalar_t<vector_type>>)
  void value(Y const& y, V& v, W& w) const {
    linear_.value(y, v, w);
    vectors::add(c_.get(), v);
  }
  template <class Y>
  [[nodiscard]] auto slant(Y const& y) const
    requires requires(linear_map<A> const& f) { f.slant(y); }
  {
    return linear_.slant(y);
  }
  template <class Y, class G>
  void slant(Y const& y, G& g) const {
    linear_.slant(y, g);
  }

 private:
  linear_map<A> linear_;
  held<C> c_;
};

/// y ↦ A y for an operator or an Eigen matrix; an lvalue A is referenced.
template <operand A>
[[nodiscard]] auto linear(A&& a) {
  return linear_map<part_t<A>>(held<part_t<A>>(slant::as_operator(std::forward<A>(a))));
}

/// y ↦ A y + c; lvalues are referenced, an expression such as −b is evaluated and owned.
/// @throws bad_input if c has not as many entries as A has rows, or an entry that is not finite.
template <operand A, class C>
  requires has_like<std::remove_cvref_t<C>>
[[nodiscard]] auto affine(A&& a, C&& c) {
  auto f = slant::linear(std::forward<A>(a));
  using kept = detail::kept_vector_t<C>;
  held<kept> offset{detail::plain_vector(std::forward<C>(c))};
  detail::require_offset("c", offset.get(), f.rows());
  return affine_map<part_t<A>, kept>(std::move(f), std::move(offset));
}

// --- identity ------------------------------------------------------------------------------------
//
// The identity y ↦ y as a slanting function.

/// F(y) = y on n unknowns, F° = I.
class identity_map : public slanting_base {
 public:
  /// @throws bad_input if n < 0.
  explicit identity_map(index n) : identity_(n) {}

  [[nodiscard]] index rows() const noexcept { return identity_.rows(); }
  [[nodiscard]] index cols() const noexcept { return identity_.cols(); }

  template <has_local Y, class V>
  void value(Y const& y, V& v) const {
    vectors::copy(y, v);
  }
  template <has_local Y>
  [[nodiscard]] identity_operator slant(Y const&) const {
    return identity_;
  }
  template <has_local Y>
  void slant(Y const&, identity_operator&) const {}

 private:
  identity_operator identity_;
};

}  // namespace slant
