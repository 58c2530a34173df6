// SPDX-License-Identifier: MIT
//
// The least that is a face: one block for each entry, free if the entry is positive.
#pragma once

#include <slant/concepts/face.hpp>
#include <slant/testing/archetypes/vector.hpp>

namespace slant::testing::archetype {

class face {
 public:
  face() = default;

  template <class C, class X>
  void assign(C const&, X const& x) {
    free_ = x.array() > 0;
  }
  [[nodiscard]] index size() const { return free_.size(); }
  [[nodiscard]] block_state state(index i) const {
    return free_(i) ? block_state::free : block_state::fixed;
  }
  void keep(vector const& x, vector& y) const { y.local() = free_.select(x.local().array(), 0.0); }
  void keep_complement(vector const& x, vector& y) const {
    y.local() = free_.select(0.0, x.local().array());
  }

 private:
  Eigen::Array<bool, Eigen::Dynamic, 1> free_;
};

static_assert(block_partition<face, vector>);

}  // namespace slant::testing::archetype
