// SPDX-License-Identifier: MIT
//
// Properties for arbitrary arguments. RC_PARAMS="seed=…" repeats a run, which rapidcheck prints.
#include "numbers.hpp"

int main() {
  bool good = properties::projections_keep_their_laws();
  good = properties::texts_are_read_again() && good;
  good = properties::operators_keep_their_laws() && good;
  good = properties::programs_are_solved() && good;
  return good ? 0 : 1;
}
