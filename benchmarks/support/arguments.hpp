// SPDX-License-Identifier: MIT
//
// The command lines of the comparisons: words, and options that take a value.
#pragma once

#include <cstdlib>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "precision_table.hpp"

namespace benchmarks {

class arguments {
 public:
  /// Throws std::invalid_argument for an option that is unknown or has no value.
  arguments(int argc, char** argv, std::vector<std::string> const& known) {
    for (int i = 1; i < argc; ++i) {
      std::string const word = argv[i];
      if (!word.starts_with("--")) {
        words_.push_back(word);
        continue;
      }
      bool found = false;
      for (auto const& name : known) found = found || word == "--" + name;
      if (!found || i + 1 == argc)
        throw std::invalid_argument(word + ": an unknown option, or its value is missing");
      options_[word.substr(2)] = argv[++i];
    }
  }
  [[nodiscard]] std::vector<std::string> const& words() const { return words_; }
  /// The value of an option, or what is usual.
  [[nodiscard]] std::string get(std::string const& name, std::string const& usual) const {
    auto const at = options_.find(name);
    return at == options_.end() ? usual : at->second;
  }
  [[nodiscard]] double number(std::string const& name, double usual) const {
    return numbers(name, {usual}).front();
  }
  /// "1e-2,1e-4" as numbers. Throws std::invalid_argument for anything else.
  [[nodiscard]] std::vector<double> numbers(std::string const& name,
                                            std::vector<double> const& usual) const {
    auto const at = options_.find(name);
    if (at == options_.end()) return usual;
    std::vector<double> list;
    std::istringstream text(at->second);
    for (std::string part; std::getline(text, part, ',');) {
      char* end = nullptr;
      list.push_back(std::strtod(part.c_str(), &end));
      if (part.empty() || *end != '\0')
        throw std::invalid_argument("--" + name + ": got " + part + ", expected a number");
    }
    if (list.empty()) throw std::invalid_argument("--" + name + ": expected a number");
    return list;
  }
  /// --tolerances, --repeats and --limit.
  [[nodiscard]] measuring how() const {
    measuring m;
    m.tolerances = numbers("tolerances", m.tolerances);
    m.repeats = static_cast<int>(number("repeats", m.repeats));
    m.limit = number("limit", m.limit);
    return m;
  }
  /// Is a method of that name asked for by the words after the first `skipped` ones? All are if
  /// there is none.
  [[nodiscard]] bool wants(std::string const& name, std::size_t skipped) const {
    known_.insert(name);
    bool wanted = words_.size() <= skipped;
    for (std::size_t i = skipped; i < words_.size(); ++i) wanted = wanted || words_[i] == name;
    return wanted;
  }
  /// Throws std::invalid_argument for a word after the first `skipped` ones, other than `none`,
  /// that wants() has not been asked about.
  void require_known(std::size_t skipped) const {
    for (std::size_t i = skipped; i < words_.size(); ++i)
      if (words_[i] != "none" && !known_.contains(words_[i]))
        throw std::invalid_argument("there is no method " + words_[i]);
  }

 private:
  std::vector<std::string> words_{};
  std::map<std::string, std::string> options_{};
  mutable std::set<std::string> known_{};
};

}  // namespace benchmarks
