// SPDX-License-Identifier: MIT
#include <slant/methods/parts/curved_minimum.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/problems/cut_face.hpp>
#include <slant/sets/sets.hpp>

#include <support/testing.hpp>

namespace cut_face_test {

using namespace test::evaluated;

MatrixXd random_matrix(Eigen::Index rows, Eigen::Index cols, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> gaussian;
  return MatrixXd::NullaryExpr(rows, cols, [&] { return gaussian(generator); });
}

TEST_CASE("the saddle point system of the face, as solved by dense matrices") {
  // Two free components, two half lines (one at its bound), a disc that slides and one that sticks.
  auto const set = slant::cartesian(slant::free_components(2), slant::half_lines(2),
                                    slant::discs(VectorXd{{1.0, 1.0}}));
  VectorXd const z{{3.0, -2.0, -1.0, 2.0, 1.2, 1.6, 0.1, 0.2}};
  MatrixXd const root = random_matrix(8, 8, 1);
  MatrixXd const A = root * root.transpose() + MatrixXd::Identity(8, 8);
  MatrixXd const N = random_matrix(2, 8, 2);
  VectorXd const r = random_matrix(8, 1, 3), offset = N.transpose() * random_matrix(2, 1, 4);
  double const α = 0.7;

  // The free directions: all but the closed half line and the normal of the sliding disc, whose
  // projection shrinks by 1/2 along the tangent: C = 2 − 1 there.
  MatrixXd basis = MatrixXd::Zero(8, 6);
  basis(0, 0) = basis(1, 1) = basis(3, 2) = basis(6, 3) = basis(7, 4) = 1;
  VectorXd const tangent{{-0.8, 0.6}};
  basis.block<2, 1>(4, 5) = tangent;
  MatrixXd H = basis.transpose() * A * basis;
  H(5, 5) += 1 / α;
  MatrixXd saddle = MatrixXd::Zero(8, 8);
  saddle << H, (N * basis).transpose(), N * basis, MatrixXd::Zero(2, 2);
  VectorXd right(8);
  right << -(basis.transpose() * r), -(N * offset);
  VectorXd const solution = test::solution_of(saddle, right);

  slant::cut_face<double> face(set, N.sparseView());
  REQUIRE(face.assign(set, z, 1.0));
  VectorXd lifted(8);
  face.lift(offset, lifted);
  lifted = -lifted;
  VectorXd gradient = r + A * lifted;
  face.whole().add_curvature(1 / α, lifted, gradient);
  auto const a = slant::matrix(A);
  slant::no_workspace w;
  MatrixXd const inverse = A.inverse();
  auto const M = slant::matrix(inverse);
  slant::curved_minimum<VectorXd, std::remove_const_t<decltype(M)>> inner(r, 8, M);
  auto const done =
      inner.minimise(a, w, M, gradient, face, α, inverse.diagonal().mean(), 1e-14, 100);
  CHECK(done.iterations <= 6);  // four dimensions, and rounding errors
  gradient += inner.image;
  face.whole().add_curvature(1 / α, inner.t, gradient);
  VectorXd dν(8);
  face.balance(gradient, dν);
  CHECK((lifted + inner.t - basis * solution.head(6)).norm() <= 1e-12);
  CHECK((-dν - N.transpose() * solution.tail(2)).norm() <= 1e-11);
}

TEST_CASE("a face that leaves an equation nothing to act on is told") {
  auto const set = slant::half_lines(3);
  sparse N(2, 3);
  N.insert(0, 0) = 1;
  N.insert(1, 1) = 1;
  slant::cut_face<double> face(set, N);
  CHECK(face.assign(set, VectorXd{{1.0, 1.0, 1.0}}, 1.0));
  CHECK(!face.assign(set, VectorXd{{1.0, -1.0, 1.0}}, 1.0));
  CHECK(face.assign(set, VectorXd{{1.0, 1.0, -1.0}}, 1.0));
  // x₀ = 0 twice where x₁ is held: the projector and the lift are those of the first row.
  N.coeffRef(1, 0) = 0.6;
  N.coeffRef(1, 1) = 0.8;
  slant::cut_face<double> same(set, N);
  CHECK(!same.assign(set, VectorXd{{1.0, -1.0, 1.0}}, 1.0));
  VectorXd cut(3), lift(3);
  same.keep(VectorXd{{4.0, 5.0, 6.0}}, cut);
  CHECK(cut == VectorXd{{0.0, 0.0, 6.0}});
  VectorXd const agreed{{3.0, 0.0, 0.0}}, apart{{3.0, 1.0, 0.0}};
  same.lift(agreed, lift);
  CHECK((lift - agreed).norm() <= 1e-15);
  CHECK(same.meets(VectorXd(agreed - lift), 3.0));
  same.lift(apart, lift);
  CHECK(!same.meets(VectorXd(apart - lift), 3.0));
  CHECK(same.assign(set, VectorXd{{1.0, 1.0, 1.0}}, 1.0));
  slant::cut_face<double> none(set, sparse(0, 3));
  CHECK(none.assign(set, VectorXd{{1.0, -1.0, 1.0}}, 1.0));
  VectorXd kept(3);
  none.keep(VectorXd{{1.0, 2.0, 3.0}}, kept);
  CHECK(kept == VectorXd{{1.0, 0.0, 3.0}});
}

}  // namespace cut_face_test
