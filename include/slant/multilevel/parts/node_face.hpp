// SPDX-License-Identifier: MIT
//
// A face as multigrid sees it: for each node i the projector Π_i onto the motions that are left and
// the curvature C_i ⪰ 0 of the boundary along them, so that
//
//     H = Π A Π + C,      Π = diag(Π_i),   C = diag(C_i).
//
// Nodes with Π_i = I and C_i = 0 are all but those of the surface and are not stored.
//
// Great curvature. A direction v in which C_i is λ, more than 1/√ε of A_ii, hardly moves, and in
// short scalars A_ii + C_i would forget A_ii. The levels hold such directions: they work with
// Π' = Π − v vᵀ and C' = C − λ v vᵀ. Their part of the inverse, v vᵀ/λ, is added at the end in
// double; what couples them to the others is ε^¼ of both at most.
//
// Lag. Coarse levels approximate. They follow a node whose Π' or C' has changed by a part of
// what it is or of A_ii, and no other: a surface that slides turns a little in every step.
#pragma once

#include <slant/base/entries.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/multilevel/block_matrix.hpp>
#include <slant/multilevel/parts/envelope_factor.hpp>
#include <slant/multilevel/parts/lanes.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace slant::detail {

/// A face that knows its blocks, as sets/curved_face.hpp does: f(row, column, Π_ij, C_ij) for the
/// entries of those where Π is not the identity or C not 0.
template <class F>
concept face_of_entries =
    requires(F const& face) { face.block_entries([](index, index, double, double) {}); };

template <int N, class T>
class node_face {
 public:
  using small = Eigen::Matrix<double, N, N>;
  static constexpr int stride = lanes<T, N>::size;

  /// Π_i and C_i.
  struct hold {
    small projector = small::Identity();
    small curvature = small::Zero();

    bool operator==(hold const& other) const {
      return projector == other.projector && curvature == other.curvature;
    }
  };
  /// What is known of a node of the surface; curvatures in units of the levels.
  struct node {
    int i = 0;                            ///< which
    hold own;                             ///< Π and C
    hold level;                           ///< Π' and C'
    hold formed;                          ///< those that the coarse levels know
    hold last;                            ///< those that they knew before the last assign
    small stiff_inverse = small::Zero();  ///< Σ v vᵀ/λ
    std::array<T, static_cast<std::size_t>(N) * stride> mask{};  ///< Π', columns of `stride`
  };

  node_face() = default;
  /// Nothing is held of n nodes whose diagonal blocks have the inverses `inverses` (as for the
  /// sweeps).
  node_face(int n, std::vector<T> inverses)
      : inverses_(inverses), free_(std::move(inverses)), place_(static_cast<std::size_t>(n), -1) {}

  [[nodiscard]] std::vector<node> const& surface() const { return surface_; }
  [[nodiscard]] T const* inverses() const { return inverses_.data(); }

  /// Becomes the face, its curvature times `weight`. `moved`: the nodes that the coarse levels have
  /// to follow. Returns whether anything changed at all. Throws bad_input if Π or C has entries
  /// between nodes, or Π_i is no projector.
  template <face_of_entries Face>
  bool assign(Face const& face, double weight, std::vector<double> const& diagonal,
              std::vector<int>& moved) {
    moved.clear();
    if (!read(face, weight)) return false;
    for (std::size_t k = 0; k < surface_.size(); ++k) {
      node& here = surface_[k];
      here.last = here.formed;
      if (changed_[k] == 0) continue;
      double const* const a = diagonal.data() + static_cast<std::size_t>(here.i) * (N * N);
      prepare(here, a);
      if (!follows(here, a)) continue;
      here.formed = here.level;
      moved.push_back(here.i);
    }
    return true;
  }
  /// As if the coarse levels had been formed with nothing held before the last assign.
  void forget_levels(std::vector<int>& moved) {
    moved.clear();
    for (node& here : surface_) {
      here.last = {};
      if (!here.formed.projector.isIdentity(0) || !here.formed.curvature.isZero(0)) {
        moved.push_back(here.i);
      }
    }
  }

  /// f(i, j, A_ij) → Π' A_ij Π' + δ_ij C' as the coarse levels have to know it.
  [[nodiscard]] auto formed_blocks() const {
    return [this, to = numbers()](int i, int j, T const* a) mutable {
      if (!find(i) && !find(j)) return a;
      small const b = block(&node::formed, i, j, a);
      for (std::size_t m = 0; m < N * N; ++m) to[m] = T(b.data()[m]);
      return static_cast<T const*>(to.data());
    };
  }
  /// The same less what it was before the last assign, for nodes that have moved.
  [[nodiscard]] auto change_of_blocks() const {
    return [this, to = numbers()](int i, int j, T const* a) mutable {
      small const b = block(&node::formed, i, j, a) - block(&node::last, i, j, a);
      for (std::size_t m = 0; m < N * N; ++m) to[m] = T(b.data()[m]);
      return static_cast<T const*>(to.data());
    };
  }

  /// r ← r − C'x.
  void subtract_curvature(T const* x, T* r) const {
    for (node const& here : surface_) {
      std::size_t const k = offset(here.i);
      for (int c = 0; c < N; ++c) {
        for (int q = 0; q < N; ++q) {
          r[k + std::size_t(q)] -= T(here.level.curvature(q, c)) * x[k + std::size_t(c)];
        }
      }
    }
  }
  /// r ← Π'r.
  void project(T* r) const {
    for (node const& here : surface_) project_at(here, r + offset(here.i));
  }
  /// y ← Π'y + factor Σ v vᵀx/λ, vectors of N numbers a node. Whether any v is held.
  template <class S>
  bool complete(S const* x, S* y, S const& factor) const {
    bool any = false;
    for (node const& here : surface_) {
      any = any || !here.stiff_inverse.isZero(0);
      S* const to = y + static_cast<index>(here.i) * N;
      S const* const from = x + static_cast<index>(here.i) * N;
      S sums[N];
      for (int q = 0; q < N; ++q) {
        sums[q] = S(0);
        for (int c = 0; c < N; ++c) {
          sums[q] += S(here.level.projector(q, c)) * to[c] +
                     S(here.stiff_inverse(q, c)) * (factor * from[c]);
        }
      }
      std::copy(sums, sums + N, to);
    }
    return any;
  }
  /// Keeps x on the surface, and gives it back with the projection of what was added to it.
  void remember(T const* x) {
    for (std::size_t k = 0; k < surface_.size(); ++k) {
      std::copy_n(x + offset(surface_[k].i), stride, kept_.data() + k * stride);
    }
  }
  void project_change(T* x) const {
    for (std::size_t k = 0; k < surface_.size(); ++k) {
      T* const here = x + offset(surface_[k].i);
      T const* const old = kept_.data() + k * stride;
      for (int c = 0; c < N; ++c) here[c] -= old[c];
      project_at(surface_[k], here);
      for (int c = 0; c < N; ++c) here[c] += old[c];
    }
  }

  /// By how much of what it was, or of A_ii, C' has to change, or Π' at all, until levels follow.
  static constexpr double lag = 0.05;

 private:
  using numbers = std::array<T, block_matrix<N, T>::padded_block>;

  [[nodiscard]] static std::size_t offset(int i) { return static_cast<std::size_t>(i) * stride; }
  [[gnu::always_inline]] static void project_at(node const& here, T* x) {
    lanes<T, N> s = lanes<T, N>::zero();
    for (int c = 0; c < N; ++c) s.add(here.mask.data() + stride * c, x[c]);
    s.store_padded(x);
  }
  [[nodiscard]] small block(hold node::*which, int i, int j, T const* entries) const {
    small b;
    for (int m = 0; m < N * N; ++m) b.data()[m] = static_cast<double>(entries[m]);
    if (node const* const here = find(i)) b = product_of((here->*which).projector, b);
    if (node const* const there = find(j)) {
      b = product_of(b, (there->*which).projector);
      if (i == j) b += (there->*which).curvature;
    }
    return b;
  }

  /// Node i, or null where it has always been free.
  [[nodiscard]] node const* find(int i) const {
    int const k = place_[static_cast<std::size_t>(i)];
    return k < 0 ? nullptr : &surface_[static_cast<std::size_t>(k)];
  }
  /// The place of node i, a new one if it has none.
  std::size_t at(int i) {
    int& place = place_[static_cast<std::size_t>(i)];
    if (place < 0) {
      place = static_cast<int>(surface_.size());
      node fresh;
      fresh.i = i;
      for (std::size_t c = 0; c < N; ++c) fresh.mask[(stride + 1) * c] = T(1);
      surface_.push_back(fresh);
      changed_.push_back(0);
      kept_.resize(surface_.size() * stride);
    }
    return static_cast<std::size_t>(place);
  }
  /// Π and C. Returns whether anything has changed.
  template <class Face>
  bool read(Face const& face, double weight) {
    now_.assign(surface_.size(), {});
    face.block_entries([&](index row, index column, auto const& π, auto const& c) {
      index const i = row / N;
      if (column / N != i) {
        if (π == 0 && c == 0) return;
        refuse(static_cast<std::size_t>(i));
      }
      std::size_t const k = at(static_cast<int>(i));
      if (k == now_.size()) now_.emplace_back();
      now_[k].projector(row % N, column % N) = static_cast<double>(π);
      now_[k].curvature(row % N, column % N) = weight * static_cast<double>(c);
    });
    // Before anything is taken over: a face that is refused leaves the last one.
    bool changed = false;
    for (std::size_t k = 0; k < surface_.size(); ++k) {
      changed_[k] = now_[k] == surface_[k].own ? 0 : 1;
      if (changed_[k] == 0) continue;
      require_projector(surface_[k].i, now_[k].projector);
      changed = true;
    }
    for (std::size_t k = 0; k < surface_.size(); ++k) surface_[k].own = now_[k];
    return changed;
  }
  [[noreturn, gnu::cold]] static void refuse(std::size_t i) {
    throw bad_input("face", "node " + show(static_cast<index>(i)) + " that moves with others",
                    "blocks of the set within the nodes of " + show(index(N)) + " unknowns");
  }
  [[nodiscard]] static double tolerance() {
    return std::sqrt(static_cast<double>(std::numeric_limits<T>::epsilon()));
  }

  /// Everything of a node that follows from Π and C; a is its diagonal block.
  void prepare(node& here, double const* a) {
    double trace = 0;
    for (int c = 0; c < N; ++c) trace += a[(N + 1) * c];
    double const largest = largest_of(here.own.curvature);
    here.level = here.own;
    here.stiff_inverse.setZero();
    if (largest > 0) hold_stiff_directions(here, a, trace / N);
    T* const inverse = inverses_.data() + offset(here.i) * N;
    if (largest == 0 && here.own.projector.isIdentity(0)) {
      std::copy_n(free_.data() + offset(here.i) * N, N * stride, inverse);
    } else {
      invert(here, a, trace / N, inverse);
    }
    for (int c = 0; c < N; ++c) {
      for (int q = 0; q < stride; ++q) {
        here.mask[static_cast<std::size_t>(stride * c + q)] =
            q < N ? T(here.level.projector(q, c)) : T(0);
      }
    }
  }
  /// The inverse of Π'(A_ii + C')Π' on range(Π'), 0 off it, to `to`.
  void invert(node const& here, double const* a, double unit, T* to) const {
    small const& p = here.level.projector;
    small h;
    for (int k = 0; k < N * N; ++k) h.data()[k] = a[k] + here.level.curvature.data()[k];
    h = product_of(p, product_of(h, p));
    double least[N], scale[N];
    for (int c = 0; c < N; ++c) {
      for (int q = 0; q < N; ++q) h(q, c) += unit * ((q == c ? 1.0 : 0.0) - p(q, c));
      scale[c] = a[(N + 1) * c];
      least[c] = 64 * std::numeric_limits<double>::epsilon() * scale[c];
    }
    invert_semidefinite<N>(h.data(), least, scale);
    h = product_of(p, product_of(h, p));
    for (int c = 0; c < N; ++c) {
      for (int q = 0; q < N; ++q) to[stride * c + q] = T(0.5 * (h(q, c) + h(c, q)));
    }
  }
  static void hold_stiff_directions(node& here, double const* a, double unit) {
    double const most = unit / tolerance();
    symmetric_eigen<double, N> const e(here.own.curvature);
    if (!(largest_of(e.values) > most)) return;
    here.level.curvature.setZero();
    for (int k = 0; k < N; ++k) {
      double const λ = e.values[k];
      small vv;
      double bent = 0;
      for (int c = 0; c < N; ++c) {
        for (int q = 0; q < N; ++q) {
          vv(q, c) = e.vectors(q, k) * e.vectors(c, k);
          bent += a[N * c + q] * vv(q, c);
        }
      }
      if (λ > most) {
        here.level.projector -= vv;
        here.stiff_inverse += vv / (λ + bent);
      } else if (std::abs(λ) > std::numeric_limits<double>::epsilon() * largest_of(e.values)) {
        here.level.curvature += λ * vv;
      }
    }
  }
  /// Whether the coarse levels have to follow.
  [[nodiscard]] static bool follows(node const& here, double const* a) {
    double trace = 0, turned = 0, bent = 0, size = 0;
    for (int c = 0; c < N; ++c) trace += a[(N + 1) * c];
    for (int k = 0; k < N * N; ++k) {
      turned = std::max(turned,
                        std::abs(here.level.projector.data()[k] - here.formed.projector.data()[k]));
      bent = std::max(bent,
                      std::abs(here.level.curvature.data()[k] - here.formed.curvature.data()[k]));
      size = std::max(size, std::abs(here.formed.curvature.data()[k]));
    }
    return turned > lag || bent > lag * (size + trace / N);
  }
  static void require_projector(int i, small const& p) {
    small const square = product_of(p, p);
    bool good = true;
    for (int k = 0; k < N * N; ++k) {
      double const mirrored = p.data()[(k % N) * N + k / N];
      good = good && std::abs(square.data()[k] - p.data()[k]) <= tolerance() &&
             std::abs(mirrored - p.data()[k]) <= tolerance();
    }
    if (!good) {
      throw bad_input("face", "no projector on node " + show(index(i)),
                      "a face that projects onto the motions that are left");
    }
  }

  std::vector<T> inverses_;  // of Π(A_ii + C)Π, all nodes
  std::vector<T> free_;      // of A_ii
  std::vector<int> place_;   // of each node in surface_, or −1
  std::vector<node> surface_;
  std::vector<unsigned char> changed_;
  std::vector<T> kept_;
  std::vector<hold> now_;  // what read finds
};

}  // namespace slant::detail
