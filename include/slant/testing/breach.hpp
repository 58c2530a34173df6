// SPDX-License-Identifier: MIT
//
// What a law check found: which law, and the numbers that show it.
#pragma once

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

/// The first breach of each law; one is enough to find the mistake.
class breach_log {
 public:
  void operator()(std::string const& law, std::string evidence) {
    if (!has(law)) found_.push_back({law, std::move(evidence)});
  }
  [[nodiscard]] bool has(std::string const& law) const {
    return std::any_of(found_.begin(), found_.end(), [&](breach const& b) { return b.law == law; });
  }
  [[nodiscard]] std::vector<breach> const& found() const { return found_; }

 private:
  std::vector<breach> found_;
};

}  // namespace slant::testing
