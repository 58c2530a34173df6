// SPDX-License-Identifier: MIT
//
// The problem that everything here is about [K (29)]:
//
//     minimise   q(x) = ½ xᵀA x − bᵀx   over   x ∈ Λ = Λ₁ × … × Λ_m,
//
// A symmetric positive semidefinite, often only an action; Λᵢ small closed convex sets.
// Gradient r(x) = A x − b. It is the case of an indicator of
//
//     minimise   q(x) + φ(x),      φ(x) = φ₁(x₁) + … + φ_m(x_m)
//
// with convex functions that have a proximal map (concepts/proximable.hpp): norms, friction.
#pragma once

#include <slant/base/diagnosis.hpp>
#include <slant/base/held.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/proximable.hpp>

#include <utility>

namespace slant {

/// What separable_qp asks of A, b and the set.
template <class A, class V, class C>
concept separable_qp_parts = vector<V> && linear_operator<A, V> && proximable<C, local_t<V>>;

namespace detail {

/// What has prox is meant as a function, all else as a set.
template <class F, class V>
struct term_demands {
  static_assert(convex_set<F, V>,
                "the set must be a convex set of vectors like b, or a function with prox");
  static constexpr bool told = true;
};
template <class F, class V>
  requires has_prox<F, V>
struct term_demands<F, V> {
  static_assert(proximable<F, V>, "the function must have dimension or size, prox and value");
  static constexpr bool told = true;
};

}  // namespace detail

/// Arguments that lack something end here and are told so; see
/// base/diagnosis.hpp.
template <class A, class V, class C>
class separable_qp : public detail::refused, public detail::scalar_of<std::remove_cvref_t<V>> {
 public:
  using operator_type = std::remove_cvref_t<A>;
  using vector_type = std::remove_cvref_t<V>;
  using set_type = std::remove_cvref_t<C>;

  static_assert(detail::vector_demands<vector_type>::told);
  static_assert(
      detail::operator_demands<operator_type, vector_type, detail::law_demand::none>::told);
  static_assert(
      detail::term_demands<detail::asked_t<vector<vector_type>, set_type>,
                           local_t<detail::asked_t<vector<vector_type>, vector_type>>>::told);

  separable_qp(held<A>, held<V>, held<C>);
  operator_type const& a() const;
  vector_type const& b() const;
  set_type const& set() const;
  index size() const;
};

/// A quadratic program with separable convex constraints: separable_qp{A, b, set}; or with a
/// separable convex function: separable_qp{A, b, φ}. Lvalues are referenced, rvalues owned. A is
/// n × n, b has n finite entries, set has dimension n; otherwise bad_input.
template <class A, class V, class C>
  requires separable_qp_parts<std::remove_cvref_t<A>, std::remove_cvref_t<V>,
                              std::remove_cvref_t<C>>
class separable_qp<A, V, C> {
 public:
  using operator_type = std::remove_cvref_t<A>;
  using vector_type = std::remove_cvref_t<V>;
  using set_type = std::remove_cvref_t<C>;
  using scalar = scalar_t<vector_type>;
  // What has prox is meant as a function.
  static constexpr bool is_set =
      convex_set<set_type, local_t<vector_type>> && !has_prox<set_type, local_t<vector_type>>;

  separable_qp(held<A> a, held<V> b, held<C> set)
      : a_(std::move(a)), b_(std::move(b)), set_(std::move(set)) {
    auto const n = index(slant::local(this->b()).size());
    detail::check_size("A.rows()", index(this->a().rows()), n, "the size of b,");
    detail::check_size("A.cols()", index(this->a().cols()), n, "the size of b,");
    detail::check_size(is_set ? "dimension of the set" : "dimension of the function",
                       slant::dimension_of(this->function()), n, "the size of b,");
    detail::check_finite("b", this->b());
  }

  /// The operator A.
  [[nodiscard]] operator_type const& a() const { return a_.get(); }
  /// The linear term b.
  [[nodiscard]] vector_type const& b() const { return b_.get(); }
  /// The feasible set Λ, if it is one.
  [[nodiscard]] set_type const& set() const
    requires is_set
  {
    return set_.get();
  }
  /// φ; of a set, the set.
  [[nodiscard]] set_type const& function() const { return set_.get(); }
  /// Number of unknowns n.
  [[nodiscard]] index size() const { return slant::local(b()).size(); }

 private:
  held<A> a_;
  held<V> b_;
  held<C> set_;
};

template <class A, class V, class C>
separable_qp(A&&, V&&, C&&) -> separable_qp<kept_t<A>, kept_t<V>, kept_t<C>>;

/// q(x) = ½ xᵀ(A x) − bᵀx = ½ xᵀ(r − b) from the gradient r = A x − b: no product is spent.
template <class QP, class V>
[[nodiscard]] auto energy(QP const& qp, V const& x, V const& r) {
  using S = scalar_t<V>;
  return S(inner_product(x, r) - inner_product(x, qp.b())) / S(2);
}

}  // namespace slant
