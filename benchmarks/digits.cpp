// SPDX-License-Identifier: MIT
//
// The digits of each method's solution that rounding leaves, on a scene of half lines and discs
// with κ(A) = 1e2 … 1e12, counted by random rounding (slant/testing/stochastic.hpp):
//
//     digits
//
// prints comma-separated values: the status, the steps, the fewest digits over eleven seeds beside
// the largest entry of x, and one entry of x as far as its digits survive.
#include <testing/stochastic_scene.hpp>

#include <cstdio>
#include <map>
#include <string>

namespace {

using S = slant::testing::stochastic<double>;

struct row {
  std::string status, first;
  slant::index steps = 0;
  double digits = 16;
};

void print(double κ) {
  std::map<std::string, row> rows;
  for (std::uint64_t seed = 1; seed <= 11; ++seed) {
    slant::testing::seed_rounding(seed);
    stochastic_scene::run_all(stochastic_scene::scene<S>(κ), 1e-12, [&](auto const& o) {
      row& all = rows[o.method];
      double const found = slant::testing::digits(o.x);
      if (found >= all.digits) return;
      all = {std::string(slant::to_string(o.status)), to_string(o.x[5]), o.steps, found};
    });
  }
  for (auto const& [method, r] : rows)
    std::printf("%s,%g,%s,%td,%.1f,%s\n", method.c_str(), κ, r.status.c_str(), r.steps, r.digits,
                r.first.c_str());
}

}  // namespace

int main() {
  std::printf("method,condition,status,steps,digits,x_5\n");
  for (double const κ : {1e2, 1e4, 1e6, 1e8, 1e10, 1e12}) print(κ);
}
