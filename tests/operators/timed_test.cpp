// SPDX-License-Identifier: MIT
#include <slant/operators/timed.hpp>

#include <chrono>
#include <support/testing.hpp>

namespace timed_test {

/// The identity, taking at least two milliseconds.
struct slow_identity {
  [[nodiscard]] slant::index rows() const { return 2; }
  [[nodiscard]] slant::index cols() const { return 2; }
  void apply(VectorXd const& x, VectorXd& y) const {
    auto const start = std::chrono::steady_clock::now();
    while (std::chrono::steady_clock::now() - start < std::chrono::milliseconds(2)) {
    }
    y = x;
  }
};

TEST_CASE("time adds up, over copies") {
  auto const a = slant::timed(slow_identity{});
  CHECK(a.seconds() == 0);
  VectorXd y(2);
  slant::apply(a, VectorXd(VectorXd::Ones(2)), y);
  CHECK(a.seconds() >= 2e-3);
  auto const copy = a;
  slant::apply(copy, VectorXd(VectorXd::Ones(2)), y);
  CHECK(a.seconds() >= 4e-3);
  CHECK(copy.seconds() == a.seconds());
}

}  // namespace timed_test
