// SPDX-License-Identifier: MIT
#include "schur_contact_scenes.hpp"

#include <slant/testing/archetypes.hpp>

#include <doctest/doctest.h>

#include <support/two_processes.hpp>

namespace schur_contact_vectors_test {

using namespace schur_contact_scenes;
namespace archetype = slant::testing::archetype;

TEST_CASE("vectors that are no Eigen objects") {
  struct injected {  // Q of U = (e₁), by hand
    [[nodiscard]] Eigen::Index rows() const { return 3; }
    [[nodiscard]] Eigen::Index cols() const { return 3; }
    void apply(archetype::vector const& x, archetype::vector& y) const {
      y.local() = x.local();
      y.local()[1] = (x.local()[0] + x.local()[2]) / 2;
    }
    void add_minimiser(double α, archetype::vector const& b, archetype::vector& y,
                       slant::no_workspace&) const {
      y.local()[1] += α * b.local()[1] / 2;
    }
  };
  MatrixXd const k = chain(3);
  MatrixXd const b{{1, 0, 0}, {0, 0, -1}};
  VectorXd const c{{1, 0}}, f{{2, 0, -1}};
  slant::constraint_rows<double> const rows(b.sparseView(), c);
  archetype::psd_operator const K(k);
  archetype::vector const load(f), zero(VectorXd(VectorXd::Zero(3)));
  auto const r = slant::solve(slant::schur_contact{slant::polyhedral_qp{K, load, rows, injected{}}},
                              zero, slant::residual_below(1e-13) || slant::at_most(20));
  REQUIRE(r.converged());
  auto const reference = oracle::minimum_over_polyhedron(k, f, b, c);
  CHECK((r.x().local() - reference->u).norm() <= 1e-12);

  // The same projector where it moves a row, which nobody can see before it does.
  slant::constraint_rows<double> const moved(MatrixXd{{0, 1, 0}, {0, 0, -1}}.sparseView(), c);
  auto const wrong =
      slant::solve(slant::schur_contact{slant::polyhedral_qp{K, load, moved, injected{}}}, zero,
                   slant::residual_below(1e-13) || slant::at_most(20));
  CHECK(wrong.status == status::breakdown);
  CHECK(wrong.reason == "the projector moves a row of B: it is not that of a U with B U = 0");
}

/// K of one process: no unknown of the one is joined to one of the other.
struct shared_stiffness {
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
  MatrixXd k;
  [[nodiscard]] Eigen::Index rows() const { return k.rows(); }
  [[nodiscard]] Eigen::Index cols() const { return k.cols(); }
  void apply(test::shared_vector const& x, test::shared_vector& y) const {
    y.local().noalias() = k * x.local();
  }
};
struct nothing_inside : slant::no_projector {
  using slant::no_projector::no_projector;
};

TEST_CASE("two processes, each with rows of its own") {
  std::srand(4);
  for (int round = 0; round < 6; ++round) {
    MatrixXd const A = MatrixXd::Random(9, 9);
    std::array const blocks{
        MatrixXd(A.topLeftCorner(5, 5).transpose() * A.topLeftCorner(5, 5) +
                 0.1 * MatrixXd::Identity(5, 5)),
        MatrixXd(A.bottomRightCorner(4, 4).transpose() * A.bottomRightCorner(4, 4) +
                 MatrixXd::Identity(4, 4))};
    small_problem p{both(blocks[0], blocks[1]), 4 * VectorXd::Random(9), MatrixXd::Zero(7, 9),
                    VectorXd::Random(7).cwiseAbs()};
    p.B.topLeftCorner(4, 5) = MatrixXd::Random(4, 5);
    p.B.bottomRightCorner(3, 4) = MatrixXd::Random(3, 4);
    p.c.head(4).setZero();  // the first starts in a corner, and has rows to release
    test::two_processes group;
    std::array<VectorXd, 2> u;
    std::array<slant::index, 2> releases{};
    bool const finished = test::two_processes::run([&](int rank) {
      auto const at = std::size_t(rank);
      int const first = 5 * rank, count = 5 - rank;
      MatrixXd const b = p.B.block(4 * rank, first, 4 - rank, count);
      row_set const rows(b.sparseView(), VectorXd(p.c.segment(4 * rank, 4 - rank)));
      shared_stiffness const K{blocks[at]};
      test::shared_vector const f(group, rank, p.f.segment(first, count));
      auto u0 = f;
      u0.local().setZero();
      auto const r = slant::solve(
          slant::schur_contact{slant::polyhedral_qp{K, f, rows, nothing_inside(count)}}, u0,
          slant::residual_below(1e-12) || slant::at_most(300));
      if (!r.converged()) return;
      u[at] = r.x().local();
      releases[at] = r.state.releases;
    });
    REQUIRE(finished);
    REQUIRE(u[0].size() == 5);
    REQUIRE(u[1].size() == 4);
    VectorXd both_parts(9);
    both_parts << u[0], u[1];
    auto const reference = oracle::minimum_over_polyhedron(p.K, p.f, p.B, p.c);
    CHECK((both_parts - reference->u).norm() <= 1e-9 * (1 + reference->u.norm()));
    CHECK(releases[0] == releases[1]);
  }
}

}  // namespace schur_contact_vectors_test
