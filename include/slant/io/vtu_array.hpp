// SPDX-License-Identifier: MIT
//
// The data arrays of a VTU file as text: decimal numbers, or base64 of their bytes behind an 8-byte
// length. VTK knows fixed types only: other scalars than float are written as double.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/io/text_scanner.hpp>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace slant {

/// How numbers stand in the file, exactly in both cases: in decimal, to be read by eye, or as
/// bytes.
enum class vtu_encoding : unsigned char { ascii, base64 };

namespace detail {

struct vtu_array {
  std::string name;
  char const* type;
  char const* format;
  int components;
  index count;  ///< tuples
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
                  .count = static_cast<index>(values.size()) / components,
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

/// A vector of `count` numbers, one per tuple. Throws bad_input.
template <class Values>
[[nodiscard]] vtu_array vtu_scalars(std::string_view name, Eigen::MatrixBase<Values> const& values,
                                    index count, vtu_encoding encoding) {
  static_assert(Values::ColsAtCompileTime == 1, "scalars: a column vector");
  if (values.size() != count) throw bad_input(name, show(values.size()) + " values", show(count));
  return vtu_columns(name, values.transpose(), 1, encoding);
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

}  // namespace detail
}  // namespace slant
