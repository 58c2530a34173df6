// SPDX-License-Identifier: MIT
//
// The least that is a face: it can cut vectors down to some components, here those in front.
#pragma once

#include <slant/concepts/face.hpp>
#include <slant/testing/archetypes/vector.hpp>

namespace slant::testing::archetype {

class face {
 public:
  explicit face(index free) : free_(free) {}

  void keep(vector const& x, vector& y) const {
    y.local() = x.local();
    y.local().tail(y.local().size() - free_).setZero();
  }

 private:
  index free_;
};

static_assert(has_keep<face, vector>);

}  // namespace slant::testing::archetype
