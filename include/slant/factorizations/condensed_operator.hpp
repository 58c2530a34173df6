// SPDX-License-Identifier: MIT
//
// B K⁻¹Bᵀ by the part of the factors of K that the rows of B reach (static_condensation.hpp),
//
//     y = u B_t L_tt⁻ᵀ L_tt⁻¹ B_tᵀ x,      u: the power of two by which K was scaled,
//
// by two sweeps with L_tt, or by one product with S⁻¹, the part of (L_tt L_ttᵀ)⁻¹ that belongs to
// the contact unknowns, where that was formed. Their entries have the precision T: rounded to float
// they are read in half the time, and good for the inner iterations of methods that compute their
// residuals with the exact ones; see concepts/slant/concepts/capabilities.hpp. B_t and x are of
// doubles either way, of any scale.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/laws.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/factorizations/parts/panel_kernels.hpp>
#include <slant/factorizations/parts/tail.hpp>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <memory>
#include <type_traits>
#include <utility>

namespace slant {

/// The operator at the top of this file; made by static_condensation::restricted. Copies share the
/// entries.
template <class T>
class condensed_operator {
  using sparse_type = Eigen::SparseMatrix<double>;
  using factor_type =
      std::conditional_t<std::is_same_v<T, double>, detail::tail_columns, detail::tail_panels<T>>;
  using inverse_type = detail::packed_symmetric<T>;

 public:
  static constexpr law_set laws = slant::laws<slant::self_adjoint, slant::positive_semidefinite>;

  /// b: n × (size of the factor); throws bad_input if it has another number of columns.
  condensed_operator(std::shared_ptr<sparse_type const> b,
                     std::shared_ptr<factor_type const> factor, double unit)
      : b_(std::move(b)), factor_(std::move(factor)), unit_(unit) {
    slant::detail::check_size("columns of B", b_->cols(), factor_->shape().size(),
                              "the size of the factor,");
  }
  /// b: n × (size of S⁻¹); throws bad_input if it has another number of columns.
  condensed_operator(std::shared_ptr<sparse_type const> b,
                     std::shared_ptr<inverse_type const> inverse, double unit)
      : b_(std::move(b)), inverse_(std::move(inverse)), unit_(unit) {
    slant::detail::check_size("columns of B", b_->cols(), inverse_->size(),
                              "the size of the inverse,");
  }

  [[nodiscard]] index rows() const { return b_->rows(); }
  [[nodiscard]] index cols() const { return b_->rows(); }
  /// Bytes that an application reads; what it reads twice counts twice.
  [[nodiscard]] index bytes() const { return inverse_ ? inverse_->bytes() : 2 * factor_->bytes(); }

  /// Bᵀx in both precisions, and the buffer of the sweeps or the products.
  struct workspace_type {
    Eigen::MatrixXd forces;
    detail::tail_vectors<T> tail;
  };
  [[nodiscard]] workspace_type workspace(has_scalar<double> auto const& x) const {
    index const columns = slant::local(x).cols();
    return {Eigen::MatrixXd(b_->cols(), columns), {b_->cols(), buffer_rows(), columns}};
  }
  /// y = B K⁻¹Bᵀx for one or several right-hand sides.
  void apply(has_scalar<double> auto const& x, auto& y, workspace_type& w) const {
    // One that was made for another matrix, of the same B, may have another buffer.
    index const columns = slant::local(x).cols();
    w.tail.x.resize(b_->cols(), columns);
    w.tail.buffer.resize(buffer_rows(), columns);
    w.forces.noalias() = b_->transpose() * slant::local(x);
    if constexpr (std::is_same_v<T, double>) {
      w.tail.x.swap(w.forces);
      solve_in_place(w.tail);
      w.tail.x.swap(w.forces);
    } else {
      solve_rounded(w);
    }
    w.forces *= unit_;
    slant::local(y).noalias() = *b_ * w.forces;
  }

  /// The same operator with entries of floats, which are made on first use and shared.
  [[nodiscard]] condensed_operator<float> rounded() const
    requires std::same_as<T, double>
  {
    if (inverse_) return {b_, inverse_->rounded(), unit_};
    return {b_, factor_->rounded(), unit_};
  }

 private:
  [[nodiscard]] index buffer_rows() const {
    return inverse_ ? inverse_->size() : factor_->shape().height();
  }
  /// v.x ← (L_tt L_ttᵀ)⁻¹ v.x, or S⁻¹ v.x.
  void solve_in_place(detail::tail_vectors<T>& v) const {
    if (!inverse_) {
      slant::detail::solve_in_place(*factor_, v);
      return;
    }
    index const n = inverse_->size();
    for (index j = 0; j < v.x.cols(); ++j) {
      inverse_->multiply(v.x.data() + j * n, v.buffer.data() + j * n);
    }
    v.x.swap(v.buffer);
  }

  /// Each right-hand side in units in which floats hold it.
  void solve_rounded(workspace_type& w) const {
    for (index j = 0; j < w.forces.cols(); ++j) {
      double const scale = std::ldexp(1.0, exponent(w.forces.col(j)));
      w.tail.x.col(j) = (w.forces.col(j) * scale).template cast<T>();
      w.forces.col(j).setConstant(1 / scale);
    }
    solve_in_place(w.tail);
    w.forces.array() *= w.tail.x.template cast<double>().array();
  }
  static int exponent(auto const& v) {
    double const largest = v.size() > 0 ? v.cwiseAbs().maxCoeff() : 0.0;
    return std::isfinite(largest) ? -std::clamp(detail::binary_exponent(largest), -1000, 1000) : 0;
  }

  std::shared_ptr<sparse_type const> b_;
  std::shared_ptr<factor_type const> factor_;    // one of the two
  std::shared_ptr<inverse_type const> inverse_;  // is there
  double unit_;
};

}  // namespace slant
