// SPDX-License-Identifier: MIT
//
// The support function of a convex set,
//
//     σ_Λ(x) = sup { xᵀv : v ∈ Λ },        prox_{ρσ}(z) = z − ρ P_Λ(z/ρ)          [Moreau 1965]
//
// which is every norm and every friction law: g‖x‖ of the disc of radius g, Σ wᵢ|xᵢ| of the box
// [−w, w], c max(0, x) of [0, c], the indicator of {x ≤ 0} of the half line. Its conjugate is the
// indicator of Λ, and v = P_Λ(z/ρ) the subgradient that belongs to prox(z). So everything follows
// from the projection, block by block.
#pragma once

#include <slant/base/held.hpp>
#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/face.hpp>
#include <slant/concepts/laws.hpp>
#include <slant/concepts/proximable.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/sets/blocks.hpp>
#include <slant/sets/slants.hpp>

#include <Eigen/Core>

#include <concepts>
#include <limits>
#include <type_traits>
#include <utility>

namespace slant {

namespace detail {

/// y = x − G x, for the slanting operator G of a projection.
template <class G, class V>
class complement_slant {
 public:
  static constexpr law_set laws = slant::laws<slant::self_adjoint, slant::firmly_nonexpansive>;

  explicit complement_slant(G g, V scaled) : g_(std::move(g)), scaled_(std::move(scaled)) {}

  [[nodiscard]] index rows() const { return g_.rows(); }
  [[nodiscard]] index cols() const { return g_.cols(); }
  template <class X, class Y>
  void apply(X const& x, Y& y) const {
    g_.apply(x, y);
    slant::local(y) = slant::local(x) - slant::local(y);
  }
  template <class D>
  void diagonal(D& d) const
    requires requires(G const& g, D& e) { g.diagonal(e); }
  {
    g_.diagonal(d);
    slant::local(d).array() = scalar_t<D>(1) - slant::local(d).array();
  }

  /// G, and the point of it.
  [[nodiscard]] G& part() { return g_; }
  [[nodiscard]] V& scaled() { return scaled_; }

 private:
  G g_;
  V scaled_;
};

}  // namespace detail

/// σ_Λ for a set Λ with support(x) that is a block or made of blocks. C is `Set const&`
/// (referenced) or a set type (owned).
template <class C>
class support_function : public detail::static_size<static_dimension_of<C>> {
  using set_type = std::remove_cvref_t<C>;
  static constexpr int n = static_dimension_of<C>;

 public:
  using scalar = set_scalar_t<C>;

  explicit support_function(held<C> set) : set_(std::move(set)) {}

  /// Λ.
  [[nodiscard]] set_type const& part() const { return set_.get(); }
  /// σ of the block with other parameters, as `power` asks for it.
  template <class... Params>
    requires std::same_as<C, set_type> && detail::takes_parameters<set_type, Params...>
  [[nodiscard]] support_function with(Params const&... params) const {
    return support_function(held<C>(set_type(part().with(params...))));
  }
  [[nodiscard]] index size() const { return slant::dimension_of(part()); }
  [[nodiscard]] index block_count() const { return slant::block_count(part()); }

  /// prox_{ρσ}(z), ρ > 0: exactly 0 where z/ρ is in Λ.
  template <class S, class Z>
    requires(n != Eigen::Dynamic)
  [[nodiscard]] auto prox(S const& ρ, Z const& z) const {
    Eigen::Matrix<S, n, 1> const from = z;
    Eigen::Matrix<S, n, 1> const scaled = from / ρ;
    Eigen::Matrix<S, n, 1> const v = slant::project(part(), scaled);
    Eigen::Matrix<S, n, 1> x;
    for (int j = 0; j < n; ++j) {
      x.coeffRef(j) = v.coeff(j) == scaled.coeff(j) ? S(0) : S(from.coeff(j) - ρ * v.coeff(j));
    }
    return x;
  }
  template <class S, class Z, class X>
    requires(n == Eigen::Dynamic) && has_visit<set_type>
  void prox(S const& ρ, Z const& z, X&& x) const {
    visit([&](auto const& block, auto const& p) { p.put(x, block.prox(ρ, p.value(z))); });
  }

  /// σ(x), ∞ allowed.
  template <class X>
    requires has_support<set_type, X>
  [[nodiscard]] scalar_t<X> value(X const& x) const {
    return part().support(x);
  }
  /// The indicator of Λ, up to rounding.
  template <class V>
  [[nodiscard]] scalar_t<V> conjugate(V const& v) const {
    return part().contains(v) ? scalar_t<V>(0) : std::numeric_limits<scalar_t<V>>::infinity();
  }

  /// I − P_Λ°(z/ρ): a matrix for a block, an operator for a product.
  template <class S, class Z>
    requires has_slant<set_type, Z>
  [[nodiscard]] auto slant(S const& ρ, Z const& z) const {
    if constexpr (n != Eigen::Dynamic) {
      Eigen::Matrix<S, n, 1> const scaled = z / ρ;
      Eigen::Matrix<S, n, n> g = part().slant(scaled);
      for (int k = 0; k < n * n; ++k) g.data()[k] = S(k % (n + 1) == 0 ? 1 : 0) - g.data()[k];
      return g;
    } else {
      plain_t<Z> scaled = z;
      slant::local(scaled) /= ρ;
      auto g = slant::projection_slant(part(), scaled);
      return detail::complement_slant<decltype(g), plain_t<Z>>(std::move(g), std::move(scaled));
    }
  }
  /// The same into an operator made earlier.
  template <class S, class Z, class G, class V>
  void slant(S const& ρ, Z const& z, detail::complement_slant<G, V>& g) const {
    slant::local(g.scaled()) = slant::local(z) / ρ;
    slant::projection_slant(part(), g.scaled(), g.part());
  }

  /// What the proximal map leaves of a motion of z.
  template <class S, class Z>
    requires(n != Eigen::Dynamic) && has_slant<set_type, Z>
  [[nodiscard]] block_state state(S const& ρ, Z const& z) const {
    Eigen::Matrix<S, n, n> const g = slant(ρ, z);
    bool nothing = true, all = true;
    for (int k = 0; k < n * n; ++k) {
      nothing = nothing && g.data()[k] == S(0);
      all = all && g.data()[k] == S(k % (n + 1) == 0 ? 1 : 0);
    }
    return nothing ? block_state::fixed : all ? block_state::free : block_state::sliding;
  }

  /// f(block, place) for every block, a support function itself.
  template <class F>
  void visit(F&& f) const
    requires has_visit<set_type>
  {
    part().visit(of_blocks(f));
  }
  /// f(block, place) for block k alone.
  template <class F>
  void visit_block(index k, F&& f) const
    requires has_visit<set_type>
  {
    slant::visit_block(part(), k, of_blocks(f));
  }

 private:
  template <class F>
  [[nodiscard]] static auto of_blocks(F& f) {
    return [&](auto const& block, auto const& p) {
      using block_type = std::remove_cvref_t<decltype(block)>;
      f(support_function<block_type const&>(held<block_type const&>(block)), p);
    };
  }

  held<C> set_;
};

/// σ_Λ; a product passed as an lvalue is referenced, an rvalue or a block is owned.
template <class C>
  requires set_part<std::remove_cvref_t<C>>
[[nodiscard]] auto support(C&& set) {
  using kept = detail::kept_part_t<C>;
  return support_function<kept>(held<kept>(std::forward<C>(set)));
}

}  // namespace slant
