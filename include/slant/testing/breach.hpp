// SPDX-License-Identifier: MIT
//
// What the law checks share: what a thing can do, its type forgotten, and what was found: which law,
// and the numbers that show it.
#pragma once

#include <slant/concepts/bad_input.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace slant::testing {

/// A law found broken.
struct breach {
  std::string law;
  std::string evidence;
};

/// A line for each.
[[nodiscard]] inline std::string listed(std::vector<breach> const& breaches) {
  std::string text;
  for (auto const& broken : breaches) text += broken.law + " (" + broken.evidence + ")\n";
  return text;
}

namespace detail {

/// Text of a number or a point; a text as it is.
template <class T>
[[nodiscard]] std::string text_of(T const& value) {
  if constexpr (requires { value.transpose(); }) {
    return "(" + slant::detail::show(value.transpose().eval()) + ")";
  } else {
    return slant::detail::show(value);
  }
}
[[nodiscard]] inline std::string text_of(std::string const& text) {
  return text;
}
[[nodiscard]] inline std::string text_of(char const* text) {
  return text;
}

}  // namespace detail

/// The first breach of each law; one is enough to find the mistake.
class breach_log {
 public:
  void operator()(std::string const& law, std::string evidence) {
    if (!has(law)) found_.push_back({law, std::move(evidence)});
  }
  /// A breach unless the law `holds`; evidence: texts, numbers and points one after the other.
  template <class... Part>
  void expect(bool holds, char const* law, Part const&... evidence) {
    if (!holds) (*this)(law, (std::string() + ... + detail::text_of(evidence)));
  }
  [[nodiscard]] bool has(std::string const& law) const {
    return std::any_of(found_.begin(), found_.end(), [&](breach const& b) { return b.law == law; });
  }
  [[nodiscard]] std::vector<breach> const& found() const { return found_; }

 private:
  std::vector<breach> found_;
};

namespace detail {

template <class>
class ability;
/// A function of a thing whose type is forgotten; empty where the thing has none. So the checks are
/// compiled once, and not for each type that is checked. Refers to the thing. (std::function does as
/// much, and its parts are a tenth of what compiling the checks of an operator costs.)
template <class R, class... A>
class ability<R(A...)> {
 public:
  ability() = default;
  /// f(thing, a…), of an f that holds nothing.
  template <class T, class F>
  ability(T const& thing, F)
      : thing_(&thing),
        call_([](void const* t, A... a) -> R { return F{}(*static_cast<T const*>(t), a...); }) {}
  template <class T, class F>
  ability(T const&&, F) = delete;
  explicit operator bool() const { return call_ != nullptr; }
  R operator()(A... a) const { return call_(thing_, a...); }

 private:
  void const* thing_ = nullptr;
  R (*call_)(void const*, A...) = nullptr;
};

}  // namespace detail

}  // namespace slant::testing
