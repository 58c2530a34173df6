// SPDX-License-Identifier: MIT
//
// Componentwise maxima: max(0, y) and max(F(y), G(y)).
//
// Kinks. max(0,·)° = 1 for y >= 0, else 0 [K (49)]. Everything else follows from
// max(F, G) = G + max(0, F − G): where F(y)_i = G(y)_i the row is that of F°.
#pragma once

#include <slant/operators/diagonal.hpp>
#include <slant/slanting/composition.hpp>
#include <slant/slanting/parts/pairs.hpp>

#include <string>
#include <utility>

namespace slant {

namespace detail {

/// The larger of two numbers, or the smaller one; NaN if either is.
template <bool Larger>
struct extremum_kernel {
  static constexpr bool chooses = true;

  template <class S>
  [[nodiscard]] static S value(S const& a, S const& b) {
    if (a >= b) return Larger ? a : b;
    return a < b ? (Larger ? b : a) : S(a + b);
  }
  template <class S>
  [[nodiscard]] static std::pair<S, S> slopes(S const& a, S const& b) {
    S const here(Larger ? 1 : 0), there(Larger ? 0 : 1);
    if (a >= b) return {here, there};
    return a < b ? std::pair<S, S>(there, here) : std::pair<S, S>(S(a + b), S(a + b));
  }
};
using max_kernel = extremum_kernel<true>;
using min_kernel = extremum_kernel<false>;

/// diag(p), p a vector of zeros and ones.
template <class V>
using indicator = diagonal_operator<V, slant::laws<slant::self_adjoint, slant::projector>>;

}  // namespace detail

/// F(y) = max(0, y) componentwise on n unknowns; F°(y) is a diagonal projector [K (49)].
/// It is the projection onto y >= 0; with other bounds use projection(set).
class positive_part_map : public slanting_base {
 public:
  /// @throws bad_input if n < 0.
  explicit positive_part_map(index n) : n_(n) {
    if (n < 0) throw bad_input("n", std::to_string(n), "a size >= 0");
  }

  [[nodiscard]] index rows() const noexcept { return n_; }
  [[nodiscard]] index cols() const noexcept { return n_; }

  template <has_local Y, class V>
  void value(Y const& y, V& v) const {
    using S = scalar_t<Y>;
    slant::local(v) =
        slant::local(y).unaryExpr([](S const& a) { return detail::max_kernel::value(a, S(0)); });
  }
  template <has_local Y>
  [[nodiscard]] auto slant(Y const& y) const {
    detail::indicator<plain_t<Y>> g{held<plain_t<Y>>(slant::like(y, n_))};
    slant(y, g);
    return g;
  }
  template <has_local Y, class G>
  void slant(Y const& y, G& g) const {
    using S = scalar_t<Y>;
    g.entries() = slant::local(y).unaryExpr(
        [](S const& a) { return detail::max_kernel::slopes(a, S(0)).first; });
  }

  [[nodiscard]] detail::written write(detail::written const& y) const {
    return {"max(0, " + y.text + ")", false};
  }

 private:
  index n_;
};

/// max(F(y), G(y)) componentwise. F and G are `Function const&` or function types (owned).
template <class F, class G>
using max_map = detail::pointwise_pair<detail::max_kernel, F, G>;

/// y ↦ max(0, y) on n unknowns.
[[nodiscard]] inline positive_part_map positive_part(index n) {
  return positive_part_map(n);
}

/// y ↦ max(0, F(y)) componentwise. An lvalue is referenced.
template <slanting_part F>
[[nodiscard]] auto positive_part(F&& f) {
  auto const n = f.rows();
  return slant::compose(positive_part_map(n), std::forward<F>(f));
}

/// y ↦ max(F(y), G(y)) componentwise. Lvalues are referenced.
/// @throws bad_input if the sizes differ.
template <slanting_part F, slanting_part G>
[[nodiscard]] auto max(F&& f, G&& g) {
  return max_map<kept_t<F>, kept_t<G>>(std::forward<F>(f), std::forward<G>(g));
}

// --- min -----------------------------------------------------------------------------------------
//
// Componentwise minimum min(F(y), G(y)), the classical complementarity function: min(x, r) = 0
// means x >= 0, r >= 0, xᵀr = 0.
//
// Kinks. min(F, G) = F − max(0, F − G): where F(y)_i = G(y)_i the row is that of G°. So
// min(x, ρ r(x)) has the same slanting operator as the natural residual x − P₊(x − ρ r(x)).

/// min(F(y), G(y)) componentwise. F and G are `Function const&` or function types (owned).
template <class F, class G>
using min_map = detail::pointwise_pair<detail::min_kernel, F, G>;

/// y ↦ min(F(y), G(y)) componentwise. Lvalues are referenced.
/// @throws bad_input if the sizes differ.
template <slanting_part F, slanting_part G>
[[nodiscard]] auto min(F&& f, G&& g) {
  return min_map<kept_t<F>, kept_t<G>>(std::forward<F>(f), std::forward<G>(g));
}

}  // namespace slant
