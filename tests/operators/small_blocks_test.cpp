// SPDX-License-Identifier: MIT
#include <slant/operators/small_blocks.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>

namespace small_blocks_test {

TEST_CASE("blocks of one, two and three components among others: the matrix it stands for") {
  // 0 1 2 3 4 5 6 7: a block (1), a block (0, 4), a block (2, 5, 7 − …) with stride 2: (3, 5, 7).
  slant::small_blocks<double, slant::laws<slant::positive_definite>> B(8);
  B.append(1, 1, 1);
  B.append(2, 0, 4);
  B.append(3, 3, 2);
  B.block(0)(0, 0) = 5;
  B.block(1) = MatrixXd{{2.0, 0.5}, {0.5, 3.0}};
  B.block(2) = MatrixXd{{4.0, 1.0, 0.0}, {1.0, 4.0, -1.0}, {0.0, -1.0, 4.0}};
  B.assign_outside(VectorXd(VectorXd::LinSpaced(8, 10, 17)));
  CHECK(B.block_count() == 3);
  MatrixXd M = MatrixXd::Zero(8, 8);
  M(1, 1) = 5;
  M(0, 0) = 2;
  M(4, 4) = 3;
  M(0, 4) = M(4, 0) = 0.5;
  for (int i : {3, 5, 7}) M(i, i) = 4;
  M(3, 5) = M(5, 3) = 1;
  M(5, 7) = M(7, 5) = -1;
  M(2, 2) = 12;
  M(6, 6) = 16;
  VectorXd const x = VectorXd::LinSpaced(8, -1, 2.5);
  VectorXd y = VectorXd::Constant(8, 1e300), d(8);
  B.apply(x, y);
  CHECK((y - M * x).norm() <= 1e-15 * M.norm());
  B.apply_add(2.0, x, y);
  CHECK((y - 3 * M * x).norm() <= 1e-14 * M.norm());
  B.diagonal(d);
  CHECK(d == M.diagonal());
  slant::testing::check_operator_laws(B);
}

}  // namespace small_blocks_test
