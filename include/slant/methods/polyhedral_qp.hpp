// SPDX-License-Identifier: MIT
//
// The problem of the Schur complement contact algorithm [D (1)]:
//
//     minimise   j(u) = ½ uᵀK u − fᵀu   over   B u ≤ c,
//
// K symmetric positive semidefinite, with the conjugate projector of a U such that B U = 0 (what
// the paper writes Bᵀ is B here).
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/iteration/detail/part_to_blame.hpp>
#include <slant/iteration/detail/refused.hpp>
#include <slant/krylov/projected_directions.hpp>
#include <slant/methods/constraint_rows.hpp>
#include <slant/operators/held.hpp>

#include <utility>

namespace slant {

/// What polyhedral_qp asks of K, f and Q.
template <class K, class V, class Q>
concept polyhedral_qp_parts = vector<V> && psd_operator<K, V> && conjugate_projector_for<Q, V>;

/// Arguments that lack something end here and are told so; see iteration/detail/refused.hpp.
template <class K, class V, class R, class Q>
class polyhedral_qp : public detail::refused, public detail::scalar_of<std::remove_cvref_t<V>> {
  using asked = detail::questions_about<std::remove_cvref_t<K>, std::remove_cvref_t<V>>;
  static constexpr bool good_vector = vector<std::remove_cvref_t<V>>;

  static_assert(good_vector,
                "polyhedral_qp: f must be a slant::vector; an expression or a view is none");
  static_assert(linear_operator<typename asked::whole, typename asked::vector_type>,
                "polyhedral_qp: K must be a linear operator on vectors like f");
  static_assert(detail::usable_part<typename asked::part, typename asked::vector_type>,
                "polyhedral_qp: a part of K cannot be used on vectors like f");
  static_assert(psd_operator<typename asked::promise, typename asked::vector_type>,
                "polyhedral_qp: K must declare self_adjoint and positive_semidefinite");
  static_assert(
      !good_vector || conjugate_projector_for<std::remove_cvref_t<Q>, typename asked::vector_type>,
      "polyhedral_qp: Q must have add_minimiser(a, b, y, w), as a conjugate_projector has");

 public:
  using operator_type = std::remove_cvref_t<K>;
  using vector_type = std::remove_cvref_t<V>;
  using projector_type = std::remove_cvref_t<Q>;

  polyhedral_qp(held<K>, held<V>, held<R>, held<Q>);
};

/// polyhedral_qp{K, f, rows, Q}: rows a constraint_rows, Q a conjugate projector. Lvalues are
/// referenced, rvalues owned. Throws bad_input if sizes do not match or f is not finite.
template <class K, class V, class R, class Q>
  requires polyhedral_qp_parts<std::remove_cvref_t<K>, std::remove_cvref_t<V>,
                               std::remove_cvref_t<Q>>
class polyhedral_qp<K, V, R, Q> {
 public:
  using operator_type = std::remove_cvref_t<K>;
  using vector_type = std::remove_cvref_t<V>;
  using rows_type = std::remove_cvref_t<R>;
  using projector_type = std::remove_cvref_t<Q>;
  using scalar = scalar_t<vector_type>;

  polyhedral_qp(held<K> k, held<V> f, held<R> rows, held<Q> q)
      : k_(std::move(k)), f_(std::move(f)), rows_(std::move(rows)), q_(std::move(q)) {
    detail::check_size("K.rows()", index(this->k().rows()), size(), "the size of f,");
    detail::check_size("K.cols()", index(this->k().cols()), size(), "the size of f,");
    detail::check_size("columns of B", this->rows().unknowns(), size(), "the size of f,");
    detail::check_size("rows of the projector", index(projection().rows()), size(),
                       "the size of f,");
    detail::check_finite("f", this->f());
  }

  [[nodiscard]] operator_type const& k() const { return k_.get(); }
  [[nodiscard]] vector_type const& f() const { return f_.get(); }
  /// B and c.
  [[nodiscard]] rows_type const& rows() const { return rows_.get(); }
  /// Q.
  [[nodiscard]] projector_type const& projection() const { return q_.get(); }
  /// Number of unknowns n.
  [[nodiscard]] index size() const { return slant::local(f()).size(); }

 private:
  held<K> k_;
  held<V> f_;
  held<R> rows_;
  held<Q> q_;
};

template <class K, class V, class R, class Q>
polyhedral_qp(K&&, V&&, R&&, Q&&) -> polyhedral_qp<kept_t<K>, kept_t<V>, kept_t<R>, kept_t<Q>>;

/// What schur_contact works on.
template <class P>
concept polyhedral_program = requires(P const& p) {
  { p.k() } -> std::same_as<typename P::operator_type const&>;
  { p.f() } -> std::same_as<typename P::vector_type const&>;
  { p.rows() } -> std::same_as<constraint_rows<typename P::scalar> const&>;
  { p.projection() } -> std::same_as<typename P::projector_type const&>;
};

/// No problem at all.
template <class P>
class schur_contact : public detail::refused_method<Eigen::VectorXd> {
  static_assert(detail::was_refused<std::remove_cvref_t<P>> ||
                    polyhedral_program<std::remove_cvref_t<P>>,
                "schur_contact: the problem must be a polyhedral_qp{K, f, rows, Q}");

 public:
  using schur_contact::refused_method::refused_method;
};

}  // namespace slant
