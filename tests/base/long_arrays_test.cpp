// SPDX-License-Identifier: MIT
#include <slant/base/long_arrays.hpp>

#include <support/testing.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <stdexcept>

namespace long_arrays_test {

TEST_CASE("a long array is a vector, long or short") {
  for (std::size_t const n : {std::size_t{3}, std::size_t{1} << 21}) {
    slant::detail::long_array<int> a(n / 2, 7);
    a.resize(n, 9);
    std::iota(a.begin(), a.end(), 0);
    auto b = a;
    a.resize(2 * n);  // moves what is there
    CHECK(std::equal(b.begin(), b.end(), a.begin()));
    CHECK(b.back() == static_cast<int>(n - 1));
    if (n > 3) CHECK(reinterpret_cast<std::uintptr_t>(b.data()) % (std::size_t{1} << 21) == 0);
  }
  slant::detail::long_array<int> a;
  CHECK_THROWS_AS(a.reserve(a.max_size() + 1), std::length_error);
}

TEST_CASE("reading ahead of an array does no harm") {
  int const a = 1;
  slant::detail::read_ahead<256>(&a, 1 << 30);
  slant::detail::read_ahead<256>(&a, -(1 << 30));
  slant::detail::read_ahead<64>(nullptr, -1);
  CHECK(a == 1);
}

}  // namespace long_arrays_test
