// SPDX-License-Identifier: MIT
//
// The smooth inequalities f(x) ≤ 0 that describe a product of blocks, as slanting functions, and
// the forces that multipliers z of them exert:
//
//     inequalities(Λ, c)       x ↦ c f(x),                  derivative c J,  J = ∇f(x)ᵀ
//     inequality_forces(Λ)     (x, z) ↦ Σ zᵢ ∇fᵢ(x),        derivative (Σ zᵢ ∇²fᵢ(x), Jᵀ)
//
// For bounds x₁ ≥ l and circles x₂² + x₃² ≤ g² these are l − x₁, x₂² + x₃² − g² and the multiplier
// terms of [T (2.3)–(2.5)]; any block with a smooth inequality form will do.
#pragma once

#include <slant/base/vector_algebra.hpp>
#include <slant/slanting/inequality_jacobian.hpp>
#include <slant/slanting/slanting_part.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace slant {

// --- inequality curvature ------------------------------------------------------------------------
//
// The derivative (H, Jᵀ) of the forces (x, z) ↦ ∇f(x) z that multipliers exert, as an operator:
// H = Σ zᵢ ∇²fᵢ(x), J = ∇f(x)ᵀ. H consists of small diagonal blocks; those of bounds are zero,
// those of balls multiples of I, and it is looked at each time which are.

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
    detail::visit_inequalities(
        set, [&](auto const& block, auto const& place, auto n, auto k, index row) {
          Eigen::Matrix<S, k, 1> const own = slant::local(z).template segment<k>(row);
          Eigen::Map<Eigen::Matrix<S, n, n>>(hessians_.data() + at) =
              block.inequality_hessian(place.value(x), own);
          at += n * n;
        });
    classify();
  }

  template <class X, class Y>
  void apply(X const& x, Y& y) const {
    vectors::set_zero(y);
    apply_add(S(1), x, y);
  }
  /// y ← y + α (H dx + Jᵀdz).
  template <class X, class Y>
  void apply_add(S const& α, X const& x, Y& y) const {
    detail::by_columns(slant::local(x), slant::local(y),
                       [&](auto const& from, auto& to) { add_column(α, from, to); });
  }
  /// y = (H x; J x); H is symmetric.
  template <class X, class Y>
  void apply_adjoint(X const& x, Y& y) const {
    vectors::set_zero(y);
    apply_adjoint_add(S(1), x, y);
  }
  template <class X, class Y>
  void apply_adjoint_add(S const& α, X const& x, Y& y) const {
    detail::by_columns(slant::local(x), slant::local(y),
                       [&](auto const& from, auto& to) { add_adjoint_column(α, from, to); });
  }

  /// f(row, column, entry) for the entries of H; runs of blocks without curvature are passed over.
  template <class F>
  void visit_hessian(F const& f) const {
    auto const& runs = jacobian_.layout().runs();
    for (std::size_t i = 0; i < runs.size(); ++i) {
      if (curved_[i] != zero) visit_hessian(runs[i], f);
    }
  }
  /// The same for every entry that can ever differ from zero.
  template <class F>
  void visit_hessian_pattern(F const& f) const {
    for (auto const& run : jacobian_.layout().runs()) visit_hessian(run, f);
  }

 private:
  static constexpr int zero = 0, diagonal = 1, full = 2;

  /// to ← to + α (H dx + Jᵀdz), from = (dx, dz).
  template <class X, class Y>
  void add_column(S const& α, X const& from, Y& to) const {
    for_each_run([&](auto const& run, auto curved, auto n, auto k, auto stride, auto step) {
      S const* const g = jacobian_.entries().data() + run.gradient;
      S const* const h = hessians_.data() + run.hessian;
      index const z = jacobian_.cols() + run.row;
      if constexpr (detail::is_one<decltype(n)> && detail::is_one<decltype(k)> && curved == zero) {
        to.segment(run.first, run.blocks) += α * jacobian_.entries()
                                                     .segment(run.gradient, run.blocks)
                                                     .cwiseProduct(from.segment(z, run.blocks));
        return;
      }
      for (index i = 0; i < run.blocks; ++i) {
        index const first = run.first + i * step;
        detail::repeat(n, [&](auto j) {
          S sum = g[i * k * n + j] * from.coeff(z + i * k);
          for (index r = 1; r < k; ++r) sum += g[(i * k + r) * n + j] * from.coeff(z + i * k + r);
          if constexpr (curved == diagonal) {
            sum += h[(i * n + j) * n + j] * from.coeff(first + j * stride);
          }
          if constexpr (curved == full) {
            for (index l = 0; l < n; ++l) {
              sum += h[(i * n + l) * n + j] * from.coeff(first + l * stride);
            }
          }
          to.coeffRef(first + j * stride) += α * sum;
        });
      }
    });
  }
  /// to ← to + α (H x; J x).
  template <class X, class Y>
  void add_adjoint_column(S const& α, X const& from, Y& to) const {
    index const n = jacobian_.cols();
    visit_hessian([&](index i, index j, S const& h) { to.coeffRef(i) += α * (h * from.coeff(j)); });
    jacobian_.visit([&](index row, index component, S const& entry) {
      to.coeffRef(n + row) += α * (entry * from.coeff(component));
    });
  }

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
  /// f(run, curvature, dimension, inequalities, stride, step), constants where they can be.
  template <class F>
  void for_each_run(F const& f) const {
    auto const& runs = jacobian_.layout().runs();
    for (std::size_t number = 0; number < runs.size(); ++number) {
      auto const& run = runs[number];
      detail::with_block_size(run, [&](auto n, auto k, auto stride, auto step) {
        switch (curved_[number]) {
          case zero:
            return f(run, std::integral_constant<int, zero>{}, n, k, stride, step);
          case diagonal:
            return f(run, std::integral_constant<int, diagonal>{}, n, k, stride, step);
          default:
            return f(run, std::integral_constant<int, full>{}, n, k, stride, step);
        }
      });
    }
  }
  /// Which runs of H are zero, which diagonal: balls and half lines need no more.
  void classify() {
    auto const& runs = jacobian_.layout().runs();
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

namespace detail {

/// Says which block has no smooth inequality form.
struct inequality_form_check {
  template <class Block, class Place>
  void operator()(Block const&, Place const&) const {
    static_assert(has_inequality_form<Block, point_t<Block>>,
                  "inequalities: every block of the set must have a smooth inequality form");
  }
};

}  // namespace detail

/// x ↦ c f(x). C is `Set const&` (referenced) or a set type (owned).
template <class C, class S>
class inequality_map : public slanting_base {
  using set_type = std::remove_cvref_t<C>;

 public:
  inequality_map(held<C> set, std::shared_ptr<detail::inequality_layout const> layout, S c)
      : set_(std::move(set)), layout_(std::move(layout)), c_(std::move(c)) {}

  [[nodiscard]] index rows() const noexcept { return layout_->rows(); }
  [[nodiscard]] index cols() const noexcept { return layout_->cols(); }

  template <has_local X, class V>
  void value(X const& x, V& v) const {
    auto& f = slant::local(v);
    detail::visit_inequalities(
        set_.get(), [&](auto const& block, auto const& place, auto, auto k, index row) {
          f.template segment<k>(row) = scalar_t<X>(c_) * block.inequality(place.value(x));
        });
  }
  template <has_local X>
  [[nodiscard]] auto slant(X const& x) const {
    inequality_jacobian<scalar_t<X>> j(layout_);
    slant(x, j);
    return j;
  }
  template <has_local X>
  void slant(X const& x, inequality_jacobian<scalar_t<X>>& j) const {
    j.renew(set_.get(), x, scalar_t<X>(c_));
  }

 private:
  held<C> set_;
  std::shared_ptr<detail::inequality_layout const> layout_;
  S c_;
};

/// (x, z) ↦ Σ zᵢ ∇fᵢ(x). C is `Set const&` (referenced) or a set type (owned).
template <class C>
class inequality_force_map : public slanting_base {
  using set_type = std::remove_cvref_t<C>;

 public:
  inequality_force_map(held<C> set, std::shared_ptr<detail::inequality_layout const> layout)
      : set_(std::move(set)), layout_(std::move(layout)) {}

  [[nodiscard]] index rows() const noexcept { return layout_->cols(); }
  [[nodiscard]] index cols() const noexcept { return layout_->cols() + layout_->rows(); }

  template <has_local Y, class V>
  void value(Y const& y, V& v) const {
    auto& force = slant::local(v);
    force.setZero();
    auto const& z = slant::local(y);
    index const first = cols() - layout_->rows();
    detail::visit_inequalities(set_.get(),
                               [&](auto const& block, auto const& place, auto, auto k, index row) {
                                 auto const g = block.inequality_gradient(place.value(y)).eval();
                                 place.put(force, (g * z.template segment<k>(first + row)).eval());
                               });
  }
  template <has_local Y>
  [[nodiscard]] auto slant(Y const& y) const {
    inequality_curvature<scalar_t<Y>> h(layout_);
    slant(y, h);
    return h;
  }
  template <has_local Y>
  void slant(Y const& y, inequality_curvature<scalar_t<Y>>& h) const {
    h.renew(set_.get(), y, slant::local(y).tail(layout_->rows()));
  }

 private:
  held<C> set_;
  std::shared_ptr<detail::inequality_layout const> layout_;
};

/// x ↦ c f(x), one value per smooth inequality, block after block. An lvalue is referenced. The
/// factor is part of the entries, other than with scale(), which costs a pass over the values.
/// @throws bad_input if c is NaN or infinite.
template <class C, class S = int>
[[nodiscard]] auto inequalities(C&& set, S c = S(1)) {
  slant::visit_blocks(set, detail::inequality_form_check{});
  if (!detail::is_finite(c)) throw bad_input("c", detail::show(c), "a finite number");
  auto layout = std::make_shared<detail::inequality_layout const>(set);
  return inequality_map<kept_t<C>, S>(std::forward<C>(set), std::move(layout), std::move(c));
}

/// (x, z) ↦ Σ zᵢ ∇fᵢ(x) with one multiplier per inequality. An lvalue is referenced.
template <class C>
[[nodiscard]] auto inequality_forces(C&& set) {
  slant::visit_blocks(set, detail::inequality_form_check{});
  auto layout = std::make_shared<detail::inequality_layout const>(set);
  return inequality_force_map<kept_t<C>>(std::forward<C>(set), std::move(layout));
}

}  // namespace slant
