// SPDX-License-Identifier: MIT
//
// Linear functions y ↦ A y, the identity, and functions shifted by a vector, y ↦ F(y) ± c:
//
//     auto gradient = slant::affine(A, -b);     // ∇q(x) = A x − b; in formulas A * x - b
#pragma once

#include <slant/base/vector_algebra.hpp>
#include <slant/operators/factors.hpp>
#include <slant/operators/identity.hpp>
#include <slant/operators/letter.hpp>
#include <slant/slanting/slanting_part.hpp>

#include <utility>

namespace slant {

/// F(y) = A y, F° = A. A is `Operator const&` (referenced) or an operator type (owned).
template <class A>
class linear_map : public slanting_base {
  using operator_type = std::remove_cvref_t<A>;
  /// A by reference; an expression is a handle already.
  using view = std::conditional_t<expression<operator_type>, operator_type,
                                  expr::letter<expr::nameless{}, operator_type, 0>>;

 public:
  explicit linear_map(held<A> a) : a_(std::move(a)) {}

  [[nodiscard]] index rows() const { return a_.get().rows(); }
  [[nodiscard]] index cols() const { return a_.get().cols(); }

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

  [[nodiscard]] detail::written write(detail::written const& y) const {
    std::string text;
    expr::print_part(a_.get(), text);
    if constexpr (expr::is_sum<operator_type>) text = "(" + text + ")";
    return {text + " " + y.as_factor(), false};
  }

 private:
  held<A> a_;
};

/// F(y) ± c. F and C are `T const&` (referenced) or plain types (owned).
template <class F, class C, bool Minus>
class shifted_map : public slanting_base {
  using function_type = std::remove_cvref_t<F>;
  using vector_type = std::remove_cvref_t<C>;

 public:
  /// c has as many entries as F has values.
  shifted_map(held<F> f, held<C> c) : f_(std::move(f)), c_(std::move(c)) {}

  [[nodiscard]] index rows() const { return f_.get().rows(); }
  [[nodiscard]] index cols() const { return f_.get().cols(); }
  /// F.
  [[nodiscard]] function_type const& function() const noexcept { return f_.get(); }
  /// c.
  [[nodiscard]] vector_type const& offset() const noexcept { return c_.get(); }

  template <class Y>
  [[nodiscard]] auto workspace(Y const& y) const {
    return slant::workspace(function(), y);
  }
  template <class Y, class V, class W>
    requires(slanting_function<function_type, plain_t<Y>> &&
             std::same_as<scalar_t<Y>, scalar_t<vector_type>>)
  void value(Y const& y, V& v, W& w) const {
    slant::evaluate(function(), y, v, w);
    if constexpr (Minus) {
      vectors::subtract(offset(), v);
    } else {
      vectors::add(offset(), v);
    }
  }
  template <class Y>
    requires slanting_function<function_type, plain_t<Y>>
  [[nodiscard]] auto slant(Y const& y) const {
    return function().slant(y);
  }
  template <class Y, class W>
    requires slanting_function<function_type, plain_t<Y>>
  [[nodiscard]] auto slant_from_value(Y const& y, W const& w) const {
    return slant::slant_from_value(function(), y, w);
  }
  template <class Y, class G, class W>
  void slant(Y const& y, G& g, W& w) const {
    slant::update_slant(function(), y, g, w);
  }
  template <class Y, class G, class W>
  void slant_after_value(Y const& y, G& g, W& w) const {
    slant::update_slant_after_value(function(), y, g, w);
  }

  [[nodiscard]] detail::written write(detail::written const& y) const {
    detail::written sum = detail::write(function(), y);
    sum.append({Minus ? "−c" : "c", false}, false);
    return sum;
  }

 private:
  held<F> f_;
  held<C> c_;
};

namespace detail {

/// y ↦ F(y) ± c; lvalues are referenced, an expression such as 2 b is evaluated and owned.
/// @throws bad_input if c has not as many entries as F has values, or one that is not finite.
template <bool Minus, class F, class C>
[[nodiscard]] auto shifted_by(F&& f, C&& c) {
  using kept = kept_vector_t<C>;
  held<kept> offset{plain_vector(std::forward<C>(c))};
  require_offset("c", offset.get(), f.rows());
  return shifted_map<kept_t<F>, kept, Minus>(held<kept_t<F>>(std::forward<F>(f)),
                                             std::move(offset));
}

}  // namespace detail

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
  return detail::shifted_by<false>(slant::linear(std::forward<A>(a)), std::forward<C>(c));
}

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

  [[nodiscard]] detail::written write(detail::written y) const { return y; }

 private:
  identity_operator identity_;
};

}  // namespace slant
