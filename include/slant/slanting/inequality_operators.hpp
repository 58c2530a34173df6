// SPDX-License-Identifier: MIT
//
// Derivatives of the smooth inequalities f(x) ≤ 0 of a product of blocks, as operators:
//
//     inequality_jacobian      J = ∇f(x)ᵀ,  one row per inequality
//     inequality_curvature     (H, Jᵀ),  H = Σ zᵢ ∇²fᵢ(x): the derivative of (x, z) ↦ ∇f(x) z
//
// Both own their entries and share the layout, so that they can be renewed in place.
#pragma once

#include <slant/concepts/capabilities.hpp>
#include <slant/slanting/detail/inequality_layout.hpp>

#include <Eigen/Core>

#include <memory>
#include <utility>

namespace slant {

/// y = J x. Made by the slanting function `inequalities`.
template <class S>
class inequality_jacobian {
 public:
  using scalar = S;
  static constexpr law_set laws{};

  explicit inequality_jacobian(std::shared_ptr<detail::inequality_layout const> layout)
      : layout_(std::move(layout)), gradients_(layout_->gradients()) {}

  [[nodiscard]] index rows() const noexcept { return layout_->rows(); }
  [[nodiscard]] index cols() const noexcept { return layout_->cols(); }

  /// J at x.
  template <class Set, class X>
  void renew(Set const& set, X const& x) {
    index at = 0;
    slant::visit_blocks(set, [&](auto const& block, auto const& place) {
      using block_type = std::remove_cvref_t<decltype(block)>;
      constexpr int n = block_type::dimension;
      constexpr int k = block_type::inequalities;
      if constexpr (k > 0) {
        Eigen::Matrix<S, n, k> const g = block.inequality_gradient(place.value(x));
        for (int i = 0; i < k; ++i) {
          for (int j = 0; j < n; ++j) gradients_[at++] = g.coeff(j, i);
        }
      }
    });
  }

  template <class X, class Y>
  void apply(X const& x, Y& y) const {
    each(slant::local(x), slant::local(y), [](S const&, S const& sum) { return sum; });
  }
  template <class X, class Y>
  void apply_add(S const& α, X const& x, Y& y) const {
    each(slant::local(x), slant::local(y),
         [&α](S const& before, S const& sum) { return S(before + α * sum); });
  }
  template <class X, class Y>
  void apply_adjoint(X const& x, Y& y) const {
    slant::local(y).setZero();
    apply_adjoint_add(S(1), x, y);
  }
  template <class X, class Y>
  void apply_adjoint_add(S const& α, X const& z, Y& y) const {
    auto const& from = slant::local(z);
    auto& to = slant::local(y);
    visit([&](index row, index component, S const& entry) {
      to.coeffRef(component) += α * (entry * from.coeff(row));
    });
  }

  /// f(row, column, entry) for every entry that can differ from zero.
  template <class F>
  void visit(F const& f) const {
    for (auto const& run : layout_->runs()) {
      detail::with_block_size(run, [&](auto n, auto k) {
        S const* g = gradients_.data() + run.gradient;
        for (index i = 0; i < run.blocks; ++i, g += n * k) {
          index const first = run.first + i * run.step;
          for (index r = 0; r < k; ++r) {
            for (index j = 0; j < n; ++j) {
              f(run.row + i * k + r, first + j * stride(n, run), g[r * n + j]);
            }
          }
        }
      });
    }
  }

 private:
  template <class S2>
  friend class inequality_curvature;

  /// 1, as a constant, for the blocks whose size is one.
  template <class N>
  static index stride(N const&, detail::inequality_run const& run) {
    if constexpr (std::is_same_v<N, index>) {
      return run.stride;
    } else {
      return 1;
    }
  }
  /// y_row = result(y_row, (J x)_row).
  template <class X, class Y, class Result>
  void each(X const& x, Y& y, Result const& result) const {
    for (auto const& run : layout_->runs()) {
      detail::with_block_size(run, [&](auto n, auto k) {
        S const* g = gradients_.data() + run.gradient;
        index first = run.first;
        index row = run.row;
        for (index i = 0; i < run.blocks; ++i, first += run.step) {
          for (index r = 0; r < k; ++r, g += n, ++row) {
            S sum = g[0] * x.coeff(first);
            for (index j = 1; j < n; ++j) sum += g[j] * x.coeff(first + j * stride(n, run));
            y.coeffRef(row) = result(y.coeff(row), sum);
          }
        }
      });
    }
  }

  std::shared_ptr<detail::inequality_layout const> layout_;
  Eigen::Matrix<S, Eigen::Dynamic, 1> gradients_;
};

/// y = H dx + Jᵀdz for the argument (dx, dz). Made by the slanting function `inequality_forces`.
template <class S>
class inequality_curvature {
 public:
  using scalar = S;
  static constexpr law_set laws{};

  explicit inequality_curvature(std::shared_ptr<detail::inequality_layout const> layout)
      : jacobian_(layout), hessians_(layout->hessians()), curved_(layout->runs().size(), 0) {}

  [[nodiscard]] index rows() const noexcept { return jacobian_.cols(); }
  [[nodiscard]] index cols() const noexcept { return jacobian_.cols() + jacobian_.rows(); }
  /// J.
  [[nodiscard]] inequality_jacobian<S> const& jacobian() const noexcept { return jacobian_; }

  /// H and J at x with the multipliers z.
  template <class Set, class X, class Z>
  void renew(Set const& set, X const& x, Z const& z) {
    jacobian_.renew(set, x);
    index at = 0;
    index row = 0;
    slant::visit_blocks(set, [&](auto const& block, auto const& place) {
      using block_type = std::remove_cvref_t<decltype(block)>;
      constexpr int n = block_type::dimension;
      constexpr int k = block_type::inequalities;
      if constexpr (k > 0) {
        Eigen::Matrix<S, k, 1> const own = slant::local(z).template segment<k>(row);
        Eigen::Map<Eigen::Matrix<S, n, n>>(hessians_.data() + at) =
            block.inequality_hessian(place.value(x), own);
        at += n * n;
        row += k;
      }
    });
    classify();
  }

  template <class X, class Y>
  void apply(X const& x, Y& y) const {
    slant::local(y).setZero();
    apply_add(S(1), x, y);
  }
  /// y ← y + α (H dx + Jᵀdz).
  template <class X, class Y>
  void apply_add(S const& α, X const& x, Y& y) const {
    auto const& from = slant::local(x);
    auto& to = slant::local(y);
    index const n_all = jacobian_.cols();
    for_each_block(jacobian_, [&](auto const& run, auto n, auto k, auto curved, S const* g,
                                  S const* h, index first, index row) {
      for (index j = 0; j < n; ++j) {
        index const at = first + j * inequality_jacobian<S>::stride(n, run);
        S sum = g[j] * from.coeff(n_all + row);
        for (index r = 1; r < k; ++r) sum += g[r * n + j] * from.coeff(n_all + row + r);
        if constexpr (curved == diagonal) sum += h[j * n + j] * from.coeff(at);
        if constexpr (curved == full) {
          for (index l = 0; l < n; ++l) {
            sum += h[l * n + j] *
                   from.coeff(first + l * inequality_jacobian<S>::stride(n, run));
          }
        }
        to.coeffRef(at) += α * sum;
      }
    });
  }
  /// y = (H x; J x); H is symmetric.
  template <class X, class Y>
  void apply_adjoint(X const& x, Y& y) const {
    slant::local(y).setZero();
    apply_adjoint_add(S(1), x, y);
  }
  template <class X, class Y>
  void apply_adjoint_add(S const& α, X const& x, Y& y) const {
    auto const& from = slant::local(x);
    auto& to = slant::local(y);
    index const n = jacobian_.cols();
    visit_hessian([&](index i, index j, S const& h) { to.coeffRef(i) += α * (h * from.coeff(j)); });
    jacobian_.visit([&](index row, index component, S const& entry) {
      to.coeffRef(n + row) += α * (entry * from.coeff(component));
    });
  }

  /// f(row, column, entry) for the entries of H; runs of blocks without curvature are passed over.
  template <class F>
  void visit_hessian(F const& f) const {
    auto const& runs = jacobian_.layout_->runs();
    for (std::size_t i = 0; i < runs.size(); ++i) {
      if (curved_[i] != zero) visit_hessian(runs[i], f);
    }
  }
  /// The same for every entry that can ever differ from zero.
  template <class F>
  void visit_hessian_pattern(F const& f) const {
    for (auto const& run : jacobian_.layout_->runs()) visit_hessian(run, f);
  }

 private:
  static constexpr int zero = 0, diagonal = 1, full = 2;

  template <class F>
  void visit_hessian(detail::inequality_run const& run, F const& f) const {
    S const* h = hessians_.data() + run.hessian;
    for (index b = 0; b < run.blocks; ++b) {
      index const first = run.first + b * run.step;
      for (index j = 0; j < run.dimension; ++j) {
        for (index i = 0; i < run.dimension; ++i) {
          f(first + i * run.stride, first + j * run.stride, *h++);
        }
      }
    }
  }
  /// f(run, dimension, inequalities, curvature, J's entries, H's entries, component, row).
  template <class F>
  void for_each_block(inequality_jacobian<S> const& jacobian, F const& f) const {
    auto const& runs = jacobian.layout_->runs();
    for (std::size_t number = 0; number < runs.size(); ++number) {
      auto const& run = runs[number];
      detail::with_block_size(run, [&](auto n, auto k) {
        auto const loop = [&](auto curved) {
          S const* g = jacobian.gradients_.data() + run.gradient;
          S const* h = hessians_.data() + run.hessian;
          index first = run.first;
          index row = run.row;
          for (index i = 0; i < run.blocks; ++i) {
            f(run, n, k, curved, g, h, first, row);
            g += n * k;
            h += n * n;
            first += run.step;
            row += k;
          }
        };
        switch (curved_[number]) {
          case zero:
            return loop(std::integral_constant<int, zero>{});
          case diagonal:
            return loop(std::integral_constant<int, diagonal>{});
          default:
            return loop(std::integral_constant<int, full>{});
        }
      });
    }
  }
  /// Which runs of H are zero, which diagonal: balls and half lines need no more.
  void classify() {
    auto const& runs = jacobian_.layout_->runs();
    for (std::size_t number = 0; number < runs.size(); ++number) {
      auto const& run = runs[number];
      index const n = run.dimension;
      auto kind = zero;
      for (index i = 0; i < run.blocks * n * n; ++i) {
        if (hessians_[run.hessian + i] == S(0)) continue;
        kind = i % (n * n) % (n + 1) == 0 ? std::max(kind, diagonal) : full;
        if (kind == full) break;
      }
      curved_[number] = kind;
    }
  }

  inequality_jacobian<S> jacobian_;
  Eigen::Matrix<S, Eigen::Dynamic, 1> hessians_;
  std::vector<int> curved_;
};

}  // namespace slant
