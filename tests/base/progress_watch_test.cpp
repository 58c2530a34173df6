// SPDX-License-Identifier: MIT
#include <slant/base/progress_watch.hpp>

#include <support/testing.hpp>

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

TEST_CASE("a norm that falls by rounding errors only is none") {
  auto const creeps = [](int k) { return 1.0 - 1e-15 * k; };
  CHECK(gives_up(creeps, [](int) { return 0.0; }).first == 23);
  auto const slow = [](int k) { return 1.0 - 1e-6 * k; };  // 1e-5 in `patience` steps
  CHECK(gives_up(slow, [](int) { return 0.0; }).first == 0);
}

TEST_CASE("below the floor a halving counts, within half of the steps spent") {
  auto const ends = [](auto norm_at) {
    slant::progress_watch<double> watch;
    for (int k = 1; k <= 100000; ++k)
      if (watch.stalled(k, norm_at(k), 1000, 1e-12)) return k;
    return 0;
  };
  // At the floor after 40 steps, or 400, or 4000, and oscillating or creeping there.
  for (int reached : {40, 400, 4000}) {
    CAPTURE(reached);
    double const rate = std::pow(1e-13, 1.0 / reached);
    CHECK(ends([&](int k) {
            return std::max(std::pow(rate, k), k % 3 == 0 ? 1e-11 : 1e-13 - 1e-19 * k);
          }) <= 2 * reached + 20);
    // Still on its way down: it goes on.
    int const end = ends([&](int k) { return std::pow(rate, k); });
    CHECK((end == 0 || end >= 10 * reached));
  }
  // Where the floor is not known, or not reached, patience counts.
  CHECK(ends([](int k) { return k < 40 ? 1.0 / k : 1e-9; }) == 1041);
}

TEST_CASE("without an energy the norm alone counts") {
  auto const ends = [](auto norm_at) {
    slant::progress_watch<double> watch;
    for (int k = 1; k <= 1000; ++k)
      if (watch.stalled(k, norm_at(k), 10)) return k;
    return 0;
  };
  CHECK(ends([](int k) { return 1.0 / k; }) == 0);
  CHECK(ends([](int) { return 1.0; }) == 12);
  CHECK(ends([](int k) { return k < 100 ? 1.0 / k : 1.0; }) == 110);
}

}  // namespace progress_watch_test
