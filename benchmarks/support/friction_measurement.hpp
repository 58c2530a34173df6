// SPDX-License-Identifier: MIT
//
// A friction problem solved in a process of its own, and what the checker says of the forces: a row
// of the tables of friction problems.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <slant/contact/friction/verify.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "child_process.hpp"
#include "cpu_clock.hpp"

namespace benchmarks {

/// What a method returns.
struct friction_outcome {
  Eigen::VectorXd r{};
  std::string status{}, solved_by{};
  std::vector<double> counts{};  ///< of its work, as many for every problem
};

/// What the table says of it; NaN where nothing was measured.
struct friction_row {
  std::string status = "failed", solved_by{};  ///< or time_limit
  double error = NAN;                          ///< natural map over ‖q‖
  double rounding = NAN;                       ///< of the error
  double penetration = NAN;                    ///< the largest, over ‖q‖
  double unit_free_error = NAN;                ///< the same in units of each contact
  double unit_free_rounding = NAN;             ///< of that
  double seconds = NAN;
  std::vector<double> counts{};

  /// A NaN is not at most anything.
  [[nodiscard]] bool solved(double tolerance) const {
    return status == "converged" && error <= tolerance && rounding <= tolerance &&
           penetration <= tolerance;
  }
};

/// method() → friction_outcome with so many counts, in a process that is ended after `limit`
/// processor seconds.
template <class Method>
[[nodiscard]] friction_row measure_friction(slant::contact::friction_problem<> const& p,
                                            std::size_t counts, double limit,
                                            Method const& method) {
  friction_row row;
  row.counts.assign(counts, NAN);
  auto const child = in_child(limit, [&] {
    double const start = cpu_seconds();
    friction_outcome const out = method();
    double const seconds = cpu_seconds() - start;
    auto const check = slant::contact::verify(p, out.r);
    std::vector<double> numbers{check.relative_natural_map, check.relative_rounding,
                                check.penetration.relative, check.unit_free_map,
                                check.unit_free_rounding,   seconds};
    numbers.insert(numbers.end(), out.counts.begin(), out.counts.end());
    // Two words behind the numbers, a character in each.
    for (char const c : out.status + '\n' + out.solved_by) numbers.push_back(double(c));
    return numbers;
  });
  if (child.how == ending::time_limit) row.status = "time_limit";
  auto const& n = child.numbers;
  std::size_t const words_from = 6 + counts;
  if (child.how != ending::finished || n.size() <= words_from) return row;
  row.error = n[0];
  row.rounding = n[1];
  row.penetration = n[2];
  row.unit_free_error = n[3];
  row.unit_free_rounding = n[4];
  row.seconds = n[5];
  std::copy_n(n.begin() + 6, counts, row.counts.begin());
  std::string words;
  for (std::size_t i = words_from; i < n.size(); ++i) words.push_back(static_cast<char>(n[i]));
  auto const end = words.find('\n');
  row.status = words.substr(0, end);
  row.solved_by = words.substr(end + 1);
  return row;
}

/// A cell; nothing for what was not measured.
[[nodiscard]] inline std::string cell(char const* format, double value) {
  if (std::isnan(value) || value < 0) return "";
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// The folders in a folder that hold a problem, in the order of their names. Throws
/// std::invalid_argument if there is none.
[[nodiscard]] inline std::vector<std::filesystem::path> friction_folders(
    std::filesystem::path const& folder) {
  std::vector<std::filesystem::path> found;
  for (auto const& entry : std::filesystem::directory_iterator(folder)) {
    if (std::filesystem::exists(entry.path() / "W.mtx")) found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  if (found.empty()) throw std::invalid_argument(folder.string() + ": no problem in it");
  return found;
}

}  // namespace benchmarks
