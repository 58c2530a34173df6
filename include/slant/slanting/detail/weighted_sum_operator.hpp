// SPDX-License-Identifier: MIT
//
// diag(p) A + diag(q) B, the slanting operator of a function of two functions, componentwise. A
// writes the result, B a temporary (or nothing, if it is a slice), and one pass over both weighs
// and adds: as a sum of products with diagonal operators it would take two temporaries and four
// passes. Of a maximum or minimum each row is that of A or that of B, and the pass only copies the
// latter.
#pragma once

#include <slant/concepts/capabilities.hpp>
#include <slant/operators/detail/accumulate.hpp>

#include <utility>

namespace slant::detail {

/// `product` holds A x or B x, or p∘x or q∘x for the adjoint.
template <class First, class Second, class Vector>
struct weighted_sum_workspace {
  First first;
  Second second;
  Vector product;
};

/// y = p∘(A x) + q∘(B x). Refers to all four. With Chooses all pᵢ are 0 or 1, qᵢ = 1 − pᵢ, or both
/// are NaN.
template <bool Chooses, class P, class Q, class A, class B>
class weighted_sum_operator {
 public:
  static constexpr law_set laws{};

  weighted_sum_operator(P const& p, Q const& q, A const& a, B const& b)
      : p_(&p), q_(&q), a_(&a), b_(&b) {}

  [[nodiscard]] index rows() const { return a_->rows(); }
  [[nodiscard]] index cols() const { return a_->cols(); }

  template <class X>
    requires linear_operator<A, plain_t<X>> && linear_operator<B, plain_t<X>>
  [[nodiscard]] auto workspace(X const& x) const {
    return make_workspace(slant::workspace(*a_, x), slant::workspace(*b_, x),
                          slant::like(x, rows()));
  }
  template <class X, class Y, class W>
    requires applies<A, X, Y> && applies<B, X, plain_t<X>>
  void apply(X const& x, Y& y, W& w) const {
    slant::apply(*a_, x, y, w.first);
    auto& result = slant::local(y);
    auto const add = [&](auto const& product) {
      for (index j = 0; j < result.cols(); ++j) {
        if constexpr (Chooses) {
          choose(result.col(j), product.col(j));
        } else {
          result.col(j) = p().cwiseProduct(result.col(j)) + q().cwiseProduct(product.col(j));
        }
      }
    };
    if constexpr (shows_segment<B, X>) {
      add(b_->segment(x));
    } else {
      slant::apply(*b_, x, w.product, w.second);
      add(slant::local(w.product));
    }
  }
  template <class X, class Y, class W>
    requires applies<A, X, plain_t<X>> && applies<B, X, plain_t<X>>
  void apply_add(scalar_t<X> α, X const& x, Y& y, W& w) const {
    auto& result = slant::local(y);
    auto const& product = slant::local(w.product);
    auto const add = [&](auto const& weights) {
      for (index j = 0; j < result.cols(); ++j) {
        result.col(j) += α * weights.cwiseProduct(product.col(j));
      }
    };
    slant::apply(*a_, x, w.product, w.first);
    add(p());
    slant::apply(*b_, x, w.product, w.second);
    add(q());
  }

  template <class X>
    requires has_adjoint<A, plain_t<X>> && has_adjoint<B, plain_t<X>>
  [[nodiscard]] auto adjoint_workspace(X const& x) const {
    return make_workspace(slant::adjoint_workspace(*a_, x), accumulate_adjoint_workspace(*b_, x),
                          slant::like(x, rows()));
  }
  /// y = Aᵀ(p∘x) + Bᵀ(q∘x).
  template <class X, class Y, class W>
    requires applies_adjoint<A, plain_t<X>, Y> && adds_adjoint<B, plain_t<X>, Y>
  void apply_adjoint(X const& x, Y& y, W& w) const {
    weigh(p(), x, w.product);
    slant::apply_adjoint(*a_, w.product, y, w.first);
    weigh(q(), x, w.product);
    accumulate_adjoint(*b_, scalar_t<X>(1), w.product, y, w.second);
  }

 private:
  [[nodiscard]] decltype(auto) p() const { return slant::local(*p_); }
  [[nodiscard]] decltype(auto) q() const { return slant::local(*q_); }

  /// yᵢ = bᵢ where pᵢ = 0; NaN where pᵢ is.
  template <class Column, class B2>
  void choose(Column&& y, B2 const& b) const {
    using S = typename B2::Scalar;
    for (index i = 0; i < index(y.size()); ++i) {
      S const weight = p().coeff(i);
      if (!(weight > S(0))) y.coeffRef(i) = weight == S(0) ? b.coeff(i) : weight;
    }
  }

  template <class First, class Second, class Vector>
  static weighted_sum_workspace<First, Second, Vector> make_workspace(First first, Second second,
                                                                      Vector product) {
    return {std::move(first), std::move(second), std::move(product)};
  }
  template <class Weights, class X, class Z>
  static void weigh(Weights const& weights, X const& x, Z& z) {
    for (index j = 0; j < slant::local(x).cols(); ++j) {
      slant::local(z).col(j) = weights.cwiseProduct(slant::local(x).col(j));
    }
  }

  P const* p_;
  Q const* q_;
  A const* a_;
  B const* b_;
};

}  // namespace slant::detail
