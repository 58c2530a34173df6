// SPDX-License-Identifier: MIT
#include <slant/sets/sets.hpp>

#include <fem/active_counts.hpp>
#include <support/testing.hpp>

namespace active_counts_test {

TEST_CASE("a block is active when x - r / A_ii lies strictly outside its set") {
  MatrixXd const A = Eigen::Vector4d(2, 4, 4, 1).asDiagonal();
  auto const set = slant::cartesian(slant::half_lines(1), slant::discs(VectorXd::Ones(1)),
                                    slant::free_components(1));
  auto const counts = [&](VectorXd const& b, VectorXd const& x) {
    return fem::count_active(set, A, b, x);
  };
  VectorXd const origin = VectorXd::Zero(4);
  // z = x − (A x − b)/A_ii = b/A_ii for a diagonal matrix.
  CHECK(counts(Eigen::Vector4d(2, 0, 0, 5), origin) == fem::active_counts{0, 0});
  CHECK(counts(Eigen::Vector4d(-2, 0, 0, 5), origin) == fem::active_counts{1, 0});
  CHECK(counts(Eigen::Vector4d(0, 4, 0, 5), origin) == fem::active_counts{0, 0});  // on the circle
  CHECK(counts(Eigen::Vector4d(0, 4, 0.5, 5), origin) == fem::active_counts{0, 1});
  // The step belongs to the block, not to the matrix: with 1/2 for all the disc would be active.
  CHECK(counts(Eigen::Vector4d(0, 3, 0, 5), origin) == fem::active_counts{0, 0});
  CHECK((fem::active_blocks(set, A, VectorXd(Eigen::Vector4d(-1, 9, 0, 5)), origin) ==
         std::vector<bool>{true, true, false}));
}

}  // namespace active_counts_test
