// SPDX-License-Identifier: MIT
//
// Dense LDLᵀ with diagonal pivoting by Eigen, for symmetric positive definite matrices.
//
// As in ldlt.hpp, K / 2^e is factored, so nothing depends on the units.
#pragma once

#include <slant/concepts/factorization.hpp>
#include <slant/factorizations/detail/spd_checks.hpp>

#include <Eigen/Cholesky>

#include <memory>
#include <numeric>
#include <string_view>
#include <utility>
#include <vector>

namespace slant {

/// P K Pᵀ = 2^e L D Lᵀ. Copies share the factors, which never change.
template <class S = double>
class dense_ldlt {
 public:
  using scalar = S;
  using matrix_type = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
  static constexpr law_set laws = slant::laws<slant::self_adjoint, slant::positive_definite>;

  /// Throws bad_input if K is not square, has an entry that is NaN or infinite, is not symmetric
  /// (up to 1024 ε, naming the worst pair), or not definite (naming the pivot).
  template <class M>
  explicit dense_ldlt(Eigen::MatrixBase<M> const& k) {
    matrix_type normalised = k;
    detail::require_symmetric_matrix("K", normalised);
    exponent_ = detail::scale_exponent(normalised);
    unit_ = detail::power_of_two<S>(-exponent_);
    normalised *= unit_;
    factor(normalised);
  }

  [[nodiscard]] index rows() const { return factors_->rows(); }
  /// What computes: "dense_ldlt".
  [[nodiscard]] std::string_view name() const noexcept { return "dense_ldlt"; }

  /// x = K⁻¹ b for one or several right-hand sides. Throws bad_input if b or x has not rows() rows.
  template <class X, class Y>
    requires std::same_as<scalar_t<X>, S>
  void solve(X const& b, Y& x) const {
    detail::check_solve(rows(), b, x);
    auto&& solution = slant::local(x);
    if (rows() == 0) return;
    solution = slant::local(b);
    // Row interchanges in place: Eigen's solve() would do the same into its destination.
    auto const& swaps = factors_->transpositionsP().indices();
    for (index i = 0; i < rows(); ++i) exchange(solution, i, index(swaps[i]));
    factors_->matrixL().solveInPlace(solution);
    auto const pivots = factors_->vectorD();
    for (index j = 0; j < solution.cols(); ++j) {
      for (index i = 0; i < rows(); ++i) solution(i, j) /= pivots.coeff(i);
    }
    factors_->matrixU().solveInPlace(solution);
    for (index i = rows(); i-- > 0;) exchange(solution, i, index(swaps[i]));
    solution *= unit_;
  }

 private:
  using factors_type = Eigen::LDLT<matrix_type, Eigen::Lower>;

  template <class X>
  static void exchange(X& x, index i, index k) {
    if (i != k) x.row(i).swap(x.row(k));
  }

  void factor(matrix_type const& k) {
    auto factors = std::make_shared<factors_type>(k.rows());
    if (k.rows() > 0) {
      factors->compute(k);
      std::vector<index> order(static_cast<std::size_t>(k.rows()));
      std::iota(order.begin(), order.end(), index{0});
      auto const& swaps = factors->transpositionsP().indices();
      auto const pivots = factors->vectorD();
      for (index i = 0; i < k.rows(); ++i) {
        index& row = order[static_cast<std::size_t>(i)];
        std::swap(row, order[static_cast<std::size_t>(swaps[i])]);
        detail::require_positive_pivot("K", k.rows(), i, row, S(pivots.coeff(i)), S(k(row, row)),
                                       exponent_);
      }
    }
    factors_ = std::move(factors);
  }

  int exponent_ = 0;
  S unit_{1};
  std::shared_ptr<factors_type const> factors_;
};

template <class M>
dense_ldlt(Eigen::MatrixBase<M> const&) -> dense_ldlt<typename M::Scalar>;

}  // namespace slant
