// SPDX-License-Identifier: MIT
//
// The nearest point of a small polyhedron, by the dual active set method of Goldfarb and Idnani
// [1983] for
//
//     minimise   ½ ‖z − x‖²   over   Eᵀz ≤ s,        z = x − E λ,   λ ≥ 0.
//
// Rows are added one by one, the most violated first; a multiplier that would become negative
// leaves. Redundant and repeated rows do no harm: those in use are independent. With s = 0 it is
// the projection onto a cone, and λ the solution of min ‖x − Eλ‖ over λ ≥ 0.
#pragma once

#include <slant/concepts/scalar.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace slant::detail {

// --- row basis -----------------------------------------------------------------------------------
//
// An orthonormal basis of the span of some columns e_i of a small dense matrix E, one column after
// the other: E_P = Q R by Gram–Schmidt, done twice, which keeps Q orthogonal to rounding [Giraud,
// Langou, Rozložník 2005]. A column that depends on those before it is refused, so that R is
// regular whatever E is; least-squares problems are solved without forming EᵀE.

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
    members_.reserve(std::size_t(Q_.cols()));
  }

  [[nodiscard]] index size() const noexcept { return index(members_.size()); }
  /// Number of the k-th column taken in.
  [[nodiscard]] index member(index k) const { return members_[std::size_t(k)]; }
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
      members_.resize(std::size_t(kept));
      if (append(e, i)) ++kept;
    }
    members_.resize(std::size_t(kept));
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
  static S dependence() { return S(4096) * detail::epsilon<S>(); }

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

/// The working room of nearest_point for an E with these sizes; keeps the rows in use from one call
/// to the next.
template <class S>
struct nearest_point {
  using matrix_type = typename row_basis<S>::matrix_type;
  using vector_type = typename row_basis<S>::vector_type;

  row_basis<S> basis;
  vector_type x;       ///< the point on entry, the nearest one on exit
  vector_type bounds;  ///< s; +infinity where there is no bound
  vector_type λ;       ///< multipliers, ≥ 0

  nearest_point(index rows, index columns)
      : basis(rows, columns),
        x(rows),
        bounds(columns),
        λ(vector_type::Zero(columns)),
        start_(rows),
        z_(rows),
        a_(columns),
        used_(columns) {}

  /// False if no point satisfies Eᵀz ≤ s.
  [[nodiscard]] bool find(matrix_type const& e) {
    start_ = x;
    if (try_same_rows(e)) return true;
    x = start_;
    basis.clear();
    λ.setZero();
    used_.setZero();
    // Each round adds a row for good and raises the distance; a row set does not come back.
    for (index round = 0; round <= 20 * (e.cols() + 1); ++round) {
      index const q = worst(e);
      if (q < 0) return true;
      if (!add(e, q)) return worst(e, S(256)) < 0;
    }
    // Rounding errors send rows in circles, as they do where rows are all but dependent: x may be
    // near the set all the same, with more of them than a row that was met leaves.
    return worst(e, S(256)) < 0;
  }

 private:
  /// What counts as zero in e_iᵀx − s_i.
  [[nodiscard]] S noise(matrix_type const& e, index i) const {
    S const size = e.col(i).norm() * std::max<S>(start_.stableNorm(), x.stableNorm());
    using std::abs;
    return S(16) * detail::epsilon<S>() * (size + abs(bounds[i]));
  }
  [[nodiscard]] S violation(matrix_type const& e, index i) const {
    return e.col(i).dot(x) - bounds[i];
  }

  /// Only for cones: the rows that were in use the last time may be so again.
  bool try_same_rows(matrix_type const& e) {
    if (basis.size() == 0) return false;
    for (index k = 0; k < basis.size(); ++k) {
      if (!(bounds[basis.member(k)] == S(0))) return false;
    }
    basis.take_out(x, a_);
    λ.setZero();
    used_.setZero();
    for (index k = 0; k < basis.size(); ++k) {
      if (!(a_[k] > S(0))) return false;
      λ[basis.member(k)] = a_[k];
      used_[basis.member(k)] = 1;
    }
    return worst(e) < 0;
  }

  /// The most violated row, measured in lengths; −1 if none is violated by more than `allowed`
  /// times its noise.
  [[nodiscard]] index worst(matrix_type const& e, S const& allowed = S(1)) const {
    index row = -1;
    S most(0);
    for (index i = 0; i < e.cols(); ++i) {
      bool const is_bound = bounds[i] < detail::infinity<S>();
      if ((used_[i] != 0 && allowed == S(1)) || !is_bound) continue;
      S const v = violation(e, i);
      if (!(v > allowed * noise(e, i))) continue;
      S const distance = v / e.col(i).norm();
      if (distance > most) {
        most = distance;
        row = i;
      }
    }
    return row;
  }

  /// Moves x until row q holds, dropping rows on the way.
  bool add(matrix_type const& e, index q) {
    while (true) {
      z_ = e.col(q);
      S const length = z_.norm();
      basis.take_out(z_, a_);
      S const rest = z_.norm();
      constexpr S infinity = detail::infinity<S>();
      bool const independent = rest > S(4096) * detail::epsilon<S>() * length;
      S const full = independent ? S(violation(e, q) / (rest * rest)) : infinity;
      S t = full;
      index leaves = -1;
      for (index k = 0; k < basis.size(); ++k) {
        if (a_[k] > S(0) && λ[basis.member(k)] / a_[k] < t) {
          t = λ[basis.member(k)] / a_[k];
          leaves = k;
        }
      }
      if (!(t < infinity)) return false;
      if (independent) x -= t * z_;
      for (index k = 0; k < basis.size(); ++k) λ[basis.member(k)] -= t * a_[k];
      λ[q] += t;
      if (leaves < 0) {
        if (!basis.append(e, q)) return false;
        used_[q] = 1;
        return true;
      }
      λ[basis.member(leaves)] = S(0);
      used_[basis.member(leaves)] = 0;
      basis.remove(e, leaves);
    }
  }

  vector_type start_;
  vector_type z_;
  vector_type a_;
  Eigen::Matrix<unsigned char, Eigen::Dynamic, 1> used_;
};

}  // namespace slant::detail
