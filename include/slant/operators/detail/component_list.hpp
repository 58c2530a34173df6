// SPDX-License-Identifier: MIT
//
// A list of different components of a vector, which can be replaced without allocating.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/scalar.hpp>

#include <cstddef>
#include <vector>

namespace slant::detail {

class component_list {
 public:
  explicit component_list(index full_size) {
    if (full_size < 0) throw bad_input("n", show(full_size), "a size >= 0");
    taken_.assign(static_cast<std::size_t>(full_size), 0);
    components_.reserve(taken_.size());
  }

  /// Replaces the components by those of a range of integers. Throws bad_input unless they are
  /// different numbers in [0, full_size()); the list is then as before.
  template <class Components>
  void assign(Components const& components) {
    require_valid(components);
    components_.clear();
    for (auto const& c : components) components_.push_back(static_cast<index>(c));
  }

  [[nodiscard]] index size() const noexcept { return static_cast<index>(components_.size()); }
  [[nodiscard]] index full_size() const noexcept { return static_cast<index>(taken_.size()); }
  [[nodiscard]] index component(index i) const { return components_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] std::vector<index> const& components() const noexcept { return components_; }

 private:
  template <class Components>
  void require_valid(Components const& components) {
    index position = 0;
    char const* expectation = nullptr;
    index offender = 0;
    for (auto const& c : components) {
      offender = static_cast<index>(c);
      if (offender < 0 || offender >= full_size()) {
        expectation = "a component of the vector (>= 0 and less than its size)";
        break;
      }
      auto& taken = taken_[static_cast<std::size_t>(offender)];
      if (taken != 0) {
        expectation = "different components";
        break;
      }
      taken = 1;
      ++position;
    }
    index unmark = position;  // the marks are only needed while checking
    for (auto const& c : components) {
      if (unmark-- == 0) break;
      taken_[static_cast<std::size_t>(c)] = 0;
    }
    if (expectation != nullptr) {
      throw bad_input("components", show(offender), expectation).at(position);
    }
  }

  std::vector<index> components_;
  std::vector<unsigned char> taken_;  // all zero between calls; its size is the full size
};

}  // namespace slant::detail
