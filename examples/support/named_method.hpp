// SPDX-License-Identifier: MIT
//
// The columns of a table: methods by name. A program lists them in one std::tuple, and a line there
// is all that a further method takes.
#pragma once

#include <cstddef>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace examples {

/// A name and how the method is made: make(qp, σ) with a separable_qp, which the method may keep,
/// and σ ≥ σ_max(A).
template <class Make>
struct named_method {
  std::string name;
  Make make;
};

template <class Make>
named_method(char const*, Make) -> named_method<Make>;

/// visit(method) for each of a tuple of methods, in order.
template <class Methods, class Visit>
void for_each_method(Methods const& methods, Visit const& visit) {
  std::apply([&](auto const&... method) { (visit(method), ...); }, methods);
}

/// The names with something behind each.
template <class Methods>
[[nodiscard]] std::vector<std::string> names_of(Methods const& methods,
                                                std::vector<std::string> const& suffixes = {""}) {
  std::vector<std::string> names;
  for_each_method(methods, [&](auto const& method) {
    for (auto const& suffix : suffixes) names.push_back(method.name + suffix);
  });
  return names;
}

}  // namespace examples
