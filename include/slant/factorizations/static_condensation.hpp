// SPDX-License-Identifier: MIT
//
// Static condensation: one sparse factorisation of K with the contact unknowns near the end of the
// elimination, after which B K⁻¹Bᵀ, for a B that touches only those, needs a small part of the
// factors,
//
//     K = [ K_ii  K_it ]     B K⁻¹Bᵀ = B_t (L_tt L_ttᵀ)⁻¹ B_tᵀ,    K = L Lᵀ,
//         [ K_ti  K_tt ]
//
// t: the columns that contact unknowns reach in the elimination tree. With all contact unknowns
// last L_tt is the dense factor of the Schur complement K_tt − K_ti K_ii⁻¹K_it. Bodies without
// contact never enter, the interior of the others only where u is recovered.
//
//     slant::static_condensation factor(K, slant::contact::contact_unknowns(data));
//     slant::contact::dual problem(slant::contact::friction_disc{}, factor, data);
//
// It is a factorisation as others are, for whoever asks for no more than K⁻¹. Without SuiteSparse
// it is ldlt, and applications sweep over all of K; report() says so.
#pragma once

#include <slant/concepts/factorization.hpp>
#include <slant/factorizations/condensation_options.hpp>
#include <slant/factorizations/ldlt.hpp>
#include <slant/factorizations/parts/contact_ordering.hpp>
#include <slant/operators/inverse.hpp>
#include <slant/operators/product.hpp>
#if defined(SLANT_HAS_CHOLMOD) && SLANT_HAS_CHOLMOD
#include <slant/factorizations/parts/cholmod_condensation.hpp>
#endif

#include <concepts>
#include <string_view>
#include <type_traits>
#include <vector>

namespace slant {

/// K factored for applications of B K⁻¹Bᵀ. Copies share the factors, which never change. S: double
/// by CHOLMOD where SuiteSparse was found, else any scalar by ldlt.
template <class S = double>
class static_condensation {
#if defined(SLANT_HAS_CHOLMOD) && SLANT_HAS_CHOLMOD
  static constexpr bool condenses = std::is_same_v<S, double>;
  using factors = std::conditional_t<condenses, detail::cholmod_condensation<S>, ldlt<S>>;
#else
  static constexpr bool condenses = false;
  using factors = ldlt<S>;
#endif

 public:
  using scalar = S;
  static constexpr law_set laws = slant::laws<slant::self_adjoint, slant::positive_definite>;

  /// contact: the unknowns that a B will touch, in any order. Throws bad_input if one is out of
  /// range or there twice, for options out of range, and as ldlt does if K is not symmetric
  /// positive definite.
  template <class M>
  static_condensation(Eigen::SparseMatrixBase<M> const& k, std::vector<index> const& contact,
                      condensation_options const& options = {})
      : contact_(detail::contact_flags(contact, k.rows())),
        factors_(make(k.derived(), contact_, options)) {
    note(static_cast<index>(contact.size()));
  }
  /// The same for another matrix with the same unknowns, with the ordering of this one.
  template <class M>
  [[nodiscard]] static_condensation refactorized(Eigen::SparseMatrixBase<M> const& k) const {
    static_condensation result = *this;
    if constexpr (condenses) {
      result.factors_ = factors_.refactorized(k.derived());
    } else {
      slant::detail::check_size("rows of K", index(k.rows()), rows(), "as before,");
      result.factors_ = factors(k.derived());
    }
    result.note(report_.contact);
    return result;
  }

  [[nodiscard]] index rows() const { return factors_.rows(); }
  /// What computes: "cholmod" or "ldlt".
  [[nodiscard]] std::string_view name() const noexcept { return factors_.name(); }
  /// What was done, why, and at which cost.
  [[nodiscard]] condensation_report const& report() const& noexcept { return report_; }
  condensation_report const& report() const&& = delete;

  template <class X>
    requires factorization<factors, X>
  [[nodiscard]] auto workspace(X const& b) const {
    return factors_.workspace(b);
  }
  /// x = K⁻¹ b, by the whole factor.
  void solve(has_scalar<S> auto const& b, auto& x, auto& w) const { factors_.solve(b, x, w); }
  /// The same once, for those who will not solve again.
  template <class X, class Y>
    requires std::same_as<scalar_t<X>, S> && has_plain_solve<factors, X>
  void solve(X const& b, Y& x) const {
    factors_.solve(b, x);
  }

  /// B K⁻¹Bᵀ, self-adjoint and semidefinite, by the part of the factor that it needs; owns what it
  /// refers to. Throws bad_input if B has not rows() columns, or touches an unknown that is not in
  /// contact.
  template <class N>
  [[nodiscard]] auto restricted(Eigen::SparseMatrixBase<N> const& b) const {
    detail::require_touches_only(contact_, b.derived());
    if constexpr (condenses) {
      return factors_.restricted(b.derived());
    } else {
      return congruence(slant::matrix(Eigen::SparseMatrix<S>(b.derived())),
                        inverse(factors(factors_)));
    }
  }

 private:
  static factors make(auto const& k, std::vector<char> const& contact,
                      condensation_options const& options) {
    options.validate();
    if constexpr (condenses) {
      return factors(k, contact, options);
    } else {
      static_cast<void>(contact);
      return factors(k);
    }
  }

  void note(index contact) {
    if constexpr (condenses) {
      report_ = factors_.report();
    } else {
      report_.reason =
          "every application sweeps over the whole factor: CHOLMOD of SuiteSparse, which factors "
          "matrices of doubles many times faster and condenses them, is not there";
      report_.chosen.entries = static_cast<double>(factors_.nonzeros() + rows());
    }
    report_.factorization = name();
    report_.unknowns = rows();
    report_.contact = contact;
  }

  std::vector<char> contact_;
  factors factors_;
  condensation_report report_;
};

template <class M>
static_condensation(Eigen::SparseMatrixBase<M> const&, std::vector<index> const&,
                    condensation_options const& = {}) -> static_condensation<typename M::Scalar>;

}  // namespace slant
