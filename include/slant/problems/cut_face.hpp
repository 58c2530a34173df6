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
// Rows may depend on others on a face and nowhere else: `assign` refuses such a face.
#pragma once

#include <slant/base/matrix_entries.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/sets/curved_face.hpp>

#include <Eigen/Cholesky>
#include <Eigen/SparseCore>

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
        weights_(N.rows()),
        normal_(N.cols()),
        kept_(N.cols()),
        image_(N.cols()) {}

  /// Becomes the face at z; κ is the weight of the curvature in W. False if N Π Nᵀ is singular:
  /// then it has no P. Allocates nothing but what a large dense factorisation needs for itself.
  template <class Set, class Z>
  [[nodiscard]] bool assign(Set const& set, Z const& z, S const& κ) {
    assemble(set, z, κ);
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

  /// normal = Nᵀ(N Π Nᵀ)⁻¹N x.
  void solve(vector_type const& x) const {
    weights_.noalias() = N_ * x;
    if (weights_.size() > 0) factors_.solveInPlace(weights_);
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
  mutable vector_type weights_, normal_, kept_, image_;  // scratch
};

}  // namespace slant
