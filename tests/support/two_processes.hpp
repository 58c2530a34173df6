// SPDX-License-Identifier: MIT
//
// Two processes, played by two threads: a vector of which each holds a part, with global
// reductions. Whoever decides something from its own part alone leaves the other waiting: then
// `run` says so.
#pragma once

#include <slant/concepts/vector.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace test {

/// What the two exchange.
class two_processes {
 public:
  /// (a₀, a₁) as given by the two, to both. Throws if the other does not come.
  template <class T>
  std::array<T, 2> exchange(int rank, T value, std::array<T, 2>& slots) {
    slots[std::size_t(rank)] = value;
    meet();
    auto const both = slots;
    meet();
    return both;
  }
  std::array<double, 2> numbers(int rank, double value) { return exchange(rank, value, numbers_); }
  std::array<Eigen::VectorXd const*, 2> parts(int rank, Eigen::VectorXd const& part) {
    return exchange(rank, &part, parts_);
  }
  void meet() {
    std::unique_lock lock(mutex_);
    int const round = round_;
    if (++here_ == 2) {
      here_ = 0;
      ++round_;
      all_here_.notify_all();
      return;
    }
    if (!all_here_.wait_for(lock, std::chrono::seconds(20), [&] { return round_ != round; }))
      throw std::runtime_error("the other process does something else");
  }

  /// f(rank) on both; whether both came to an end.
  template <class F>
  static bool run(F f) {
    std::atomic<int> finished = 0;
    auto const guarded = [&](int rank) {
      try {
        f(rank);
        ++finished;
      } catch (std::runtime_error const&) {
      }
    };
    std::thread other([&] { guarded(1); });
    guarded(0);
    other.join();
    return finished == 2;
  }

 private:
  std::mutex mutex_;
  std::condition_variable all_here_;
  int here_ = 0, round_ = 0;
  std::array<double, 2> numbers_{};
  std::array<Eigen::VectorXd const*, 2> parts_{};
};

/// The part of a vector that one of the two holds.
class shared_vector {
 public:
  shared_vector(two_processes& group, int rank, Eigen::VectorXd part)
      : group_(&group), rank_(rank), part_(std::move(part)) {}

  [[nodiscard]] Eigen::VectorXd& local() { return part_; }
  [[nodiscard]] Eigen::VectorXd const& local() const { return part_; }
  [[nodiscard]] double inner_product(shared_vector const& y) const {
    auto const [a, b] = group_->numbers(rank_, part_.dot(y.part_));
    return a + b;
  }
  [[nodiscard]] shared_vector like(slant::index n) const {
    return {*group_, rank_, Eigen::VectorXd(n)};
  }
  [[nodiscard]] double minimum(double value) const {
    auto const [a, b] = group_->numbers(rank_, value);
    return std::min(a, b);
  }
  [[nodiscard]] slant::index global_size() const {
    auto const [a, b] = group_->numbers(rank_, double(part_.size()));
    return slant::index(a + b);
  }
  [[nodiscard]] two_processes& group() const { return *group_; }
  [[nodiscard]] int rank() const { return rank_; }

 private:
  two_processes* group_;
  int rank_;
  Eigen::VectorXd part_;
};

static_assert(slant::vector<shared_vector>);

/// Some rows of a symmetric positive definite matrix that acts on shared vectors.
struct shared_matrix {
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
  Eigen::MatrixXd my_rows;

  [[nodiscard]] slant::index rows() const { return my_rows.rows(); }
  [[nodiscard]] slant::index cols() const { return my_rows.rows(); }
  void apply(shared_vector const& x, shared_vector& y) const {
    auto const [first, second] = x.group().parts(x.rank(), x.local());
    y.local() =
        my_rows.leftCols(first->size()) * *first + my_rows.rightCols(second->size()) * *second;
    x.group().meet();  // nobody overwrites what the other still reads
  }
};

}  // namespace test
