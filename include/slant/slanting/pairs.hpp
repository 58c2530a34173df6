// SPDX-License-Identifier: MIT
//
// Functions of two slanting functions, componentwise: maximum, minimum and the Fischer–Burmeister
// function.
#pragma once

#include <slant/concepts/capabilities.hpp>
#include <slant/operators/composition.hpp>
#include <slant/operators/diagonal.hpp>
#include <slant/slanting/composition.hpp>
#include <slant/slanting/slanting_part.hpp>

#include <cmath>
#include <string>
#include <type_traits>
#include <utility>

namespace slant::detail {

// --- weighted sum operator -----------------------------------------------------------------------
//
// diag(p) A + diag(q) B, the slanting operator of a function of two functions, componentwise. A
// writes the result, B a temporary (or nothing, if it is a slice), and one pass over both weighs
// and adds: as a sum of products with diagonal operators it would take two temporaries and four
// passes. Of a maximum or minimum each row is that of A or that of B, and the pass only copies the
// latter.

/// `product` holds A x or B x, or p∘x or q∘x for the adjoint.
template <class First, class Second, class Vector>
struct weighted_sum_workspace {
  First first;
  Second second;
  Vector product;
};
template <class First, class Second, class Vector>
weighted_sum_workspace(First, Second, Vector) -> weighted_sum_workspace<First, Second, Vector>;

/// y = p∘(A x) + q∘(B x), p and q of type P. Owns all four, which can be renewed. With Chooses all pᵢ
/// are 0 or 1, qᵢ = 1 − pᵢ, or both are NaN.
template <bool Chooses, class P, class A, class B>
class weighted_sum_operator {
 public:
  static constexpr law_set laws{};

  weighted_sum_operator(P p, P q, A a, B b)
      : p_(std::move(p)), q_(std::move(q)), a_(std::move(a)), b_(std::move(b)) {}

  [[nodiscard]] index rows() const { return a_.rows(); }
  [[nodiscard]] index cols() const { return a_.cols(); }
  /// p, q, A and B, to be renewed.
  [[nodiscard]] P const& first_weights() const noexcept { return p_; }
  [[nodiscard]] P& first_weights() noexcept { return p_; }
  [[nodiscard]] P& second_weights() noexcept { return q_; }
  [[nodiscard]] A& first() noexcept { return a_; }
  [[nodiscard]] B& second() noexcept { return b_; }

  template <class X>
    requires linear_operator<A, plain_t<X>> && linear_operator<B, plain_t<X>>
  [[nodiscard]] auto workspace(X const& x) const {
    return weighted_sum_workspace{slant::workspace(a_, x), slant::workspace(b_, x),
                                  slant::like(x, rows())};
  }
  template <class X, class Y, class W>
    requires applies<A, X, Y> && applies<B, X, plain_t<X>>
  void apply(X const& x, Y& y, W& w) const {
    slant::apply(a_, x, y, w.first);
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
      add(b_.segment(x));
    } else {
      slant::apply(b_, x, w.product, w.second);
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
    slant::apply(a_, x, w.product, w.first);
    add(p());
    slant::apply(b_, x, w.product, w.second);
    add(q());
  }

  template <class X>
    requires has_adjoint<A, plain_t<X>> && has_adjoint<B, plain_t<X>>
  [[nodiscard]] auto adjoint_workspace(X const& x) const {
    return weighted_sum_workspace{slant::adjoint_workspace(a_, x),
                                  accumulate_workspace<true>(b_, x), slant::like(x, rows())};
  }
  /// y = Aᵀ(p∘x) + Bᵀ(q∘x).
  template <class X, class Y, class W>
    requires applies_adjoint<A, plain_t<X>, Y> && adds_adjoint<B, plain_t<X>, Y>
  void apply_adjoint(X const& x, Y& y, W& w) const {
    weigh(p(), x, w.product);
    slant::apply_adjoint(a_, w.product, y, w.first);
    weigh(q(), x, w.product);
    accumulate<true>(b_, scalar_t<X>(1), w.product, y, w.second);
  }

 private:
  [[nodiscard]] decltype(auto) p() const { return slant::local(p_); }
  [[nodiscard]] decltype(auto) q() const { return slant::local(q_); }

  /// yᵢ = bᵢ where pᵢ = 0; NaN where pᵢ is.
  template <class Column, class B2>
  void choose(Column&& y, B2 const& b) const {
    using S = typename B2::Scalar;
    for (index i = 0; i < index(y.size()); ++i) {
      S const weight = p().coeff(i);
      if (!(weight > S(0))) y.coeffRef(i) = weight == S(0) ? b.coeff(i) : weight;
    }
  }

  template <class Weights, class X, class Z>
  static void weigh(Weights const& weights, X const& x, Z& z) {
    for (index j = 0; j < slant::local(x).cols(); ++j) {
      slant::local(z).col(j) = weights.cwiseProduct(slant::local(x).col(j));
    }
  }

  P p_;
  P q_;
  A a_;
  B b_;
};

// --- pointwise pair ------------------------------------------------------------------------------
//
// Slanting functions of the form v_i = κ(F(y)_i, G(y)_i) with a function κ of two numbers. With the
// slopes p_i, q_i of κ in its two arguments
//
//     F̃°(y) = diag(p) F°(y) + diag(q) G°(y).

/// `f` and `g` hold F(y) and G(y).
template <class First, class Second, class Vector>
struct pointwise_pair_workspace {
  First first;
  Second second;
  Vector f;
  Vector g;
};
template <class First, class Second, class Vector>
pointwise_pair_workspace(First, Second, Vector, Vector)
    -> pointwise_pair_workspace<First, Second, Vector>;

/// κ is Kernel::value(a, b) → number and Kernel::slopes(a, b) → {p, q}; Kernel::chooses says that
/// the slopes are always (1, 0) or (0, 1), or NaN; Kernel::name is printed.
template <class Kernel, class F, class G>
class pointwise_pair : public slanting_base {
  using left_type = std::remove_cvref_t<F>;
  using right_type = std::remove_cvref_t<G>;
  template <class V>
  static constexpr bool usable =
      slanting_function<left_type, V> && slanting_function<right_type, V>;

 public:
  /// Throws bad_input if the numbers of values or of arguments differ.
  pointwise_pair(held<F> f, held<G> g) : f_(std::move(f)), g_(std::move(g)) {
    require_equal_sizes("g.rows()", right().rows(), left().rows(), "f.rows()");
    require_equal_sizes("g.cols()", right().cols(), left().cols(), "f.cols()");
  }

  [[nodiscard]] index rows() const { return left().rows(); }
  [[nodiscard]] index cols() const { return left().cols(); }
  [[nodiscard]] left_type const& left() const noexcept { return f_.get(); }
  [[nodiscard]] right_type const& right() const noexcept { return g_.get(); }

  template <class Y>
  [[nodiscard]] auto workspace(Y const& y) const {
    return pointwise_pair_workspace{slant::workspace(left(), y), slant::workspace(right(), y),
                                    slant::like(y, rows()), slant::like(y, rows())};
  }
  template <class Y, class V, class W>
    requires usable<plain_t<Y>>
  void value(Y const& y, V& v, W& w) const {
    evaluate_parts(y, w);
    slant::local(v) = slant::local(w.f).binaryExpr(
        slant::local(w.g), [](auto const& a, auto const& b) { return Kernel::value(a, b); });
  }
  template <class Y>
    requires usable<plain_t<Y>>
  [[nodiscard]] auto slant(Y const& y) const {
    auto w = workspace(y);
    evaluate_parts(y, w);
    return slant_from_value(y, w);
  }
  template <class Y, class W>
    requires usable<plain_t<Y>>
  [[nodiscard]] auto slant_from_value(Y const& y, W const& w) const {
    using first = slant_operator_t<left_type, Y>;
    using second = slant_operator_t<right_type, Y>;
    weighted_sum_operator<Kernel::chooses, plain_t<Y>, first, second> s(
        slant::like(y, rows()), slant::like(y, rows()), slant::slant_from_value(left(), y, w.first),
        slant::slant_from_value(right(), y, w.second));
    set_slopes(s, w);
    return s;
  }
  template <class Y, class S, class W>
  void slant(Y const& y, S& s, W& w) const {
    evaluate_parts(y, w);
    slant_after_value(y, s, w);
  }
  template <class Y, class S, class W>
  void slant_after_value(Y const& y, S& s, W& w) const {
    set_slopes(s, w);
    slant::update_slant_after_value(left(), y, s.first(), w.first);
    slant::update_slant_after_value(right(), y, s.second(), w.second);
  }

  [[nodiscard]] written write(written const& y) const {
    std::string const f = detail::write(left(), y).text, g = detail::write(right(), y).text;
    return {Kernel::name + ("(" + f) + ", " + g + ")", false};
  }

 private:
  template <class Y, class W>
  void evaluate_parts(Y const& y, W& w) const {
    slant::evaluate(left(), y, w.f, w.first);
    slant::evaluate(right(), y, w.g, w.second);
  }
  template <class S, class W>
  void set_slopes(S& s, W const& w) const {
    auto& p = slant::local(s.first_weights());
    auto& q = slant::local(s.second_weights());
    for (index i = 0; i < rows(); ++i) {
      auto const [at_f, at_g] = Kernel::slopes(slant::local(w.f)[i], slant::local(w.g)[i]);
      p[i] = at_f;
      q[i] = at_g;
    }
  }

  held<F> f_;
  held<G> g_;
};

}  // namespace slant::detail

namespace slant {

// --- max -----------------------------------------------------------------------------------------
//
// Kinks. max(0,·)° = 1 for y >= 0, else 0 [K (49)]. Everything else follows from
// max(F, G) = G + max(0, F − G): where F(y)_i = G(y)_i the row is that of F°.

namespace detail {

/// The larger of two numbers, or the smaller one; NaN if either is.
template <bool Larger>
struct extremum_kernel {
  static constexpr bool chooses = true;
  static constexpr char const* name = Larger ? "max" : "min";

  template <class S>
  [[nodiscard]] static S value(S const& a, S const& b) {
    if (a >= b) return Larger ? a : b;
    return a < b ? (Larger ? b : a) : S(a + b);
  }
  template <class S>
  [[nodiscard]] static std::pair<S, S> slopes(S const& a, S const& b) {
    S const here(Larger ? 1 : 0), there(Larger ? 0 : 1);
    if (a >= b) return {here, there};
    return a < b ? std::pair<S, S>(there, here) : std::pair<S, S>(S(a + b), S(a + b));
  }
};
using max_kernel = extremum_kernel<true>;
using min_kernel = extremum_kernel<false>;

/// diag(p), p a vector of zeros and ones.
template <class V>
using indicator = diagonal_operator<V, slant::laws<slant::self_adjoint, slant::projector>>;

}  // namespace detail

/// F(y) = max(0, y) componentwise on n unknowns; F°(y) is a diagonal projector [K (49)].
/// It is the projection onto y >= 0; with other bounds use projection(set).
class positive_part_map : public slanting_base {
 public:
  /// @throws bad_input if n < 0.
  explicit positive_part_map(index n) : n_(n) {
    if (n < 0) throw bad_input("n", std::to_string(n), "a size >= 0");
  }

  [[nodiscard]] index rows() const noexcept { return n_; }
  [[nodiscard]] index cols() const noexcept { return n_; }

  template <has_local Y, class V>
  void value(Y const& y, V& v) const {
    using S = scalar_t<Y>;
    slant::local(v) =
        slant::local(y).unaryExpr([](S const& a) { return detail::max_kernel::value(a, S(0)); });
  }
  template <has_local Y>
  [[nodiscard]] auto slant(Y const& y) const {
    detail::indicator<plain_t<Y>> g{held<plain_t<Y>>(slant::like(y, n_))};
    slant(y, g);
    return g;
  }
  template <has_local Y, class G>
  void slant(Y const& y, G& g) const {
    using S = scalar_t<Y>;
    g.entries() = slant::local(y).unaryExpr(
        [](S const& a) { return detail::max_kernel::slopes(a, S(0)).first; });
  }

  [[nodiscard]] detail::written write(detail::written const& y) const {
    return {"max(0, " + y.text + ")", false};
  }

 private:
  index n_;
};

/// y ↦ max(0, y) on n unknowns.
[[nodiscard]] inline positive_part_map positive_part(index n) {
  return positive_part_map(n);
}

/// y ↦ max(0, F(y)) componentwise. An lvalue is referenced.
template <slanting_part F>
[[nodiscard]] auto positive_part(F&& f) {
  auto const n = f.rows();
  return slant::compose(positive_part_map(n), std::forward<F>(f));
}

/// y ↦ max(F(y), G(y)) componentwise. Lvalues are referenced.
/// @throws bad_input if the sizes differ.
template <slanting_part F, slanting_part G>
[[nodiscard]] auto max(F&& f, G&& g) {
  return detail::pointwise_pair<detail::max_kernel, kept_t<F>, kept_t<G>>(std::forward<F>(f),
                                                                          std::forward<G>(g));
}

// --- min -----------------------------------------------------------------------------------------
//
// Componentwise minimum min(F(y), G(y)), the classical complementarity function: min(x, r) = 0
// means x >= 0, r >= 0, xᵀr = 0.
//
// Kinks. min(F, G) = F − max(0, F − G): where F(y)_i = G(y)_i the row is that of G°. So
// min(x, ρ r(x)) has the same slanting operator as the natural residual x − P₊(x − ρ r(x)).

/// y ↦ min(F(y), G(y)) componentwise. Lvalues are referenced.
/// @throws bad_input if the sizes differ.
template <slanting_part F, slanting_part G>
[[nodiscard]] auto min(F&& f, G&& g) {
  return detail::pointwise_pair<detail::min_kernel, kept_t<F>, kept_t<G>>(std::forward<F>(f),
                                                                          std::forward<G>(g));
}

// --- fischer burmeister --------------------------------------------------------------------------
//
// The Fischer–Burmeister function φ(a, b) = √(a² + b²) − a − b of two slanting functions,
// componentwise. φ(a, b) = 0 means a >= 0, b >= 0, a b = 0.
//
// Accuracy. Both √(a² + b²) − a − b and a/√(a² + b²) − 1 cancel where it matters, at b ≪ a. Neither
// is computed so: with the larger argument M, the other one m, t = m/M (|m| <= M if M > 0)
//
//     φ = −2m / (√(1+t²) + 1 + t),           ∂φ/∂M = −t² / (s (1 + s)),   s = √(1+t²),
//
// so value and slopes are within 4 ulp at any scale (subnormal results excepted), and nothing
// overflows that the result does not.
//
// Kink. φ° at (0, 0) is (√½ − 1, √½ − 1), the limit along a = b > 0: symmetric in a and b, and both
// slopes are negative, so F̃° is as regular as there.

namespace detail {

struct fischer_burmeister_kernel {
  static constexpr bool chooses = false;
  static constexpr char const* name = "φ_FB";

  template <class S>
  [[nodiscard]] static S value(S const& a, S const& b) {
    using std::sqrt;
    if (a == S(0) && b == S(0)) return S(0);
    S const& larger = a >= b ? a : b;
    S const& other = a >= b ? b : a;
    if (larger > S(0) && larger >= S(-other)) {
      S const t = other / larger;
      return S(-2) * (other / (sqrt(S(1) + t * t) + S(1) + t));
    }
    // a + b <= 0: with p = −other >= |larger| all terms of φ are sums of numbers >= 0.
    S const p = -other;
    S const t = larger / p;
    return p * (sqrt(S(1) + t * t) + (S(1) - t));
  }

  /// {∂φ/∂a, ∂φ/∂b}.
  template <class S>
  [[nodiscard]] static std::pair<S, S> slopes(S const& a, S const& b) {
    using std::abs;
    using std::sqrt;
    if (a == S(0) && b == S(0)) return {S(sqrt(S(0.5)) - S(1)), S(sqrt(S(0.5)) - S(1))};
    if (abs(a) >= abs(b)) {
      auto const [at_a, at_b] = ordered_slopes<S>(a, b);
      return {at_a, at_b};
    }
    auto const [at_b, at_a] = ordered_slopes<S>(b, a);
    return {at_a, at_b};
  }

 private:
  /// Slopes in (p, q) for |p| >= |q|, p ≠ 0, or with a NaN among them.
  template <class S>
  [[nodiscard]] static std::pair<S, S> ordered_slopes(S const& p, S const& q) {
    using std::abs;
    using std::sqrt;
    S const t = q / abs(p);
    S const s = sqrt(S(1) + t * t);
    S const at_p = p > S(0) ? S(-(t * t) / (s * (S(1) + s))) : S(-(S(1) + S(1) / s));
    return {at_p, S(t / s - S(1))};
  }
};

}  // namespace detail

/// y ↦ √(F(y)² + G(y)²) − F(y) − G(y) componentwise. Lvalues are referenced.
/// @throws bad_input if the sizes differ.
template <slanting_part F, slanting_part G>
[[nodiscard]] auto fischer_burmeister(F&& f, G&& g) {
  return detail::pointwise_pair<detail::fischer_burmeister_kernel, kept_t<F>, kept_t<G>>(
      std::forward<F>(f), std::forward<G>(g));
}

}  // namespace slant
