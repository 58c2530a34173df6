// SPDX-License-Identifier: MIT
#include <slant/concepts/random.hpp>

#include <support/testing.hpp>

TEST_CASE("random_bits are the numbers of std::mt19937_64") {
  for (std::uint64_t const seed : {0ULL, 1ULL, 5489ULL, 19905ULL, ~0ULL}) {
    CAPTURE(seed);
    slant::detail::random_bits ours(seed);
    std::mt19937_64 theirs(seed);
    int different = 0;
    for (int i = 0; i < 2000; ++i) different += ours() != theirs() ? 1 : 0;
    CHECK(different == 0);
  }
}

TEST_CASE("normal_numbers have the moments and the quantiles of the normal distribution") {
  slant::detail::normal_numbers gaussian(20161);
  int const n = 100000;
  double sum = 0, square = 0, fourth = 0, within_one = 0;
  for (int i = 0; i < n; ++i) {
    double const x = gaussian();
    sum += x;
    square += x * x;
    fourth += x * x * x * x;
    within_one += std::abs(x) < 1 ? 1 : 0;
  }
  CHECK(sum / n == doctest::Approx(0).epsilon(0.016));
  CHECK(square / n == doctest::Approx(1).epsilon(0.025));
  CHECK(fourth / n == doctest::Approx(3).epsilon(0.05));
  CHECK(within_one / n == doctest::Approx(std::erf(std::sqrt(0.5))).epsilon(0.012));
}
