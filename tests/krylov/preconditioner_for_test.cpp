// SPDX-License-Identifier: MIT
#include <slant/iteration/solve.hpp>
#include <slant/krylov/preconditioner.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/sets/sets.hpp>

#include <support/testing.hpp>

namespace preconditioner_for_test {

/// The exact inverse on every face, by dense algebra.
struct exact_on_faces {
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
  MatrixXd A;
  int* entered;

  struct room {
    VectorXd kept;
  };
  [[nodiscard]] Eigen::Index rows() const { return A.rows(); }
  [[nodiscard]] Eigen::Index cols() const { return A.cols(); }
  [[nodiscard]] room workspace(VectorXd const& x) const { return {VectorXd::Ones(x.size())}; }
  void apply(VectorXd const& x, VectorXd& y, room&) const { y = A.ldlt().solve(x); }
  template <class Face>
  void enter(Face const& face, room& w) const {
    face.keep(VectorXd(VectorXd::Ones(A.rows())), w.kept);
    ++*entered;
  }
  void apply_on_face(VectorXd const& x, VectorXd& y, room& w) const {
    MatrixXd held = w.kept.asDiagonal() * A * w.kept.asDiagonal();
    held.diagonal() += VectorXd::Ones(A.rows()) - w.kept;
    y = w.kept.cwiseProduct(VectorXd(held.ldlt().solve(w.kept.cwiseProduct(x))));
  }
};

static_assert(slant::preconditions_faces<exact_on_faces, VectorXd, slant::curved_face<double>>);

MatrixXd matrix(Eigen::Index n) {
  MatrixXd A = 2 * MatrixXd::Identity(n, n);
  A.diagonal(1).setConstant(-1);
  A.diagonal(-1).setConstant(-1);
  return A;
}

TEST_CASE("with the inverse on faces a Newton step is one product of the inner iteration") {
  MatrixXd const A = matrix(40);
  VectorXd const b = VectorXd::LinSpaced(40, -1, 1.5);
  int entered = 0;
  exact_on_faces const M{A, &entered};
  auto const spd = slant::matrix<slant::self_adjoint, slant::positive_definite>(A);
  slant::separable_qp const qp{spd, b, slant::half_lines(40)};
  auto const r = slant::solve(slant::symmetric_newton{qp, M}, test::zeros(40),
                              slant::reduced_gradient_below(1e-12) || slant::at_most(50));
  REQUIRE(r.converged());
  CHECK(entered > 0);
  CHECK(entered <= r.iterations());
  CHECK(r.state.work.inner_iterations <= r.iterations());
  VectorXd const gradient = A * r.x() - b;
  CHECK(r.x().minCoeff() == 0);
  CHECK(gradient.minCoeff() >= -1e-12);
  CHECK(r.x().cwiseProduct(gradient).cwiseAbs().maxCoeff() <= 1e-11);
}

TEST_CASE("where the boundary is curved the plain preconditioner serves") {
  MatrixXd const A = matrix(30);
  VectorXd const b = VectorXd::LinSpaced(30, -2, 2);
  int entered = 0;
  exact_on_faces const M{A, &entered};
  auto const spd = slant::matrix<slant::self_adjoint, slant::positive_definite>(A);
  VectorXd const radii = VectorXd::Constant(10, 0.3);
  auto const set = slant::cartesian(slant::half_lines(10), slant::discs(radii));
  slant::separable_qp const qp{spd, b, set};
  auto const stop = slant::reduced_gradient_below(1e-11) || slant::at_most(100);
  VectorXd const zero = VectorXd::Zero(30);
  auto const r = slant::solve(slant::symmetric_newton{qp, M}, zero, stop);
  auto const plain = slant::solve(slant::symmetric_newton{qp}, zero, stop);
  REQUIRE(r.converged());
  REQUIRE(plain.converged());
  CHECK((r.x() - plain.x()).norm() <= 1e-8 * plain.x().norm());
}

}  // namespace preconditioner_for_test
