// SPDX-License-Identifier: MIT
#include <slant/factorizations/parts/panel_kernels.hpp>

#include <support/testing.hpp>

namespace panel_kernels_test {

using slant::index;
namespace detail = slant::detail;
using slant::detail::rounded_entry;

template <class T>
using matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;

/// A panel stored by columns, and y.
template <class T>
struct example {
  Eigen::Matrix<T, Eigen::Dynamic, 8> R;
  Eigen::Matrix<T, Eigen::Dynamic, 1> y;
  Eigen::Matrix<T, 8, 1> p = Eigen::Matrix<T, 8, 1>::Random();

  explicit example(index rows)
      : R(Eigen::Matrix<T, Eigen::Dynamic, 8>::Random(rows, 8)),
        y(Eigen::Matrix<T, Eigen::Dynamic, 1>::Random(rows)) {}

  [[nodiscard]] slant::detail::panel_columns<T> columns() const {
    slant::detail::panel_columns<T> result{{}, slant::detail::tile_rows<T>};
    for (index j = 0; j < 8; ++j)
      result.column[static_cast<std::size_t>(j)] = R.data() + j * R.rows();
    return result;
  }
};

TEST_CASE_TEMPLATE(
    "both loops, and both in one, with short and with long vectors, any number of rows", T, float,
    double) {
  T const ε = std::numeric_limits<T>::epsilon();
  for (bool const longer : {false, true}) {
    if (longer && !slant::detail::has_long_vectors()) continue;
    for (index rows = 0; rows < 40; ++rows) {
      example<T> const e(rows);
      // One place before and behind: nothing else may be written to.
      Eigen::Matrix<T, Eigen::Dynamic, 1> y(rows + 2);
      y << T(7), e.y, T(9);
      slant::detail::subtract_panel(longer, e.columns(), e.p.data(), y.data() + 1, rows);
      for (index i = 0; i < rows; ++i)
        CHECK(std::abs(y[i + 1] - (e.y[i] - e.R.row(i).dot(e.p))) <= 16 * ε);
      CHECK(y[0] == T(7));
      CHECK(y[rows + 1] == T(9));
      Eigen::Matrix<T, 8, 1> products;
      slant::detail::panel_products(longer, e.columns(), e.y.data(), rows, products.data());
      for (index j = 0; j < 8; ++j)
        CHECK(std::abs(products[j] - e.R.col(j).dot(e.y)) <= T(rows + 1) * 2 * ε);
      Eigen::Matrix<T, Eigen::Dynamic, 1> z(rows + 2);
      z << T(7), e.y, T(9);
      Eigen::Matrix<T, 8, 1> again;
      slant::detail::subtract_panel_and_products(longer, e.columns(), e.p.data(), e.y.data(),
                                                 z.data() + 1, rows, again.data());
      CHECK((z - y).cwiseAbs().maxCoeff() <= 16 * ε);
      CHECK((again - products).cwiseAbs().maxCoeff() <= T(rows + 1) * 2 * ε);
      CHECK(z[0] == T(7));
      CHECK(z[rows + 1] == T(9));
    }
  }
}

TEST_CASE_TEMPLATE("each right-hand side as by itself, whatever the number of rows", T, float,
                   double) {
  T const ε = std::numeric_limits<T>::epsilon();
  for (bool const longer : {false, true}) {
    if (longer && !detail::has_long_vectors()) continue;
    for (index rows = 0; rows < 40; ++rows) {
      example<T> const e(rows);
      matrix<T> const p = matrix<T>::Random(8, 4);
      matrix<T> const before = matrix<T>::Random(rows + 3, 4);  // with rows that stay as they are
      matrix<T> y = before;
      detail::subtract_panel_from_four(longer, e.columns(), p.data(), y.data() + 1, rows + 3, rows);
      matrix<T> products(8, 4);
      detail::panel_products_of_four(longer, e.columns(), before.data() + 1, rows + 3, rows,
                                     products.data());
      for (index k = 0; k < 4; ++k) {
        for (index i = 0; i < rows; ++i) {
          T exact = before(i + 1, k);
          for (index j = 0; j < 8; ++j) exact -= e.R(i, j) * p(j, k);
          CHECK(std::abs(y(i + 1, k) - exact) <= 16 * ε);
        }
        for (index const i : {index(0), rows + 1, rows + 2}) CHECK(y(i, k) == before(i, k));
        for (index j = 0; j < 8; ++j) {
          T exact(0);
          for (index i = 0; i < rows; ++i) exact += e.R(i, j) * before(i + 1, k);
          CHECK(std::abs(products(j, k) - exact) <= T(rows + 1) * 2 * ε);
        }
      }
    }
  }
}

TEST_CASE("rounded as a cast does it; what floats cannot hold is their largest number or zero") {
  CHECK(rounded_entry<float>(0.1) == 0.1f);
  CHECK(rounded_entry<float>(-1e-20) == -1e-20f);
  CHECK(rounded_entry<float>(1e300) == std::numeric_limits<float>::max());
  CHECK(rounded_entry<float>(-1e300) == -std::numeric_limits<float>::max());
  CHECK(rounded_entry<float>(1e-43) == 0);
  CHECK(rounded_entry<float>(-1e-43) == 0);
  CHECK(rounded_entry<float>(0.0) == 0);
  CHECK(rounded_entry<double>(0.1) == 0.1);
}

template <class T>
matrix<T> random_symmetric(index n) {
  matrix<T> const a = matrix<T>::Random(n, n);
  return a + a.transpose();
}

template <class T>
void pack(matrix<T> const& from, slant::detail::packed_symmetric<T>& to) {
  for (index j = 0; j < from.cols(); ++j)
    for (index i = j; i < from.rows(); ++i) to.set(i, j, from(i, j));
}

TEST_CASE_TEMPLATE("packed: products as with the dense matrix, whatever the size", T, float,
                   double) {
  T const ε = std::numeric_limits<T>::epsilon();
  for (index n = 0; n < 45; ++n) {
    matrix<T> const S = random_symmetric<T>(n);
    slant::detail::packed_symmetric<T> packed(n);
    pack(S, packed);
    CHECK(packed.size() == n);
    for (index j = 0; j < n; ++j)
      for (index i = j; i < n; ++i) CHECK(packed(i, j) == S(i, j));
    // One place before and behind: nothing else may be written to.
    matrix<T> const x = matrix<T>::Random(n, 1);
    matrix<T> y = matrix<T>::Constant(n + 2, 1, T(7));
    CHECK(test::allocations_of([&] { packed.multiply(x.data(), y.data() + 1); }) == 0);
    for (index i = 0; i < n; ++i) {
      T exact(0), size(0);
      for (index j = 0; j < n; ++j) {
        exact += S(i, j) * x(j);
        size += std::abs(S(i, j) * x(j));
      }
      CHECK(std::abs(y(i + 1) - exact) <= T(n) * ε * size);
    }
    CHECK(y(0) == T(7));
    CHECK(y(n + 1) == T(7));
  }
}

TEST_CASE("packed: an entry may be set again") {
  slant::detail::packed_symmetric<double> packed(11);
  for (double const v : {3.0, -2.0}) {
    packed.set(9, 8, v);
    packed.set(10, 2, v);
    packed.set(5, 5, v);
  }
  VectorXd const x = VectorXd::LinSpaced(11, 1, 11);
  VectorXd y(11), expected = VectorXd::Zero(11);
  packed.multiply(x.data(), y.data());
  expected[9] = -2 * x[8];
  expected[8] = -2 * x[9];
  expected[10] = -2 * x[2];
  expected[2] = -2 * x[10];
  expected[5] = -2 * x[5];
  CHECK(y == expected);
}

TEST_CASE("packed, in floats: made once, half the size, each entry rounded") {
  matrix<double> const S = random_symmetric<double>(21);
  slant::detail::packed_symmetric<double> packed(21);
  pack(S, packed);
  packed.set(20, 3, 1e300);
  auto const floats = packed.rounded();
  CHECK(floats == packed.rounded());
  CHECK(floats->bytes() < 0.7 * double(packed.bytes()));
  CHECK((*floats)(20, 3) == std::numeric_limits<float>::max());
  CHECK((*floats)(12, 7) == float(S(12, 7)));
  CHECK((*floats)(7, 7) == float(S(7, 7)));
}

}  // namespace panel_kernels_test
