// SPDX-License-Identifier: MIT
//
// The methods that can be asked for by name: the names of their headers in slant/methods. The first
// one is recommended, and taken unless another is asked for.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/methods/kprgp.hpp>
#include <string>
#include <string_view>
#include <tuple>

#include "outcome.hpp"

namespace from_files {

/// A method: run(dual, settings) → outcome, where dual is a slant::contact::dual.
template <class Run>
struct named_method {
  std::string_view name;
  std::string_view sentence;
  Run run;
};
template <class Run>
named_method(char const*, char const*, Run) -> named_method<Run>;

inline constexpr std::tuple methods{
    named_method{"kprgp",
                 "Active sets: conjugate gradients on a face, gradient projections to change it.",
                 [](auto const& dual, settings const& s) {
                   return run_on_dual(slant::kprgp{dual.qp()}, dual.zero(), s);
                 }},
};

/// Name of the recommended method.
inline constexpr std::string_view recommended_method = std::get<0>(methods).name;

/// f(method) for every method.
template <class F>
void for_each_method(F f) {
  std::apply([&](auto const&... method) { (f(method), ...); }, methods);
}

/// f(method) for the method of that name. Throws slant::bad_input that lists the known names.
template <class F>
void with_method(std::string_view name, F f) {
  bool found = false;
  std::string known;
  for_each_method([&](auto const& method) {
    known.append(known.empty() ? "" : ", ").append(method.name);
    if (method.name != name) return;
    found = true;
    f(method);
  });
  if (!found) throw slant::bad_input("--method", name, "one of " + known);
}

}  // namespace from_files
