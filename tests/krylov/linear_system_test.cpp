// SPDX-License-Identifier: MIT
#include <slant/iteration/solve.hpp>
#include <slant/krylov/krylov.hpp>
#include <slant/operators/counted.hpp>

#include <support/testing.hpp>
#include "spd_matrices.hpp"

namespace linear_system_test {

template <class W>
struct minimal_state {
  VectorXd x;
  VectorXd r;
  W a_workspace;
  double unit = 1;
  double residual_norm = 0;
  double residual_scale = 0;
  slant::status status = slant::status::running;
  slant::work work{};
};

TEST_CASE("first residual and its scale: one product, none from zero") {
  auto const M = test::with_spectrum(test::log_spaced(4, 10));
  auto const A = slant::counted(test::spd(M));
  VectorXd const b = test::random_vector(4), x = test::random_vector(4, 7);
  auto const start = [&](VectorXd const& right, VectorXd const& x0) {
    minimal_state<decltype(slant::workspace(A, x0))> s{x0, VectorXd(4), slant::workspace(A, x0)};
    slant::detail::start_residual(A, right, s);
    return s;
  };
  auto const zero = start(b, VectorXd::Zero(4));
  CHECK(zero.unit * zero.r == -b);
  CHECK(std::log2(zero.unit) == std::ceil(std::log2(b.norm())));
  CHECK(zero.residual_scale == zero.residual_norm);
  CHECK(A.applications() == 0);
  auto const warm = start(b, x);
  CHECK((warm.unit * warm.r - (M * x - b)).norm() <= 1e-15 * b.norm());
  CHECK(warm.residual_scale == doctest::Approx(b.norm()).epsilon(1e-14));
  CHECK(warm.work.operator_applications == 1);
  CHECK(A.applications() == 1);
  auto const homogeneous = start(VectorXd::Zero(4), x);
  CHECK(homogeneous.residual_scale == homogeneous.residual_norm);
  CHECK(start(VectorXd::Zero(4), VectorXd::Zero(4)).status == slant::status::converged);
}

TEST_CASE("converged is said of A x − b, not of a residual that lost it on the way from far away") {
  auto const M = test::with_spectrum(test::log_spaced(30, 100));
  auto const A = test::spd(M);
  VectorXd const b = test::random_vector(30);
  auto const stop = slant::residual_below(1e-10) || slant::at_most(1000);
  auto const check = [&](auto const& method, double size) {
    auto const r = slant::solve(method, VectorXd(VectorXd::Constant(30, size)), stop);
    CHECK(r.converged());
    CHECK((M * r.x() - b).norm() <= 1.01e-10 * b.norm());
  };
  for (double size : {0.0, 1e6, 1e10, 1e14}) {
    CAPTURE(size);
    check(slant::cg{A, b}, size);
    check(slant::bicgstab{A, b}, size);
  }
}

TEST_CASE("more digits than x can hold: stalled, and soon") {
  auto const A = test::spd(test::with_spectrum(test::log_spaced(30, 1e4)));
  VectorXd const b = test::random_vector(30), zero = VectorXd::Zero(30);
  auto const check = [&](auto const& method) {
    auto const r =
        slant::solve(method, zero, slant::residual_below(1e-17) || slant::at_most(100000));
    CHECK(r.status == slant::status::stalled);
    CHECK(r.iterations() < 2000);
  };
  check(slant::cg{A, b});
  check(slant::bicgstab{A, b});
}

TEST_CASE("one product confirms success, none where r comes from x already") {
  auto const M = test::with_spectrum(test::log_spaced(30, 100));
  auto const A = slant::counted(test::spd(M));
  VectorXd const b = test::random_vector(30), zero = VectorXd::Zero(30);
  auto const r = slant::solve(slant::cg{A, b}, zero, slant::residual_below(1e-8));
  CHECK(A.applications() == r.iterations() + 1);
  CHECK(A.applications() == r.state.work.operator_applications);
  auto const again = slant::solve(slant::cg{A, b}, r.x(), slant::residual_below(1e-8));
  CHECK(again.converged());
  CHECK(again.state.work.operator_applications == 1);
}

TEST_CASE("a norm that overflows is a breakdown, not a solution") {
  auto const A = test::spd(MatrixXd(MatrixXd::Identity(10, 10)));
  VectorXd const b = VectorXd::Constant(10, 1.5e308), zero = VectorXd::Zero(10);
  auto const stop = slant::residual_below(1e-12) || slant::at_most(5);
  CHECK(slant::solve(slant::cg{A, b}, zero, stop).status == slant::status::breakdown);
  CHECK(slant::solve(slant::bicgstab{A, b}, zero, stop).status == slant::status::breakdown);
}

TEST_CASE("a residual that is no number is a breakdown") {
  minimal_state<int> s{VectorXd(2), VectorXd{{1.0, std::nan("")}}, 0};
  slant::detail::note_residual(s);
  CHECK(s.status == slant::status::breakdown);
}

}  // namespace linear_system_test
