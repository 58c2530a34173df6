// SPDX-License-Identifier: MIT
//
// Random numbers for estimates: the Mersenne twister MT19937-64 [Nishimura 2000, Tables of 64-bit
// Mersenne twisters], as std::mt19937_64, and normal variates by the polar method [Marsaglia and
// Bray 1964]. The same on every platform, which <random> promises only of its generators; and that
// header is a tenth of a small program.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace slant::detail {

/// 64 random bits a call; the numbers of std::mt19937_64 with the same seed.
class random_bits {
 public:
  explicit random_bits(std::uint64_t seed) {
    state_[0] = seed;
    for (std::size_t i = 1; i < size; ++i) {
      std::uint64_t const last = state_[i - 1];
      state_[i] = 6364136223846793005U * (last ^ (last >> 62U)) + i;
    }
  }

  std::uint64_t operator()() {
    if (next_ == size) renew();
    std::uint64_t z = state_[next_++];
    z ^= (z >> 29U) & 0x5555555555555555U;
    z ^= (z << 17U) & 0x71d67fffeda60000U;
    z ^= (z << 37U) & 0xfff7eee000000000U;
    return z ^ (z >> 43U);
  }
  /// Heads or tails.
  bool coin() { return ((*this)() >> 63U) != 0; }

 private:
  static constexpr std::size_t size = 312, middle = 156;

  void renew() {
    for (std::size_t i = 0; i < size; ++i) {
      std::uint64_t const both =
          (state_[i] & 0xffffffff80000000U) | (state_[(i + 1) % size] & 0x7fffffffU);
      std::uint64_t const twist = (both & 1U) != 0 ? 0xb5026f5aa96619e9U : 0U;
      state_[i] = state_[(i + middle) % size] ^ (both >> 1U) ^ twist;
    }
    next_ = 0;
  }

  std::array<std::uint64_t, size> state_{};
  std::size_t next_ = size;
};

/// Normally distributed numbers of mean 0 and variance 1.
class normal_numbers {
 public:
  explicit normal_numbers(std::uint64_t seed) : bits_(seed) {}

  double operator()() {
    if (has_other_) {
      has_other_ = false;
      return other_;
    }
    double x = 0, y = 0, square = 0;
    do {
      x = 2 * fraction() - 1;
      y = 2 * fraction() - 1;
      square = x * x + y * y;
    } while (square > 1 || square == 0);
    double const factor = std::sqrt(-2 * std::log(square) / square);
    other_ = x * factor;
    has_other_ = true;
    return y * factor;
  }

 private:
  /// Uniform in [0, 1).
  double fraction() {
    double const value = static_cast<double>(bits_()) / 18446744073709551616.0;
    return value < 1 ? value : std::nextafter(1.0, 0.0);
  }

  random_bits bits_;
  double other_ = 0;
  bool has_other_ = false;
};

}  // namespace slant::detail
