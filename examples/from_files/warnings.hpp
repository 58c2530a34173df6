// SPDX-License-Identifier: MIT
//
// Warnings about data that are valid and look wrong: in the report, on standard error, or as a
// refusal.
#pragma once

#include <cstdio>
#include <nlohmann/json.hpp>
#include <slant/contact/node_layout.hpp>
#include <slant/contact/plausibility.hpp>
#include <slant/io/matrix_market.hpp>
#include <slant/io/text_scanner.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "problem_folder.hpp"
#include "solution.hpp"

namespace from_files {

using warning_list = std::vector<slant::contact::plausibility_warning>;

/// The places of the unknowns, D at each node, from the file that --coordinates names.
[[nodiscard]] inline slant::contact::node_layout<double> read_layout(arguments const& a,
                                                                     problem const& p) {
  if (a.coordinates.empty()) return {};
  Eigen::SparseMatrix<double> const x = slant::read_matrix_market(a.coordinates);
  std::string const name = slant::detail::printable(a.coordinates);
  if (x.rows() != 2 && x.rows() != 3)
    throw slant::bad_input("rows of " + name, slant::detail::show(x.rows()), "2 or 3 coordinates");
  slant::detail::check_size("entries of " + name, x.rows() * x.cols(), p.K.rows(),
                            "the coordinates of a node for each of its unknowns,");
  return slant::contact::interleaved_layout(Eigen::MatrixXd(x));
}

/// With --strict the first warning is a refusal.
inline void refuse_warnings(arguments const& a, warning_list const& warnings) {
  if (!a.strict || warnings.empty()) return;
  std::string text = "--strict: " + warnings.front().text;
  if (warnings.size() > 1)
    text += " (and " + std::to_string(warnings.size() - 1) + " more of this kind or another)";
  throw std::invalid_argument(text);
}

/// Of the data alone, before the computation.
inline void check_data(arguments const& a, problem const& p,
                       slant::contact::node_layout<double> const& layout) {
  if (a.strict) refuse_warnings(a, slant::contact::check_plausibility(p.K, p.contact, layout));
}

/// Of the data, and of the solution where there is one.
[[nodiscard]] inline warning_list warnings_about(
    arguments const& a, problem const& p, solution const& s,
    slant::contact::node_layout<double> const& layout) {
  auto warnings = s.converged() && s.is_finite()
                      ? slant::contact::check_plausibility(p.K, p.contact, s.u, s.run.λ, layout)
                      : slant::contact::check_plausibility(p.K, p.contact, layout);
  refuse_warnings(a, warnings);
  return warnings;
}

/// One line of standard error for each; what the report says of them.
[[nodiscard]] inline nlohmann::ordered_json report_warnings(warning_list const& warnings) {
  auto list = nlohmann::ordered_json::array();
  for (auto const& w : warnings) {
    std::fprintf(stderr, "from_files: warning: %s\n", w.text.c_str());
    list.push_back({{"kind", to_string(w.kind)},
                    {"rows", w.rows},
                    {"index", w.at},
                    {"count", w.count},
                    {"text", w.text}});
  }
  return list;
}

}  // namespace from_files
