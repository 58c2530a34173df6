// SPDX-License-Identifier: MIT
//
// The same problem in other units: powers of two change no bit of a run.
#pragma once

#include <support/testing.hpp>

namespace test {

/// solve_in(e, l) runs a method with A in units of 2^e and x in units of 2^l, and takes the unit of
/// x out again: status, steps and bits of x are those of the run in plain units. far: the largest
/// exponent at which e and l may stand alone; `both`: the largest e together with l = ±far.
template <class Solve>
void check_scales(Solve const& solve_in, int far, int both) {
  auto const plain = solve_in(0, 0);
  REQUIRE(plain.converged());
  for (auto const& [stiffness, length] : {std::pair{far, 0},
                                          {-far, 0},
                                          {0, far},
                                          {0, -far},
                                          {far, -far},
                                          {-far, far},
                                          {both, far},
                                          {-both, -far}}) {
    CAPTURE(stiffness);
    CAPTURE(length);
    auto const r = solve_in(stiffness, length);
    CHECK(r.status == plain.status);
    CHECK(r.iterations() == plain.iterations());
    CHECK(r.state.work == plain.state.work);
    CHECK(r.x() == plain.x());
  }
}

}  // namespace test
