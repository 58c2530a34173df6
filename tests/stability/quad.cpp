// SPDX-License-Identifier: MIT
#include <stability/quad.hpp>

#include <cmath>
#include <utility>

namespace stability {

quad root(quad a) {
  if (!(a > 0)) return 0;
  if (a - a != 0) return a;  // infinite
  quad scale = 1;            // powers of two, until a double holds a
  quad const four_hundred = static_cast<quad>(std::ldexp(1.0, 400));
  while (a > four_hundred) {
    a /= four_hundred;
    scale *= static_cast<quad>(std::ldexp(1.0, 200));
  }
  while (a < 1 / four_hundred) {
    a *= four_hundred;
    scale /= static_cast<quad>(std::ldexp(1.0, 200));
  }
  quad y = static_cast<quad>(std::sqrt(static_cast<double>(a)));
  y = (y + a / y) / 2;
  y = (y + a / y) / 2;
  return scale * y;
}

quad dot(quad_vector const& x, quad_vector const& y) {
  quad sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += x[i] * y[i];
  return sum;
}

quad_vector quad_matrix::times(quad_vector const& x) const {
  quad_vector y(rows, quad(0));
  quad const* a = entries.data();
  for (std::size_t i = 0; i < rows; ++i) {
    quad sum = 0;
    for (std::size_t j = 0; j < cols; ++j) sum += *a++ * x[j];
    y[i] = sum;
  }
  return y;
}

quad_cholesky::quad_cholesky(quad_matrix a) : l_(std::move(a)) {
  std::size_t const n = l_.rows;
  for (std::size_t i = 0; i < n && ok_; ++i) {
    quad* const row = l_.entries.data() + i * n;
    for (std::size_t j = 0; j <= i; ++j) {
      quad const* const other = l_.entries.data() + j * n;
      quad sum = row[j];
      for (std::size_t k = 0; k < j; ++k) {
        if (row[k] == 0) continue;
        sum -= row[k] * other[k];
      }
      if (j < i) {
        row[j] = sum / other[j];
      } else {
        ok_ = sum > 0;
        row[i] = root(sum);
      }
    }
  }
}

quad_vector quad_cholesky::solve(quad_vector x) const {
  std::size_t const n = l_.rows;
  for (std::size_t i = 0; i < n; ++i) {
    quad sum = x[i];
    for (std::size_t k = 0; k < i; ++k) sum -= l_(i, k) * x[k];
    x[i] = sum / l_(i, i);
  }
  for (std::size_t i = n; i-- > 0;) {
    quad const value = x[i] / l_(i, i);
    x[i] = value;
    for (std::size_t k = 0; k < i; ++k) x[k] -= l_(i, k) * value;
  }
  return x;
}

quad_vector eliminate(quad_matrix a, quad_vector b) {
  std::size_t const n = a.rows;
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (magnitude(a(i, k)) > magnitude(a(pivot, k))) pivot = i;
    if (!(magnitude(a(pivot, k)) > 0)) return {};
    if (pivot != k) {
      for (std::size_t j = k; j < n; ++j) std::swap(a(k, j), a(pivot, j));
      std::swap(b[k], b[pivot]);
    }
    for (std::size_t i = k + 1; i < n; ++i) {
      if (a(i, k) == 0) continue;
      quad const factor = a(i, k) / a(k, k);
      for (std::size_t j = k + 1; j < n; ++j) a(i, j) -= factor * a(k, j);
      b[i] -= factor * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) b[k] -= a(k, j) * b[j];
    b[k] /= a(k, k);
  }
  return b;
}

}  // namespace stability
