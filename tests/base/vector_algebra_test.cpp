// SPDX-License-Identifier: MIT
#include <slant/base/vector_algebra.hpp>

#include <support/testing.hpp>

namespace {

namespace vectors = slant::vectors;
using strided = Eigen::Map<VectorXd, 0, Eigen::InnerStride<3>>;

VectorXd ramp(int n, double first) {
  return VectorXd::LinSpaced(n, first, first + n - 1);
}

}  // namespace

TEST_CASE("whole vectors") {
  VectorXd const x = ramp(7, 1), y = ramp(7, -2.5);
  VectorXd z;
  vectors::copy(x, z);  // takes the size
  CHECK(z == x);
  vectors::negate(x, z);
  CHECK(z == -x);
  vectors::sum(x, y, z);
  CHECK(z == x + y);
  vectors::difference(x, y, z);
  CHECK(z == x - y);
  vectors::waxpy(0.3, x, y, z);
  CHECK(z == y + 0.3 * x);
  vectors::waxpby(0.3, x, -0.7, y, z);
  CHECK(z == 0.3 * x - 0.7 * y);
  vectors::multiply(x, y, z);
  CHECK(z == x.cwiseProduct(y));
  vectors::quotient(y, x, z);
  CHECK(z == y.cwiseQuotient(x));
  vectors::scale(0.1, x, z);
  CHECK(z == 0.1 * x);
  vectors::scale(3, z);
  CHECK(z == 3 * VectorXd(0.1 * x));
  z = x;
  vectors::divide(3, z);
  CHECK(z == x / 3);
  vectors::axpy(0.3, y, z);
  CHECK(z == x / 3 + 0.3 * y);
  z = x;
  vectors::add(y, z);
  CHECK(z == x + y);
  vectors::subtract(y, z);
  CHECK(z == VectorXd(x + y) - y);
  vectors::fill(4, z);
  CHECK(z == VectorXd::Constant(7, 4));
  vectors::set_zero(z);
  CHECK(z == VectorXd::Zero(7));
  CHECK(vectors::equal(x, x));
  CHECK_FALSE(vectors::equal(x, y));
  CHECK_FALSE(vectors::equal(x, ramp(6, 1)));
}

TEST_CASE("results in place, entries apart from each other, and parts of vectors") {
  VectorXd const x = ramp(5, 1), y = ramp(5, 10);
  VectorXd z = x;
  vectors::waxpby(2, z, -3, y, z);
  CHECK(z == 2 * x - 3 * y);
  vectors::waxpy(-1, z, z, z);
  CHECK(z == VectorXd::Zero(5));

  VectorXd memory = VectorXd::Constant(15, -1);
  strided apart(memory.data(), 5);
  vectors::copy(x, apart);
  for (int i = 0; i < 15; ++i) CHECK(memory[i] == (i % 3 == 0 ? x[i / 3] : -1));
  vectors::axpy(2, y, apart);
  CHECK(apart == x + 2 * y);
  vectors::sum(apart, y, z);
  CHECK(z == x + 3 * y);
  vectors::keep(VectorXd(x - VectorXd::Constant(5, 1)), y, apart);
  CHECK(apart[0] == 0);
  CHECK(apart[1] == y[1]);

  auto part = memory.segment(4, 5);
  vectors::copy(x, part);
  CHECK(memory.segment(4, 5) == x);
  vectors::fill(7, memory.segment(0, 2));
  CHECK(memory[1] == 7);
}

TEST_CASE("several columns, whatever the order they are stored in") {
  using by_rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  MatrixXd const a = MatrixXd::Random(4, 3), b = MatrixXd::Random(4, 3);
  by_rows const c = b;
  MatrixXd d;
  vectors::difference(a, b, d);
  CHECK(d == a - b);
  vectors::difference(a, c, d);
  CHECK(d == a - b);
  by_rows e = c;
  vectors::waxpy(2, c, e, e);
  CHECK(e == 3 * c);
  MatrixXd wide = MatrixXd::Zero(6, 3);
  auto middle = wide.middleRows(1, 4);
  vectors::copy(a, middle);
  CHECK(wide.middleRows(1, 4) == a);
  CHECK(wide.row(0).isZero());
  CHECK(wide.row(5).isZero());
}

TEST_CASE("nothing allocates where sizes fit") {
  VectorXd const x = ramp(50, 1), y = ramp(50, 3);
  VectorXd z(50);
  slant::testing::allocation_guard const guard;
  vectors::copy(x, z);
  vectors::waxpby(2, x, 3, y, z);
  vectors::multiply(x, z, z);
  vectors::keep(x, y, z);
  vectors::axpy(-2, y, z);
  double const product = slant::inner_product(x, z) + slant::norm(z);
  auto const allocations = guard.count();
  CHECK(product != 0);
  CHECK(allocations == 0);
}
