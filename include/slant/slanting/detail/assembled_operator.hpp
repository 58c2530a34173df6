// SPDX-License-Identifier: MIT
//
// F°(y) of a composition: its parts by value, where they can be renewed, and a rule that makes the
// operator out of references to them.
#pragma once

#include <slant/slanting/detail/forwarding_operator.hpp>

#include <cstddef>
#include <tuple>
#include <utility>

namespace slant::detail {

/// Rule is a function object: rule(parts…) → an operator that refers to the parts.
template <class Rule, class... Parts>
class assembled_operator : public forwarding_operator<assembled_operator<Rule, Parts...>> {
  using made = std::invoke_result_t<Rule const&, Parts const&...>;

 public:
  static constexpr law_set laws = laws_of<made>;

  explicit assembled_operator(Rule rule, Parts... parts)
      : rule_(std::move(rule)), parts_(std::move(parts)...) {}

  [[nodiscard]] made underlying() const { return std::apply(rule_, parts_); }

  [[nodiscard]] Rule const& rule() const noexcept { return rule_; }
  [[nodiscard]] Rule& rule() noexcept { return rule_; }
  template <std::size_t I>
  [[nodiscard]] auto const& part() const noexcept {
    return std::get<I>(parts_);
  }
  template <std::size_t I>
  [[nodiscard]] auto& part() noexcept {
    return std::get<I>(parts_);
  }

 private:
  [[no_unique_address]] Rule rule_;
  std::tuple<Parts...> parts_;
};

/// A copyable, assignable reference to an operator that lives in the slanting function.
template <class A>
class operator_view : public forwarding_operator<operator_view<A>> {
 public:
  static constexpr law_set laws = laws_of<A>;

  explicit operator_view(A const& a) noexcept : pointer_(&a) {}

  [[nodiscard]] A const& underlying() const noexcept { return *pointer_; }

 private:
  A const* pointer_;
};

}  // namespace slant::detail
