// SPDX-License-Identifier: MIT
//
// The operator that inner iterations apply: the rounded twin of A where A has one, else A itself.
//
// With rounded products a residual is not worth lowering by more than a factor of 2⁻¹²; the next
// step begins with an exact one. Where rounding spoils a step, because A is too badly conditioned
// for it, `give_up` turns to A for the rest of the iteration.
#pragma once

#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/rounded.hpp>
#include <slant/concepts/vector.hpp>

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
    if (!at_work()) return inner.minimise(a, wa, m, r, face, ρ, s, target, most);
    return inner.minimise(*twin_, workspace_, m, r, face, ρ, s, target, most, S(1) / S(4096));
  }

 private:
  std::optional<twin> twin_;  // empty once given up
  workspace_t<twin, V> workspace_;
};

}  // namespace slant
