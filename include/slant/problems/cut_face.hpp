// SPDX-License-Identifier: MIT
//
// The face of a Newton step (sets/curved_face.hpp), range(Π) with curvature C, cut by ker N for
// equations N x = n. The orthogonal projector onto range(Π) ∩ ker N is
//
//     P = Π − Π Nᵀ(N Π Nᵀ)⁻¹N Π.
//
// N Π Nᵀ is the coarse problem of the face, dense, and factored for each face. Where the face has
// lost components that some equation depends on, it is something else than N Nᵀ: that is why a
// method of multipliers, whose steps are right in the metric of N Nᵀ, is slow there and Newton's
// method is not.
//
// Rows may depend on others on a face and nowhere else. `assign` tells; those that do are left out
// of N Π Nᵀ, which leaves P what it is, and a lift does not meet them unless they agree with the
// others.
#pragma once

#include <slant/base/matrix_entries.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/problems/equality_constraints.hpp>
#include <slant/sets/curved_face.hpp>

#include <Eigen/Cholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <vector>

namespace slant {

/// P, P C and P W P, as curved_minimum wants them, for Eigen vectors.
template <class S>
class cut_face {
 public:
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using sparse_type = Eigen::SparseMatrix<S>;
  using dense_type = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

  /// Room for the faces of a set; the rows of N have length 1. Allocates.
  template <class Set>
  cut_face(Set const& set, sparse_type const& N)
      : face_(set),
        N_(N),
        coarse_(N.rows(), N.rows()),
        factors_(N.rows()),
        weights_(N.rows()),
        normal_(N.cols()) {}

  /// Becomes the face at z; κ is the weight of the curvature in W. False if N Π Nᵀ is singular;
  /// else nothing is allocated but what a large dense factorisation needs for itself.
  template <class Set, class Z>
  [[nodiscard]] bool assign(Set const& set, Z const& z, S const& κ) {
    assemble(set, z, κ);
    independent_.clear();
    all_told_ = true;
    if (factor(coarse_)) return true;
    independent_ = detail::independent_rows(coarse_);
    coarse_ = dense_type(coarse_(independent_, independent_));
    static_cast<void>(factor(coarse_));
    look_at_rows_left_out();
    return false;
  }

  /// The face that is cut.
  [[nodiscard]] curved_face<S> const& whole() const { return face_; }

  /// y = P x.
  void keep(vector_type const& x, vector_type& y) const {
    face_.keep(x, y);
    cut(y);
  }
  /// y = P W P x; W commutes with Π.
  void weigh(vector_type const& x, vector_type& y) const {
    keep(x, y);
    face_.weigh(y, kept_);
    y = kept_;
    cut(y);
  }
  /// y ← y + α P C x for x ∈ range(Π).
  void add_curvature(S const& α, vector_type const& x, vector_type& y) const {
    if (face_.curved_count() == 0) return;
    image_.setZero(x.size());
    face_.add_curvature(α, x, image_);
    cut(image_);
    y += image_;
  }

  /// Whether rounding is all of N x, for a sum x of terms of that length. False where a row that was
  /// left out does not depend on others up to rounding: then that says nothing.
  [[nodiscard]] bool meets(vector_type const& x, S const& length) const {
    using std::sqrt;
    weights_.noalias() = N_ * x;
    S const n(static_cast<double>(x.size()));
    return all_told_ && slant::norm(weights_) <= S(16) * detail::epsilon<S>() * sqrt(n) * length;
  }
  /// y = Π Nᵀ(N Π Nᵀ)⁻¹N x: the shortest step in the face that N maps to N x.
  void lift(vector_type const& x, vector_type& y) const {
    solve(x);
    face_.keep(normal_, y);
  }
  /// y = Nᵀ(N Π Nᵀ)⁻¹N Π x: what of Π x a multiplier can balance, and that multiplier.
  void balance(vector_type const& x, vector_type& y) const {
    face_.keep(x, kept_);
    solve(kept_);
    y = normal_;
  }

 private:
  /// Π and N Π Nᵀ.
  template <class Set, class Z>
  void assemble(Set const& set, Z const& z, S const& κ) {
    face_.assign(set, z, κ);
    coarse_.setZero(N_.rows(), N_.rows());
    face_.projector_entries([&](index i, index j, S const& value) {
      for (typename sparse_type::InnerIterator a(N_, i); a; ++a) {
        for (typename sparse_type::InnerIterator b(N_, j); b; ++b) {
          coarse_(a.row(), b.row()) += value * a.value() * b.value();
        }
      }
    });
  }

  /// N Π Nᵀ sees the squares of distances: whether the rows left out are combinations of the others
  /// is told by what the projector, applied twice, leaves of them.
  void look_at_rows_left_out() {
    using std::sqrt;
    S const n(static_cast<double>(N_.cols()));
    for (index i = 0; i < N_.rows(); ++i) {
      if (std::binary_search(independent_.begin(), independent_.end(), i)) continue;
      vector_type const row = N_.row(i).transpose();
      vector_type rest(N_.cols());
      keep(row, rest);
      cut(rest);
      if (rest.norm() > S(16) * detail::epsilon<S>() * sqrt(n)) all_told_ = false;
    }
  }

  /// Whether all pivots can be told from zero.
  [[nodiscard]] bool factor(dense_type const& matrix) {
    index const p = matrix.rows();
    if (p == 0) return true;
    factors_.compute(matrix);
    if (factors_.info() != Eigen::Success) return false;
    S const least = factors_.matrixLLT().diagonal().minCoeff();
    return least * least > detail::smallest_pivot(p, S(1));
  }

  /// normal = Nᵀ(N Π Nᵀ)⁻¹N x, without rows that depend on others.
  void solve(vector_type const& x) const {
    weights_.noalias() = N_ * x;
    if (coarse_.rows() < weights_.size()) {
      part_ = weights_(independent_);
      if (part_.size() > 0) factors_.solveInPlace(part_);
      weights_.setZero();
      weights_(independent_) = part_;
    } else if (weights_.size() > 0) {
      factors_.solveInPlace(weights_);
    }
    normal_.noalias() = N_.transpose() * weights_;
  }
  /// y ← P y for y ∈ range(Π).
  void cut(vector_type& y) const {
    solve(y);
    face_.keep(normal_, kept_);
    y -= kept_;
  }

  curved_face<S> face_;
  sparse_type N_;
  dense_type coarse_;               // N Π Nᵀ
  std::vector<index> independent_;  // its rows, where it is singular
  bool all_told_ = true;            // and the others depend on these up to rounding
  Eigen::LLT<dense_type> factors_;
  mutable vector_type weights_, part_, normal_, kept_ = normal_, image_ = normal_;  // scratch
};

}  // namespace slant
