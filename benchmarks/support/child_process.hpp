// SPDX-License-Identifier: MIT
//
// Work in a process of its own: its peak memory is that of the work alone, a limit on its processor
// seconds holds whatever it does, and a crash is a line of the table.
#pragma once

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstdio>
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

inline std::vector<double> read_all(int from) {
  std::vector<double> numbers(1 << 13);
  std::size_t filled = 0;  // bytes
  while (true) {
    if (filled == numbers.size() * sizeof(double)) numbers.resize(2 * numbers.size());
    auto const got = ::read(from, reinterpret_cast<char*>(numbers.data()) + filled,
                            numbers.size() * sizeof(double) - filled);
    if (got <= 0) break;
    filled += static_cast<std::size_t>(got);
  }
  numbers.resize(filled / sizeof(double));
  return numbers;
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
    auto const seconds = static_cast<rlim_t>(std::ceil(limit));
    rlimit const cpu{seconds, seconds + 5};
    ::setrlimit(RLIMIT_CPU, &cpu);
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
    result.numbers = detail::read_all(ends[0]);
    int status = 0;
    ::waitpid(child, &status, 0);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) result.how = ending::finished;
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) result.how = ending::time_limit;
  }
  ::close(ends[0]);
  return result;
}

}  // namespace benchmarks
