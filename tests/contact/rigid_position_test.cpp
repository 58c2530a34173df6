// SPDX-License-Identifier: MIT
#include "loose_brick.hpp"

#include <slant/contact/free_motions.hpp>
#include <slant/contact/parts/rigid_position.hpp>
#include <support/testing.hpp>

namespace rigid_position_test {

using sparse = Eigen::SparseMatrix<double>;

/// R α.
VectorXd position(test::loose_brick const& b) {
  auto const motions = slant::contact::find_free_motions(b.K);
  sparse const R = slant::contact::detail::kernel_of(motions, b.K.rows());
  return R * slant::contact::detail::rigid_position<double>(b.K, b.data, R)();
}

TEST_CASE("rigid_position: a brick falls until it rests, however far that is") {
  test::loose_brick brick(1, {-0.3, 0, 0}, 0.05);
  CHECK(position(brick).isZero(0));  // no gap, nothing to do
  for (double const gap : {1e-6, 1.0, 1e4, -0.1}) {
    CAPTURE(gap);
    brick.data.d.setConstant(gap);
    // The springs give way by 3 force units over 12 nodes of a stiffness of 1e5 and more.
    VectorXd const left = brick.data.N * position(brick) - brick.data.d;
    CHECK(left.minCoeff() >= -1e-5 - 1e-9 * std::abs(gap));
    CHECK(left.maxCoeff() <= 1e-5 + 1e-9 * std::abs(gap));
    // Friction holds it along x, up to what its springs give.
    CHECK((brick.data.T * position(brick)).cwiseAbs().maxCoeff() <= 1e-5 + 1e-9 * std::abs(gap));
  }
}

TEST_CASE("rigid_position: it tilts over three nodes; far obstacles and units do not matter") {
  test::loose_brick brick(1, {0, 0, 0}, 0.05);
  auto const floor = brick.mesh.nodes_on({2, false});
  for (slant::index i = 0; i < 12; ++i) {
    brick.data.d(i) = 0.1 * (1 + 0.3 * brick.mesh.nodes(0, floor[std::size_t(i)]));
  }
  VectorXd const tilted = position(brick);
  CHECK((brick.data.N * tilted - brick.data.d).cwiseAbs().maxCoeff() <= 1e-5);
  auto other = brick;
  other.data.d(5) = 1e9;
  other.data.d(6) = std::numeric_limits<double>::infinity();
  CHECK((position(other) - tilted).norm() <= 1e-4);
  for (double const unit : {0x1p-400, 0x1p400}) {
    other = brick;
    other.K *= unit;
    other.data.f *= unit;
    other.data.g *= unit;
    CHECK((position(other) - tilted).norm() <= 1e-9);
    other = brick;
    other.K /= unit;
    other.data.d *= unit;
    CHECK((position(other) / unit - tilted).norm() <= 1e-9);
  }
  other = brick;
  for (slant::index i = 0; i < 12; i += 2) {
    other.data.N.coeffRef(i, brick.unknowns.first[floor[std::size_t(i)]] + 2) *= 1e8;
    other.data.d(i) *= 1e8;
  }
  CHECK((position(other) - tilted).norm() <= 1e-9);
}

TEST_CASE("rigid_position: it stays where nothing stops or moves it") {
  test::loose_brick sliding(1, {-0.3, 0, 0}, 0.01), lifted(-1, {0, 0, 0}, 0.05),
      idle(0, {0, 0, 0}, 0.05);
  for (auto* brick : {&sliding, &lifted, &idle}) {
    brick->data.d.setConstant(0.1);
    CHECK(position(*brick).isZero(0));
  }
}

}  // namespace rigid_position_test
