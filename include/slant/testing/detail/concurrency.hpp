// SPDX-License-Identifier: MIT
//
// One operator applied from two threads at the same time, each with its own workspace.
#pragma once

#include <slant/testing/detail/operator_sampler.hpp>

#include <atomic>
#include <chrono>
#include <string>
#include <thread>
#include <utility>

namespace slant::testing::detail {

/// Applies to `other` as long as it lives, and counts.
template <class V>
class applied_beside {
 public:
  applied_beside(operator_probe<V> const& a, V const& other, V result)
      : thread_([this, &a, &other, y = std::move(result)]() mutable {
          auto const apply_beside = a.with_one_workspace(other);
          while (!stop_.load(std::memory_order_relaxed)) {
            apply_beside(other, y);
            finished_.fetch_add(1, std::memory_order_relaxed);
          }
        }) {}
  ~applied_beside() {
    stop_ = true;
    thread_.join();
  }
  applied_beside(applied_beside const&) = delete;
  applied_beside& operator=(applied_beside const&) = delete;

  /// Applications that are finished.
  [[nodiscard]] long finished() const { return finished_.load(std::memory_order_relaxed); }

 private:
  std::atomic<bool> stop_ = false;
  std::atomic<long> finished_ = 0;
  std::thread thread_;  // last: it uses the others from its first moment
};

/// A x is the same while another thread applies A to something else. The two must meet, and often:
/// an application counts where one of the other thread's ended during it. On a busy machine with
/// one free core they meet only where the system interrupts one of them, so time is limited as
/// well.
template <class V>
void check_concurrency(operator_sampler<V>& sampler, operator_probe<V> const& a,
                       scalar_t<V> const& size) {
  using S = scalar_t<V>;
  constexpr int meetings = 2000;
  constexpr std::chrono::milliseconds patience(50);
  std::string const law = "repeatability, beside another thread with its own workspace";

  V const x = sampler.random(a.cols);
  V const other = sampler.random(a.cols);
  V const expected = sampler.image(x);
  S const image_size = size * slant::norm(x);
  auto const apply = a.with_one_workspace(x);
  V y = sampler.garbage(a.rows);

  applied_beside<V> const beside(a, other, y);
  while (beside.finished() == 0) std::this_thread::yield();
  auto const end = std::chrono::steady_clock::now() + patience;
  for (int met = 0; met < meetings && std::chrono::steady_clock::now() < end;) {
    long const before = beside.finished();
    apply(x, y);
    met += beside.finished() != before;
    sampler.expect_close(law, y, expected, image_size);
    if (sampler.has_found(law)) return;
  }
}

}  // namespace slant::testing::detail
