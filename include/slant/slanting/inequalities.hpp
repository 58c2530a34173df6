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

#include <slant/slanting/inequality_curvature.hpp>
#include <slant/slanting/slanting_base.hpp>

#include <memory>
#include <utility>

namespace slant {

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
    index row = 0;
    slant::visit_blocks(set_.get(), [&](auto const& block, auto const& place) {
      constexpr int k = detail::inequalities_of<std::remove_cvref_t<decltype(block)>>;
      if constexpr (k > 0) {
        f.template segment<k>(row) = scalar_t<X>(c_) * block.inequality(place.value(x));
        row += k;
      }
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
  /// c.
  [[nodiscard]] S const& factor() const noexcept { return c_; }

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
    index row = cols() - layout_->rows();
    slant::visit_blocks(set_.get(), [&](auto const& block, auto const& place) {
      constexpr int k = detail::inequalities_of<std::remove_cvref_t<decltype(block)>>;
      if constexpr (k > 0) {
        auto const g = block.inequality_gradient(place.value(y)).eval();
        place.put(force, (g * z.template segment<k>(row)).eval());
        row += k;
      }
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
