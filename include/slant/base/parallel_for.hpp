// SPDX-License-Identifier: MIT
//
// Loops whose rounds are independent of each other: each round writes what no other round reads or
// writes, and nothing is summed over rounds. So the result is the same to the last bit for any
// number of threads. With OpenMP (a compiler that defines _OPENMP) rounds run in parallel, else one
// after the other.
#pragma once

#include <slant/concepts/scalar.hpp>

#include <exception>

namespace slant::detail {

/// f(0), …, f(n − 1), in any order; throws what the first round that throws has thrown, the first
/// in order, not in time. `work`: multiplications in all rounds together, or fewer; threads are
/// woken for as many as Eigen wakes them for in a sparse product.
template <class F>
void parallel_for(index n, [[maybe_unused]] index work, F const& f) {
#ifdef _OPENMP
  if (n > 1 && work > 20000) {
    std::exception_ptr thrown;  // none may leave a parallel region
    index thrower = n;
#pragma omp parallel for schedule(dynamic, 1)
    for (index i = 0; i < n; ++i) {
      try {
        f(i);
      } catch (...) {
#pragma omp critical(slant_parallel_for)
        if (i < thrower) {
          thrower = i;
          thrown = std::current_exception();
        }
      }
    }
    if (thrown) std::rethrow_exception(thrown);
    return;
  }
#endif
  for (index i = 0; i < n; ++i) f(i);
}

}  // namespace slant::detail
