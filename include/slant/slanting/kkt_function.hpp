// SPDX-License-Identifier: MIT
//
// The optimality conditions of min ½xᵀA x − bᵀx over {x : f(x) ≤ 0} as one equation F(y) = 0 for
// the unknowns and their multipliers, y = (x, z) [T (2.10), (2.11)]:
//
//     F(y) = ( A x − b + Σ zᵢ ∇fᵢ(x) ;  z − max(0, z + ρ f(x)) )
//
// with bounds fᵢ = l − x₁ and circles fᵢ = x₂² + x₃² − g² in [T], z = (λ, μ); here with the smooth
// inequalities of any product of blocks. Its slanting operator [T (2.13)] follows by composition,
//
//     F°(y) = [ A + H   Jᵀ ; −ρ D(𝒜) J   D(ℐ) ],   H = Σ zᵢ ∇²fᵢ(x),   J = ∇f(x)ᵀ,
//
// 𝒜 = {i : zᵢ + ρ fᵢ(x) > 0}, ℐ the others.
//
// The second row is written as min(−ρ f(x), z): the same function, but z is not subtracted from
// itself, so nothing cancels where z is large; and ties are inactive, as in [T].
#pragma once

#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/operators/restriction.hpp>
#include <slant/slanting/arithmetic.hpp>
#include <slant/slanting/inequalities.hpp>
#include <slant/slanting/pairs.hpp>
#include <slant/slanting/stack.hpp>

#include <utility>

namespace slant {

/// F°(y) of kkt_function. Its parts are those of the generalised saddle-point system [T (3.1)].
template <class Composed, class S>
class kkt_operator;

template <class G>
inline constexpr bool is_kkt_operator = false;
template <class Composed, class S>
inline constexpr bool is_kkt_operator<kkt_operator<Composed, S>> = true;

namespace detail {

/// What a factory is handed again so that it keeps it alike: the reference, or a copy.
template <class T>
[[nodiscard]] T again(held<T> const& part) {
  return part.get();
}

/// F, made of A (or a reference), b and the set (or a reference).
template <class A, class V, class C, class S>
[[nodiscard]] auto compose_kkt(held<A> const& a, V const& b, held<C> const& set, S const& ρ) {
  auto constraints = slant::inequalities(again(set), S(-ρ));
  auto forces = slant::inequality_forces(again(set));
  auto c = slant::like(b, slant::local(b).size());
  vectors::negate(b, c);
  auto gradient = slant::affine(again(a), std::move(c));
  index const n = constraints.cols();
  index const p = constraints.rows();
  auto const x = [&] { return slant::linear(slant::slice(n + p, 0, n)); };  // to be owned twice
  auto z = slant::linear(slant::slice(n + p, n, p));
  auto equilibrium = slant::compose(std::move(gradient), x()) + std::move(forces);
  auto complementarity = slant::min(slant::compose(std::move(constraints), x()), std::move(z));
  return slant::stack(std::move(equilibrium), std::move(complementarity));
}

}  // namespace detail

/// What the composition made, with its parts by name.
template <class Composed, class S>
class kkt_operator : public Composed {
 public:
  kkt_operator(Composed composed, S ρ) : Composed(std::move(composed)), ρ_(std::move(ρ)) {}

  /// (H, Jᵀ), with jacobian() = J.
  [[nodiscard]] auto const& curvature() const noexcept {
    return this->template block<0, 0>().template term<1>();
  }
  /// J.
  [[nodiscard]] auto const& jacobian() const noexcept { return curvature().jacobian(); }
  /// 1 for the inequalities in 𝒜, 0 for those in ℐ.
  [[nodiscard]] auto const& active() const noexcept {
    return this->template block<1, 0>().first_weights();
  }
  /// A.
  [[nodiscard]] auto const& hessian() const noexcept {
    return expr::operator_behind(
        this->template block<0, 0>().template term<0>().template factor<0>());
  }
  /// The composition itself.
  [[nodiscard]] Composed& composed() noexcept { return *this; }
  /// ρ.
  [[nodiscard]] S const& rho() const noexcept { return ρ_; }

 private:
  S ρ_;
};

/// F of [T (2.11)] for A, b and a set made of blocks with smooth inequalities. Made by slant::kkt.
template <class A, class V, class C>
class kkt_function : public slanting_base {
  using scalar = scalar_t<V>;
  using composed =
      decltype(detail::compose_kkt(std::declval<held<A> const&>(), std::declval<V const&>(),
                                   std::declval<held<C> const&>(), scalar()));

 public:
  /// See slant::kkt.
  kkt_function(held<A> const& a, V const& b, held<C> const& set, scalar const& ρ)
      : f_(detail::compose_kkt(a, b, set, ρ)), unknowns_(a.get().rows()), ρ_(ρ) {}

  [[nodiscard]] index rows() const { return f_.rows(); }
  [[nodiscard]] index cols() const { return f_.cols(); }
  /// Number of components of x, the first ones of y.
  [[nodiscard]] index unknowns() const noexcept { return unknowns_; }
  /// Number of inequalities and multipliers.
  [[nodiscard]] index multipliers() const { return cols() - unknowns(); }
  [[nodiscard]] scalar const& rho() const noexcept { return ρ_; }

  template <class Y>
  [[nodiscard]] auto workspace(Y const& y) const {
    return slant::workspace(f_, y);
  }
  template <class Y, class F, class W>
    requires has_workspace_value<composed, plain_t<Y>>
  void value(Y const& y, F& f, W& w) const {
    f_.value(y, f, w);
  }
  template <class Y>
    requires slanting_function<composed, plain_t<Y>>
  [[nodiscard]] auto slant(Y const& y) const {
    return kkt_operator(f_.slant(y), ρ_);
  }
  template <class Y, class W>
    requires slanting_function<composed, plain_t<Y>>
  [[nodiscard]] auto slant_from_value(Y const& y, W const& w) const {
    return kkt_operator(slant::slant_from_value(f_, y, w), ρ_);
  }
  template <class Y, class G, class W>
  void slant(Y const& y, kkt_operator<G, scalar>& g, W& w) const {
    f_.slant(y, g.composed(), w);
  }
  template <class Y, class G, class W>
  void slant_after_value(Y const& y, kkt_operator<G, scalar>& g, W& w) const {
    f_.slant_after_value(y, g.composed(), w);
  }

 private:
  composed f_;
  index unknowns_;
  scalar ρ_;
};

/// F of [T (2.11)]: kkt(A, b, set, ρ). A is n × n (an operator or an Eigen matrix), b has n entries
/// and is copied, the set n components in blocks with smooth inequalities; [T] takes ρ = 1. Lvalues
/// A and set are referenced.
/// @throws bad_input if sizes differ, b has entries that are not finite, or not 0 < ρ < ∞.
template <operand A, class V, class C>
  requires vector<std::remove_cvref_t<V>>
[[nodiscard]] auto kkt(A&& a, V const& b, C&& set, scalar_t<V> const& ρ) {
  index const n = slant::dimension_of(set);
  detail::require_size("A", a, n, n, "the dimension of the set");
  detail::require_offset("b", b, n);
  detail::check_positive("rho", ρ);
  return kkt_function<part_t<A>, V, kept_t<C>>(
      held<part_t<A>>(slant::as_operator(std::forward<A>(a))), b,
      held<kept_t<C>>(std::forward<C>(set)), ρ);
}

}  // namespace slant
