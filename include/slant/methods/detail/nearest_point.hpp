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

#include <slant/methods/detail/row_basis.hpp>

#include <limits>

namespace slant::detail {

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
      if (!add(e, q)) return false;
    }
    // Rounding errors send rows in circles, as they do where rows are all but dependent: x may be
    // near the set all the same, with more of them than a row that was met leaves.
    return worst(e, S(256)) < 0;
  }

 private:
  /// What counts as zero in e_iᵀx − s_i.
  [[nodiscard]] S noise(matrix_type const& e, index i) const {
    S const size = e.col(i).cwiseAbs().dot(start_.cwiseAbs().cwiseMax(x.cwiseAbs()));
    using std::abs;
    return S(16) * std::numeric_limits<S>::epsilon() * (size + abs(bounds[i]));
  }
  [[nodiscard]] S violation(matrix_type const& e, index i) const {
    return e.col(i).dot(x) - bounds[i];
  }
  [[nodiscard]] bool bounded(index i) const {
    return bounds[i] < std::numeric_limits<S>::infinity();
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
      if ((used_[i] != 0 && allowed == S(1)) || !bounded(i)) continue;
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
      constexpr S infinity = std::numeric_limits<S>::infinity();
      bool const independent = rest > S(4096) * std::numeric_limits<S>::epsilon() * length;
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
