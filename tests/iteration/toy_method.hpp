// SPDX-License-Identifier: MIT
//
// A method small enough to know every state by heart: x ← x / 2.
#pragma once

#include <slant/concepts/iterative_method.hpp>

namespace toy {

struct state {
  double x = 0;
  double residual_norm = 0;
  double residual_scale = 1;
  slant::index iteration = 0;
  slant::status status = slant::status::running;
};

/// Halves x; at rest (converged) as soon as x < 1e-3.
struct halving {
  state start(double x0) const { return {x0, x0, x0, 0, slant::status::running}; }
  void step(state& s) const {
    if (s.status != slant::status::running) return;
    s.x /= 2;
    s.residual_norm = s.x;
    ++s.iteration;
    if (s.x < 1e-3) s.status = slant::status::converged;
  }
};

static_assert(slant::iterative_method<halving, double>);

}  // namespace toy
