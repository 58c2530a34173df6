// SPDX-License-Identifier: MIT
//
// What the command line of from_files says, and what every kind of problem makes of it.
#pragma once

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/scalar.hpp>
#include <string>
#include <support/command_line.hpp>

#include "result_files.hpp"

namespace from_files {

struct arguments {
  std::filesystem::path folder{};
  std::string method{};  ///< empty: the one recommended for the problem
  double tolerance = 1e-8;
  std::optional<slant::index> max_iterations{};
  std::string start{"automatic"};
  bool prove = false;                    ///< the bound of the error
  std::filesystem::path coefficients{};  ///< of friction, for Coulomb's law on a body
  bool symmetric = false;                ///< refuse a W that is not
  std::filesystem::path output{};
  bool list_methods = false;
  bool strict = false;                  ///< warnings are refusals
  std::filesystem::path coordinates{};  ///< of the nodes of a body; empty: not known
};

/// For files whose place is known before the computation; none if none are asked for.
[[nodiscard]] inline std::optional<result_files> places_for(arguments const& a,
                                                            std::vector<std::string> names) {
  if (a.output.empty()) return std::nullopt;
  return std::make_optional<result_files>(a.output, std::move(names));
}

/// Prints the report in one line, where what is not finite becomes null; then the files appear. No
/// result counts before all of it can arrive. Returns the exit status.
[[nodiscard]] inline int deliver(arguments const& a, nlohmann::ordered_json json, bool converged,
                                 std::optional<result_files>& files) {
  json["output"] = nullptr;
  if (files) json["output"] = a.output.string();
  // A path may hold bytes that are no text.
  std::printf("%s\n",
              json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace).c_str());
  examples::require_printed();
  if (files) files->commit();
  return converged ? examples::succeeded : examples::not_converged;
}

}  // namespace from_files
