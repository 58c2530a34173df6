// SPDX-License-Identifier: MIT
//
// The least that is a vector: not an Eigen object, no element access, no arithmetic of its own.
// What compiles with it uses nothing but slant::local, inner_product, norm and like, and will run
// on vectors distributed over processes.
#pragma once

#include <slant/concepts/vector.hpp>

#include <Eigen/Core>

namespace slant::testing::archetype {

template <class S>
class basic_vector {
 public:
  using storage = Eigen::Matrix<S, Eigen::Dynamic, 1>;

  explicit basic_vector(storage entries) : entries_(std::move(entries)) {}

  [[nodiscard]] storage& local() noexcept { return entries_; }
  [[nodiscard]] storage const& local() const noexcept { return entries_; }
  [[nodiscard]] S inner_product(basic_vector const& y) const { return entries_.dot(y.entries_); }
  [[nodiscard]] basic_vector like(index n) const { return basic_vector(storage(n)); }

 private:
  storage entries_;
};

using vector = basic_vector<double>;

static_assert(slant::vector<vector>);

}  // namespace slant::testing::archetype
