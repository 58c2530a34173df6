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
// application costs what one of A as a sparse matrix does, twice what five_point takes.
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
      : nx_(a.nx()),
        ny_(a.ny()),
        along_x_(a.along_x()),
        along_y_(a.along_y()),
        reciprocal_(a.rows()) {
    require(τ >= S(0) && τ <= S(1), "tau", τ, "a number in [0, 1]");
    a.diagonal(reciprocal_);
    for (Eigen::Index j = 0; j < ny_; ++j)
      for (Eigen::Index i = 0; i < nx_; ++i) {
        Eigen::Index const here = i + nx_ * j;
        S d = reciprocal_[here];
        if (i > 0) {
          S const north = j + 1 < ny_ ? along_y_[i - 1] : S(0);
          d -= along_x_[i] * (along_x_[i] + τ * north) * reciprocal_[here - 1];
        }
        if (j > 0) {
          S const east = i + 1 < nx_ ? along_x_[i + 1] : S(0);
          d -= along_y_[i] * (along_y_[i] + τ * east) * reciprocal_[here - nx_];
        }
        reciprocal_[here] = S(1) / d;
      }
  }

  [[nodiscard]] Eigen::Index rows() const { return reciprocal_.size(); }
  [[nodiscard]] Eigen::Index cols() const { return reciprocal_.size(); }

  template <class X, class Y>
    requires std::same_as<slant::scalar_t<X>, S>
  void apply(X const& x, Y& y) const {
    auto const& from = slant::local(x);
    auto& to = slant::local(y);
    for (Eigen::Index column = 0; column < from.cols(); ++column)
      solve(from.col(column), to.col(column));
  }

 private:
  /// Two sweeps. What waits for the node before is one multiplication and one addition: all else of
  /// a node can be computed ahead, and the time is that of these chains.
  template <class X, class Y>
  void solve(X const& from, Y&& to) const {
    for (Eigen::Index j = 0; j < ny_; ++j) {
      S west(0);
      for (Eigen::Index i = 0; i < nx_; ++i) {
        Eigen::Index const here = i + nx_ * j;
        S const south = j > 0 ? S(along_y_[i] * to[here - nx_]) : S(0);
        S const e = reciprocal_[here];
        west = e * (from[here] + south) + (e * along_x_[i]) * west;
        to[here] = west;
      }
    }
    for (Eigen::Index j = ny_; j-- > 0;) {
      S east(0);
      for (Eigen::Index i = nx_; i-- > 0;) {
        Eigen::Index const here = i + nx_ * j;
        S const north = j + 1 < ny_ ? S(along_y_[i] * to[here + nx_]) : S(0);
        S const e = reciprocal_[here];
        east = (to[here] + e * north) + (e * along_x_[i + 1]) * east;
        to[here] = east;
      }
    }
  }

  Eigen::Index nx_;
  Eigen::Index ny_;
  vector along_x_;
  vector along_y_;
  vector reciprocal_;  ///< 1/d
};

}  // namespace fem
