// SPDX-License-Identifier: MIT
//
// Time of the comparisons: processor seconds of this process, the sum over its threads. A machine
// that others use too disturbs them little, and a library that quietly takes a second thread does
// not look twice as fast.
#pragma once

#include <algorithm>
#include <ctime>
#include <stdexcept>
#include <utility>
#include <vector>

namespace benchmarks {

/// Processor seconds that this process has used; a child process starts at 0.
[[nodiscard]] inline double cpu_seconds() {
  std::timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

/// Processor seconds of this process since it was made.
class stopwatch {
 public:
  [[nodiscard]] double seconds() const { return cpu_seconds() - start_; }

 private:
  double start_ = cpu_seconds();
};

/// Throws std::runtime_error if this clock moves in steps of more than 0.1 ms on average, as it
/// does under RLIMIT_CPU (`ulimit -t`): short runs would be measured as 0.
inline void require_fine_clock() {
  double const start = cpu_seconds();
  double before = start;
  int steps = 0;
  while (before < start + 0.02) {
    double const now = cpu_seconds();
    if (now > before) ++steps;
    before = now;
  }
  if (steps < 200)
    throw std::runtime_error("the processor clock is too coarse; is a limit (ulimit -t) set?");
}

/// The middle one of at least one number; of two the smaller one.
[[nodiscard]] inline double median(std::vector<double> values) {
  auto const middle = values.begin() + (std::ssize(values) - 1) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Seconds of job(), the median of `repeats` runs; what takes longer than `enough` seconds runs
/// once.
template <class Job>
[[nodiscard]] double median_seconds(int repeats, double enough, Job const& job) {
  std::vector<double> seconds;
  do {
    double const start = cpu_seconds();
    job();
    seconds.push_back(cpu_seconds() - start);
  } while (static_cast<int>(seconds.size()) < repeats && seconds.front() <= enough);
  return median(std::move(seconds));
}

}  // namespace benchmarks
