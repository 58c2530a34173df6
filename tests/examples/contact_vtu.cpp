// SPDX-License-Identifier: MIT
//
// The file for ParaView, read back: every point has the numbers of its contact node.
#include <fem/contact_vtu.hpp>
#include <fem/steel_brick.hpp>
#include <fem/two_bricks.hpp>
#include <fem/two_plates.hpp>
#include <io/io_support.hpp>
#include <pugixml.hpp>
#include <support/testing.hpp>

namespace contact_vtu {
namespace {

/// The numbers of a data array of points, one column per point.
MatrixXd point_data(pugi::xml_document const& file, char const* name) {
  auto const piece = file.child("VTKFile").child("UnstructuredGrid").child("Piece");
  auto const array = piece.child("PointData").find_child_by_attribute("Name", name);
  auto const points = piece.attribute("NumberOfPoints").as_int();
  MatrixXd values(array.attribute("NumberOfComponents").as_int(), points);
  std::istringstream text(array.child_value());
  for (Eigen::Index point = 0; point < points; ++point)
    for (Eigen::Index i = 0; i < values.rows(); ++i) text >> values(i, point);
  REQUIRE_FALSE(text.fail());
  return values;
}

/// Writes made-up numbers for a scene and reads them back.
template <int D>
void check_points(fem::contact_scene<D> const& scene) {
  Eigen::Index const m = scene.contact_count();
  VectorXd const u = VectorXd::LinSpaced(scene.unknowns.count, -1, 1);
  VectorXd const λ = VectorXd::LinSpaced(D * m, 0, 1);
  auto const field = fem::make_contact_field(scene, u, λ.head(m), λ.tail((D - 1) * m));

  io_test::temporary_folder const folder;
  fem::write_contact_vtu(folder / "a.vtu", scene, field, u, slant::vtu_encoding::ascii);
  pugi::xml_document file;
  REQUIRE(file.load_file((folder / "a.vtu").c_str()));

  MatrixXd const displacement = point_data(file, "displacement");
  REQUIRE(displacement.rows() == 3);
  CHECK(displacement.topRows(D).isApprox(scene.displacement(u), 1e-14));
  MatrixXd pressure = point_data(file, "contact_pressure");
  MatrixXd friction = point_data(file, "friction");
  MatrixXd state = point_data(file, "contact_state");
  REQUIRE(friction.rows() == 3);
  auto const check = [&](int node, std::size_t at, double sign) {
    auto const i = static_cast<Eigen::Index>(at);
    CHECK(pressure(0, node) == doctest::Approx(field.normal[i]));
    CHECK(friction.col(node).head(D - 1).isApprox(sign * field.friction.col(i), 1e-14));
    CHECK(state(0, node) == static_cast<int>(field.state[at]));
    pressure(0, node) = 0;
    friction.col(node).head(D - 1).setZero();
    state(0, node) = fem::no_contact_node;
  };
  for (std::size_t at = 0; at < scene.contact_nodes.size(); ++at) {
    check(scene.contact_nodes[at], at, 1);
    // The other body feels the opposite friction.
    if (!scene.opposite_nodes.empty()) check(scene.opposite_nodes[at], at, -1);
  }
  CHECK(pressure.isZero(0));
  CHECK(friction.isZero(0));
  CHECK((state.array() == fem::no_contact_node).all());
}

}  // namespace

TEST_CASE("a contact solution arrives at its points, of one body and of two") {
  check_points(fem::make_steel_brick({.k = 2, .load = fem::brick_load::lift}));
  auto const bricks = fem::make_two_bricks(3);
  CHECK(bricks.opposite_nodes.size() == 9);
  check_points(bricks);
  check_points(fem::make_two_plates(2));
}

}  // namespace contact_vtu
