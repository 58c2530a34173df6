// SPDX-License-Identifier: MIT
//
// An orthonormal basis of the span of some columns e_i of a small dense matrix E, one column after
// the other: E_P = Q R by Gram–Schmidt, done twice, which keeps Q orthogonal to rounding [Giraud,
// Langou, Rozložník 2005]. A column that depends on those before it is refused, so that R is
// regular whatever E is; least-squares problems are solved without forming EᵀE.
#pragma once

#include <slant/concepts/scalar.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace slant::detail {

template <class S>
class row_basis {
 public:
  using matrix_type = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;

  /// Room for columns of an E with these sizes; nothing allocates from here on.
  row_basis(index rows, index columns)
      : Q_(rows, std::min(rows, columns)),
        R_(matrix_type::Zero(Q_.cols(), Q_.cols())),
        h_(Q_.cols()),
        v_(rows) {
    members_.reserve(static_cast<std::size_t>(Q_.cols()));
  }

  [[nodiscard]] index size() const noexcept { return static_cast<index>(members_.size()); }
  /// Number of the k-th column taken in.
  [[nodiscard]] index member(index k) const { return members_[static_cast<std::size_t>(k)]; }
  void clear() noexcept { members_.clear(); }

  /// Takes column i of E in; false if it is in the span already, up to rounding.
  bool append(matrix_type const& e, index i) {
    index const k = size();
    if (k == Q_.cols()) return false;
    v_ = e.col(i);
    S const length = v_.norm();
    R_.col(k).setZero();
    for (int pass = 0; pass < 2; ++pass) {
      auto h = h_.head(k);
      h.noalias() = Q_.leftCols(k).transpose() * v_;
      v_.noalias() -= Q_.leftCols(k) * h;
      R_.col(k).head(k) += h;
    }
    S const rest = v_.norm();
    if (!(rest > dependence() * length)) return false;
    R_(k, k) = rest;
    Q_.col(k) = v_ / rest;
    members_.push_back(i);
    return true;
  }
  /// Leaves the k-th member out; the others stay in their order.
  void remove(matrix_type const& e, index k) {
    index const last = size();
    index kept = k;
    for (index j = k + 1; j < last; ++j) {
      index const i = member(j);
      members_.resize(static_cast<std::size_t>(kept));
      if (append(e, i)) ++kept;
    }
    members_.resize(static_cast<std::size_t>(kept));
  }

  /// x ← x − Q Qᵀx, the part orthogonal to all members; a is set to the least-squares coefficients
  /// of x: the k-th belongs to the k-th member.
  void take_out(vector_type& x, vector_type& a) {
    auto h = h_.head(size());
    auto coefficients = a.head(size());
    coefficients.setZero();
    for (int pass = 0; pass < 2; ++pass) {
      h.noalias() = Q_.leftCols(size()).transpose() * x;
      x.noalias() -= Q_.leftCols(size()) * h;
      coefficients += h;
    }
    solve(a);
  }

 private:
  /// Sine of the angle between a column and the span below which it counts as dependent: some
  /// digits more than the rounding errors of rows that were computed in two ways.
  static S dependence() { return S(4096) * std::numeric_limits<S>::epsilon(); }

  void solve(vector_type& a) const {
    for (index k = size(); k-- > 0;) {
      S t = a[k];
      for (index j = k + 1; j < size(); ++j) t -= R_(k, j) * a[j];
      a[k] = t / R_(k, k);
    }
  }

  matrix_type Q_;
  matrix_type R_;
  vector_type h_;  // scratch
  vector_type v_;  // scratch
  std::vector<index> members_;
};

}  // namespace slant::detail
