// SPDX-License-Identifier: MIT
//
// Properties for arbitrary arguments. RC_PARAMS="seed=…" repeats a run, which rapidcheck prints.
#include "numbers.hpp"

int main() {
  bool good = properties::operators_keep_their_laws();
  good = properties::programs_are_solved() && good;
  return good ? 0 : 1;
}
