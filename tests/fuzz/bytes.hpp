// SPDX-License-Identifier: MIT
//
// Bytes of a fuzzer as the numbers and sizes of a problem. Every sequence of bytes means something:
// behind the last one follow zeros.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string_view>

namespace fuzz {

class bytes {
 public:
  bytes(std::uint8_t const* data, std::size_t size) : next_(data), end_(data + size) {}

  [[nodiscard]] bool empty() const { return next_ == end_; }
  std::uint8_t byte() { return next_ == end_ ? std::uint8_t{0} : *next_++; }
  /// A number of [0, n), n <= 256.
  int below(int n) { return byte() % n; }
  /// A multiple of 1/4 in [−4, 4): sums of products of a few are exact.
  double quarter() { return (below(32) - 16) / 4.0; }

  /// A finite number of the range that methods are made for: mostly a multiple of 1/4, else one
  /// with digits, a power of two or an extreme.
  double finite() {
    int const kind = byte();
    if (kind < 192) return (kind % 32 - 16) / 4.0;
    if (kind < 224) return (below(2) == 0 ? 1.0 : -1.0) * std::ldexp(1.0, 8 * (below(256) - 128));
    if (kind < 248) return (kind - 236) / 3.0;
    static constexpr double extremes[] = {1e150, -1e300, 1e-150, 1e16, -1e16, -0.0, 1e300, -1e-300};
    return extremes[kind - 248];
  }
  /// Any number, of any eight bytes too: NaN, infinite, subnormal.
  double any() {
    int const kind = byte();
    if (kind < 232) return finite();
    if (kind < 248) {
      using limits = std::numeric_limits<double>;
      static constexpr double ends[] = {
          limits::infinity(), -limits::infinity(), limits::quiet_NaN(),  limits::max(),
          limits::lowest(),   limits::min(),       limits::denorm_min(), limits::epsilon()};
      return ends[kind % 8];
    }
    std::uint64_t bits = 0;
    for (int i = 0; i < 8; ++i) bits = bits << 8 | byte();
    double x = 0;
    std::memcpy(&x, &bits, sizeof x);
    return x;
  }

 private:
  std::uint8_t const* next_;
  std::uint8_t const* end_;
};

/// Ends the run as a crash does, so that the fuzzer keeps the input.
inline void demand(bool holds, char const* what) {
  if (holds) return;
  std::fprintf(stderr, "demand not met: %s\n", what);
  std::abort();
}

/// Messages stand in one line, without control characters.
inline void demand_message(std::string_view message) {
  demand(message.find(": got ") != message.npos && message.find(", expected ") != message.npos,
         "a message names value and expectation");
  for (char const c : message)
    demand(static_cast<unsigned char>(c) >= 0x20 && c != 0x7f, "a message is one printable line");
}

}  // namespace fuzz
