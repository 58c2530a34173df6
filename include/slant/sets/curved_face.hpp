// SPDX-License-Identifier: MIT
//
// The face that a Newton step moves in, with the curvature of the boundary of Λ along it.
//
// At z the projection P_Λ has the slanting operator G = diag(G₁, …, G_m), symmetric, 0 ⪯ G_i ⪯ I.
// A Newton step for the natural residual x − P_Λ(x − ρ r(x)) is a quadratic program on range(G),
//
//     minimise  q(x + t) + ½ tᵀ(C/ρ) t   over   t ∈ range(G),        C = G⁺ − I on range(G) ⪰ 0
//
// (derivation in slanting/symmetrized.hpp). C/ρ is the curvature of the boundary times the force
// that presses x against it: 0 for a block inside its set and for flat boundaries, (1 − τ)/(τρ)
// with τ = g/‖z‖ on the tangent of a disc. Both spaces are known block by block, and blocks inside
// their sets (G_i = I) or fixed (G_i = 0) are told by a mask: only curved ones store matrices.
#pragma once

#include <slant/base/entries.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/sets/blocks.hpp>

#include <Eigen/Core>

#include <limits>
#include <vector>

namespace slant {

/// range(G), C and W = (I + κC)⁻¹ on range(G) at a point; vectors have the dimension of the set.
/// Outputs must not alias inputs.
template <scalar S = double>
class curved_face {
 public:
  /// Room for the blocks of a set; nothing is known yet. Allocates.
  template <class C>
  explicit curved_face(C const& set)
      : mask_(slant::dimension_of(set)), curved_(static_cast<std::size_t>(mask_.size()), false) {
    std::size_t entries = 0;
    slant::visit_blocks(set, [&](auto const& block, auto const& p) {
      if constexpr (!whole_space<std::remove_cvref_t<decltype(block)>>) {
        entries += static_cast<std::size_t>(p.size() * p.size());
      }
    });
    mask_.setOnes();
    blocks_.reserve(static_cast<std::size_t>(slant::block_count(set)));
    components_.reserve(static_cast<std::size_t>(mask_.size()));
    held_.reserve(static_cast<std::size_t>(mask_.size()));
    matrices_.reserve(3 * entries);
  }

  /// Becomes the face at z. κ ≥ 0 is the weight of the curvature in W. Does not allocate.
  template <class C, class Z>
  void assign(C const& set, Z const& z, S const& κ) {
    blocks_.clear();
    for (index const component : components_) curved_[static_cast<std::size_t>(component)] = false;
    components_.clear();
    held_.clear();
    matrices_.clear();
    slant::visit_blocks(set, [&](auto const& block, auto const& p) {
      using block_type = std::remove_cvref_t<decltype(block)>;
      if constexpr (!whole_space<block_type>) {
        Eigen::Matrix<S, block_type::dimension, block_type::dimension> const g =
            block.slant(p.value(z));
        add(g, p, κ);
      }
    });
  }

  /// Number of blocks with some, but not every motion left.
  [[nodiscard]] index curved_count() const { return static_cast<index>(blocks_.size()); }

  /// f(component) for those of the blocks with some, but not every motion left.
  template <class F>
  void curved_components(F f) const {
    for (index const component : components_) f(component);
  }

  /// y = Π x, the orthogonal projection onto range(G).
  template <class X, class Y>
  void keep(X const& x, Y& y) const {
    transform(range_projector, slant::local(x), slant::local(y));
  }

  /// y = W x, 0 off range(G).
  template <class X, class Y>
  void weigh(X const& x, Y& y) const {
    transform(range_weight, slant::local(x), slant::local(y));
  }

  /// f(row, column, value) for the entries of Π that are not zero because of where they stand.
  template <class F>
  void projector_entries(F f) const {
    for (index i = 0; i < mask_.size(); ++i) {
      if (!curved_[static_cast<std::size_t>(i)] && mask_[i] != S(0)) f(i, i, S(1));
    }
    for_each([&](auto entry, index const* component, index n) {
      for (index j = 0; j < n; ++j) {
        for (index l = 0; l < n; ++l) f(component[j], component[l], entry(range_projector, j, l));
      }
    });
  }

  /// f(row, column, Π_ij, C_ij) for the blocks that have not every motion: their entries, of fixed
  /// blocks those of the diagonal. Elsewhere Π is the identity and C is 0.
  template <class F>
  void block_entries(F f) const {
    for (index const i : held_) f(i, i, S(0), S(0));
    for_each([&](auto entry, index const* component, index n) {
      for (index j = 0; j < n; ++j) {
        for (index l = 0; l < n; ++l) {
          f(component[j], component[l], entry(range_projector, j, l), entry(range_curvature, j, l));
        }
      }
    });
  }

  /// y ← y + α C x.
  template <class X, class Y>
  void add_curvature(S const& α, X const& x, Y& y) const {
    auto const& from = slant::local(x);
    auto& to = slant::local(y);
    for_each([&](auto entry, index const* component, index n) {
      for (index j = 0; j < n; ++j) {
        S sum(0);
        for (index l = 0; l < n; ++l)
          sum += entry(range_curvature, j, l) * from.coeff(component[l]);
        to.coeffRef(component[j]) += α * sum;
      }
    });
  }

 private:
  enum kind : int { range_projector, range_curvature, range_weight };

  struct curved_block {
    std::size_t component;  // first of its components
    std::size_t matrix;     // first entry of its three matrices
    index size;
  };

  template <class G, class P>
  void add(G const& g, P const& p, S const& κ) {
    constexpr int N = G::RowsAtCompileTime;
    bool inside = true;
    for (int j = 0; j < N * N; ++j) inside = inside && g.data()[j] == S(j % (N + 1) == 0 ? 1 : 0);
    // Nor is there a motion where G is so small that 1/γ leaves the range of the numbers.
    S const least = std::numeric_limits<S>::min() / std::numeric_limits<S>::epsilon();
    bool fixed = true;
    for (int j = 0; j < N; ++j) fixed = fixed && !(g.data()[j * (N + 1)] > least);
    for (index j = 0; j < N; ++j) {
      mask_.coeffRef(p.component(j)) = fixed ? S(0) : S(1);
      if (fixed) held_.push_back(p.component(j));
    }
    if (inside || fixed) return;

    blocks_.push_back({components_.size(), matrices_.size(), N});
    for (index j = 0; j < N; ++j) {
      components_.push_back(p.component(j));
      curved_[static_cast<std::size_t>(p.component(j))] = true;
    }
    detail::symmetric_eigen<S, N> const spectrum(g);
    // An eigenvalue that is only a rounding error of the largest one is no motion.
    S const zero =
        S(4 * N) * std::numeric_limits<S>::epsilon() * detail::largest_of(spectrum.values);
    auto const append = [&](auto of) {
      std::size_t const first = matrices_.size();
      matrices_.resize(first + N * N, S(0));
      for (int j = 0; j < N; ++j) {
        S const γ = spectrum.values[j] < S(1) ? spectrum.values[j] : S(1);
        if (!(γ > zero)) continue;
        S const weight = of(γ);
        S const* const v = spectrum.vectors.data() + N * j;
        for (int k = 0; k < N * N; ++k) {
          matrices_[first + std::size_t(k)] += weight * v[k % N] * v[k / N];
        }
      }
    };
    append([](S const&) { return S(1); });
    append([](S const& γ) { return S((S(1) - γ) / γ); });
    append([&](S const& γ) { return S(γ / (γ + κ * (S(1) - γ))); });
  }

  /// f(entry(kind, row, column), its components, how many) for each curved block.
  template <class F>
  void for_each(F&& f) const {
    for (auto const& b : blocks_) {
      S const* const first = matrices_.data() + b.matrix;
      index const n = b.size;
      f([=](kind k, index i, index j) { return first[(k * n + j) * n + i]; },
        components_.data() + b.component, n);
    }
  }

  template <class X, class Y>
  void transform(kind k, X const& x, Y& y) const {
    vectors::keep(mask_, x, y);
    for_each([&](auto entry, index const* component, index n) {
      for (index j = 0; j < n; ++j) {
        S sum(0);
        for (index l = 0; l < n; ++l) sum += entry(k, j, l) * x.coeff(component[l]);
        y.coeffRef(component[j]) = sum;
      }
    });
  }

  Eigen::Matrix<S, Eigen::Dynamic, 1> mask_;  // 0 on fixed blocks
  std::vector<bool> curved_;                  // components of curved blocks
  std::vector<curved_block> blocks_;
  std::vector<index> components_;
  std::vector<index> held_;  // components of fixed blocks
  std::vector<S> matrices_;
};

}  // namespace slant
