// SPDX-License-Identifier: MIT
//
// The adversities: families of programs that get harder with a parameter.
#pragma once

#include <stability/program.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace stability {

struct family {
  std::string_view name;
  std::string_view sentence;
  std::vector<double> parameters;  ///< from mild to hard
  std::vector<std::string> variants;
  program (*make)(double parameter, std::string const& variant);
};

/// All of them; those in contact first.
[[nodiscard]] std::vector<family> const& families();

/// The program of a family. Throws std::invalid_argument if there is no such family.
[[nodiscard]] program make_program(std::string_view family, double parameter,
                                   std::string const& variant);

}  // namespace stability
