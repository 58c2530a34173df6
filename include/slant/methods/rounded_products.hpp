// SPDX-License-Identifier: MIT
//
// The operator that inner iterations apply: the rounded twin of A where A has one, else A itself.
//
// The step t that conjugate gradients find with the twin is as good as its products are; its image
// A t is then computed by A, so that whoever takes the step knows the residual as exactly as
// without a twin. If that residual is not what the twin promised, because A is too badly
// conditioned for its precision, or a number has left its range, the step is computed anew with A,
// and so are all others.
#pragma once

#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/rounded.hpp>
#include <slant/concepts/vector.hpp>

#include <algorithm>
#include <optional>
#include <utility>

namespace slant {

/// Nothing to round: everything is done with A.
template <class A, class V>
class rounded_products {
 public:
  rounded_products(A const&, V const&) {}

  /// Whether steps are computed with rounded products.
  [[nodiscard]] static constexpr bool at_work() noexcept { return false; }
  static constexpr void give_up() noexcept {}
  /// inner.minimise with these products.
  template <class Inner, class WA, class M, class Face, class S>
  static auto minimise(Inner& inner, A const& a, WA& wa, M const& m, V const& r, Face const& face,
                       S const& ρ, S const& s, S const& target, index most) {
    return inner.minimise(a, wa, m, r, face, ρ, s, target, most);
  }
};

/// The twin with its workspace. A copy shares what the operator shares.
template <class A, class V>
  requires has_rounded<A, V>
class rounded_products<A, V> {
  using twin = decltype(std::declval<A const&>().rounded());

 public:
  rounded_products(A const& a, V const& prototype)
      : twin_(a.rounded()), workspace_(slant::workspace(*twin_, prototype)) {}

  [[nodiscard]] bool at_work() const noexcept { return twin_.has_value(); }
  void give_up() { twin_.reset(); }

  template <class Inner, class WA, class M, class Face, class S>
  auto minimise(Inner& inner, A const& a, WA& wa, M const& m, V const& r, Face const& face,
                S const& ρ, S const& s, S const& target, index most) {
    auto const exactly = [&] { return inner.minimise(a, wa, m, r, face, ρ, s, target, most); };
    if (!at_work()) return exactly();
    auto found = inner.minimise(*twin_, workspace_, m, r, face, ρ, s, target, most, least_progress);
    slant::apply(a, inner.t, inner.image, wa);
    ++found.iterations;
    S const residual = inner.residual(r, face, ρ);
    S const enough = std::max(S(4) * found.residual, S(16) * least_progress * found.first_residual);
    if (found.finite && residual <= enough) {
      found.residual = residual;
      return found;
    }
    give_up();
    auto again = exactly();
    again.iterations += found.iterations;
    return again;
  }

 private:
  /// With products of this precision a residual is not worth lowering further in one step.
  static constexpr scalar_t<V> least_progress = scalar_t<V>(1) / scalar_t<V>(4096);

  std::optional<twin> twin_;  // empty once given up
  workspace_t<twin, V> workspace_;
};

}  // namespace slant
