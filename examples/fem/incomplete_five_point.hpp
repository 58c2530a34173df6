// SPDX-License-Identifier: MIT
//
// Modified incomplete Cholesky factors of a five-point operator, without fill (Gustafsson, BIT 18,
// 1978, 142–156): A ≈ (D + L) D⁻¹ (D + L)ᵀ with the entries of A below the diagonal in L, and D
// such that the diagonals and, up to the factor τ of what is dropped, the sums of the rows agree:
//
//     d = a − Σ over the nodes w to the west and s to the south of
//             ℓ_w² / d_w + τ ℓ_w n_w / d_w,      ℓ_s² / d_s + τ ℓ_s e_s / d_s
//
// (n_w and e_s the weights from w to the north, from s to the east). With τ near 1 the condition of
// the preconditioned operator grows like 1/h, that of A like 1/h². On the whole grid τ = 1 is best;
// where nodes are fixed it corrects for what is not there, and 0.99 needs fewer steps. An
// application costs what one of A does.
#pragma once

#include <cstddef>
#include <fem/five_point.hpp>

namespace fem {

/// y = M x, M ≈ A⁻¹, as a preconditioner.
template <class S = double>
class incomplete_five_point {
 public:
  using scalar = S;
  using vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  /// A product B Bᵀ: the d are positive, since A is an M-matrix.
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_definite>;

  /// Factors A. Throws std::invalid_argument unless 0 ≤ τ ≤ 1.
  explicit incomplete_five_point(five_point<S> const& a, S const& τ = S(99) / S(100))
      : nx_(a.nx()), ny_(a.ny()), along_x_(a.along_x()), along_y_(a.along_y()), d_(a.rows()) {
    require(τ >= S(0) && τ <= S(1), "tau", τ, "a number in [0, 1]");
    a.diagonal(d_);
    for (Eigen::Index j = 0; j < ny_; ++j)
      for (Eigen::Index i = 0; i < nx_; ++i) {
        Eigen::Index const here = i + nx_ * j;
        if (i > 0) {
          S const north = j + 1 < ny_ ? along_y_[i - 1] : S(0);
          d_[here] -= along_x_[i] * (along_x_[i] + τ * north) / d_[here - 1];
        }
        if (j > 0) {
          S const east = i + 1 < nx_ ? along_x_[i + 1] : S(0);
          d_[here] -= along_y_[i] * (along_y_[i] + τ * east) / d_[here - nx_];
        }
      }
  }

  [[nodiscard]] Eigen::Index rows() const { return d_.size(); }
  [[nodiscard]] Eigen::Index cols() const { return d_.size(); }

  template <class X, class Y>
    requires std::same_as<slant::scalar_t<X>, S>
  void apply(X const& x, Y& y) const {
    auto const& from = slant::local(x);
    auto& to = slant::local(y);
    for (Eigen::Index column = 0; column < from.cols(); ++column) {
      for (Eigen::Index j = 0; j < ny_; ++j)
        for (Eigen::Index i = 0; i < nx_; ++i) {
          Eigen::Index const here = i + nx_ * j;
          S sum = from(here, column);
          if (i > 0) sum += along_x_[i] * to(here - 1, column);
          if (j > 0) sum += along_y_[i] * to(here - nx_, column);
          to(here, column) = sum / d_[here];
        }
      for (Eigen::Index j = ny_; j-- > 0;)
        for (Eigen::Index i = nx_; i-- > 0;) {
          Eigen::Index const here = i + nx_ * j;
          S sum(0);
          if (i + 1 < nx_) sum += along_x_[i + 1] * to(here + 1, column);
          if (j + 1 < ny_) sum += along_y_[i] * to(here + nx_, column);
          to(here, column) += sum / d_[here];
        }
    }
  }

 private:
  Eigen::Index nx_;
  Eigen::Index ny_;
  vector along_x_;
  vector along_y_;
  vector d_;
};

}  // namespace fem
