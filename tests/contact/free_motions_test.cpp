// SPDX-License-Identifier: MIT
#include <slant/contact/free_motions.hpp>
#include <slant/contact/parts/rigid_position.hpp>

#include <fem/stacked_bricks.hpp>
#include <support/testing.hpp>
#include "loose_brick.hpp"

namespace free_motions_test {

using namespace test::evaluated;
using Eigen::Matrix2Xd;
using Eigen::Matrix3Xd;
using slant::contact::factorize_stiffness;
using slant::contact::find_free_motions;
using slant::contact::node_layout;
using slant::contact::rigid_body_modes;

/// K and its layout with these unknowns left out.
struct body {
  sparse K;
  node_layout<double> layout;

  void hold(std::vector<Eigen::Index> const& unknowns) {
    std::vector<Eigen::Index> kept;
    node_layout<double> rest{layout.x, {}, {}};
    for (Eigen::Index j = 0; j < K.rows(); ++j) {
      if (std::find(unknowns.begin(), unknowns.end(), j) != unknowns.end()) continue;
      kept.push_back(j);
      rest.node.push_back(layout.node[std::size_t(j)]);
      rest.axis.push_back(layout.axis[std::size_t(j)]);
    }
    auto const P = slant::detail::columns_of_identity<double>(K.rows(), kept);
    K = sparse(P.transpose() * K * P);
    layout = rest;
  }
  /// The unknown of a node at a place.
  [[nodiscard]] Eigen::Index at(VectorXd const& place, int axis) const {
    for (std::size_t j = 0; j < layout.node.size(); ++j)
      if (layout.axis[j] == axis && layout.x.col(layout.node[j]) == place) return Eigen::Index(j);
    FAIL("no node there");
    return -1;
  }
  [[nodiscard]] std::string sentence() const { return find_free_motions(K, layout).sentence(); }
};

body make_brick() {
  auto const scene = fem::make_stack({.bricks = 1, .cells = {2, 2, 2}});
  return {scene.K, slant::contact::layout_of(scene.mesh.nodes, scene.unknowns.first)};
}

body make_plate() {
  auto const mesh = fem::make_box_mesh<2>({3, 2}, {3, 1});
  auto const own = fem::number_unknowns(mesh, [](Eigen::Index) { return false; });
  return {fem::stiffness<2>(mesh, own, fem::lame(10, 0.3)),
          slant::contact::interleaved_layout(mesh.nodes)};
}

TEST_CASE("free motions of a brick in space, held at more and more points") {
  std::string const name = "body 0 (unknowns 0 to ";
  body brick = make_brick();
  CHECK(brick.sentence() == name + "80) can move along x, y and z and turn about x, y and z");
  body sliding = brick;
  std::vector<Eigen::Index> floor;
  for (std::size_t j = 0; j < brick.layout.node.size(); ++j) {
    if (brick.layout.axis[j] == 2 && brick.layout.x(2, brick.layout.node[j]) == 0)
      floor.push_back(Eigen::Index(j));
  }
  sliding.hold(floor);
  CHECK(sliding.sentence() == name + "71) can move along x and y and turn about z");
  body pinned = brick;
  auto const corner = Vector3d(2, 0, 0);
  pinned.hold({brick.at(corner, 0), brick.at(corner, 1), brick.at(corner, 2)});
  CHECK(pinned.sentence() == name + "77) can turn about x, y and z");
  body hinged = brick;
  auto const edge = Vector3d(2, 1, 0);
  hinged.hold({brick.at(corner, 0), brick.at(corner, 1), brick.at(corner, 2), brick.at(edge, 0),
               brick.at(edge, 2)});
  CHECK(hinged.sentence() == name + "75) can turn about the axis along y through (2, 0.5, 0)");
  hinged.hold({hinged.at(Vector3d(0, 0, 0), 2)});
  CHECK(find_free_motions(hinged.K, hinged.layout).free.empty());
  CHECK(factorize_stiffness(hinged.K).rows() == hinged.K.rows());
}

TEST_CASE("free motions of a plate, also in other units and directions") {
  body plate = make_plate();
  CHECK(plate.sentence() == "body 0 (unknowns 0 to 23) can move along x and y and turn about z");
  auto const corner = Vector2d(3, 0);
  body pinned = plate;
  pinned.hold({plate.at(corner, 0), plate.at(corner, 1)});
  CHECK(pinned.sentence() == "body 0 (unknowns 0 to 21) can turn about the point (3, 0)");
  body rolling = plate;
  rolling.hold({plate.at(corner, 1), plate.at(Vector2d(0, 0), 1)});
  CHECK(rolling.sentence() == "body 0 (unknowns 0 to 21) can move along x");
  for (double const unit : {1e-150, 1e-9, 1e150}) {
    rolling.K = unit * rolling.K;
    CHECK(rolling.sentence() == "body 0 (unknowns 0 to 21) can move along x");
    rolling.K = rolling.K / unit;
  }
  // The same frame turned by 30 degrees: K' = Q K Qᵀ.
  double const c = std::cos(0.5235987755982988), s = std::sin(0.5235987755982988);
  body turned = plate;
  turned.layout.x = Eigen::Matrix2d{{c, -s}, {s, c}} * plate.layout.x;
  MatrixXd Q = MatrixXd::Zero(24, 24);
  for (int i = 0; i < 12; ++i) Q.block<2, 2>(2 * i, 2 * i) << c, -s, s, c;
  MatrixXd const springs = [&] {  // across the frame's own y at two nodes
    MatrixXd k = Q * MatrixXd(plate.K) * Q.transpose();
    for (Eigen::Index const j : {plate.at(corner, 1), plate.at(Vector2d(0, 0), 1)})
      k += 10 * Q.col(j) * Q.col(j).transpose();
    return k;
  }();
  turned.K = MatrixXd((springs + springs.transpose()) / 2).sparseView();
  CHECK(turned.sentence() == "body 0 (unknowns 0 to 23) can move along (0.866, 0.5)");
}

TEST_CASE("bodies, places not known, and what a refusal says") {
  auto const stack = fem::make_stack({.bricks = 3, .cells = {2, 1, 1}});
  auto const motions = find_free_motions(stack.K);
  CHECK(motions.bodies == 3);
  CHECK(motions.dimension() == 18);
  CHECK(motions.free[2].text == "body 2 (unknowns 72 to 107) has 6 free motions");
  CHECK((stack.K.block(72, 72, 36, 36) * motions.free[2].motions).norm() <= 1e-9 * stack.K.norm());
  std::string const said = SLANT_COMPLAINT(factorize_stiffness(stack.K));
  CHECK(said.starts_with("K: got pivot "));
  CHECK(said.find("zero up to rounding: body 0 (unknowns 0 to 35) has 6 free motions; body 1") !=
        said.npos);
  CHECK(said.ends_with(
      ", expected a symmetric positive definite matrix, with supports that hold every body"));

  // An unknown without stiffness, a mechanism, and what is no matter of motions.
  sparse none(2, 2);
  none.insert(0, 0) = 1;
  CHECK(find_free_motions(none).sentence() == "body 1 (unknown 1) has 1 free motion");
  sparse const indefinite = MatrixXd{{1, 2}, {2, 1}}.sparseView();
  CHECK(find_free_motions(indefinite).free.empty());
  CHECK(find_free_motions(indefinite).undetermined == std::vector<slant::index>{0});
  CHECK(SLANT_COMPLAINT(factorize_stiffness(indefinite))
            .ends_with("= -3, expected a symmetric positive definite matrix"));
}

TEST_CASE("the name of a motion") {
  auto const plate = make_plate();
  auto const& L = plate.layout;
  VectorXd d(24), r(24);
  for (std::size_t j = 0; j < 24; ++j) {
    d[int(j)] = L.axis[j] == 0 ? -2 : 0;
    r[int(j)] = L.axis[j] == 0 ? -L.x(1, L.node[j]) : L.x(0, L.node[j]);
  }
  CHECK(slant::contact::name_motion(plate.K, d, L) == "body 0 (unknowns 0 to 23) moves along -x");
  CHECK(slant::contact::name_motion(plate.K, r, L) ==
        "body 0 (unknowns 0 to 23) turns about the point (0, 0)");
  CHECK(slant::contact::name_motion(plate.K, r) == "body 0 (unknowns 0 to 23) moves");
}

// --- rigid-body modes of nodes

/// What is left of v outside the columns of R.
double outside(MatrixXd const& R, VectorXd const& v) {
  return (v - R * (R.transpose() * v)).norm() / v.norm();
}

TEST_CASE("translations and rotations about any point, and nothing else") {
  Matrix3Xd nodes(3, 5);
  nodes << 0, 100, 7, 1, 3,  //
      0, 1, -2, 4, 8,        //
      1, 2, 5, 6, -1;
  MatrixXd const R = rigid_body_modes(nodes);
  REQUIRE(R.cols() == 6);
  CHECK((R.transpose() * R - MatrixXd::Identity(6, 6)).norm() <= 1e-14);
  VectorXd turn(15), stretch(15);
  for (int i = 0; i < 5; ++i) {
    turn.segment<3>(3 * i) = Vector3d(1, -2, 3).cross(nodes.col(i) - Vector3d(9, 8, 7));
    stretch.segment<3>(3 * i) = nodes.col(i);
  }
  CHECK(outside(R, turn) <= 1e-14);
  CHECK(outside(R, stretch) >= 0.1);

  Matrix2Xd const flat = nodes.topRows(2);
  MatrixXd const plane = rigid_body_modes(flat);
  REQUIRE(plane.cols() == 3);
  VectorXd spin(10);
  for (int i = 0; i < 5; ++i) spin.segment<2>(2 * i) << 4 - flat(1, i), flat(0, i) + 1;
  CHECK(outside(plane, spin) <= 1e-14);
}

TEST_CASE("nodes on a line do not turn about it, a single one not at all") {
  Matrix3Xd line(3, 4);
  for (int i = 0; i < 4; ++i) line.col(i) = Vector3d(0.1, 0.2, 0.3) * i;
  CHECK(rigid_body_modes(line).cols() == 5);
  CHECK(rigid_body_modes(Matrix3Xd(line.col(1))).cols() == 3);
  for (double const far : {1e3, 1e6})
    CHECK(rigid_body_modes(Matrix3Xd(line.array() + far)).cols() == 5);
  for (double const size : {1e-300, 1e308}) {
    CHECK(rigid_body_modes(Matrix3Xd(size * line)).cols() == 5);
    Matrix3Xd corner = size * line;
    corner(0, 3) = 0;
    CHECK(rigid_body_modes(corner).cols() == 6);
  }
  Matrix3Xd axis = Matrix3Xd::Constant(3, 4, 0.7);
  axis.row(1) << 1e6 + 1, 1e6 + 2, 1e6 + 4, 1e6 + 5;
  CHECK(rigid_body_modes(axis).cols() == 5);
  CHECK(rigid_body_modes(Matrix2Xd(2, 1).setOnes()).cols() == 2);
}

TEST_CASE("bad coordinates") {
  CHECK_THROWS_AS(static_cast<void>(rigid_body_modes(MatrixXd(4, 2).setOnes())), slant::bad_input);
  CHECK_THROWS_AS(static_cast<void>(rigid_body_modes(MatrixXd(3, 0))), slant::bad_input);
  MatrixXd nodes = MatrixXd::Ones(3, 2);
  nodes(1, 1) = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(static_cast<void>(rigid_body_modes(nodes)), slant::bad_input);
}

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
  for (slant::index i = 0; i < 12; ++i)
    brick.data.d(i) = 0.1 * (1 + 0.3 * brick.mesh.nodes(0, floor[std::size_t(i)]));
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

}  // namespace free_motions_test
