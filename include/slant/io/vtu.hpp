// SPDX-License-Identifier: MIT
//
// Writes meshes with data for ParaView: VTK's XML format for unstructured grids (VTU).
//
//   vtu_grid grid(nodes);                                  // D × n, one column per point
//   grid.add_cells(vtu_cell::tetrahedron, cells);          // 4 × c, one column per cell
//   grid.add_point_vectors("displacement", u);             // 2 × n or 3 × n
//   grid.add_point_scalars("pressure", p);                 // n
//   grid.write("brick.vtu");
//
// Needs pugixml (CMake component vtu).
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/io/atomic_file.hpp>
#include <slant/io/text_scanner.hpp>

#include <Eigen/Core>
#include <pugixml.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace slant {

// --- array ---------------------------------------------------------------------------------------
//
// The data arrays of a VTU file as text: decimal numbers, or base64 of their bytes behind an 8-byte
// length. VTK knows fixed types only: other scalars than float are written as double.

/// How numbers stand in the file, exactly in both cases: in decimal, to be read by eye, or as
/// bytes.
enum class vtu_encoding : unsigned char { ascii, base64 };

namespace detail {

struct vtu_array {
  std::string name;
  char const* type;
  char const* format;
  int components;
  std::string text;
};

[[nodiscard]] inline std::string base64(std::string_view bytes) {
  static constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::size_t const n = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < n ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= n ? digits[group >> (18 - 6 * k) & 63u] : '=';
  }
  return text;
}

/// VTK's name for a number type.
template <class T>
[[nodiscard]] constexpr char const* vtu_type() {
  if constexpr (std::same_as<T, float>)
    return "Float32";
  else if constexpr (std::same_as<T, double>)
    return "Float64";
  else if constexpr (std::same_as<T, std::uint8_t>)
    return "UInt8";
  else {
    static_assert(std::same_as<T, std::int64_t>);
    return "Int64";
  }
}

/// Numbers of one of VTK's types, `components` to a tuple.
template <class T>
[[nodiscard]] vtu_array vtu_numbers(std::string_view name, std::vector<T> const& values,
                                    int components, vtu_encoding encoding) {
  vtu_array array{.name = std::string(name),
                  .type = vtu_type<T>(),
                  .format = encoding == vtu_encoding::ascii ? "ascii" : "binary",
                  .components = components,
                  .text = {}};
  if (encoding == vtu_encoding::ascii) {
    for (T const value : values) {
      if (!array.text.empty()) array.text += ' ';
      append_number(array.text, value);
    }
  } else {
    std::uint64_t const length = values.size() * sizeof(T);
    std::string bytes(sizeof length + length, '\0');
    std::memcpy(bytes.data(), &length, sizeof length);
    if (length > 0) std::memcpy(bytes.data() + sizeof length, values.data(), length);
    array.text = base64(bytes);
  }
  return array;
}

/// Columns as tuples with `components` numbers, filled up with zeros. Throws bad_input.
template <class Values>
[[nodiscard]] vtu_array vtu_columns(std::string_view name, Eigen::MatrixBase<Values> const& values,
                                    int components, vtu_encoding encoding) {
  using scalar = typename Values::Scalar;
  using number = std::conditional_t<std::integral<scalar>, std::int64_t,
                                    std::conditional_t<std::same_as<scalar, float>, float, double>>;
  static_assert(!std::unsigned_integral<scalar> || sizeof(scalar) < sizeof(std::int64_t),
                "VTU data: unsigned 64-bit numbers need not fit Int64");
  if (name.empty() || printable(name, false) != name)
    throw bad_input("name", quoted(name), "a name without control characters");
  std::vector<number> numbers;
  numbers.reserve(static_cast<std::size_t>(values.cols() * components));
  for (index j = 0; j < values.cols(); ++j)
    for (index i = 0; i < components; ++i) {
      auto const value = i < values.rows() ? static_cast<number>(values(i, j)) : number{};
      if constexpr (std::floating_point<number>)
        if (!std::isfinite(value))
          throw bad_input(name, show(values(i, j)) + " at " + show(j), "finite numbers");
      numbers.push_back(value);
    }
  return vtu_numbers(name, numbers, components, encoding);
}

/// A matrix of `count` columns with 2 or 3 components. Throws bad_input.
template <class Values>
[[nodiscard]] vtu_array vtu_vectors(std::string_view name, Eigen::MatrixBase<Values> const& values,
                                    index count, vtu_encoding encoding) {
  if (values.rows() != 2 && values.rows() != 3)
    throw bad_input(name, show(values.rows()) + " components", "2 or 3, one column per vector");
  if (values.cols() != count) throw bad_input(name, show(values.cols()) + " vectors", show(count));
  return vtu_columns(name, values, 3, encoding);
}

// --- document ------------------------------------------------------------------------------------

/// An XML file of VTK's, <VTKFile type="…" version="…">.
class vtk_document {
 public:
  vtk_document(char const* type, char const* version) {
    xml_.append_child(pugi::node_declaration).append_attribute("version") = "1.0";
    xml_.append_child("VTKFile").append_attribute("type") = type;
    root().append_attribute("version") = version;
  }
  [[nodiscard]] pugi::xml_node root() const { return xml_.child("VTKFile"); }

  /// The file appears complete or not at all. Throws as atomic_file.
  void write(std::filesystem::path const& path) const {
    struct : pugi::xml_writer {
      void write(void const* data, std::size_t size) override {
        text.append(static_cast<char const*>(data), size);
      }
      std::string text{};
    } out;
    xml_.save(out, " ");
    atomic_file file(path);
    file.write(out.text);
    file.commit();
  }

 private:
  pugi::xml_document xml_;
};

}  // namespace detail

// --- vtu -----------------------------------------------------------------------------------------

/// Cell shapes, with VTK's numbers for them.
enum class vtu_cell : std::uint8_t {
  vertex = 1,
  line = 3,
  triangle = 5,
  quadrilateral = 9,
  tetrahedron = 10,
  hexahedron = 12,  ///< the lower face around, then the upper one, as VTK has them
  wedge = 13,
  pyramid = 14,
  quadratic_line = 21,  ///< corners first, then the middles of the edges, as VTK has them
  quadratic_triangle = 22,
  quadratic_quadrilateral = 23,
  quadratic_tetrahedron = 24,
  quadratic_hexahedron = 25
};

[[nodiscard]] constexpr index node_count(vtu_cell cell) {
  // By VTK's number; 0 for shapes that are not here.
  constexpr index counts[] = {0, 1, 0, 2, 0, 3, 0, 0, 0, 4, 4, 0,  8,
                              6, 5, 0, 0, 0, 0, 0, 0, 3, 6, 8, 10, 20};
  auto const number = static_cast<std::size_t>(cell);
  return number < std::size(counts) ? counts[number] : 0;
}

/// An unstructured grid with named data on its points. Everything is checked when it is
/// added: sizes, node numbers, names, and that numbers are finite; each failure is a bad_input.
class vtu_grid {
 public:
  /// points: 2 × n or 3 × n, one column per point; a missing third coordinate is 0.
  template <class Points>
  explicit vtu_grid(Eigen::MatrixBase<Points> const& points,
                    vtu_encoding encoding = vtu_encoding::base64)
      : points_(points.cols()),
        coordinates_(detail::vtu_vectors("points", points, points.cols(), encoding)),
        encoding_(encoding) {}

  /// Adds cells of one shape: node numbers from 0, one column per cell. May be called again for
  /// other shapes.
  template <class Cells>
    requires std::integral<typename Cells::Scalar>
  void add_cells(vtu_cell shape, Eigen::MatrixBase<Cells> const& cells) {
    if (cells.rows() != node_count(shape))
      throw bad_input("cells", detail::show(cells.rows()) + " nodes per cell",
                      detail::show(node_count(shape)) + " for this shape");
    for (index cell = 0; cell < cells.cols(); ++cell)
      for (index i = 0; i < cells.rows(); ++i)
        if (std::cmp_less(cells(i, cell), 0) || std::cmp_greater_equal(cells(i, cell), points_))
          throw bad_input(
              "cells", "node " + detail::show(+cells(i, cell)) + " in cell " + detail::show(cell),
              "node numbers from 0 to " + detail::show(points_ - 1));
    for (index cell = 0; cell < cells.cols(); ++cell) {
      for (index i = 0; i < cells.rows(); ++i)
        connectivity_.push_back(static_cast<std::int64_t>(cells(i, cell)));
      offsets_.push_back(static_cast<std::int64_t>(connectivity_.size()));
      types_.push_back(static_cast<std::uint8_t>(shape));
    }
  }

  /// One number per point: floating point, or integers such as states.
  template <class Values>
  void add_point_scalars(std::string_view name, Eigen::MatrixBase<Values> const& values) {
    static_assert(Values::ColsAtCompileTime == 1, "scalars: a column vector");
    if (values.size() != points_)
      throw bad_input(name, detail::show(values.size()) + " values", detail::show(points_));
    add(name, detail::vtu_columns(name, values.transpose(), 1, encoding_));
  }

  /// One vector per point: 2 × n or 3 × n; a missing third component is 0.
  template <class Values>
  void add_point_vectors(std::string_view name, Eigen::MatrixBase<Values> const& values) {
    add(name, detail::vtu_vectors(name, values, points_, encoding_));
  }

  /// Writes the file, which appears complete or not at all. Throws as atomic_file.
  void write(std::filesystem::path const& path) const {
    detail::vtk_document const document("UnstructuredGrid", "1.0");
    auto root = document.root();
    root.append_attribute("byte_order") =
        std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
    root.append_attribute("header_type") = "UInt64";
    auto piece = root.append_child("UnstructuredGrid").append_child("Piece");
    piece.append_attribute("NumberOfPoints") = static_cast<long long>(points_);
    piece.append_attribute("NumberOfCells") = static_cast<long long>(types_.size());

    append(piece.append_child("PointData"), point_data_);
    append(piece.append_child("Points"), {coordinates_});
    append(piece.append_child("Cells"),
           {detail::vtu_numbers("connectivity", connectivity_, 1, encoding_),
            detail::vtu_numbers("offsets", offsets_, 1, encoding_),
            detail::vtu_numbers("types", types_, 1, encoding_)});
    document.write(path);
  }

 private:
  using arrays = std::vector<detail::vtu_array>;

  void add(std::string_view name, detail::vtu_array array) {
    for (auto const& other : point_data_)
      if (other.name == name)
        throw bad_input("name", detail::quoted(name) + " again", "a new name");
    point_data_.push_back(std::move(array));
  }

  static void append(pugi::xml_node parent, arrays const& data) {
    for (auto const& array : data) {
      auto node = parent.append_child("DataArray");
      node.append_attribute("type") = array.type;
      node.append_attribute("Name") = array.name.c_str();
      node.append_attribute("NumberOfComponents") = array.components;
      node.append_attribute("format") = array.format;
      node.append_child(pugi::node_pcdata).set_value(array.text.c_str());
    }
  }

  index points_;
  detail::vtu_array coordinates_;
  vtu_encoding encoding_;
  std::vector<std::int64_t> connectivity_{};
  std::vector<std::int64_t> offsets_{};
  std::vector<std::uint8_t> types_{};
  arrays point_data_{};
};

// --- series --------------------------------------------------------------------------------------
//
// A series of VTU files as one data set of ParaView: a .pvd file that lists them with their times.
//
//   vtu_series series("out/path.pvd");
//   grid.write(series.next(0.5));          // out/path_000.vtu at the time 0.5
//   grid.write(series.next(1.0));          // out/path_001.vtu
//   series.write();

/// Names the files of a series and writes the list of them.
class vtu_series {
 public:
  /// Throws bad_input unless the path ends with .pvd.
  explicit vtu_series(std::filesystem::path list) : list_(std::move(list)) {
    if (list_.extension() != ".pvd" || list_.stem().empty()) {
      throw bad_input("list", list_.string(), "the name of a .pvd file");
    }
  }

  /// Where the file of the next time belongs: beside the list, numbered from 0. Throws bad_input
  /// unless times are finite and increase.
  [[nodiscard]] std::filesystem::path next(double time) {
    if (!detail::is_finite(time) || (!times_.empty() && !(time > times_.back()))) {
      throw bad_input("time", detail::show(time),
                      times_.empty() ? "a finite number"
                                     : "a number greater than " + detail::show(times_.back()));
    }
    times_.push_back(time);
    return list_.parent_path() / name_of(times_.size() - 1);
  }

  [[nodiscard]] std::size_t size() const { return times_.size(); }

  /// Writes the list; it may be written again when the series has grown. Throws as atomic_file.
  void write() const {
    detail::vtk_document const document("Collection", "0.1");
    auto collection = document.root().append_child("Collection");
    for (std::size_t i = 0; i < times_.size(); ++i) {
      auto entry = collection.append_child("DataSet");
      entry.append_attribute("timestep") = detail::show(times_[i]).c_str();
      entry.append_attribute("part") = 0;
      entry.append_attribute("file") = name_of(i).c_str();
    }
    document.write(list_);
  }

 private:
  [[nodiscard, gnu::cold]] std::string name_of(std::size_t i) const {
    std::string number = std::to_string(i);
    if (number.size() < 3) number.insert(0, 3 - number.size(), '0');
    return list_.stem().string() + "_" + number + ".vtu";
  }

  std::filesystem::path list_;
  std::vector<double> times_{};
};

}  // namespace slant
