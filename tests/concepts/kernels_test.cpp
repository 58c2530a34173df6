// SPDX-License-Identifier: MIT
#include <slant/concepts/kernels.hpp>

#include <support/testing.hpp>

namespace {

template <class S>
using column = Eigen::Matrix<S, Eigen::Dynamic, 1>;

/// Entries of many sizes, none of them a short binary fraction.
template <class S>
column<S> entries(slant::index n, int seed) {
  column<S> x(n);
  for (slant::index i = 0; i < n; ++i)
    x[i] = S(std::sin(1.0 + 3.7 * double(i) + seed) * std::exp(double((i * 7 + seed) % 11) - 5));
  return x;
}

}  // namespace

TEST_CASE_TEMPLATE("sums of products have the bits of Eigen's", S, float, double) {
  for (slant::index n = 0; n < 70; ++n) {
    CAPTURE(n);
    column<S> const x = entries<S>(n, 1), y = entries<S>(n, 2);
    CHECK(slant::kernels::dot(n, x.data(), y.data()) == x.dot(y));
    auto const α = static_cast<S>(0.3);
    column<S> const scaled = α * x;
    CHECK(slant::kernels::scaled_square(n, α, x.data()) == scaled.dot(scaled));
  }
}

TEST_CASE("products may start at any entry") {
  column<double> const x = entries<double>(40, 1), y = entries<double>(40, 2);
  for (slant::index i = 0; i < 8; ++i) {
    for (slant::index j = 0; j < 8; ++j) {
      column<double> const a = x.segment(i, 30), b = y.segment(j, 30);
      CHECK(slant::kernels::dot(30, x.data() + i, y.data() + j) == a.dot(b));
    }
  }
}

TEST_CASE_TEMPLATE("combinations do to each entry what a loop does", S, float, double,
                   long double) {
  S const factors[] = {S(1), S(-1), S(0), static_cast<S>(0.3), S(-7)};
  for (slant::index const n : {0, 1, 2, 3, 4, 7, 8, 33}) {
    column<S> const x = entries<S>(n, 3), y = entries<S>(n, 4);
    for (S const& α : factors) {
      for (S const& β : factors) {
        CAPTURE(n);
        CAPTURE(α);
        CAPTURE(β);
        column<S> w(n), expected(n);
        for (slant::index i = 0; i < n; ++i) expected[i] = α * x[i] + β * y[i];
        slant::kernels::waxpby(n, α, x.data(), β, y.data(), w.data());
        CHECK(w == expected);
        w = x;  // in place
        slant::kernels::waxpby(n, α, w.data(), β, y.data(), w.data());
        CHECK(w == expected);
        w = y;
        slant::kernels::waxpby(n, α, x.data(), β, w.data(), w.data());
        CHECK(w == expected);
      }
      column<S> w(n), product = α * x, quotient = x / S(α - S(2));
      slant::kernels::scale(n, α, x.data(), w.data());
      CHECK(w == product);
      slant::kernels::divide(n, S(α - S(2)), x.data(), w.data());
      CHECK(w == quotient);
    }
    column<S> w(n);
    slant::kernels::multiply(n, x.data(), y.data(), w.data());
    CHECK(w == x.cwiseProduct(y));
    slant::kernels::quotient(n, x.data(), y.data(), w.data());
    CHECK(w == x.cwiseQuotient(y));
    slant::kernels::copy(n, x.data(), w.data());
    CHECK(w == x);
    slant::kernels::fill(n, S(5), w.data());
    CHECK(w == column<S>::Constant(n, S(5)));
  }
}

TEST_CASE("the largest entry, and NaN wherever it stands") {
  column<double> x = entries<double>(9, 5);
  CHECK(slant::kernels::largest(9, x.data()) == x.cwiseAbs().maxCoeff());
  CHECK(slant::kernels::largest(0, x.data()) == 0);
  x[4] = -std::numeric_limits<double>::infinity();
  CHECK(slant::kernels::largest(9, x.data()) == std::numeric_limits<double>::infinity());
  for (int i = 0; i < 9; ++i) {
    column<double> y = x;
    y[i] = std::numeric_limits<double>::quiet_NaN();
    CHECK(std::isnan(slant::kernels::largest(9, y.data())));
  }
}

TEST_CASE("masks select and do not multiply") {
  double const inf = std::numeric_limits<double>::infinity(),
               nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> const mask{0, 1, 0, 1, 0}, x{inf, 2, nan, 4, 5};
  std::vector<double> y(5, -1);
  slant::kernels::keep(5, mask.data(), x.data(), y.data());
  CHECK(y == std::vector<double>{0, 2, 0, 4, 0});
  std::vector<double> const finite{1, inf, 3, nan, 5};
  slant::kernels::keep_complement(5, mask.data(), finite.data(), y.data());
  CHECK(y == std::vector<double>{1, 0, 3, 0, 5});
}

TEST_CASE("vectors are equal in all entries, and NaN is equal to nothing") {
  for (slant::index const n : {1, 2, 5, 8}) {
    column<double> const x = entries<double>(n, 6);
    CHECK(slant::kernels::equal(n, x.data(), x.data()));
    for (slant::index i = 0; i < n; ++i) {
      column<double> y = x;
      y[i] = std::nextafter(y[i], 1e9);
      CHECK_FALSE(slant::kernels::equal(n, x.data(), y.data()));
      y[i] = std::numeric_limits<double>::quiet_NaN();
      CHECK_FALSE(slant::kernels::equal(n, y.data(), y.data()));
    }
  }
}
