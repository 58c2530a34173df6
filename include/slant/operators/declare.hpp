// SPDX-License-Identifier: MIT
//
// Laws that the caller knows and the types cannot: `declare<self_adjoint>(product(A, B))` where A
// and B commute. The laws are asserted, not verified; slant::testing::check_operator_laws samples
// them.
#pragma once

#include <slant/operators/as_operator.hpp>
#include <slant/operators/detail/closure.hpp>
#include <slant/operators/detail/decorator.hpp>

#include <type_traits>
#include <utility>

namespace slant {

namespace detail {

/// Does nothing around an application.
struct no_probe {
  struct nothing {};
  nothing enter(application_kind, index) const noexcept { return {}; }
};

}  // namespace detail

/// The operator A with the laws L in addition to its own.
template <class A, law_set L>
class declared_operator : public detail::decorator<A, detail::no_probe> {
 public:
  static constexpr law_set laws = laws_of<A> | L;
  using detail::decorator<A, detail::no_probe>::decorator;

  /// The inverse of A, with what the laws of A imply for it.
  [[nodiscard]] auto inverse() const
    requires detail::knows_its_inverse<std::remove_cvref_t<A>>
  {
    using inverse_part = std::remove_cvref_t<decltype(this->get().inverse())>;
    return declared_operator<inverse_part, detail::inverse_laws(laws)>{
        held<inverse_part>(this->get().inverse())};
  }
};

/// Asserts laws of A. Throws bad_input if A is not square: only square operators have laws.
template <law... L, operand A>
  requires(sizeof...(L) > 0)
[[nodiscard]] auto declare(A&& a) {
  held<part_t<A>> part{slant::as_operator(std::forward<A>(a))};
  detail::require_square("A", part.get());
  return declared_operator<part_t<A>, slant::laws<L...>>{std::move(part)};
}

}  // namespace slant
