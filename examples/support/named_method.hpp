// SPDX-License-Identifier: MIT
//
// The columns of a table: methods by name. A program lists them in one std::tuple, and a line there
// is all that a further method takes.
#pragma once

#include <slant/iteration/stopping.hpp>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace examples {

/// When a run of a table ends.
struct run_limits {
  double tolerance = 1e-6;  ///< relative
  slant::index max_iterations = 20000;
};

/// The rule of most methods: the reduced gradient.
struct reduced_gradient_rule {
  [[nodiscard]] auto operator()(run_limits const& limits) const {
    return slant::reduced_gradient_below(limits.tolerance) || slant::at_most(limits.max_iterations);
  }
};

/// A method of a table.
template <class Make, class Stop = reduced_gradient_rule>
struct named_method {
  std::string name;
  Make make;  ///< make(problem), which offers qp(), sigma() ≥ σ_max(A) and preconditioner() ≈ A⁻¹
  Stop stop{};         ///< stop(limits): its stopping rule
  bool ours = true;    ///< must converge; a document's may fail, as there
  bool nested = ours;  ///< is shown from zero and by nested iteration
};

template <class Make>
named_method(char const*, Make) -> named_method<Make>;
template <class Make, class Stop>
named_method(char const*, Make, Stop) -> named_method<Make, Stop>;
template <class Make, class Stop>
named_method(char const*, Make, Stop, bool) -> named_method<Make, Stop>;
template <class Make, class Stop>
named_method(char const*, Make, Stop, bool, bool) -> named_method<Make, Stop>;

/// visit(method) for each of a tuple of methods, in order.
template <class Methods, class Visit>
void for_each_method(Methods const& methods, Visit const& visit) {
  std::apply([&](auto const&... method) { (visit(method), ...); }, methods);
}

/// The names of the columns.
template <class Methods>
[[nodiscard]] std::vector<std::string> names_of(Methods const& methods) {
  std::vector<std::string> names;
  for_each_method(methods, [&](auto const& method) {
    names.push_back(method.nested ? method.name + " from 0" : method.name);
    if (method.nested) names.push_back(method.name + " nested");
  });
  return names;
}

}  // namespace examples
