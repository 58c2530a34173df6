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
// Rows may depend on others on a face and nowhere else. `assign` refuses such a face;
// `assign_independent` cuts it by as many rows as are independent there, which have the same
// kernel.
#pragma once

#include <slant/base/matrix_entries.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/sets/curved_face.hpp>

#include <Eigen/Cholesky>
#include <Eigen/SparseCore>

#include <cmath>
#include <limits>
#include <vector>

namespace slant {

/// P, P C and P W P, as curved_minimum wants them, for Eigen vectors.
template <class S>
class cut_face {
 public:
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using sparse_type = Eigen::SparseMatrix<S>;

  /// Room for the faces of a set; the rows of N have length 1. Allocates.
  template <class Set>
  cut_face(Set const& set, sparse_type const& N)
      : face_(set),
        N_(N),
        coarse_(N.rows(), N.rows()),
        factors_(N.rows()),
        is_left_(static_cast<std::size_t>(N.rows()), false),
        weights_(N.rows()),
        normal_(N.cols()),
        kept_(N.cols()),
        image_(N.cols()) {
    pivots_.reserve(is_left_.size());
  }

  /// Becomes the face at z; κ is the weight of the curvature in W. False if N Π Nᵀ is singular:
  /// then it has no P. Allocates nothing but what a large dense factorisation needs for itself.
  template <class Set, class Z>
  [[nodiscard]] bool assign(Set const& set, Z const& z, S const& κ) {
    assemble(set, z, κ);
    uses_pivots_ = false;
    index const p = coarse_.rows();
    if (p == 0) return true;
    factors_.compute(coarse_);
    if (factors_.info() != Eigen::Success) return false;
    for (index i = 0; i < p; ++i) {
      S const pivot = factors_.matrixLLT()(i, i);
      if (!(pivot * pivot > detail::smallest_pivot(p, S(1)))) return false;
    }
    return true;
  }

  /// Becomes the face at z, cut by rows that are independent there; returns how many. By a Cholesky
  /// factorisation of N Π Nᵀ with diagonal pivoting that ends at the first pivot that may be zero.
  /// Does not allocate.
  template <class Set, class Z>
  index assign_independent(Set const& set, Z const& z, S const& κ) {
    using std::sqrt;
    assemble(set, z, κ);
    uses_pivots_ = true;
    pivots_.clear();
    is_left_.assign(is_left_.size(), true);
    weights_ = coarse_.diagonal();
    index const p = coarse_.rows();
    // What Π leaves of a row that is normal to the face.
    S const rounding = S(1024) * std::numeric_limits<S>::epsilon();
    while (static_cast<index>(pivots_.size()) < p) {
      index i = -1;
      S best(0);
      for (index j = 0; j < p; ++j) {
        S const pivot = coarse_(j, j);
        if (!is_left(j) || !(pivot > detail::smallest_pivot(p, weights_[j]))) continue;
        if (!(pivot > rounding * rounding) || !(pivot > best * weights_[j])) continue;
        best = pivot / weights_[j];
        i = j;
      }
      if (i < 0) break;
      S const root = sqrt(coarse_(i, i));
      for (index j = 0; j < p; ++j)
        if (is_left(j)) coarse_(j, i) /= root;
      is_left_[static_cast<std::size_t>(i)] = false;
      for (index j = 0; j < p; ++j) {
        if (!is_left(j)) continue;
        for (index l = 0; l < p; ++l)
          if (is_left(l)) coarse_(l, j) -= coarse_(l, i) * coarse_(j, i);
      }
      pivots_.push_back(i);
    }
    return static_cast<index>(pivots_.size());
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
    coarse_.setZero();
    face_.projector_entries([&](index i, index j, S const& value) {
      for (typename sparse_type::InnerIterator a(N_, i); a; ++a) {
        for (typename sparse_type::InnerIterator b(N_, j); b; ++b) {
          coarse_(a.row(), b.row()) += value * a.value() * b.value();
        }
      }
    });
  }

  [[nodiscard]] bool is_left(index row) const { return is_left_[static_cast<std::size_t>(row)]; }

  /// Column k of L is in column pivots[k] of coarse; the other rows get the weight 0.
  void solve_with_pivots() const {
    auto const count = pivots_.size();
    for (std::size_t k = 0; k < count; ++k) {
      index const i = pivots_[k];
      for (std::size_t j = 0; j < k; ++j)
        weights_[i] -= coarse_(i, pivots_[j]) * weights_[pivots_[j]];
      weights_[i] /= coarse_(i, i);
    }
    for (std::size_t k = count; k-- > 0;) {
      index const i = pivots_[k];
      for (std::size_t j = k + 1; j < count; ++j)
        weights_[i] -= coarse_(pivots_[j], i) * weights_[pivots_[j]];
      weights_[i] /= coarse_(i, i);
    }
    for (index i = 0; i < weights_.size(); ++i)
      if (is_left(i)) weights_[i] = S(0);
  }

  /// normal = Nᵀ(N Π Nᵀ)⁻¹N x.
  void solve(vector_type const& x) const {
    weights_.noalias() = N_ * x;
    if (uses_pivots_) {
      solve_with_pivots();
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

  using dense_type = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

  curved_face<S> face_;
  sparse_type N_;
  dense_type coarse_;
  Eigen::LLT<dense_type> factors_;
  std::vector<index> pivots_;  // with them, coarse_ holds the factor
  std::vector<bool> is_left_;  // rows that are none of them
  bool uses_pivots_ = false;
  mutable vector_type weights_, normal_, kept_, image_;  // scratch
};

}  // namespace slant
