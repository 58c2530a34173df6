// SPDX-License-Identifier: MIT
#include <slant/iteration/solve.hpp>

#include <slant/krylov/face_cg.hpp>
#include <slant/operators/counted.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>
#include <slant/sets/face.hpp>

#include <doctest/doctest.h>

#include <support/allocation_guard.hpp>
#include "spd_matrices.hpp"

namespace face_cg_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A face given by its 0/1 mask.
struct masked {
  VectorXd mask;
  void keep(auto const& x, auto& y) const { slant::local(y) = mask.cwiseProduct(slant::local(x)); }
};

TEST_CASE("face_cg minimises over the free components and leaves the others alone") {
  auto const M = test::with_spectrum(test::log_spaced(30, 50));
  VectorXd const b = test::random_vector(30), x0 = test::random_vector(30, 5);
  masked face{VectorXd::Zero(30)};
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < 30; i += 2) {
    face.mask(i) = 1;
    free.push_back(i);
  }
  auto const A = test::spd(M);
  auto const r = slant::solve(slant::face_cg{A, b, face}, x0,
                              slant::residual_below(1e-13) || slant::at_most(200));
  REQUIRE(r.converged());

  // Oracle: the dense system of the free components.
  VectorXd fixed = x0;
  for (auto i : free) fixed(i) = 0;
  VectorXd const rhs = (b - M * fixed)(free);
  VectorXd const exact = M(free, free).ldlt().solve(rhs);
  CHECK((r.x()(free) - exact).norm() <= 1e-11 * exact.norm());
  for (Eigen::Index i = 1; i < 30; i += 2) CHECK(r.x()(i) == x0(i));
  CHECK((r.state.unit * r.state.r - (M * r.x() - b)).norm() <= 1e-12 * b.norm());
}

TEST_CASE("an empty face is solved at once, a full one is plain cg") {
  auto const M = test::with_spectrum(test::log_spaced(10, 5));
  VectorXd const b = test::random_vector(10);
  auto const A = test::spd(M);
  auto const stop = slant::residual_below(1e-12) || slant::at_most(50);
  masked const none{VectorXd::Zero(10)}, all{VectorXd::Ones(10)};
  VectorXd const x0 = VectorXd::Zero(10);
  auto const r = slant::solve(slant::face_cg{A, b, none}, x0, stop);
  CHECK(r.converged());
  CHECK(r.iterations() == 0);
  CHECK(r.x() == x0);
  auto const s = slant::solve(slant::face_cg{A, b, all}, x0, stop);
  CHECK(s.converged());
  CHECK((s.x() - VectorXd(M.ldlt().solve(b))).norm() <= 1e-10 * s.x().norm());
}

TEST_CASE("a flat direction of the face is a breakdown, not a division by zero") {
  MatrixXd const M = Eigen::Vector3d(1, 0, 1).asDiagonal();
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(M);
  VectorXd const b = Eigen::Vector3d(0, 1, 0);
  masked const all{VectorXd::Ones(3)};
  auto const r = slant::solve(slant::face_cg{A, b, all}, VectorXd(VectorXd::Zero(3)),
                              slant::residual_below(1e-12) || slant::at_most(10));
  CHECK(r.status == slant::status::breakdown);
  CHECK(r.x().allFinite());
}

TEST_CASE("far from the boundary it is face_cg, bit for bit") {
  auto const M = test::with_spectrum(test::log_spaced(12, 50));
  VectorXd const b = test::random_vector(12), x0 = VectorXd::Zero(12);
  auto const A = test::spd(M);
  auto const set = slant::discs(VectorXd(VectorXd::Constant(6, 1e6)));
  slant::face<double> const face(set, x0);
  auto const stop = slant::residual_below(1e-12) || slant::at_most(50);
  auto const r = slant::solve(slant::cg_feas{A, b, set, face}, x0, stop);
  auto const twin = slant::solve(slant::face_cg{A, b, face}, x0, stop);
  REQUIRE(r.converged());
  CHECK(r.x() == twin.x());
  CHECK(r.state.work == twin.state.work);
  CHECK_FALSE(r.state.at_boundary);
}

TEST_CASE("the half step ends on the boundary, lowers q, and names who blocked") {
  // q = ½‖x − b‖²: one CG step would go to b, the discs of radius 1 end at different lengths.
  VectorXd b(8);
  b << 3, 4, 0.3, 0.4, -30, 40, 5, 6;
  auto const A = test::spd(MatrixXd(MatrixXd::Identity(8, 8)));
  auto const set =
      slant::cartesian(slant::discs(VectorXd(VectorXd::Ones(3))), slant::free_components(2));
  VectorXd const x0 = VectorXd::Zero(8);
  slant::face<double> const face(set, x0);
  auto const counting = slant::counted(A);
  auto const r = slant::solve(slant::cg_feas{counting, b, set, face}, x0,
                              slant::residual_below(1e-12) || slant::at_most(5));
  CHECK(r.status == slant::status::stalled);
  CHECK(r.reason == "the boundary of the set is reached before the minimum on the face");
  CHECK(r.state.at_boundary);
  CHECK(r.state.blocked == std::vector<slant::index>{2});
  CHECK((r.x() - b / 50).norm() <= 1e-15);
  CHECK(set.contains(r.x()));
  CHECK((r.state.unit * r.state.r - (r.x() - b)).norm() <= 1e-14 * b.norm());
  CHECK(counting.applications() == 1);  // the one of the step: r came along
  CHECK(r.x().dot(0.5 * r.x() - b) < 0);
}

TEST_CASE("blocks that reach their boundaries together are all named; others stay off the face") {
  VectorXd const b{{2.0, -3.0, -3.0, 5.0}};
  auto const A = test::spd(MatrixXd(MatrixXd::Identity(4, 4)));
  auto const set = slant::half_lines(4);
  VectorXd const x0{{1.0, 1.0, 1.0, 0.0}};
  slant::face<double> const face(set, x0);
  auto const r = slant::solve(slant::cg_feas{A, b, set, face}, x0, slant::at_most(5));
  CHECK(r.state.at_boundary);
  CHECK(r.state.blocked == std::vector<slant::index>{1, 2});
  CHECK(r.x() == VectorXd{{1.25, 0.0, 0.0, 0.0}});
}

TEST_CASE("no allocation, half step included") {
  VectorXd b = VectorXd::Constant(40, -1.0);
  b(0) = 1;
  auto const M = test::with_spectrum(test::log_spaced(40, 10));
  auto const A = test::spd(M);
  auto const set = slant::half_lines(40);
  VectorXd const x0 = VectorXd::Ones(40);
  slant::face<double> const face(set, x0);
  slant::cg_feas const method{A, b, set, face};
  auto s = method.start(x0);
  slant::testing::allocation_guard guard;
  for (int k = 0; k < 40; ++k) method.step(s);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
  CHECK(s.at_boundary);
  CHECK(s.blocked.size() >= 1);
}

TEST_CASE("no end at all: unbounded; a start outside: refused") {
  MatrixXd const M = Eigen::Vector2d(1, 0).asDiagonal();
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(M);
  auto const set = slant::half_lines(2);
  VectorXd const b{{0.0, 1.0}}, one = VectorXd::Ones(2);
  slant::face<double> const face(set, one);
  auto const r = slant::solve(slant::cg_feas{A, b, set, face}, VectorXd{{0.0, 1.0}},
                              slant::residual_below(1e-12) || slant::at_most(10));
  CHECK(r.status == slant::status::unbounded);
  CHECK(r.x().allFinite());
  slant::cg_feas const method{A, b, set, face};
  CHECK_THROWS_WITH_AS(static_cast<void>(method.start(VectorXd(-one))),
                       "x0: got a point outside, expected a point of the set", slant::bad_input);
  CHECK_THROWS_AS((slant::cg_feas{A, b, slant::half_lines(3), face}), slant::bad_input);
}

}  // namespace face_cg_test
