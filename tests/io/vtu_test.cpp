// SPDX-License-Identifier: MIT
//
// VTU files, read back by an XML parser and a base64 decoder of the test's own.
#include <slant/io/vtu.hpp>

#include <cstring>
#include <pugixml.hpp>
#include <support/testing.hpp>
#include "io_support.hpp"

namespace vtu_test {

using io_test::temporary_folder;
using slant::vtu_cell;
using slant::vtu_encoding;
using slant::vtu_grid;
using test::complaint;

std::string decode_base64(std::string const& text) {
  static std::string const digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0, count = 0;
  for (char const c : text) {
    if (c == '=') break;
    REQUIRE(digits.find(c) != std::string::npos);
    bits = bits << 6 | static_cast<unsigned>(digits.find(c));
    count += 6;
    if (count >= 8) {
      count -= 8;
      bytes += static_cast<char>(bits >> count & 0xffu);
    }
  }
  REQUIRE(text.size() % 4 == 0);
  return bytes;
}

/// The numbers of a DataArray in either encoding.
template <class T>
std::vector<double> numbers(pugi::xml_node array) {
  std::vector<double> values;
  std::string const text = array.child_value();
  if (std::string(array.attribute("format").value()) == "ascii") {
    std::istringstream in(text);
    for (double value = 0; in >> value;) values.push_back(value);
    return values;
  }
  REQUIRE(std::string(array.attribute("format").value()) == "binary");
  std::string const bytes = decode_base64(text);
  std::uint64_t length = 0;
  REQUIRE(bytes.size() >= sizeof length);
  std::memcpy(&length, bytes.data(), sizeof length);
  REQUIRE(bytes.size() == sizeof length + length);
  for (std::size_t at = sizeof length; at < bytes.size(); at += sizeof(T)) {
    T value;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    values.push_back(static_cast<double>(value));
  }
  return values;
}

pugi::xml_node array_named(pugi::xml_node parent, char const* name) {
  return parent.find_child_by_attribute("DataArray", "Name", name);
}

std::string type_of(pugi::xml_node array) {
  return array.attribute("type").value();
}

/// A square of two triangles with a line on its lower side and a vertex.
struct square {
  Eigen::Matrix<double, 2, 4> points{{0, 1, 1, 0}, {0, 0, 1, 0.1}};
  Eigen::Matrix<int, 3, 2> triangles{{0, 0}, {1, 2}, {2, 3}};
};

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

TEST_CASE("vtu: everything comes back") {
  temporary_folder const folder;
  square const mesh;
  for (vtu_encoding const encoding : {vtu_encoding::ascii, vtu_encoding::base64}) {
    vtu_grid grid(mesh.points, encoding);
    grid.add_cells(vtu_cell::triangle, mesh.triangles);
    grid.add_cells(vtu_cell::line, Eigen::Vector2i(0, 1));
    grid.add_cells(vtu_cell::vertex, Eigen::Matrix<long, 1, 1>(3));
    Eigen::Matrix<double, 2, 4> const displacement = 0.1 * mesh.points;
    grid.add_point_vectors("displacement", displacement);
    grid.add_point_scalars("height <m> & \"more\"", Eigen::Vector4f(0.1f, 0.2f, 0.3f, 0.4f));
    grid.add_point_scalars("state", Eigen::Vector4i(0, 1, 2, -1));
    grid.add_point_scalars("energy", Eigen::Vector4d(1e-300, -2.5, 1 / 3.0, 1e300));
    grid.write(folder / "a.vtu");
    CHECK(folder.entries() == 1);

    pugi::xml_document document;
    REQUIRE(document.load_file((folder / "a.vtu").c_str()));
    auto const root = document.child("VTKFile");
    CHECK(std::string(root.attribute("type").value()) == "UnstructuredGrid");
    CHECK(std::string(root.attribute("byte_order").value()) == "LittleEndian");
    CHECK(std::string(root.attribute("header_type").value()) == "UInt64");
    auto const piece = root.child("UnstructuredGrid").child("Piece");
    CHECK(piece.attribute("NumberOfPoints").as_int() == 4);
    CHECK(piece.attribute("NumberOfCells").as_int() == 4);

    auto const points = piece.child("Points").child("DataArray");
    CHECK(type_of(points) == "Float64");
    CHECK(points.attribute("NumberOfComponents").as_int() == 3);
    CHECK(numbers<double>(points) == std::vector<double>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0.1, 0});

    auto const cells = piece.child("Cells");
    CHECK(numbers<std::int64_t>(array_named(cells, "connectivity")) ==
          std::vector<double>{0, 1, 2, 0, 2, 3, 0, 1, 3});
    CHECK(numbers<std::int64_t>(array_named(cells, "offsets")) == std::vector<double>{3, 6, 8, 9});
    CHECK(type_of(array_named(cells, "types")) == "UInt8");
    CHECK(numbers<std::uint8_t>(array_named(cells, "types")) == std::vector<double>{5, 5, 3, 1});

    auto const on_points = piece.child("PointData");
    CHECK(numbers<double>(array_named(on_points, "displacement")) ==
          std::vector<double>{0, 0, 0, 0.1, 0, 0, 0.1, 0.1, 0, 0, 0.1 * 0.1, 0});
    auto const height = array_named(on_points, "height <m> & \"more\"");
    CHECK(type_of(height) == "Float32");
    CHECK(height.attribute("NumberOfComponents").as_int() == 1);
    CHECK(static_cast<float>(numbers<float>(height)[2]) == 0.3f);
    CHECK(type_of(array_named(on_points, "state")) == "Int64");
    CHECK(numbers<std::int64_t>(array_named(on_points, "state")) ==
          std::vector<double>{0, 1, 2, -1});
    CHECK(numbers<double>(array_named(on_points, "energy")) ==
          std::vector<double>{1e-300, -2.5, 1 / 3.0, 1e300});
  }
}

TEST_CASE("vtu: tetrahedra in space, other scalars as double") {
  temporary_folder const folder;
  Eigen::Matrix<long double, 3, 4> points;
  points << 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 / 3.0L;
  vtu_grid grid(points);
  grid.add_cells(vtu_cell::tetrahedron, Eigen::Vector4i(0, 1, 2, 3));
  grid.write(folder / "a.vtu");
  pugi::xml_document document;
  REQUIRE(document.load_file((folder / "a.vtu").c_str()));
  auto const piece = document.child("VTKFile").child("UnstructuredGrid").child("Piece");
  auto const read = piece.child("Points").child("DataArray");
  CHECK(type_of(read) == "Float64");
  CHECK(numbers<double>(read)[11] == 1 / 3.0);
  CHECK(numbers<std::uint8_t>(array_named(piece.child("Cells"), "types")) ==
        std::vector<double>{10});
}

TEST_CASE("vtu: every shape has VTK's number and its nodes") {
  struct shape {
    vtu_cell cell;
    int number, nodes;
  };
  shape const shapes[] = {{vtu_cell::vertex, 1, 1},
                          {vtu_cell::line, 3, 2},
                          {vtu_cell::triangle, 5, 3},
                          {vtu_cell::quadrilateral, 9, 4},
                          {vtu_cell::tetrahedron, 10, 4},
                          {vtu_cell::hexahedron, 12, 8},
                          {vtu_cell::wedge, 13, 6},
                          {vtu_cell::pyramid, 14, 5},
                          {vtu_cell::quadratic_line, 21, 3},
                          {vtu_cell::quadratic_triangle, 22, 6},
                          {vtu_cell::quadratic_quadrilateral, 23, 8},
                          {vtu_cell::quadratic_tetrahedron, 24, 10},
                          {vtu_cell::quadratic_hexahedron, 25, 20}};
  for (auto const& s : shapes) {
    CHECK(static_cast<int>(s.cell) == s.number);
    CHECK(slant::node_count(s.cell) == s.nodes);
  }
}

TEST_CASE("vtu: what does not fit is refused") {
  square const mesh;
  vtu_grid grid(mesh.points);
  CHECK(complaint([] { vtu_grid const flat(MatrixXd(1, 3)); }) ==
        "points: got 1 components, expected 2 or 3, one column per vector");
  CHECK(complaint([] { vtu_grid const deep(MatrixXd(4, 3)); }) ==
        "points: got 4 components, expected 2 or 3, one column per vector");
  CHECK(complaint([] { vtu_grid const lost(Vector3d(0, not_a_number, 0)); }) ==
        "points: got nan at 0, expected finite numbers");
  CHECK(SLANT_COMPLAINT(grid.add_cells(vtu_cell::line, mesh.triangles)) ==
        "cells: got 3 nodes per cell, expected 2 for this shape");
  CHECK(SLANT_COMPLAINT(grid.add_cells(vtu_cell::triangle, Eigen::Vector3i(0, 1, 4))) ==
        "cells: got node 4 in cell 0, expected node numbers from 0 to 3");
  CHECK(SLANT_COMPLAINT(grid.add_cells(vtu_cell::triangle, Eigen::Vector3i(0, -1, 2))) ==
        "cells: got node -1 in cell 0, expected node numbers from 0 to 3");
  CHECK(SLANT_COMPLAINT(grid.add_point_scalars("p", Vector3d::Zero())) ==
        "p: got 3 values, expected 4");
  CHECK(SLANT_COMPLAINT(grid.add_point_scalars("p", Eigen::Vector4d(1, 2, 3, not_a_number))) ==
        "p: got nan at 3, expected finite numbers");
  CHECK(SLANT_COMPLAINT(grid.add_point_scalars(
            "p", Eigen::Vector4d(1, std::numeric_limits<double>::infinity(), 3, 4))) ==
        "p: got inf at 1, expected finite numbers");
  CHECK(SLANT_COMPLAINT(grid.add_point_vectors("u", MatrixXd::Zero(2, 5))) ==
        "u: got 5 vectors, expected 4");
  CHECK(SLANT_COMPLAINT(grid.add_point_vectors("u", MatrixXd::Zero(4, 4))) ==
        "u: got 4 components, expected 2 or 3, one column per vector");
  CHECK(SLANT_COMPLAINT(grid.add_point_scalars("", Eigen::Vector4d::Zero())) ==
        "name: got '', expected a name without control characters");
  CHECK(SLANT_COMPLAINT(grid.add_point_scalars("a\nb", Eigen::Vector4d::Zero())) ==
        "name: got 'a\\x0ab', expected a name without control characters");
  grid.add_point_scalars("p", Eigen::Vector4d::Zero());
  CHECK(SLANT_COMPLAINT(grid.add_point_scalars("p", Eigen::Vector4d::Zero())) ==
        "name: got 'p' again, expected a new name");
}

TEST_CASE("a list of numbered files with their times") {
  io_test::temporary_folder const folder;
  slant::vtu_series series(folder / "slip & stick.pvd");
  CHECK(series.next(0.5) == folder / "slip & stick_000.vtu");
  CHECK(series.next(2) == folder / "slip & stick_001.vtu");
  CHECK(series.size() == 2);
  series.write();
  CHECK(io_test::get(folder / "slip & stick.pvd") ==
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n <Collection>\n"
        "  <DataSet timestep=\"0.5\" part=\"0\" file=\"slip &amp; stick_000.vtu\" />\n"
        "  <DataSet timestep=\"2\" part=\"0\" file=\"slip &amp; stick_001.vtu\" />\n"
        " </Collection>\n</VTKFile>\n");
  CHECK(folder.entries() == 1);
}

TEST_CASE("names and times that make no series are refused") {
  CHECK(SLANT_COMPLAINT(slant::vtu_series("out.vtu")) ==
        "list: got out.vtu, expected the name of a .pvd file");
  slant::vtu_series series("out.pvd");
  CHECK(SLANT_COMPLAINT(series.next(NAN)) == "time: got nan, expected a finite number");
  static_cast<void>(series.next(1));
  CHECK(SLANT_COMPLAINT(series.next(1)) == "time: got 1, expected a number greater than 1");
  CHECK(series.size() == 1);
}

}  // namespace vtu_test
