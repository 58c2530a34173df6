// SPDX-License-Identifier: MIT
#include <slant/methods/progress_watch.hpp>

#include <doctest/doctest.h>

#include <utility>

namespace progress_watch_test {

/// First step at which the watch gives up, and how often it asked for the energy.
template <class Norm, class Energy>
std::pair<int, int> gives_up(Norm norm_at, Energy energy_at, int patience = 10, int last = 1000) {
  slant::progress_watch<double> watch;
  int asked = 0;
  for (int k = 1; k <= last; ++k) {
    auto const energy = [&] {
      ++asked;
      return std::pair<double, double>(energy_at(k), 1e-12);
    };
    if (watch.stalled(k, norm_at(k), patience, energy)) return {k, asked};
  }
  return {0, asked};
}

TEST_CASE("falling norms are progress, and the energy is not asked for") {
  CHECK(gives_up([](int k) { return 1.0 / k; }, [](int) { return 0.0; }) == std::pair(0, 0));
}

TEST_CASE("a norm that stays is none, unless the energy falls") {
  auto const stays = [](int) { return 1.0; };
  // Once the energy has been seen, once it has not fallen since.
  CHECK(gives_up(stays, [](int) { return 5.0; }) == std::pair(23, 2));
  CHECK(gives_up(stays, [](int k) { return -1e-3 * k; }).first == 0);
  CHECK(gives_up(stays, [](int k) { return -1e-15 * k; }).first == 23);  // rounding errors
  CHECK(gives_up(stays, [](int k) { return k < 100 ? -1.0 * k : -100.0; }).first > 100);
}

TEST_CASE("without an energy the norm alone counts") {
  auto const ends = [](auto norm_at) {
    slant::progress_watch<double> watch;
    for (int k = 1; k <= 1000; ++k) {
      if (watch.stalled(k, norm_at(k), 10)) return k;
    }
    return 0;
  };
  CHECK(ends([](int k) { return 1.0 / k; }) == 0);
  CHECK(ends([](int) { return 1.0; }) == 12);
  CHECK(ends([](int k) { return k < 100 ? 1.0 / k : 1.0; }) == 110);
}

}  // namespace progress_watch_test
