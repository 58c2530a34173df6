// SPDX-License-Identifier: MIT
#include <slant/factorizations/parts/panel_kernels.hpp>

#include <support/testing.hpp>

namespace packed_symmetric_test {

using slant::index;

template <class T>
using matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;

template <class T>
matrix<T> random_symmetric(index n) {
  matrix<T> const a = matrix<T>::Random(n, n);
  return a + a.transpose();
}

template <class T>
void pack(matrix<T> const& from, slant::detail::packed_symmetric<T>& to) {
  for (index j = 0; j < from.cols(); ++j) {
    for (index i = j; i < from.rows(); ++i) to.set(i, j, from(i, j));
  }
}

TEST_CASE_TEMPLATE("products as with the dense matrix, whatever the size", T, float, double) {
  T const ε = std::numeric_limits<T>::epsilon();
  for (index n = 0; n < 45; ++n) {
    matrix<T> const S = random_symmetric<T>(n);
    slant::detail::packed_symmetric<T> packed(n);
    pack(S, packed);
    CHECK(packed.size() == n);
    for (index j = 0; j < n; ++j) {
      for (index i = j; i < n; ++i) CHECK(packed(i, j) == S(i, j));
    }
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

TEST_CASE("an entry may be set again") {
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

TEST_CASE("in floats: made once, half the size, each entry rounded") {
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

}  // namespace packed_symmetric_test
