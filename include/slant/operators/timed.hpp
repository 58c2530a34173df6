// SPDX-License-Identifier: MIT
//
// Measures the wall-clock time spent in an operator; laws and capabilities are unchanged.
#pragma once

#include <slant/operators/declare.hpp>
#include <slant/operators/matrix.hpp>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <utility>

namespace slant {

namespace detail {

class stopwatch {
  using clock = std::chrono::steady_clock;

  class running {
   public:
    explicit running(std::atomic<std::int64_t>& total) : total_(total), start_(clock::now()) {}
    running(running const&) = delete;
    running& operator=(running const&) = delete;
    ~running() {
      auto const spent = std::chrono::nanoseconds(clock::now() - start_);
      total_.fetch_add(spent.count(), std::memory_order_relaxed);
    }

   private:
    std::atomic<std::int64_t>& total_;
    clock::time_point start_;
  };

 public:
  [[nodiscard]] running enter(application_kind, index) const { return running(*nanoseconds_); }

  [[nodiscard]] double seconds() const noexcept {
    return 1e-9 * static_cast<double>(nanoseconds_->load(std::memory_order_relaxed));
  }

 private:
  std::shared_ptr<std::atomic<std::int64_t>> nanoseconds_ =
      std::make_shared<std::atomic<std::int64_t>>(0);
};

}  // namespace detail

/// The operator A, timed. Copies add to the same total; threads that apply it at the same time each
/// add their own time.
template <class A>
class timed_operator : public detail::decorator<A, detail::stopwatch> {
 public:
  using detail::decorator<A, detail::stopwatch>::decorator;

  /// Seconds spent in apply, apply_add, their adjoints and columns.
  [[nodiscard]] double seconds() const noexcept { return this->probe().seconds(); }
};

/// A with the time of its applications measured.
template <operand A>
[[nodiscard]] auto timed(A&& a) {
  return timed_operator<part_t<A>>{held<part_t<A>>(slant::as_operator(std::forward<A>(a)))};
}

}  // namespace slant
