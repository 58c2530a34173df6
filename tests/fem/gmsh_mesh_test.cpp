// SPDX-License-Identifier: MIT
#include <fem/gmsh_mesh.hpp>
#include <io/io_support.hpp>
#include <support/testing.hpp>

namespace gmsh_mesh_test {

/// The unit square, two triangles, one of them clockwise; node numbers with a gap.
std::string const square =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
    "$PhysicalNames\n3\n1 1 \"floor\"\n1 2 \"rest\"\n2 9 \"fluid\"\n$EndPhysicalNames\n"
    "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n7 0 1e0 0\n$EndNodes\n"
    "$Elements\n7\n1 15 2 0 1 1\n2 1 2 1 1 1 2\n3 1 2 2 2 3 2\n4 1 2 2 3 3 7\n5 1 2 2 4 7 1\n"
    "6 2 2 9 1 1 2 3\n7 2 2 9 1 1 7 3\n$EndElements\n";

fem::planar_domain read(std::string const& text) {
  io_test::temporary_folder const folder;
  io_test::put(folder / "m.msh", text);
  return fem::read_gmsh(folder / "m.msh");
}

std::string replaced(std::string const& from, std::string const& to) {
  std::string text = square;
  auto const at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

TEST_CASE("a square: nodes, triangles turned the right way, parts of the boundary") {
  auto const domain = read(square);
  CHECK(domain.mesh.node_count() == 4);
  REQUIRE(domain.mesh.cell_count() == 2);
  double area = 0;
  for (int cell = 0; cell < 2; ++cell) {
    double const part = fem::element_of<2>(domain.mesh, cell).volume;
    CHECK(part > 0);
    area += part;
  }
  CHECK(area == doctest::Approx(1));
  REQUIRE(domain.boundary.size() == 4);
  CHECK(domain.part("floor") == 0);
  CHECK(domain.part("rest") == 1);
  for (auto const& edge : domain.boundary) {
    bool const floor = domain.mesh.nodes(1, edge.from) == 0 && domain.mesh.nodes(1, edge.to) == 0;
    CHECK(edge.part == (floor ? 0 : 1));
    CHECK(domain.outward(edge).norm() == doctest::Approx(1));
    Vector2d const middle = (domain.mesh.nodes.col(edge.from) + domain.mesh.nodes.col(edge.to)) / 2;
    CHECK(domain.outward(edge).dot(middle - Vector2d(0.5, 0.5)) == doctest::Approx(0.5));
  }
}

TEST_CASE("sections of other kinds are passed over, and so are blank lines") {
  auto const domain = read(
      replaced("$Nodes", "\n$Comments\nmade by hand\n$Nodes in a comment\n$EndComments\n$Nodes"));
  CHECK(domain.mesh.cell_count() == 2);
}

TEST_CASE("what cannot be used is named with file and line") {
  auto const refused = [](std::string const& text, std::string const& expected) {
    io_test::temporary_folder const folder;
    auto const file = folder / "m.msh";
    io_test::put(file, text);
    std::string const said = SLANT_COMPLAINT(fem::read_gmsh(file));
    CAPTURE(said);
    CHECK(said.starts_with(file.string()));
    CHECK(said.find(expected) != std::string::npos);
  };
  refused(replaced("2.2 0 8", "4.1 0 8"), "m.msh:2: got '4.1 0 8', expected 2.2 0 8");
  refused(replaced("2.2 0 8", "2.2 1 8"), "m.msh:2: got '2.2 1 8', expected 2.2 0 8");
  refused(replaced("$MeshFormat", "solid"), "m.msh:1: got 'solid', expected $MeshFormat");
  refused(replaced("\"floor\"", "floor"), "m.msh:6: got 'floor', expected a name in double quotes");
  refused(replaced("1 2 \"rest\"", "1 1 \"rest\""),
          "m.msh:7: got 1, expected a number that has no");
  refused(replaced("$Nodes\n4", "$Nodes\nfour"), "m.msh:11: got 'four', expected the number of n");
  refused(replaced("$Nodes\n4", "$Nodes\n4000"), "m.msh:11: got 4000, expected a number of lines");
  refused(replaced("$Nodes\n4", "$Nodes\n3"), "m.msh:15: got '7 0 1e0 0', expected $EndNodes");
  refused(replaced("$Nodes\n4", "$Nodes\n5"), "m.msh:16: got '$EndNodes', expected the number of");
  refused(replaced("1 1 0\n", "1 nan 0\n"), "m.msh:14: got nan, expected a finite coordinate");
  refused(replaced("1 1 0\n", "1 1,0 0\n"), "m.msh:14: got '1,0', expected a coordinate");
  refused(replaced("1 1 0\n", "1 1\n"), "m.msh:14: got the end of the line, expected a coordinate");
  refused(replaced("1 1 0\n", "1 1 0.5\n"), "expected z = 0, a plane mesh");
  refused(replaced("7 0 1e0", "3 0 1e0"), "m.msh:15: got 3, expected a number that no node has");
  refused(replaced("1 7 3\n", "1 8 3\n"), "m.msh:25: got 8, expected the number of a node");
  refused(replaced("1 7 3\n", "1 3 3\n"), "m.msh:25: got a triangle without area");
  refused(replaced("7 2 2 9", "7 3 2 9"), "m.msh:25: got 3, expected 1 (line), 2 (triangle)");
  refused(replaced("2 1 2 1 1 1 2", "2 1 2 5 1 1 2"), "m.msh:20: got 5, expected a physical group");
  refused(replaced("2 1 2 1 1 1 2\n", "2 1 2 1 1 1 2 3\n"), "m.msh:20: got '3', expected as many");
  refused(replaced("2 1 2 1 1 1 2\n", "2 1 2 1 1 1 3\n"), "got a boundary edge without a line");
  refused(replaced("1 15 2 0 1 1\n", "1 1 2 1 1 1 3\n"), "that is no edge of the boundary");
  refused(replaced("$EndElements\n", ""), "got the end of the file, expected $EndElements");
  refused(replaced("$EndElements\n", "$EndElements"), "expected a line feed at the end");
  refused(square.substr(0, square.find("$Elements")), "got no triangles");
  CHECK_THROWS_AS(static_cast<void>(fem::read_gmsh("/no/such/file.msh")), slant::bad_input);
}

}  // namespace gmsh_mesh_test
