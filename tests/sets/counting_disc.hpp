// SPDX-License-Identifier: MIT
//
// A disc that counts how often it is asked anything, and random vectors: shared by the tests of
// products.
#pragma once

#include <slant/sets/ball.hpp>

#include <Eigen/Core>

#include <random>

namespace products {

template <class S = double>
using vec = Eigen::Matrix<S, Eigen::Dynamic, 1>;

/// n numbers in [−3, 3], the same on every platform.
template <class S = double>
[[nodiscard]] vec<S> numbers(Eigen::Index n, unsigned seed) {
  std::mt19937 engine(seed);
  vec<S> v(n);
  for (auto& e : v) e = S(6) * S(int(engine() >> 12U)) / S(1 << 20) - S(3);
  return v;
}

/// ball<2> with a count of all questions since the last reset.
class counting_disc : public slant::ball<2> {
  using base = slant::ball<2>;

 public:
  static inline int questions = 0;

  counting_disc() = default;
  explicit counting_disc(double radius) : base(radius) {}
  [[nodiscard]] counting_disc with(double radius) const { return counting_disc(radius); }

  [[nodiscard]] auto project(auto const& x) const { return ++questions, base::project(x); }
  [[nodiscard]] bool contains(auto const& x) const { return ++questions, base::contains(x); }
  [[nodiscard]] auto state(auto const& x) const { return ++questions, base::state(x); }
  [[nodiscard]] auto slant(auto const& x) const { return ++questions, base::slant(x); }
  [[nodiscard]] double step_to_boundary(auto const& x, auto const& d) const {
    return ++questions, base::step_to_boundary(x, d);
  }
  [[nodiscard]] double support(auto const& y) const { return ++questions, base::support(y); }
};

}  // namespace products
