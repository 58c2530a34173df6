// SPDX-License-Identifier: MIT
#include "follow.hpp"

int coulomb::follow_in_space(settings const& s) {
  return follow(s, make_bodies(s.model, s.k));
}
