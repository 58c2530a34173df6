// SPDX-License-Identifier: MIT
//
// The guard itself: it must see every kind of allocation that the library could make.
#include "allocation_guard.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

namespace allocation_guard_test {

using slant::testing::allocation_guard;

// An address that escapes into a volatile cannot be optimised away together with its allocation.
void* volatile sink = nullptr;

void keep(void const* address) {
  sink = const_cast<void*>(address);
}

struct alignas(64) over_aligned {
  double values[8];
};

TEST_CASE("allocation guard: sees new, aligned new and containers") {
  allocation_guard guard;
  auto const number = std::make_unique<int>(7);
  keep(number.get());
  auto const plain = guard.count();
  guard.reset();
  auto const aligned = std::make_unique<over_aligned>();
  keep(aligned.get());
  auto const over = guard.count();
  guard.reset();
  std::vector<double> const values(100, 1.0);
  keep(values.data());
  auto const container = guard.count();
  CHECK(plain == 1);
  CHECK(over == 1);
  CHECK(container == 1);
}

TEST_CASE("allocation guard: sees the C functions") {
  allocation_guard guard;
  void* block = std::malloc(16);
  keep(block);
  auto const by_malloc = guard.count();
  guard.reset();
  block = std::realloc(block, 1 << 20);
  keep(block);
  auto const by_realloc = guard.count();
  std::free(block);
  guard.reset();
  block = std::calloc(4, 4);
  keep(block);
  auto const by_calloc = guard.count();
  std::free(block);
  guard.reset();
  void* aligned = nullptr;
  auto const status = ::posix_memalign(&aligned, 64, 128);
  keep(aligned);
  auto const by_posix_memalign = guard.count();
  std::free(aligned);
  CHECK(by_malloc == 1);
  CHECK(by_realloc >= 1);
  CHECK(by_calloc == 1);
  CHECK(status == 0);
  CHECK(by_posix_memalign == 1);
}

TEST_CASE("allocation guard: sees the temporaries of Eigen") {
  Eigen::MatrixXd const a = Eigen::MatrixXd::Identity(50, 50);
  Eigen::VectorXd const x = Eigen::VectorXd::Ones(50);
  Eigen::VectorXd y = x;
  allocation_guard guard;
  y.noalias() = a * x;
  auto const without_temporary = guard.count();
  guard.reset();
  y = a * y;  // evaluated into a temporary, because y occurs on both sides
  auto const with_temporary = guard.count();
  guard.reset();
  Eigen::VectorXd const copy = x;
  keep(copy.data());
  auto const by_copy = guard.count();
  CHECK(without_temporary == 0);
  CHECK(with_temporary == 1);
  CHECK(by_copy == 1);
}

}  // namespace allocation_guard_test
