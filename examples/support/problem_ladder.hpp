// SPDX-License-Identifier: MIT
//
// Problems by the size of their mesh, made when they are asked for and kept: the rows of a table
// and the levels of nested iteration share them.
#pragma once

#include <map>
#include <support/contact_problem.hpp>
#include <utility>
#include <vector>

namespace examples {

/// make(size) is the scene of a mesh; size / 2 is the next coarser one.
template <int D, class Make>
class problem_ladder {
 public:
  explicit problem_ladder(Make make) : make_(std::move(make)) {}

  [[nodiscard]] contact_problem<D> const& at(int size) {
    auto const found = problems_.find(size);
    return found != problems_.end() ? found->second
                                    : problems_.try_emplace(size, make_(size)).first->second;
  }
  /// …, size/4, size/2, size, none of them below `coarsest` but perhaps the last.
  [[nodiscard]] std::vector<contact_problem<D> const*> ladder(int size, int coarsest = 2) {
    std::vector<contact_problem<D> const*> result;
    if (size / 2 >= coarsest) result = ladder(size / 2, coarsest);
    result.push_back(&at(size));
    return result;
  }

 private:
  Make make_;
  std::map<int, contact_problem<D>> problems_{};
};

template <int D, class Make>
[[nodiscard]] problem_ladder<D, Make> make_ladder(Make make) {
  return problem_ladder<D, Make>(std::move(make));
}

}  // namespace examples
