// SPDX-License-Identifier: MIT
//
// The stiffness of a membrane on a grid of nodes, without a matrix. Linear elements on triangles
// with right angles give, for −div(w ∇v) with w = w(x), a weight on each edge between neighbours:
//
//     vᵀA v = Σ along_x[i] (v(i, j) − v(i−1, j))² + Σ along_y[i] (v(i, j) − v(i, j−1))²,
//
//     along_x[i] = hy/hx (w(x_{i−1}) + w(x_i)) / 2                              i = 0 … nx
//     along_y[i] = hx/hy (w(x_{i−1}) + 4 w(x_i) + w(x_{i+1})) / 6               i = 0 … nx − 1
//
// with v = 0 on the edges of the rectangle; the vertex rule on each of the six triangles of a node.
#pragma once

#include <Eigen/SparseCore>
#include <cmath>
#include <concepts>
#include <slant/concepts/laws.hpp>
#include <slant/concepts/vector.hpp>

#include <fem/rectangle_grid.hpp>

namespace fem {

/// y = A x in five diagonals of which none is stored. Unknowns are ordered as in rectangle_grid.
template <class S = double>
class five_point {
 public:
  using scalar = S;
  using vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  /// Every node hangs on the edges through a chain of positive weights.
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_definite>;

  /// Of the weight w(x) > 0. Throws std::invalid_argument for a grid that is none, or if w is not a
  /// positive finite number at a node.
  template <class Weight>
  five_point(rectangle_grid<S> const& grid, Weight const& w)
      : nx_(grid.nx), ny_(grid.ny), along_x_(grid.nx + 1), along_y_(grid.nx) {
    require_grid(grid);
    S const slope = grid.hy() / grid.hx();
    auto const at = [&](Eigen::Index i) { return checked(w(grid.x(i))); };
    for (Eigen::Index i = 0; i <= nx_; ++i) along_x_[i] = slope * (at(i - 1) + at(i)) / S(2);
    for (Eigen::Index i = 0; i < nx_; ++i)
      along_y_[i] = (at(i - 1) + S(4) * at(i) + at(i + 1)) / (S(6) * slope);
    diagonal_ = along_x_.head(nx_) + along_x_.tail(nx_) + S(2) * along_y_;
  }

  [[nodiscard]] Eigen::Index rows() const { return nx_ * ny_; }
  [[nodiscard]] Eigen::Index cols() const { return nx_ * ny_; }
  [[nodiscard]] Eigen::Index nx() const { return nx_; }
  [[nodiscard]] Eigen::Index ny() const { return ny_; }
  /// Weights of the nx + 1 edges of a line of nodes, from edge to edge of the rectangle.
  [[nodiscard]] vector const& along_x() const { return along_x_; }
  /// Weights of the edges in y through the nodes of a line.
  [[nodiscard]] vector const& along_y() const { return along_y_; }

  template <class X, class Y>
    requires std::same_as<slant::scalar_t<X>, S>
  void apply(X const& x, Y& y) const {
    auto const& from = slant::local(x);
    auto& to = slant::local(y);
    auto const inner = along_x_.segment(1, nx_ - 1).asDiagonal();
    for (Eigen::Index j = 0; j < ny_; ++j) {
      auto const here = from.middleRows(nx_ * j, nx_);
      auto line = to.middleRows(nx_ * j, nx_);
      line.noalias() = diagonal_.asDiagonal() * here;
      line.bottomRows(nx_ - 1).noalias() -= inner * here.topRows(nx_ - 1);
      line.topRows(nx_ - 1).noalias() -= inner * here.bottomRows(nx_ - 1);
      if (j > 0) line.noalias() -= along_y_.asDiagonal() * from.middleRows(nx_ * (j - 1), nx_);
      if (j + 1 < ny_)
        line.noalias() -= along_y_.asDiagonal() * from.middleRows(nx_ * (j + 1), nx_);
    }
  }
  template <class Y>
    requires std::same_as<slant::scalar_t<Y>, S>
  void diagonal(Y& d) const {
    for (Eigen::Index j = 0; j < ny_; ++j) slant::local(d).middleRows(nx_ * j, nx_) = diagonal_;
  }
  /// A as a matrix.
  [[nodiscard]] Eigen::SparseMatrix<S> matrix() const {
    Eigen::SparseMatrix<S> A(rows(), cols());
    A.reserve(Eigen::VectorXi::Constant(cols(), 5));
    for (Eigen::Index j = 0; j < ny_; ++j)
      for (Eigen::Index i = 0; i < nx_; ++i) {
        Eigen::Index const here = i + nx_ * j;
        if (j > 0) A.insert(here - nx_, here) = -along_y_[i];
        if (i > 0) A.insert(here - 1, here) = -along_x_[i];
        A.insert(here, here) = diagonal_[i];
        if (i + 1 < nx_) A.insert(here + 1, here) = -along_x_[i + 1];
        if (j + 1 < ny_) A.insert(here + nx_, here) = -along_y_[i];
      }
    A.makeCompressed();
    return A;
  }
  /// An upper bound of the largest eigenvalue: twice the largest diagonal entry, since no sum of
  /// the other entries of a row exceeds the diagonal one.
  [[nodiscard]] S largest_eigenvalue_bound() const { return S(2) * diagonal_.maxCoeff(); }

 private:
  static S checked(S const& weight) {
    using std::isfinite;
    require(weight > S(0) && isfinite(weight), "w", weight, "a positive finite weight");
    return weight;
  }

  Eigen::Index nx_;
  Eigen::Index ny_;
  vector along_x_;
  vector along_y_;
  vector diagonal_{};
};

}  // namespace fem
