// SPDX-License-Identifier: MIT
//
// Work in a process of its own: its peak memory is that of the work alone, a limit on its processor
// seconds holds whatever it does, and a crash is a line of the table.
//
// The parent watches the clock of the child and ends it. RLIMIT_CPU would be less code, but a
// process with that limit reads its own clock (cpu_clock.hpp) in ticks of the scheduler: steps of 4
// ms instead of 1 µs on Linux, and what takes less may take 0 seconds.
#pragma once

#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstddef>
#include <cstdio>
#include <ctime>
#include <exception>
#include <vector>

namespace benchmarks {

/// How a child ended.
enum class ending { finished, time_limit, failed };

struct child_result {
  ending how = ending::failed;
  std::vector<double> numbers{};  ///< what the body returned, if it finished
};

namespace detail {

inline bool write_all(int to, std::vector<double> const& numbers) {
  auto const* bytes = reinterpret_cast<char const*>(numbers.data());
  std::size_t left = numbers.size() * sizeof(double);
  while (left > 0) {
    auto const written = ::write(to, bytes, left);
    if (written <= 0) return false;
    bytes += written;
    left -= static_cast<std::size_t>(written);
  }
  return true;
}

/// Processor seconds of another process; 0 if it is gone.
inline double cpu_seconds_of(pid_t process) {
  clockid_t clock{};
  std::timespec used{};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &used) != 0) return 0;
  return double(used.tv_sec) + 1e-9 * double(used.tv_nsec);
}

/// All that a child writes until it ends or has used `limit` seconds; whether it had to be ended.
inline bool read_all(int from, pid_t child, double limit, std::vector<double>& numbers) {
  bool late = false;
  std::size_t filled = 0;  // bytes
  numbers.resize(1 << 13);
  while (true) {
    pollfd wait{from, POLLIN, 0};
    if (::poll(&wait, 1, 100) == 0) {
      if (!late && cpu_seconds_of(child) > limit) late = ::kill(child, SIGKILL) == 0;
      continue;
    }
    if (filled == numbers.size() * sizeof(double)) numbers.resize(2 * numbers.size());
    auto const got = ::read(from, reinterpret_cast<char*>(numbers.data()) + filled,
                            numbers.size() * sizeof(double) - filled);
    if (got <= 0) break;
    filled += static_cast<std::size_t>(got);
  }
  numbers.resize(filled / sizeof(double));
  return late;
}

}  // namespace detail

/// body() → std::vector<double> in a child that is ended after `limit` processor seconds. What the
/// body throws goes to standard error.
template <class Body>
[[nodiscard]] child_result in_child(double limit, Body const& body) {
  int ends[2];
  std::fflush(nullptr);
  if (::pipe(ends) != 0) return {};
  pid_t const child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    int status = 2;
    try {
      status = detail::write_all(ends[1], body()) ? 0 : 2;
    } catch (std::exception const& failure) {
      std::fprintf(stderr, "%s\n", failure.what());
    }
    std::fflush(nullptr);
    ::_exit(status);
  }
  ::close(ends[1]);
  child_result result;
  if (child > 0) {
    bool const late = detail::read_all(ends[0], child, limit, result.numbers);
    int status = 0;
    ::waitpid(child, &status, 0);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) result.how = ending::finished;
    if (WIFSIGNALED(status) && late) result.how = ending::time_limit;
  }
  ::close(ends[0]);
  return result;
}

}  // namespace benchmarks
