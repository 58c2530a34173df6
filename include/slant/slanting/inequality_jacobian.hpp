// SPDX-License-Identifier: MIT
//
// The Jacobian J = ∇f(x)ᵀ of the smooth inequalities f(x) ≤ 0 of a product of blocks, as an
// operator: one row per inequality. It owns its entries and shares the layout, so that it can be
// renewed in place.
#pragma once

#include <slant/concepts/capabilities.hpp>
#include <slant/concepts/vector_algebra.hpp>
#include <slant/slanting/detail/inequality_layout.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

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

  /// c J at x.
  template <class Set, class X>
  void renew(Set const& set, X const& x, S const& c = S(1)) {
    index at = 0;
    slant::visit_blocks(set, [&](auto const& block, auto const& place) {
      using block_type = std::remove_cvref_t<decltype(block)>;
      constexpr int n = static_dimension_of<block_type>;
      constexpr int k = detail::inequalities_of<block_type>;
      if constexpr (k > 0) {
        Eigen::Matrix<S, n, k> const g = block.inequality_gradient(place.value(x));
        for (int i = 0; i < k; ++i) {
          for (int j = 0; j < n; ++j) gradients_[at++] = c * g.coeff(j, i);
        }
      }
    });
  }

  /// Row i times factors(i): other units of the inequalities.
  template <class F>
  void scale_rows(F const& factors) {
    auto const& c = slant::local(factors);
    for (auto const& run : layout_->runs()) {
      index at = run.gradient;
      for (index row = run.row; row < run.row + run.blocks * run.inequalities; ++row) {
        gradients_.segment(at, run.dimension) *= c.coeff(row);
        at += run.dimension;
      }
    }
  }

  template <class X, class Y>
  void apply(X const& x, Y& y) const {
    detail::by_columns(slant::local(x), slant::local(y), [&](auto const& from, auto& to) {
      each(from, to, [](auto&& target, auto const& sum) { target = sum; });
    });
  }
  template <class X, class Y>
  void apply_add(S const& α, X const& x, Y& y) const {
    detail::by_columns(slant::local(x), slant::local(y), [&](auto const& from, auto& to) {
      each(from, to, [&α](auto&& target, auto const& sum) { target += α * sum; });
    });
  }
  template <class X, class Y>
  void apply_adjoint(X const& x, Y& y) const {
    vectors::set_zero(y);
    apply_adjoint_add(S(1), x, y);
  }
  template <class X, class Y>
  void apply_adjoint_add(S const& α, X const& z, Y& y) const {
    detail::by_columns(slant::local(z), slant::local(y), [&](auto const& from, auto& to) {
      visit([&](index row, index component, S const& entry) {
        to.coeffRef(component) += α * (entry * from.coeff(row));
      });
    });
  }

  /// f(row, column, entry) for every entry that can differ from zero.
  template <class F>
  void visit(F const& f) const {
    for (auto const& run : layout_->runs()) {
      S const* entry = gradients_.data() + run.gradient;
      for (index i = 0; i < run.blocks; ++i) {
        for (index r = 0; r < run.inequalities; ++r) {
          for (index j = 0; j < run.dimension; ++j) {
            f(run.row + i * run.inequalities + r, run.first + i * run.step + j * run.stride,
              *entry++);
          }
        }
      }
    }
  }

  [[nodiscard]] detail::inequality_layout const& layout() const noexcept { return *layout_; }
  /// The entries of J, in the order of the layout.
  [[nodiscard]] auto const& entries() const noexcept { return gradients_; }

 private:
  /// put(y_row, (J x)_row), rows of blocks of one number all at once.
  template <class X, class Y, class Put>
  void each(X const& x, Y& y, Put const& put) const {
    for (auto const& run : layout_->runs()) {
      detail::with_block_size(run, [&](auto n, auto k, auto stride, auto step) {
        if constexpr (detail::is_one<decltype(n)> && detail::is_one<decltype(k)>) {
          put(y.segment(run.row, run.blocks), gradients_.segment(run.gradient, run.blocks)
                                                  .cwiseProduct(x.segment(run.first, run.blocks)));
        } else {
          S const* const g = gradients_.data() + run.gradient;
          for (index i = 0; i < run.blocks; ++i) {
            for (index r = 0; r < k; ++r) {
              index const own = (i * k + r) * n;
              S sum = g[own] * x.coeff(run.first + i * step);
              for (index j = 1; j < n; ++j) {
                sum += g[own + j] * x.coeff(run.first + i * step + j * stride);
              }
              put(y.coeffRef(run.row + i * k + r), sum);
            }
          }
        }
      });
    }
  }

  std::shared_ptr<detail::inequality_layout const> layout_;
  Eigen::Matrix<S, Eigen::Dynamic, 1> gradients_;
};

}  // namespace slant
