// SPDX-License-Identifier: MIT
//
// Largest error of each projection, in units of the last place of a component, over random and
// adversarial points, against naive twins computed with 50 digits:
//
//     projection_errors [POINTS]        (a million by default)
//
// prints comma-separated values. The slow tests hold the same errors against their limits, also for
// the half line and the interval, which are exact.

#include <oracle/projection_errors.hpp>

#include <cstdio>
#include <cstdlib>

namespace {

template <class Errors>
void print(char const* set, char const* scalar, int points, Errors const& errors) {
  std::printf("%s,%s,%d,%.2f,%d\n", set, scalar, points, errors.ulp, errors.outside);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  using oracle::float_50;
  int const n = argc > 1 ? std::atoi(argv[1]) : 1000000;
  if (n < 1) {
    std::fprintf(stderr, "usage: projection_errors [POINTS]\n");
    return 2;
  }
  std::printf("set,scalar,points,largest_error_in_ulp,outside_of_set\n");
  print("ball<2>", "double", n, oracle::ball_errors<double, float_50, 2>(n, 103));
  print("ball<3>", "double", n, oracle::ball_errors<double, float_50, 3>(n, 104));
  print("ball<2>", "float", n, oracle::ball_errors<float, float_50, 2>(n, 105));
  print("ellipse", "double", n, oracle::ellipse_errors<double, float_50, long double>(n, 107));
  print("ellipse", "float", n, oracle::ellipse_errors<float, float_50, long double>(n, 108));
  print("second_order_cone<2>", "double", n, oracle::cone_errors<double, float_50, 2>(n, 110));
  print("second_order_cone<3>", "double", n, oracle::cone_errors<double, float_50, 3>(n, 111));
  print("second_order_cone<3>", "float", n, oracle::cone_errors<float, float_50, 3>(n, 112));
  return 0;
}
