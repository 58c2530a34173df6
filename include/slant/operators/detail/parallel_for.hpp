// SPDX-License-Identifier: MIT
//
// Loops whose rounds are independent of each other: each round writes what no other round reads or
// writes, and nothing is summed over rounds. So the result is the same to the last bit for any
// number of threads. With OpenMP (a compiler that defines _OPENMP) rounds run in parallel, else one
// after the other.
#pragma once

#include <slant/concepts/scalar.hpp>

#include <exception>
#include <limits>
#include <vector>

namespace slant::detail {

/// f(0), …, f(n − 1), in any order. f must not throw. `work`: multiplications in all rounds
/// together; threads are woken for as many as Eigen wakes them for in a sparse product.
template <class F>
void parallel_for(index n, [[maybe_unused]] index work, F const& f) {
#ifdef _OPENMP
  if (n > 1 && work > 20000) {
#pragma omp parallel for schedule(dynamic, 1)
    for (index i = 0; i < n; ++i) f(i);
    return;
  }
#endif
  for (index i = 0; i < n; ++i) f(i);
}

/// The same for an f that may throw: all rounds are run, then the exception of the first round that
/// threw is thrown on. Allocates; for set-up.
template <class F>
void parallel_for_throwing(index n, F const& f) {
  std::vector<std::exception_ptr> thrown(static_cast<std::size_t>(n));
  parallel_for(n, std::numeric_limits<index>::max(), [&](index i) {
    try {
      f(i);
    } catch (...) {
      thrown[static_cast<std::size_t>(i)] = std::current_exception();
    }
  });
  for (auto const& e : thrown) {
    if (e) std::rethrow_exception(e);
  }
}

}  // namespace slant::detail
