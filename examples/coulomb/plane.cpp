// SPDX-License-Identifier: MIT
#include "follow.hpp"

int coulomb::follow_in_plane(settings const& s) {
  return follow(s, make_plates(s.k));
}
