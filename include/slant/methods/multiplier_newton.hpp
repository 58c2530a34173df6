// SPDX-License-Identifier: MIT
//
// The semismooth Newton step for minimiser and multiplier of min q(x) over x ∈ Λ, Q x = x̄,
// together: with the face of P_Λ at z = x − α r, Π onto its range and C its curvature
// (sets/curved_face.hpp),
//
//     [ Π A Π + C/α   Π Nᵀ ] [ t  ]   [ −Π r           ]
//     [ N Π                ] [ dμ ] = [ −N (Q x − x̄)  ]         t ∈ range(Π),  ν ← ν + Nᵀdμ
//
// N the independent rows of G. With a solution of the second row and the projector onto the face
// cut by ker N, P = Π − Π Nᵀ(N Π Nᵀ)⁻¹N Π, conjugate gradients on P (A + C/α) P find t, and the
// first row then dμ. N Π Nᵀ is the coarse problem of the face, dense and factored for each step.
//
// Why: the step of a method of multipliers, dμ ~ Q x − x̄, is right in the metric of N Nᵀ. Where the
// face has lost components that some equation depends on (contact is open, and a body is held by a
// part of its constraints) N Π Nᵀ is something else, and such methods are slow.
#pragma once

#include <slant/concepts/linear_operator.hpp>
#include <slant/factorizations/detail/spd_checks.hpp>
#include <slant/sets/curved_face.hpp>

#include <Eigen/Cholesky>
#include <Eigen/SparseCore>

#include <optional>
#include <vector>

namespace slant {

/// One such step, for Eigen vectors. Allocates.
template <class S>
class multiplier_newton {
 public:
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using sparse_type = Eigen::SparseMatrix<S>;

  vector_type t;         ///< the step of x
  vector_type dν;        ///< that of the multiplier, a gradient
  index iterations = 0;  ///< products spent

  /// The coarse problem of the face at z. False if the face does not leave N Π independent rows:
  /// then there is no such step.
  template <class Set>
  [[nodiscard]] bool assign(sparse_type const& N, Set const& set, vector_type const& z) {
    face_.emplace(set);
    face_->assign(set, z, S(1));
    std::vector<Eigen::Triplet<S>> entries;
    face_->projector_entries([&](index i, index j, S const& value) {
      entries.emplace_back(static_cast<int>(i), static_cast<int>(j), value);
    });
    sparse_type Π(N.cols(), N.cols());
    Π.setFromTriplets(entries.begin(), entries.end());
    rows_ = N * Π;
    dense_type const gram = dense_type(rows_ * sparse_type(rows_.transpose()));
    coarse_.compute(gram);
    if (coarse_.info() != Eigen::Success) return false;
    for (index i = 0; i < gram.rows(); ++i) {
      S const pivot = coarse_.matrixLLT()(i, i);
      if (!(pivot * pivot > detail::smallest_pivot(gram.rows(), S(1)))) return false;
    }
    return true;
  }

  /// t and dν for the gradient r and the offset Q x − x̄, until the residual of the first row has
  /// fallen by the factor η, or after `most` products. False if A is not definite on the face.
  template <class A, class W>
  [[nodiscard]] bool solve(A const& a, W& a_workspace, sparse_type const& N, vector_type const& r,
                           vector_type const& offset, S const& α, S const& η, index most) {
    vector_type image(r.size()), p, z(r.size());
    t = -(rows_.transpose() * coarse_.solve(N * offset));
    slant::apply(a, t, image, a_workspace);
    iterations = 1;
    vector_type h = r + image;
    face_->add_curvature(S(1) / α, t, h);
    vector_type g = cut(h);
    S const target = η * g.norm();
    S size = g.squaredNorm();
    p = -g;
    while (size > target * target && iterations < most) {
      slant::apply(a, p, image, a_workspace);
      ++iterations;
      face_->add_curvature(S(1) / α, p, image);
      S const bend = p.dot(image);
      if (!(bend > S(0))) return false;
      S const length = size / bend;
      t += length * p;
      h += length * image;
      g = cut(h);
      S const next = g.squaredNorm();
      p = (next / size) * p - g;
      size = next;
    }
    dν = -(N.transpose() * coarse_.solve(rows_ * h));
    return t.allFinite() && dν.allFinite();
  }

 private:
  using dense_type = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

  /// P v.
  [[nodiscard]] vector_type cut(vector_type const& v) const {
    vector_type kept(v.size());
    face_->keep(v, kept);
    kept.noalias() -= rows_.transpose() * coarse_.solve(rows_ * v);
    return kept;
  }

  std::optional<curved_face<S>> face_{};
  sparse_type rows_{};  // N Π
  Eigen::LLT<dense_type> coarse_{};
};

}  // namespace slant
