// SPDX-License-Identifier: MIT
//
// Contact with Tresca friction as one equation for displacements and multipliers [K (46)]:
//
//     G(u, λ) = ( K u + Bᵀλ − f ;  λ − P_Λ(λ + ρ (B u − c)) ) = 0,    B = [N; T],  c = (d, 0),
//
// λ = (λ_ν, λ_t), Λ = {λ_ν ≥ 0, ‖λ_t,i‖ ≤ gᵢ}. Its slanting operator follows by composition,
//
//     G°(u, λ) = [ K   Bᵀ ; −ρ P°B   I − P° ],    P° = P_Λ°(λ + ρ (B u − c))       [K after (53)]
//
// and is not symmetric: its Newton systems [K (54)] are for BiCGSTAB. With u = K⁻¹(f − Bᵀλ)
// eliminated, what remains is the natural residual of the dual problem (contact::dual).
#pragma once

#include <slant/contact/contact_data.hpp>
#include <slant/contact/friction_law.hpp>
#include <slant/operators/letter.hpp>
#include <slant/operators/restriction.hpp>
#include <slant/slanting/arithmetic.hpp>
#include <slant/slanting/projection.hpp>
#include <slant/slanting/stack.hpp>

#include <limits>
#include <utility>

namespace slant::contact {

/// The equation of a contact scene. Holds B, c and the set; refers to K if that is an lvalue. Not
/// movable: its function refers to it.
///
///     slant::contact::primal_dual problem(slant::contact::friction_disc{}, scene.K, data);
///     auto G = problem.function(ρ);
///     auto y = …;                                     // a zero of G
///     auto u = problem.displacement(y), λ = problem.multipliers(y);
template <class Friction, class K, class S>
class primal_dual {
 public:
  using vector_type = Eigen::VectorX<S>;
  using sparse_type = Eigen::SparseMatrix<S>;

  /// Throws bad_input if the data do not fit (see contact::data::validate) or K is not square.
  primal_dual(Friction friction, held<K> k, data<S> const& c)
      : K_(std::move(k)),
        minus_f_(-detail::validated(friction, c, index(K_.get().rows())).f),
        B_(detail::stacked_constraints(c)),
        set_(detail::feasible_set(friction, c)),
        minus_c_(vector_type::Zero(B_.rows())) {
    slant::detail::check_size("columns of K", index(K_.get().cols()), minus_f_.size(),
                              "the rows of K,");
    // An infinite gap never closes, whatever finite number stands for it: its row of B is empty.
    minus_c_.head(c.nodes()) = -c.d.cwiseMin(std::numeric_limits<S>::max());
  }
  primal_dual(primal_dual const&) = delete;
  primal_dual& operator=(primal_dual const&) = delete;

  /// G for this ρ, in units of forces per length: the mean of the diagonal of K, say. Refers to
  /// this object. Throws bad_input unless 0 < ρ < ∞.
  [[nodiscard]] auto function(S const& ρ) const& {
    if (!(ρ > S(0) && slant::detail::is_finite(ρ))) {
      throw bad_input("rho", slant::detail::show(ρ), "a finite number > 0");
    }
    index const n = minus_f_.size();
    index const p = B_.rows();
    auto const u = [&] { return linear(slice(n + p, 0, n)); };  // each to be owned twice
    auto const λ = [&] { return linear(slice(n + p, n, p)); };
    auto equilibrium = affine(K_.get(), minus_f_) * u() + linear(adjoint(B_)) * λ();
    auto trial = λ() + positive(ρ) * (affine(B_, minus_c_) * u());
    return stack(std::move(equilibrium), λ() - projection(set_) * std::move(trial));
  }
  auto function(S const& ρ) const&& = delete;

  /// The feasible set Λ.
  [[nodiscard]] auto const& set() const& { return set_; }
  auto const& set() const&& = delete;
  /// B = [N; T].
  [[nodiscard]] sparse_type const& constraints() const& { return B_; }
  sparse_type const& constraints() const&& = delete;
  /// (u, λ) = 0, the start that costs nothing.
  [[nodiscard]] vector_type zero() const {
    return vector_type::Zero(minus_f_.size() + minus_c_.size());
  }
  /// u of y = (u, λ).
  [[nodiscard]] vector_type displacement(vector_type const& y) const {
    slant::detail::check_size("y", y.size(), minus_f_.size() + minus_c_.size());
    return y.head(minus_f_.size());
  }
  /// λ of y = (u, λ).
  [[nodiscard]] vector_type multipliers(vector_type const& y) const {
    slant::detail::check_size("y", y.size(), minus_f_.size() + minus_c_.size());
    return y.tail(minus_c_.size());
  }

 private:
  held<K> K_;
  vector_type minus_f_;
  sparse_type B_;
  detail::feasible_set_t<Friction, S> set_;
  vector_type minus_c_;
};

template <class Friction, class K, class S>
primal_dual(Friction, K&&, data<S> const&) -> primal_dual<Friction, kept_t<K>, S>;

}  // namespace slant::contact
