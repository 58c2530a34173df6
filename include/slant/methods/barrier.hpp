// SPDX-License-Identifier: MIT
//
// What the inequalities f(x) ≤ 0 of a product of blocks contribute to an interior-point method at a
// point with slacks z = −f(x) > 0 and multipliers ν > 0 [K §3.2.1, §3.2.3]:
//
//     G = ∇f(x),   D₂₂ = N⁻¹Z,   W = Σ ν_i ∇²f_i + G D₂₂⁻¹ Gᵀ,   P_SC = diag(A) + W.
//
// J_SC = A + W. All of W and P_SC is made of small blocks, one for each block of the set with an
// inequality; free blocks have no row, no multiplier, no slack and no entry here.
//
// Units. f of a disc is a square of lengths, that of an ellipse a pure number. Each f_i is divided
// by a power of two σ_i such that z_i is of the order of the distance to the boundary; multipliers
// are then forces, whatever form a block gives to its inequality.
//
// W is semidefinite even where an f_i is not convex: with z = −f(x), ν_i (∇²f_i + ∇f_i ∇f_iᵀ/z_i)
// is ν_i z_i times the Hessian of −log(−f_i), and that is convex for cones as well.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/methods/lorentz_pairs.hpp>
#include <slant/operators/detail/definite_inverse.hpp>
#include <slant/operators/small_blocks.hpp>
#include <slant/slanting/inequality_jacobian.hpp>

#include <Eigen/Core>

#include <limits>
#include <memory>
#include <type_traits>
#include <vector>

namespace slant {

/// The inequalities of a set with their derivatives at a point. Rows: one per inequality, in the
/// order of the blocks.
template <scalar S = double>
class barrier {
 public:
  using column = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using curvature_operator = small_blocks<S>;
  using stiffness_operator = small_blocks<S, laws<positive_semidefinite>>;
  using preconditioner_operator = small_blocks<S, laws<positive_semidefinite>>;

  /// Room for the blocks of a set; allocates.
  template <class C>
  explicit barrier(C const& set)
      : layout_(std::make_shared<detail::inequality_layout const>(set)),
        jacobian_(layout_),
        curvature_(layout_->cols()),
        stiffness_(layout_->cols()),
        preconditioner_(layout_->cols()),
        per_unit_(column::Zero(layout_->rows())),
        outside_(column::Zero(layout_->cols())) {
    slant::visit_blocks(set, [this](auto const& block, auto const& place) {
      using block_type = std::remove_cvref_t<decltype(block)>;
      if constexpr (single_point<block_type>) hold(place);
      if constexpr (detail::inequalities_of<block_type> > 0) {
        index const stride = place.size() > 1 ? place.component(1) - place.component(0) : 1;
        curvature_.append(place.size(), place.component(0), stride);
        stiffness_.append(place.size(), place.component(0), stride);
        preconditioner_.append(place.size(), place.component(0), stride);
      }
    });
  }

  /// Number of inequalities; some of them may be without a bound and then count for nothing.
  [[nodiscard]] index rows() const noexcept { return layout_->rows(); }
  /// 1/σ, 0 for an inequality without a bound.
  [[nodiscard]] column& per_unit() noexcept { return per_unit_; }
  [[nodiscard]] column const& per_unit() const noexcept { return per_unit_; }
  /// G ᵀ, in units σ.
  [[nodiscard]] inequality_jacobian<S> const& jacobian() const noexcept { return jacobian_; }
  /// Σ ν_i ∇²f_i.
  [[nodiscard]] curvature_operator const& curvature() const noexcept { return curvature_; }
  /// W.
  [[nodiscard]] stiffness_operator const& stiffness() const noexcept { return stiffness_; }
  /// P_SC⁻¹; 0 on components of single points.
  [[nodiscard]] preconditioner_operator const& preconditioner() const noexcept {
    return preconditioner_;
  }

  /// z = −f(x)/σ, 1 where there is no bound; whether all are numbers > 0.
  template <class C, class X, class Z>
  [[nodiscard]] bool slacks(C const& set, X const& x, Z& z) const {
    auto& out = slant::local(z);
    index row = 0;
    bool inside = true;
    slant::visit_blocks(set, [&](auto const& block, auto const& place) {
      constexpr int k = detail::inequalities_of<std::remove_cvref_t<decltype(block)>>;
      if constexpr (k > 0) {
        auto const f = block.inequality(place.value(x));
        for (index i = 0; i < k; ++i, ++row) {
          bool const bound = per_unit_.coeff(row) > S(0);
          out.coeffRef(row) = bound ? S(-f.coeff(i) * per_unit_.coeff(row)) : S(1);
          inside = inside && out.coeff(row) > S(0);
        }
      }
    });
    return inside;
  }

  /// G at x.
  template <class C, class X>
  void linearise(C const& set, X const& x) {
    jacobian_.renew(set, x);
    jacobian_.scale_rows(per_unit_);
  }

  /// Σ ν_i ∇²f_i, W and P_SC⁻¹ at x, where G is, for the diagonal d of A. `unit` is that of ν.
  template <class C, class X, class M, class Z, class D>
  void assemble(C const& set, X const& x, M const& ν, Z const& z, S const& unit, D const& d) {
    assemble(set, x, ν, z, unit, d, no_pairs{});
  }
  /// The same where bounded sections of the Lorentz cone have W from their pairs.
  template <class C, class X, class M, class Z, class D, class Pairs>
  void assemble(C const& set, X const& x, M const& ν, Z const& z, S const& unit, D const& d,
                Pairs const& pairs) {
    lorentz_place of_pairs;
    auto const& multipliers = slant::local(ν);
    auto const& slack = slant::local(z);
    auto const& diagonal = slant::local(d);
    index row = 0, entry = 0, number = 0;
    slant::visit_blocks(set, [&](auto const& block, auto const& place) {
      using block_type = std::remove_cvref_t<decltype(block)>;
      constexpr int n = static_dimension_of<block_type>;
      constexpr int k = detail::inequalities_of<block_type>;
      if constexpr (k > 0) {
        using square = Eigen::Matrix<S, n, n>;
        Eigen::Matrix<S, k, 1> forces, weights;
        for (int i = 0; i < k; ++i) {
          forces[i] = unit * multipliers.coeff(row + i);
          weights[i] = forces[i] * per_unit_.coeff(row + i);
        }
        square w = block.inequality_hessian(place.value(x), weights);
        curvature_.template block<n>(number) = w;
        for (int i = 0; i < k; ++i) {
          S const stiff = forces[i] / slack.coeff(row + i);
          S const* const g = jacobian_.entries().data() + entry + n * i;
          for (int c = 0; c < n; ++c) {
            for (int r = 0; r < n; ++r) w.data()[r + n * c] += (stiff * g[r]) * g[c];
          }
        }
        replace_by_pairs(block, pairs, of_pairs, row, unit, w);
        stiffness_.template block<n>(number) = w;
        for (int j = 0; j < n; ++j) w.data()[j + n * j] += diagonal.coeff(place.component(j));
        preconditioner_.template block<n>(number) = detail::definite_inverse(w);
        row += k;
        entry += k * n;
        ++number;
      }
    });
    outside_ = diagonal.cwiseInverse();
    keep_fixed(outside_);
    preconditioner_.assign_outside(outside_);
  }

  /// Counts the components of a block as those of a single point.
  template <class Place>
  void hold(Place const& place) {
    for (index j = 0; j < place.size(); ++j) fixed_.push_back(place.component(j));
  }
  /// Zero on the components of single points.
  template <class V>
  void keep_fixed(V& v) const {
    auto& entries = slant::local(v);
    for (index const i : fixed_) entries.coeffRef(i) = S(0);
  }

 private:
  struct no_pairs {};

  /// W of a block from its pairs, where it has some.
  template <class B, class Pairs, class W>
  static void replace_by_pairs(B const& block, Pairs const& pairs, lorentz_place& of_pairs,
                               index row, S const& unit, W& w) {
    if constexpr (std::is_same_v<Pairs, lorentz_pairs<S>> && lorentz_block<B>) {
      auto const at = of_pairs.template next<B>(row);
      if (pairs.bound(at.number)) w = detail::multiple_of(unit, pairs.stiffness(block, at));
    }
  }

  std::shared_ptr<detail::inequality_layout const> layout_;
  inequality_jacobian<S> jacobian_;
  curvature_operator curvature_;
  stiffness_operator stiffness_;
  preconditioner_operator preconditioner_;
  column per_unit_;
  column outside_;
  std::vector<index> fixed_;
};

}  // namespace slant
