// SPDX-License-Identifier: MIT
#include "spd_matrices.hpp"

#include <slant/iteration/solve.hpp>
#include <slant/krylov/face_cg.hpp>

#include <doctest/doctest.h>

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

}  // namespace face_cg_test
