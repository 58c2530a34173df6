// SPDX-License-Identifier: MIT
//
// The symmetric form of a generalised Newton system (I − G (I − ρA)) dx = −F; derivation in
// symmetrizable, below:
//
//     H s = G (ρA − I) F,     H = G (I − G) + ρ G A G,     dx = G s − F.
#pragma once

#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/capabilities.hpp>
#include <slant/operators/identity.hpp>
#include <slant/slanting/arithmetic.hpp>
#include <slant/slanting/composition.hpp>

#include <type_traits>
#include <utility>

namespace slant {

// --- symmetrizable -------------------------------------------------------------------------------
//
// Which generalised Newton operators can be symmetrised: M = I − G (I − ρ A) with G self-adjoint,
// 0 ⪯ G ⪯ I, A self-adjoint positive definite, ρ > 0. Known from the types alone: the chain rule
// has assembled M out of parts that carry their laws.
//
// Why it can be. M dx = −F says dx = −F + G s with s = (I − ρA) dx. Insert dx, multiply by G:
//
//     H s = −G (I − ρA) F,      H = G (I − G) + ρ G A G.
//
// H is self-adjoint and semidefinite, definite on range(G), where the right-hand side lies. On that
// range H = G [G⁻¹ − I + ρA] G: the shift (G⁻¹ − I)/ρ of A is the curvature of the set's boundary.
// So conjugate gradients solve the Newton system, with one product by A each and no BiCGSTAB.

namespace detail {

template <class M>
struct newton_parts {
  static constexpr bool known = false;
};

/// I − G (I − ρ A), ρ known to be positive.
template <class G, class A, class S>
struct newton_parts<
    expr::sum<identity_operator,
              expr::product<expr::minus_one, G,
                            expr::sum<identity_operator,
                                      expr::product<expr::number<S, expr::sign::minus>, A>>>>> {
  static constexpr bool known = true;
  using slant_type = G;
  using operator_type = A;

  template <class M>
  static auto const& slant_part(M const& m) {
    return m.template term<1>().template factor<0>();
  }
  /// −ρ A.
  template <class M>
  static auto const& scaled_part(M const& m) {
    return m.template term<1>().template factor<1>().template term<1>();
  }
};

template <class M> concept newton_operator = newton_parts<M>::known;

template <newton_operator M>
using slant_part_t = typename newton_parts<M>::slant_type;
template <newton_operator M>
using matrix_part_t = typename newton_parts<M>::operator_type;

}  // namespace detail

/// An operator I − G (I − ρ A) whose parts promise what the top of this file asks for.
template <class M>
concept symmetrizable =
    detail::newton_operator<std::remove_cvref_t<M>> &&
    declares_self_adjoint<detail::slant_part_t<std::remove_cvref_t<M>>> &&
    declares_firmly_nonexpansive<detail::slant_part_t<std::remove_cvref_t<M>>> &&
    declares_self_adjoint<detail::matrix_part_t<std::remove_cvref_t<M>>> &&
    declares_positive_definite<detail::matrix_part_t<std::remove_cvref_t<M>>>;

/// G of I − G (I − ρ A).
template <symmetrizable M>
[[nodiscard]] auto const& slant_of_projection(M const& m) {
  return detail::newton_parts<M>::slant_part(m);
}

/// ρ of I − G (I − ρ A).
template <symmetrizable M>
[[nodiscard]] auto step_length(M const& m) {
  auto const& minus_ρ = detail::newton_parts<M>::scaled_part(m).coefficient();
  return expr::value_as<decltype(minus_ρ.value)>(expr::negative_number(minus_ρ));
}

/// A of I − G (I − ρ A).
template <symmetrizable M>
[[nodiscard]] auto const& hessian(M const& m) {
  return detail::newton_parts<M>::scaled_part(m).template factor<0>();
}

namespace detail {

/// `first` and `second` are vectors, `slant` and `matrix` workspaces of G and A.
template <class Vector, class Slant, class Matrix>
struct symmetrized_workspace {
  Vector first;
  Vector second;
  Slant slant_part;
  Matrix matrix_part;
};
template <class Vector, class Slant, class Matrix>
symmetrized_workspace(Vector, Vector, Slant, Matrix)
    -> symmetrized_workspace<Vector, Slant, Matrix>;

}  // namespace detail

/// y = H x = G (x − G x + ρ A G x). M is `Operator const&` (referenced) or an operator type. Refers
/// to M as it is at each application, so it needs no renewal of its own.
template <class M>
class symmetrized_operator {
  using part = std::remove_cvref_t<M>;
  using g_type =
      std::remove_cvref_t<decltype(slant::slant_of_projection(std::declval<part const&>()))>;
  using a_type = std::remove_cvref_t<decltype(slant::hessian(std::declval<part const&>()))>;

 public:
  static constexpr law_set laws = slant::laws<slant::self_adjoint, slant::positive_semidefinite>;

  explicit symmetrized_operator(held<M> m) : m_(std::move(m)) {}

  [[nodiscard]] index rows() const { return m_.get().rows(); }
  [[nodiscard]] index cols() const { return m_.get().cols(); }

  template <class X>
    requires linear_operator<g_type, plain_t<X>> && linear_operator<a_type, plain_t<X>>
  [[nodiscard]] auto workspace(X const& x) const {
    return detail::symmetrized_workspace{slant::like(x, rows()), slant::like(x, rows()),
                                         slant::workspace(g(), x), slant::workspace(a(), x)};
  }
  /// One product by A, two by G.
  template <class X, class Y, class W>
    requires linear_operator<g_type, plain_t<X>> && linear_operator<a_type, plain_t<X>>
  void apply(X const& x, Y& y, W& w) const {
    slant::apply(g(), x, w.first, w.slant_part);
    slant::apply(a(), w.first, w.second, w.matrix_part);
    slant::local(w.first) =
        slant::local(x) - slant::local(w.first) + ρ<X>() * slant::local(w.second);
    slant::apply(g(), w.first, y, w.slant_part);
  }

  /// b = G (ρA − I) F, the right-hand side that belongs to the residual F. b must not alias F.
  template <class F, class B, class W>
  void right_hand_side(F const& residual, B& b, W& w) const {
    slant::apply(a(), residual, w.first, w.matrix_part);
    vectors::waxpby(ρ<F>(), w.first, scalar_t<F>(-1), residual, w.first);
    slant::apply(g(), w.first, b, w.slant_part);
  }
  /// dx = G s − F, the Newton step of a solution s of H s = b.
  template <class F, class S, class D, class W>
  void step(F const& residual, S const& s, D& dx, W& w) const {
    slant::apply(g(), s, dx, w.slant_part);
    vectors::subtract(residual, dx);
  }

 private:
  [[nodiscard]] g_type const& g() const { return slant::slant_of_projection(m_.get()); }
  [[nodiscard]] a_type const& a() const { return slant::hessian(m_.get()); }
  template <class X>
  [[nodiscard]] scalar_t<X> ρ() const {
    return static_cast<scalar_t<X>>(slant::step_length(m_.get()));
  }

  held<M> m_;
};

/// H of the operator M = I − G (I − ρA); an lvalue is referenced.
template <class M>
  requires symmetrizable<M>
[[nodiscard]] auto symmetrized(M&& m) {
  return symmetrized_operator<kept_t<M>>(std::forward<M>(m));
}

}  // namespace slant
