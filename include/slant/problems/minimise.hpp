// SPDX-License-Identifier: MIT
//
// Quadratic programs as they are written on paper:
//
//     auto const program = slant::minimise(slant::quadratic(A, b)).over(half_lines(n) * discs(g));
//     auto const run = slant::solve(program, 1e-8);
//
// is separable_qp{A, b, Λ}, the problem min ½ xᵀA x − bᵀx over x ∈ Λ, and
//
//     auto const program = slant::minimise(slant::quadratic(A, b) + slant::support(discs(g)));
//
// is separable_qp{A, b, φ}, the problem min ½ xᵀA x − bᵀx + Σ gᵢ‖xᵢ‖.
#pragma once

#include <slant/problems/separable_qp.hpp>

#include <utility>

namespace slant {

/// q(x) = ½ xᵀA x − bᵀx. A and V are `T const&` (referenced) or plain types (owned).
template <class A, class V>
struct quadratic_function {
  held<A> a;
  held<V> b;
};

/// q(x) = ½ xᵀA x − bᵀx. Lvalues are referenced.
template <class A, class V>
[[nodiscard]] auto quadratic(A&& a, V&& b) {
  return quadratic_function<kept_t<A>, kept_t<V>>{held<kept_t<A>>(std::forward<A>(a)),
                                                  held<kept_t<V>>(std::forward<V>(b))};
}

/// What is to be minimised, before it is said where.
template <class A, class V>
class minimisation {
 public:
  explicit minimisation(quadratic_function<A, V> q) : q_(std::move(q)) {}

  /// min q(x) over x ∈ Λ. A set passed as an lvalue is referenced.
  /// @throws bad_input if sizes differ or b has an entry that is not finite.
  template <class C>
  [[nodiscard]] auto over(C&& set) && {
    return separable_qp<A, V, kept_t<C>>(std::move(q_.a), std::move(q_.b),
                                         held<kept_t<C>>(std::forward<C>(set)));
  }

 private:
  quadratic_function<A, V> q_;
};

/// min q(x) over what follows: minimise(quadratic(A, b)).over(Λ).
template <class A, class V>
[[nodiscard]] minimisation<A, V> minimise(quadratic_function<A, V> q) {
  return minimisation<A, V>(std::move(q));
}

/// q + φ. A function passed as an lvalue is referenced.
template <class A, class V, class F>
struct composite_function {
  quadratic_function<A, V> q;
  held<F> φ;
};
template <class A, class V, class F>
  requires proximable<std::remove_cvref_t<F>, local_t<std::remove_cvref_t<V>>>
[[nodiscard]] auto operator+(quadratic_function<A, V> q, F&& φ) {
  return composite_function<A, V, kept_t<F>>{std::move(q), held<kept_t<F>>(std::forward<F>(φ))};
}

/// min q(x) + φ(x). @throws bad_input if sizes differ or b has an entry that is not finite.
template <class A, class V, class F>
[[nodiscard]] auto minimise(composite_function<A, V, F> f) {
  return separable_qp<A, V, F>(std::move(f.q.a), std::move(f.q.b), std::move(f.φ));
}

}  // namespace slant
