// SPDX-License-Identifier: MIT
#include <slant/contact/friction/friction_gauss_seidel.hpp>

#include "contact/friction_scenes.hpp"

#include <slant/contact/friction/verify.hpp>

#include <doctest/doctest.h>

namespace friction_sweeps_test {

using blocks = slant::contact::friction_blocks<3, double>;
using sweeps = slant::contact::friction_sweeps<3, double>;

TEST_CASE("sweeps: one contact takes one, many coupled ones converge to a solution") {
  auto const single = test::single_solution_cases();
  for (auto const& c : single) {
    if (c.problem.dimension() != 3) continue;
    blocks const b(c.problem);
    Eigen::VectorXd r = Eigen::VectorXd::Zero(3);
    sweeps const once(b);
    auto memory = once.memory();
    once.sweep(r, memory);
    CHECK((b.force(r) - c.r[0]).norm() <= 1e-13 * (1 + c.r[0].norm()));
  }
  auto const p = test::random_friction(8, 3, 0.4, 11);
  blocks const b(p);
  sweeps const s(b);
  auto memory = s.memory();
  Eigen::VectorXd r = Eigen::VectorXd::Zero(24);
  for (int k = 0; k < 400; ++k) s.sweep(r, memory);
  CHECK(slant::contact::verify(p, b.force(r)).relative_natural_map <= 1e-12);
}

TEST_CASE(
    "sweeps: open contacts cost nothing as neighbours, and nothing when they are passed over") {
  slant::index const m = 40;
  auto const p = test::chain_friction(m);
  blocks const b(p);
  sweeps const s(b);
  auto memory = s.memory();
  Eigen::VectorXd r = Eigen::VectorXd::Zero(3 * m);
  for (int k = 0; k < 5; ++k) s.sweep(r, memory);
  // Every second contact is open: all neighbours of the others.
  CHECK(s.sweep(r, memory, true) ==
        m + (m - 1));                         // diagonals, and closed neighbours of open contacts
  CHECK(s.sweep(r, memory, false) == m / 2);  // the diagonals of the closed
}

TEST_CASE("sweeps: contacts without compliance or with an indefinite block stay finite") {
  auto p = test::random_friction(3, 3, 0.5, 5);
  Eigen::MatrixXd W = p.W;
  W.middleRows(3, 3).setZero();
  W.middleCols(3, 3).setZero();
  p.W = W.sparseView();
  p.q[3] = 1;  // leaves by itself
  blocks const b(p);
  sweeps const s(b);
  auto memory = s.memory();
  Eigen::VectorXd r = Eigen::VectorXd::Constant(9, 1.);
  for (int k = 0; k < 1000; ++k) s.sweep(r, memory);
  CHECK(slant::contact::verify(p, b.force(r)).relative_natural_map <= 1e-10);
  W.block(3, 3, 3, 3) = -Eigen::Matrix3d::Identity();
  p.W = W.sparseView();
  p.q[3] = -1;
  blocks const negative(p);
  sweeps const t(negative);
  auto new_memory = t.memory();
  r.setZero();
  for (int k = 0; k < 10; ++k) t.sweep(r, new_memory);
  CHECK(r.allFinite());
}

TEST_CASE("sweeps: indefinite blocks with a positive diagonal are made definite") {
  Eigen::Matrix3d D = Eigen::Matrix3d::Identity();
  D(0, 1) = D(1, 0) = 5;
  auto const p =
      test::make_friction_problem(D, Eigen::Vector3d(-1, 2, 1), Eigen::VectorXd::Constant(1, 0.5));
  blocks const b(p);
  double const shift = sweeps(b).shift(0) / b.diagonal(0)(2, 2);  // in units of D
  CHECK(shift > 4);                                               // its smallest eigenvalue is −4
  CHECK(shift < 4.1);
  blocks const definite(test::chain_friction(2));
  CHECK(sweeps(definite).shift(1) == 0);
  sweeps const s(b);
  auto memory = s.memory();
  Eigen::VectorXd r = Eigen::VectorXd::Zero(3);
  for (int k = 0; k < 10; ++k) s.sweep(r, memory);
  CHECK(r.allFinite());
}

}  // namespace friction_sweeps_test
