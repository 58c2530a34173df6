// SPDX-License-Identifier: MIT
//
// Reads a plane mesh of triangles with a named boundary from a file of Gmsh (MSH 2.2, text):
//
//     $PhysicalNames   2 5 "fluid"                  dimension, number, name
//     $Nodes           7 -0.14 -0.2 0               number, x, y, z = 0
//     $Elements        31 1 2 4 5 6 7               number, type, tags, tags…, nodes…
//
// Lines (type 1) with a named physical group are the boundary; triangles (type 2) the domain;
// points (type 15) and other sections are passed over; anything else is refused, naming file and
// line.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fem/gmsh_scanner.hpp>
#include <fem/planar_domain.hpp>

namespace fem {

namespace detail {

/// Walks through the sections of one file.
class gmsh_reader {
 public:
  gmsh_reader(std::string_view text, std::string file) : scan_(text, std::move(file)) {}

  [[nodiscard]] planar_domain read() {
    read_format();
    while (scan_.next_line()) {
      std::string const section(scan_.word());
      if (section == "$PhysicalNames") {
        read_names();
      } else if (section == "$Nodes") {
        read_nodes();
      } else if (section == "$Elements") {
        read_elements();
      } else if (section.size() > 1 && section[0] == '$' && !section.starts_with("$End")) {
        std::string const end = "$End" + section.substr(1);
        while (scan_.require_line(end), scan_.line() != end) {
        }
      } else {
        scan_.refuse(slant::detail::quoted(scan_.line()), "the beginning of a section, $Name");
      }
    }
    if (triangles_.empty()) scan_.refuse("no triangles", "$Nodes and $Elements with triangles");
    return finish();
  }

 private:
  struct line_element {
    int from, to, part;
    slant::index at;  ///< line of the file
  };

  int node() {
    auto const id = scan_.number<int>("the number of a node");
    auto const found = nodes_.find(id);
    if (found == nodes_.end()) scan_.refuse(std::to_string(id), "the number of a node in $Nodes");
    used_[static_cast<std::size_t>(found->second)] = true;
    return found->second;
  }

  void read_format() {
    scan_.expect_line("$MeshFormat");
    scan_.require_line("2.2 0 8");
    bool const version = scan_.word() == "2.2";
    if (!version || scan_.word() != "0")
      scan_.refuse(slant::detail::quoted(scan_.line()),
                   "2.2 0 8, Gmsh's text format 2.2 (gmsh -format msh22)");
    scan_.expect_line("$EndMeshFormat");
  }

  void read_names() {
    for (slant::index left = scan_.count("the number of names"); left > 0; --left) {
      scan_.require_line("a dimension, a number and a name");
      auto const dimension = scan_.number<int>("a dimension");
      auto const tag = scan_.number<int>("the number of a physical group");
      std::string_view const word = scan_.word();
      if (word.size() < 3 || word.front() != '"' || word.back() != '"')
        scan_.refuse(slant::detail::quoted(word), "a name in double quotes, without blanks");
      if (dimension != 1) continue;
      if (!parts_.try_emplace(tag, static_cast<int>(domain_.parts.size())).second)
        scan_.refuse(std::to_string(tag), "a number that has no name yet");
      domain_.parts.emplace_back(word.substr(1, word.size() - 2));
    }
    scan_.expect_line("$EndPhysicalNames");
  }

  void read_nodes() {
    if (!nodes_.empty()) scan_.refuse("$Nodes", "only one section of that name");
    auto const n = scan_.count("the number of nodes");
    if (n > std::numeric_limits<int>::max() / 6) scan_.refuse(std::to_string(n), "fewer nodes");
    domain_.mesh.nodes.resize(2, n);
    used_.assign(static_cast<std::size_t>(n), false);
    for (int i = 0; i < n; ++i) {
      scan_.require_line("a node: number, x, y, z");
      auto const id = scan_.number<int>("the number of a node");
      if (!nodes_.try_emplace(id, i).second)
        scan_.refuse(std::to_string(id), "a number that no node has yet");
      domain_.mesh.nodes(0, i) = scan_.coordinate();
      domain_.mesh.nodes(1, i) = scan_.coordinate();
      if (double const z = scan_.coordinate(); z != 0)
        scan_.refuse(std::to_string(z), "z = 0, a plane mesh");
      scan_.expect_end_of_line("three coordinates");
    }
    scan_.expect_line("$EndNodes");
  }

  void read_elements() {
    for (slant::index left = scan_.count("the number of elements"); left > 0; --left) {
      scan_.require_line("an element: number, type, tags, nodes");
      scan_.number<int>("the number of an element");
      auto const type = scan_.number<int>("the type of an element");
      auto const tags = scan_.number<int>("the number of tags");
      if (tags < 1 || tags > 100) scan_.refuse(std::to_string(tags), "one tag or more");
      auto const group = scan_.number<int>("the number of a physical group");
      for (int i = 1; i < tags; ++i) scan_.number<int>("a tag");
      if (type == 15) continue;
      if (type == 1) {
        auto const part = parts_.find(group);
        if (part == parts_.end())
          scan_.refuse(std::to_string(group), "a physical group that has a name");
        int const from = node();
        lines_.push_back({from, node(), part->second, scan_.line_number()});
      } else if (type == 2) {
        add_triangle();
      } else {
        scan_.refuse(std::to_string(type), "1 (line), 2 (triangle) or 15 (point)");
      }
      scan_.expect_end_of_line("as many nodes as the type has");
    }
    scan_.expect_line("$EndElements");
  }

  void add_triangle() {
    std::array<int, 3> t{};
    for (int& corner : t) corner = node();
    auto const edge = [&](std::size_t i) -> Eigen::Vector2d {
      return domain_.mesh.nodes.col(t[i]) - domain_.mesh.nodes.col(t[0]);
    };
    double const area = edge(1)[0] * edge(2)[1] - edge(1)[1] * edge(2)[0];
    double const size = edge(1).squaredNorm() + edge(2).squaredNorm();
    if (!(std::abs(area) > 16 * std::numeric_limits<double>::epsilon() * size))
      scan_.refuse("a triangle without area", "corners that do not lie on a line");
    if (area < 0) std::swap(t[1], t[2]);
    triangles_.push_back(t);
  }

  /// Each edge of the boundary gets the name of its line.
  [[nodiscard]] planar_domain finish() {
    auto& mesh = domain_.mesh;
    mesh.cells.resize(3, static_cast<Eigen::Index>(triangles_.size()));
    for (Eigen::Index cell = 0; cell < mesh.cells.cols(); ++cell)
      for (int a = 0; a < 3; ++a)
        mesh.cells(a, cell) =
            triangles_[static_cast<std::size_t>(cell)][static_cast<std::size_t>(a)];
    for (auto const& [id, i] : nodes_)
      if (!used_[static_cast<std::size_t>(i)])
        scan_.refuse("node " + std::to_string(id) + " in no element", "a node of a triangle");
    domain_.boundary = boundary_of(mesh);
    std::map<std::pair<int, int>, line_element const*> named;
    for (auto const& line : lines_) named[std::minmax(line.from, line.to)] = &line;
    for (auto& edge : domain_.boundary) {
      auto const found = named.find(std::minmax(edge.from, edge.to));
      if (found == named.end())
        scan_.refuse("a boundary edge without a line", "lines in named groups all around");
      edge.part = found->second->part;
      named.erase(found);
    }
    if (!named.empty())
      scan_.refuse("a line at line " + std::to_string(named.begin()->second->at) +
                       " that is no edge of the boundary",
                   "lines on the boundary only");
    return std::move(domain_);
  }

  gmsh_scanner scan_;
  planar_domain domain_{};
  std::map<int, int> parts_{};  // physical group → part
  std::map<int, int> nodes_{};  // number in the file → column
  std::vector<bool> used_{};
  std::vector<std::array<int, 3>> triangles_{};
  std::vector<line_element> lines_{};
};

}  // namespace detail

/// The mesh in a file. Throws slant::bad_input naming file and line, what stands there and what was
/// expected; std::invalid_argument for triangles that do not fit together.
[[nodiscard]] inline planar_domain read_gmsh(std::filesystem::path const& file) {
  std::string const text = slant::detail::read_text_file(file);
  return detail::gmsh_reader(text, slant::detail::printable(file)).read();
}

}  // namespace fem
