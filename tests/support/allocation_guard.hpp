// SPDX-License-Identifier: MIT
//
// Counts heap allocations, so that a test can demand that a piece of code makes none.
//
//   CHECK(test::allocations_of([&] { method.step(state); }) == 0);
//
// or, where the code makes what is looked at later,
//
//   slant::testing::allocation_guard guard;
//   auto const report = solver.solve(F, f, dy);
//   auto const allocations = guard.count();  // before CHECK, which may itself allocate
//   CHECK(allocations == 0);
//
// What is counted: every malloc, calloc, aligned allocation and growing or shrinking realloc of the
// whole process, whoever makes it: operator new, Eigen (which calls malloc itself), a solver in a
// shared library, another thread. Memory that is mapped directly (mmap) is not seen, and under
// valgrind, which takes malloc over, nothing is: the guard's own test then fails.
//
// Why not only operator new: Eigen allocates dynamic matrices by std::malloc, so a guard on
// operator new would find every Eigen loop free of allocations.
#pragma once

#include <cstddef>

namespace slant::testing {

/// Number of allocations of the process so far; grows by one with each.
[[nodiscard]] std::size_t allocations_so_far() noexcept;

/// Counts the allocations since its construction. Guards may be nested.
class allocation_guard {
 public:
  allocation_guard() noexcept : start_(allocations_so_far()) {}

  /// Allocations since the guard was made or last reset.
  [[nodiscard]] std::size_t count() const noexcept { return allocations_so_far() - start_; }

  void reset() noexcept { start_ = allocations_so_far(); }

 private:
  std::size_t start_;
};

}  // namespace slant::testing

namespace test {

/// Allocations that a call makes.
[[nodiscard]] std::size_t allocations_of(auto&& call) {
  slant::testing::allocation_guard const guard;
  call();
  return guard.count();
}

}  // namespace test
