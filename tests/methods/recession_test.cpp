// SPDX-License-Identifier: MIT
#include <slant/slant.hpp>

#include <support/testing.hpp>

namespace recession_test {

/// A = diag(1, soft), b = (0, 1): q falls for ever along (0, 1) if soft = 0.
template <class Set>
auto program(Set const& set, double soft = 0) {
  return slant::separable_qp{slant::declare<slant::self_adjoint, slant::positive_semidefinite>(
                                 slant::diagonal(VectorXd{{1.0, soft}})),
                             VectorXd{{0.0, 1.0}}, set};
}

/// What the watch looks at.
struct snapshot {
  using scalar = double;
  VectorXd x;
  VectorXd r;
  double unit = 1;
  double σ = 1;
  double size_of_b = 1;
  VectorXd φ = VectorXd(2);
  VectorXd trial = VectorXd(2);
  struct {
    VectorXd p = VectorXd(2);
  } directions{};
  std::tuple<> a_workspace{};
  slant::work work{};
};

snapshot at(double x0, double x1) {
  return {VectorXd{{x0, x1}}, VectorXd{{x0, -1.0}}};
}

TEST_CASE("a cycle of any length that moves on along the kernel is found") {
  for (int period = 1; period <= 7; ++period) {
    CAPTURE(period);
    slant::recession_watch<VectorXd> watch(VectorXd(2), 2);
    bool found = false;
    int k = 0;
    for (; k < 100 && !found; ++k) {
      auto s = at(1 + k % period, k);
      found = watch.found(program(slant::half_lines(2)), s);
      if (found) {
        CHECK(s.directions.p(0) == 0.0);
        CHECK(s.directions.p(1) < 0.0);
        CHECK(s.work.operator_applications == 1);
      }
    }
    CHECK(found);
    CHECK(k <= 4 * period + 2);
  }
}

TEST_CASE("no direction: the set is in the way, the way is not flat, or it does not go down") {
  auto const never = [](auto const& set, auto const& snapshot_at, double soft = 0) {
    slant::recession_watch<VectorXd> watch(VectorXd(2), 2);
    bool found = false;
    for (int k = 0; k < 50; ++k) {
      auto s = snapshot_at(k);
      found = found || watch.found(program(set, soft), s);
    }
    return !found;
  };
  VectorXd const wide{{1e3, 1e3}};
  CHECK(never(slant::intervals(wide), [](int k) { return at(1, k); }));
  CHECK(never(slant::half_lines(2), [](int k) { return at(1 + 1e-3 * k, k); }));
  CHECK(never(slant::half_lines(2), [](int k) {
    auto s = at(1, k);
    s.r(1) = 1e-17;  // noise of a right-hand side in the range of A
    return s;
  }));
  CHECK(never(slant::half_lines(2), [](int) { return at(1, 1); }));
  // The differences of gradients have lost a curvature that A has, far below that of others.
  for (double const soft : {1e-9, 1e-20}) {
    CHECK(never(
        slant::half_lines(2), [](int k) { return at(1, k); }, soft));
  }
}

TEST_CASE("a solution that is far away: what rounding leaves of a slope that cancels is none") {
  double const e = 0x1p-30;
  MatrixXd const K{{e, e, 0}, {e, 0.25 + e, -0.5}, {0, -0.5, 1}};
  VectorXd const b{{e, e, 0}};  // K (−1, 2, 1)
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(K);
  slant::separable_qp const qp{A, b, slant::free_components(3)};
  auto const rule = slant::reduced_gradient_below(1e-9) || slant::at_most(300);
  CHECK(slant::solve(slant::kprgp{qp}, VectorXd(VectorXd::Zero(3)), rule).converged());
}

TEST_CASE("a direction that looks flat and is not is confirmed only now and then") {
  slant::recession_watch<VectorXd> watch(VectorXd(2), 2);
  slant::index spent = 0;
  auto const set = slant::half_lines(2);
  auto const qp = program(set, 1e-9);
  for (int k = 0; k < 1000; ++k) {
    auto s = at(1, k);
    CHECK_FALSE(watch.found(qp, s));
    spent += s.work.operator_applications;
  }
  CHECK(spent <= 10);
}

TEST_CASE("flatness and descent know no units") {
  VectorXd const p{{3.0, 4.0}};
  CHECK(slant::flatness(p, 0.5) == 12.5 * 0x1p-52);
  CHECK(slant::flatness(VectorXd(0x1p200 * p), 0x1p100) == 25 * 0x1p448);
  CHECK(slant::is_descent(1e-10, p, 1.0));
  CHECK(!slant::is_descent(1e-16, p, 1.0));
  CHECK(slant::is_descent(0x1p-433, p, 0x1p-400));
}

}  // namespace recession_test
