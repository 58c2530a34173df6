// SPDX-License-Identifier: MIT
#include <slant/contact/free_motions.hpp>
#include <slant/factorizations/factorizations.hpp>
#include <slant/testing/laws.hpp>

#include <fem/box_mesh.hpp>
#include <fem/elasticity.hpp>
#include <support/dense_of.hpp>
#include <support/testing.hpp>
#include "spd_examples.hpp"

namespace generalized_inverse_test {

using namespace test::evaluated;
using slant::generalized_inverse;

/// A steel box that nothing holds.
template <int D>
struct floating_box {
  fem::box_mesh<D> mesh;
  sparse K;
  MatrixXd R;

  explicit floating_box(std::array<int, D> const& cells, Eigen::Matrix<double, D, 1> const& origin =
                                                             Eigen::Matrix<double, D, 1>::Zero()) {
    Eigen::Matrix<double, D, 1> size;
    for (int axis = 0; axis < D; ++axis) size[axis] = cells[static_cast<std::size_t>(axis)];
    mesh = fem::make_box_mesh<D>(cells, size, origin);
    auto const unknowns = fem::number_unknowns(mesh, [](Eigen::Index) { return false; });
    K = fem::stiffness<D>(mesh, unknowns, fem::lame(2.119e5, 0.277));
    R = slant::contact::rigid_body_modes(mesh.nodes);
  }
};

double size_of(sparse const& K) {
  return slant::detail::largest_row_sum(K);
}

/// max |K K⁺ K − K| / max |K|, the columns of K⁺K one by one.
double first_law(sparse const& K, generalized_inverse<double> const& inverse) {
  double worst = 0;
  VectorXd y(K.rows());
  auto w = slant::workspace(inverse, y);
  for (Eigen::Index j = 0; j < K.cols(); ++j) {
    VectorXd const column = K.col(j);
    slant::apply(inverse, column, y, w);
    worst = std::max(worst, (K * y - column).cwiseAbs().maxCoeff());
  }
  return worst / K.coeffs().cwiseAbs().maxCoeff();
}

/// P K⁺ P with the projector P onto the orthogonal complement of the kernel.
MatrixXd projected(generalized_inverse<double> const& inverse) {
  MatrixXd const& R = inverse.kernel();
  MatrixXd const P = MatrixXd::Identity(R.rows(), R.rows()) - R * R.transpose();
  return P * test::dense_of(inverse) * P;
}

TEST_CASE("K K+ K = K for slender bodies from 1:1 to 1:100") {
  for (int const length : {1, 10, test::effort(100, 30)}) {
    CAPTURE(length);
    floating_box<3> const box({length, 1, 1});
    generalized_inverse<double> const given(box.K, box.R);
    CHECK(first_law(box.K, given) <= 1e-11);
    CHECK((box.K * given.kernel()).norm() <= 1e-13 * size_of(box.K));
    generalized_inverse<double> const computed(box.K);
    CHECK(computed.kernel().cols() == 6);
    CHECK((box.K * computed.kernel()).norm() <= 1e-12 * size_of(box.K));
    CHECK(first_law(box.K, computed) <= 1e-10);
    // Both bases span the same space.
    MatrixXd const& R = given.kernel();
    CHECK((computed.kernel() - R * (R.transpose() * computed.kernel())).norm() <= 1e-5);
  }
  floating_box<2> const strip({test::effort(400, 100), 4});
  generalized_inverse<double> const plane(strip.K, strip.R);
  CHECK(plane.kernel().cols() == 3);
  CHECK(first_law(strip.K, plane) <= 1e-11);
  CHECK(generalized_inverse<double>(strip.K).kernel().cols() == 3);
}

TEST_CASE("far from the origin and in any units") {
  floating_box<3> const box({12, 2, 1}, {1e6, -2e6, 3e6});
  CHECK(first_law(box.K, generalized_inverse<double>(box.K, box.R)) <= 1e-11);
  for (double const unit : {1e-150, 1e150}) {
    sparse const K = unit * box.K;
    CHECK(first_law(K, generalized_inverse<double>(K, box.R)) <= 1e-11);
    CHECK(generalized_inverse<double>(K).kernel().cols() == 6);
  }
}

TEST_CASE("the fixing rows lie far apart: no motion of the body exceeds that of its fixed points") {
  for (int const length : {1, 10, 100}) {
    floating_box<3> const box({length, 1, 1});
    generalized_inverse<double> const inverse(box.K, box.R);
    MatrixXd const& R = inverse.kernel();
    MatrixXd const held = R(inverse.fixing(), Eigen::all);
    MatrixXd const amplification = test::solutions_of(held.transpose(), R.transpose());
    CHECK(amplification.cwiseAbs().maxCoeff() <= 1.05 + 1e-12);
  }
}

TEST_CASE("the projected operator is the Moore-Penrose inverse") {
  floating_box<3> const box({test::effort(16, 6), 1, 1});
  generalized_inverse<double> const inverse(box.K, box.R);
  Eigen::SelfAdjointEigenSolver<MatrixXd> const eigen{MatrixXd(box.K)};
  VectorXd reciprocal = eigen.eigenvalues().cwiseInverse();
  reciprocal.head(6).setZero();
  MatrixXd const pseudo =
      eigen.eigenvectors() * reciprocal.asDiagonal() * eigen.eigenvectors().transpose();
  CHECK((projected(inverse) - pseudo).norm() <= 1e-9 * pseudo.norm());
  slant::testing::check_operator_laws(inverse, {.roundings = 1e5});
}

TEST_CASE("two bodies in one matrix, unknowns without stiffness, a regular matrix, nothing") {
  sparse const one = test::grid_laplacian(3, 0.0);
  sparse units(2, 2);
  units.insert(0, 0) = 1;
  units.insert(1, 1) = 1e-6;  // much softer
  sparse two = test::blown_up(units, MatrixXd(one));
  two.conservativeResize(55, 55);
  for (double const unit : {1.0, 1e-30, 1e20}) {
    sparse const K = unit * two;
    generalized_inverse<double> const inverse(K);
    CHECK(inverse.kernel().cols() == 3);  // two constants, and the last unknown
    CHECK(first_law(K, inverse) <= 1e-12);
  }

  units.coeffRef(1, 1) = 1e-60;
  sparse const regular = test::blown_up(units, MatrixXd(test::grid_laplacian(3, 0.5)));
  generalized_inverse<double> const ordinary(regular);
  CHECK(ordinary.kernel().cols() == 0);
  CHECK(first_law(regular, ordinary) <= 1e-12);
  CHECK(generalized_inverse<double>(sparse(3, 3)).kernel().cols() == 3);
  CHECK(generalized_inverse<double>(sparse(0, 0)).rows() == 0);
}

TEST_CASE("what is no kernel is refused with what was measured") {
  floating_box<3> const box({3, 1, 1});
  auto const complaint = [&](sparse const& K, MatrixXd const& R) -> std::string {
    return test::complaint([&] { generalized_inverse<double> const inverse(K, R); });
  };
  CHECK(complaint(box.K, box.R) == "nothing thrown");
  MatrixXd wrong = box.R;
  wrong(0, 0) += 1e-6;
  CHECK(test::contains(complaint(box.K, wrong), "R: got max |K R| = "));
  CHECK(test::contains(complaint(box.K, wrong), "expected columns in the kernel of K"));
  std::string const incomplete = complaint(box.K, box.R.leftCols(5));
  CHECK(test::contains(incomplete, "R: got 5 directions"));
  CHECK(test::contains(incomplete, "expected the whole kernel"));
  // Trusses; of the first of these no pivot is zero up to rounding.
  for (unsigned const seed : {16U, 1U, 2U}) {
    std::mt19937 random(seed);
    MatrixXd const x = MatrixXd::NullaryExpr(3, 6, [&] { return double(random()) * 0x1p-31; });
    MatrixXd K = MatrixXd::Zero(18, 18);
    for (Eigen::Index i = 0; i < 6; ++i) {
      for (Eigen::Index j = 0; j < i; ++j) {
        VectorXd bar = VectorXd::Zero(18);
        bar.segment<3>(3 * i) = (x.col(i) - x.col(j)).normalized();
        bar.segment<3>(3 * j) = -bar.segment<3>(3 * i);
        K += bar * bar.transpose();
      }
    }
    Eigen::SelfAdjointEigenSolver<MatrixXd> const modes(K);
    CHECK(complaint(K.sparseView(), modes.eigenvectors().leftCols(6)) == "nothing thrown");
    CHECK(complaint(K.sparseView(), modes.eigenvectors().leftCols(5)) != "nothing thrown");
  }
  MatrixXd twice(box.R.rows(), 7);
  twice << box.R, box.R.col(2);
  CHECK(test::contains(complaint(box.K, twice), "columns of R: got rank 6"));
  CHECK(test::contains(complaint(box.K, box.R.topRows(4)), "rows of R"));
  sparse const negative = -box.K;
  CHECK(complaint(negative, box.R) != "nothing thrown");
  CHECK_THROWS_AS(generalized_inverse<double>{negative}, slant::bad_input);
}

TEST_CASE("an application does not allocate") {
  floating_box<3> const box({4, 1, 1});
  generalized_inverse<double> const inverse(box.K, box.R);
  VectorXd const x = VectorXd::Ones(box.K.rows());
  VectorXd y(x.size());
  auto w = slant::workspace(inverse, x);
  CHECK(test::allocations_of([&] { inverse.apply(x, y, w); }) == 0);
}

TEST_CASE("more directions than the iteration begins with") {
  // Twelve bars that nothing connects.
  sparse K(24, 24);
  for (int i = 0; i < 24; ++i) {
    K.insert(i, i) = 1;
    K.insert(i, i ^ 1) = -1;
  }
  CHECK(slant::computed_kernel(K).cols() == 12);
  sparse const apart = VectorXd::LinSpaced(24, 0, 23)
                           .unaryExpr([](double i) { return i < 2 ? 1e30 : 1.0; })
                           .asDiagonal() *
                       K;
  CHECK_THROWS_AS(static_cast<void>(slant::computed_kernel(apart)), slant::bad_input);
}

TEST_CASE("single precision") {
  Eigen::SparseMatrix<float> const K = test::grid_laplacian<float>(4, 0.0);
  slant::generalized_inverse<float> const inverse(K);
  CHECK(inverse.kernel().cols() == 1);
  Eigen::VectorXf b = Eigen::VectorXf::LinSpaced(64, -1.0F, 1.0F), x(64);
  slant::apply(inverse, b, x);
  CHECK((K * x - b).norm() <= 1e-5F * b.norm());
}

TEST_CASE("what has no kernel that can be told from the rest is refused") {
  sparse K = test::grid_laplacian(3, 0.0);
  CHECK(slant::computed_kernel(K).cols() == 1);
  // An eigenvalue of 200 rounding errors: neither zero nor not.
  K.coeffRef(5, 5) += 27 * 200 * std::numeric_limits<double>::epsilon() * 12;
  CHECK_THROWS_AS(static_cast<void>(slant::computed_kernel(K)), slant::bad_input);
  CHECK(slant::computed_kernel(test::grid_laplacian(3, 1e-6)).cols() == 0);
  CHECK_THROWS_AS(static_cast<void>(slant::computed_kernel(test::grid_laplacian(3, -1e-6))),
                  slant::bad_input);
}

}  // namespace generalized_inverse_test
