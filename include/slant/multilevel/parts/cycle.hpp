// SPDX-License-Identifier: MIT
//
// The V-cycle on the levels of a hierarchy, on all of space or on a face.
//
//     cycle(b):   x ← forwards sweep of block Gauss–Seidel from 0,   r ← b − K x
//                 x ← x + P cycle(Pᵀr)            on the last level: its factor
//                 x ← backwards sweep
//
// Definite. With sweeps, forwards before and backwards after the coarse correction make M = S + B Bᵀ with the
// symmetrised sweep S = (D + Lᵀ)⁻¹ D (D + L)⁻¹, definite for every matrix with definite diagonal
// blocks, and a semidefinite rest, however inexact the coarse levels are. No bound of a spectrum is
// needed that would have to be right. On a singular K, of bodies that float, M is definite as well.
//
// Chebyshev. In place of a sweep m steps of the polynomial of the fourth kind [Lottes 2023] in
// D⁻¹K, whose spectrum is in (0, λ],
//
//     z ← (2k − 3)/(2k + 1) z + (8k − 4)/(2k + 1) D⁻¹r/λ,    x ← x + z,    k = 1, …, m.
//
// Nothing but products by K, in no order of the nodes; 2m of them instead of two. An error e
// becomes w(D⁻¹K) e with |w| < 1 on (0, λ] and some way beyond, to 1.5 λ, 1.25 λ, 1.15 λ, 1.11 λ
// for m = 1 to 4: M is definite as long as the spectrum ends before that. λ is 1.2 times what the
// power method finds. It holds on every face of level 0, as Π and C only lower the spectrum, and is
// found anew on coarse levels where they have followed a face.
//
// Faces. On a face H = Π K Π + C takes the place of K (node_face.hpp): the inverses of the diagonal
// blocks at the surface are all that the sweeps know of it, and P is truncated by Π. In the rows of
// the coarse levels that come from nodes where the face has changed, and no others, the change is
// added [truncated multigrid: Gräser, Kornhuber 2009]. Levels hold no face: a workspace does. Every
// 256 changes it begins again from the levels without a face, before what rounding leaves of them
// adds up.
#pragma once

#include <slant/concepts/scalar.hpp>
#include <slant/multilevel/block_matrix.hpp>
#include <slant/multilevel/hierarchy.hpp>
#include <slant/multilevel/parts/envelope_factor.hpp>
#include <slant/multilevel/parts/galerkin.hpp>
#include <slant/multilevel/parts/node_face.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace slant::detail {

/// Block vectors of a level; z is for polynomials.
template <class T>
struct level_vectors {
  std::vector<T> x, b, r, z;

  level_vectors(std::size_t n, index degree)
      : x(n, T(0)), b(n, T(0)), r(n, T(0)), z(degree > 0 ? n : 0, T(0)) {}
};

/// What belongs to a face: copies of the coarse levels whose rows follow it, and as much again for
/// the changes.
template <int N, int M, class T>
struct levels_on_face {
  node_face<N, T> face;
  std::vector<block_matrix<M, T>> A;  // of coarse levels
  std::vector<block_matrix<M, T>> D;  // what the last face has changed of them
  std::vector<std::vector<T>> inverses;
  std::vector<T> largest;
  int changes = 0;  // of A since it was that of no face: each leaves some rounding
  envelope_factor<N, T> only;
  envelope_factor<M, T> last;
  galerkin_scratch<N, M, T> first_scratch;
  std::vector<galerkin_scratch<M, M, T>> scratch;
  std::vector<int> moved, parents;

  explicit levels_on_face(hierarchy<N, M, T> const& h)
      : face(h.fine.A.nodes(), h.fine.inverses), only(h.only), last(h.last) {
    if (!h.coarse.empty()) first_scratch = {h.fine.P, h.fine.longest};
    std::size_t const most = static_cast<std::size_t>(h.fine.A.nodes());
    moved.reserve(most);
    parents.reserve(most);
    for (std::size_t l = 0; l < h.coarse.size(); ++l) {
      A.push_back(h.coarse[l].A);
      D.push_back(h.coarse[l].A.of_same_pattern());
      inverses.push_back(h.coarse[l].inverses);
      largest.push_back(h.coarse[l].largest);
      scratch.emplace_back();
      if (l + 1 < h.coarse.size()) scratch.back() = {h.coarse[l].P, h.coarse[l].longest};
    }
  }
};

/// The workspace of a cycle.
template <int N, int M, class T>
struct cycle_workspace {
  level_vectors<T> fine;
  std::vector<level_vectors<T>> coarse;
  std::optional<levels_on_face<N, M, T>> on_face;

  explicit cycle_workspace(hierarchy<N, M, T> const& h) : fine(h.fine.A.padded_size(), h.degree) {
    for (auto const& l : h.coarse) coarse.emplace_back(l.A.padded_size(), h.degree);
  }
};

/// What smooths a level before the coarse correction, from 0, then r = b − A x, and after it.
/// Degree 0: sweeps.
template <int N, class T>
struct smoother {
  block_matrix<N, T> const& A;
  T const* inverses;
  T largest;  // eigenvalue of D⁻¹A, about
  index degree;
  node_face<N, T> const* face;  // on level 0: C in A + C, of which sweeps know by the inverses

  void before(level_vectors<T>& v) const {
    if (degree == 0) return A.forwards_from_zero(inverses, v.b.data(), v.x.data(), v.r.data());
    std::fill(v.x.begin(), v.x.end(), T(0));
    v.r = v.b;
    polynomial(v);
    residual(v);
  }
  void after(level_vectors<T>& v) const {
    if (degree == 0) return A.backwards(inverses, v.b.data(), v.x.data(), v.r.data());
    residual(v);
    polynomial(v);
  }

 private:
  void residual(level_vectors<T>& v) const {
    A.multiply(v.x.data(), v.r.data());
    for (std::size_t k = 0; k < v.r.size(); ++k) v.r[k] = v.b[k] - v.r[k];
    if (face) face->subtract_curvature(v.x.data(), v.r.data());
  }
  void polynomial(level_vectors<T>& v) const {
    constexpr double margin = 1.2;
    std::fill(v.z.begin(), v.z.end(), T(0));
    for (index k = 1; k <= degree; ++k) {
      if (k > 1) residual(v);
      double const n = static_cast<double>(2 * k + 1);
      double const α = (n - 4) / n, β = (4 * n - 8) / (n * margin);
      A.step(inverses, v.r.data(), T(α), T(β) / largest, v.z.data(), v.x.data());
    }
  }
};

/// x = cycle(b) on the levels below the finest, from l on.
template <int N, int M, class T>
void coarse_cycle(hierarchy<N, M, T> const& h, cycle_workspace<N, M, T>& w, bool on_face,
                  std::size_t l) {
  auto const& A = on_face ? w.on_face->A[l] : h.coarse[l].A;
  auto const& inverses = on_face ? w.on_face->inverses[l] : h.coarse[l].inverses;
  auto& v = w.coarse[l];
  bool const last = l + 1 == h.coarse.size();
  if (last && h.factored) {
    (on_face ? w.on_face->last : h.last).solve(v.b.data(), v.x.data());
    return;
  }
  smoother<M, T> const smooth{
      A, inverses.data(), on_face ? w.on_face->largest[l] : h.coarse[l].largest, h.degree, nullptr};
  smooth.before(v);
  if (!last) {
    auto const& P = h.coarse[l].P;
    P.restrict_to(v.r.data(), w.coarse[l + 1].b.data());
    coarse_cycle(h, w, on_face, l + 1);
    P.add_to(w.coarse[l + 1].x.data(), v.x.data());
  }
  smooth.after(v);
}

/// x = cycle(b) on all levels.
template <int N, int M, class T>
void cycle(hierarchy<N, M, T> const& h, cycle_workspace<N, M, T>& w, bool on_face) {
  auto& v = w.fine;
  auto* const face = on_face ? &w.on_face->face : nullptr;
  smoother<N, T> const smooth{h.fine.A, face ? face->inverses() : h.fine.inverses.data(),
                              h.fine.largest, h.degree, face};
  // r = b − A x, or at a surface what Π makes of it.
  smooth.before(v);
  if (!h.coarse.empty() || h.factored) {
    if (face) {
      face->project(v.r.data());
      face->remember(v.x.data());
    }
    if (h.coarse.empty()) {
      (on_face ? w.on_face->only : h.only).solve(v.r.data(), v.r.data());
      for (std::size_t k = 0; k < v.x.size(); ++k) v.x[k] += v.r[k];
    } else {
      h.fine.P.restrict_to(v.r.data(), w.coarse.front().b.data());
      coarse_cycle(h, w, on_face, 0);
      h.fine.P.add_to(w.coarse.front().x.data(), v.x.data());
    }
    if (face) face->project_change(v.x.data());
  }
  smooth.after(v);
}

/// The coarse levels follow a face of which w.on_face->moved are the nodes that have changed. Returns
/// how many of their rows that were.
template <int N, int M, class T>
index follow_face(hierarchy<N, M, T> const& h, cycle_workspace<N, M, T>& w) {
  auto& f = *w.on_face;
  if (f.moved.empty()) return 0;
  if (h.coarse.empty()) {
    if (h.factored) f.only.factor(h.fine.A, h.fine.A, f.face.formed_blocks());
    return 0;
  }
  constexpr int most = 256;
  bool const begins_again = ++f.changes > most;
  if (begins_again) {
    f.changes = 1;
    for (std::size_t l = 0; l < f.A.size(); ++l) {
      f.A[l] = h.coarse[l].A;
      f.inverses[l] = h.coarse[l].inverses;
      f.largest[l] = h.coarse[l].largest;
    }
    f.face.forget_levels(f.moved);
  }
  index rows = 0;
  for (std::size_t l = 0; l < f.A.size(); ++l) {
    if (l == 0) {
      galerkin_change(h.fine.A, h.fine.P, f.A[0], f.D[0], f.moved, f.parents, f.first_scratch,
                      f.face.change_of_blocks());
    } else {
      galerkin_change(f.D[l - 1], h.coarse[l - 1].P, f.A[l], f.D[l], f.moved, f.parents,
                      f.scratch[l - 1], whole_blocks{});
    }
    for (int const i : f.parents) {
      invert_diagonal(f.A[l], h.coarse[l].A, i, f.inverses[l].data());
    }
    if (h.degree > 0 && !f.parents.empty()) {
      f.largest[l] = largest_jacobi_eigenvalue(f.A[l], f.inverses[l].data(), w.coarse[l].x,
                                               w.coarse[l].r, true);
    }
    rows += static_cast<index>(f.parents.size());
    std::swap(f.moved, f.parents);
  }
  if (h.factored && (begins_again || !f.moved.empty())) {
    f.last.factor(f.A.back(), h.coarse.back().A, whole_blocks{});
  }
  return rows;
}

}  // namespace slant::detail
