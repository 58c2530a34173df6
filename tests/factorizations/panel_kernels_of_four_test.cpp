// SPDX-License-Identifier: MIT
#include <slant/factorizations/parts/panel_kernels.hpp>

#include <doctest/doctest.h>
#include <Eigen/Core>

#include <cstddef>
#include <limits>

namespace panel_kernels_of_four_test {

using slant::index;
namespace detail = slant::detail;

TEST_CASE_TEMPLATE("each right-hand side as by itself, whatever the number of rows", T, float,
                   double) {
  using matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
  T const ε = std::numeric_limits<T>::epsilon();
  for (bool const longer : {false, true}) {
    if (longer && !detail::has_long_vectors()) continue;
    for (index rows = 0; rows < 40; ++rows) {
      matrix const R = matrix::Random(rows, 8);
      matrix const p = matrix::Random(8, 4);
      matrix const before = matrix::Random(rows + 3, 4);  // with rows that stay as they are
      detail::panel_columns<T> columns{{}, detail::tile_rows<T>};
      for (index j = 0; j < 8; ++j) columns.column[std::size_t(j)] = R.data() + j * rows;

      matrix y = before;
      detail::subtract_panel_from_four(longer, columns, p.data(), y.data() + 1, rows + 3, rows);
      matrix products(8, 4);
      detail::panel_products_of_four(longer, columns, before.data() + 1, rows + 3, rows,
                                     products.data());
      for (index k = 0; k < 4; ++k) {
        for (index i = 0; i < rows; ++i) {
          T exact = before(i + 1, k);
          for (index j = 0; j < 8; ++j) exact -= R(i, j) * p(j, k);
          CHECK(std::abs(y(i + 1, k) - exact) <= 16 * ε);
        }
        for (index const i : {index(0), rows + 1, rows + 2}) CHECK(y(i, k) == before(i, k));
        for (index j = 0; j < 8; ++j) {
          T exact(0);
          for (index i = 0; i < rows; ++i) exact += R(i, j) * before(i + 1, k);
          CHECK(std::abs(products(j, k) - exact) <= T(rows + 1) * 2 * ε);
        }
      }
    }
  }
}

}  // namespace panel_kernels_of_four_test
