// SPDX-License-Identifier: MIT
//
// Dense LDLᵀ for symmetric positive definite matrices.
//
// As in ldlt.hpp, K / 2^e is factored, so nothing depends on the units. No pivoting, of which
// definite matrices have no need: the error is that of the equilibrated matrix, whatever the rows
// are scaled by [Demmel 1989; Higham, Accuracy and Stability, 10.1].
//
// Eight columns at a time, in place of the lower triangle: they receive what all panels before
// take from them (panel_kernels.hpp: so that a panel is read once for four columns), then what they
// take from each other. Plain loops over arrays and not Eigen's LDLT: that brings the products of
// matrices with it, three seconds of the compiler in every program that factors a small matrix.
#pragma once

#include <slant/base/matrix_entries.hpp>
#include <slant/compiled.hpp>
#include <slant/concepts/factorization.hpp>
#include <slant/factorizations/parts/panel_kernels.hpp>

#include <algorithm>
#include <concepts>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

namespace slant {

/// K = 2^e L D Lᵀ. Copies share the factors, which never change.
template <class S = double>
class dense_ldlt {
 public:
  using scalar = S;
  using matrix_type = Eigen::MatrixX<S>;
  static constexpr law_set laws = slant::laws<slant::self_adjoint, slant::positive_definite>;

  /// Throws bad_input if K is not square, has an entry that is NaN or infinite, is not symmetric
  /// (up to 1024 ε, naming the worst pair), or not definite (naming the pivot).
  template <class M>
  explicit dense_ldlt(Eigen::MatrixBase<M> const& k) {
    normalise_and_factor(k);
  }

  [[nodiscard]] index rows() const { return factors_->rows(); }
  /// What computes: "dense_ldlt".
  [[nodiscard]] std::string_view name() const noexcept { return "dense_ldlt"; }

  /// x = K⁻¹ b for one or several right-hand sides. Throws bad_input if b or x has not rows() rows.
  void solve(has_scalar<S> auto const& b, auto& x) const {
    detail::check_solve(rows(), b, x);
    auto&& solution = slant::local(x);
    solution = slant::local(b);
    index const columns = solution.cols(), apart = solution.colStride();
    for (index k = 0; k < columns;) {
      bool const together = k + 4 <= columns && solution.rowStride() == 1;
      solve_in_place({solution.data() + k * apart, solution.rowStride(), apart, together ? 4 : 1});
      k += together ? 4 : 1;
    }
  }

 private:
  static constexpr index width = detail::panel_width;
  /// Whether the kernels exist for these numbers.
  static constexpr bool has_kernels = std::same_as<S, double> || std::same_as<S, float>;

  /// One or four vectors: entry i of vector k is first[i · step + k · apart].
  struct right_hand_sides {
    S* first;
    index step, apart, count;

    S& operator()(index i, index k) const { return first[i * step + k * apart]; }
    [[nodiscard]] right_hand_sides from(index i) const {
      return {first + i * step, step, apart, count};
    }
  };

  /// Rows `first`, `first` + 1, … of eight columns of L.
  static detail::panel_columns<S> panel(matrix_type const& l, index first, index column) {
    return detail::panel_from(l.data() + column * l.rows() + first, l.rows(), detail::tile_rows<S>);
  }

  /// y ← y − R p, with eight numbers of p for each of the vectors y.
  static void subtract(detail::panel_columns<S> const& r, S const* p, right_hand_sides const& y,
                       index rows) {
    if constexpr (has_kernels) {
      bool const long_vectors = detail::has_long_vectors();
      if (y.step == 1) {
        return y.count == 4
                   ? detail::subtract_panel_from_four(long_vectors, r, p, y.first, y.apart, rows)
                   : detail::subtract_panel(long_vectors, r, p, y.first, rows);
      }
    }
    for (index k = 0; k < y.count; ++k) {
      for (auto const& column : r.column) {
        S const factor = p[k * width + (&column - r.column.data())];
        for (index i = 0; i < rows; ++i) y(i, k) -= factor * column[i];
      }
    }
  }
  /// result ← Rᵀy, eight numbers for each of the vectors y.
  static void products(detail::panel_columns<S> const& r, right_hand_sides const& y, index rows,
                       S* result) {
    if constexpr (has_kernels) {
      bool const long_vectors = detail::has_long_vectors();
      if (y.step == 1) {
        return y.count == 4
                   ? detail::panel_products_of_four(long_vectors, r, y.first, y.apart, rows, result)
                   : detail::panel_products(long_vectors, r, y.first, rows, result);
      }
    }
    for (index k = 0; k < y.count; ++k) {
      for (auto const& column : r.column) {
        S sum(0);
        for (index i = 0; i < rows; ++i) sum += y(i, k) * column[i];
        result[k * width + (&column - r.column.data())] = sum;
      }
    }
  }

  void normalise_and_factor(matrix_type k);
  /// The lower triangle becomes L, without its ones, and D.
  void factor(matrix_type& a) const;

  void solve_in_place(right_hand_sides const& x) const;

  int exponent_ = 0;
  S unit_{1};
  std::shared_ptr<matrix_type const> factors_;
};

template <class S>
void dense_ldlt<S>::normalise_and_factor(matrix_type k) {
  detail::require_symmetric_matrix("K", k);
  exponent_ = detail::scale_exponent(k);
  unit_ = detail::power_of_two<S>(-exponent_);
  for (index i = 0; i < k.size(); ++i) k.data()[i] *= unit_;
  factor(k);
  factors_ = std::make_shared<matrix_type const>(std::move(k));
}

template <class S>
void dense_ldlt<S>::factor(matrix_type& a) const {
  index const n = a.rows();
  std::vector<S> diagonal(static_cast<std::size_t>(n));
  for (index j = 0; j < n; ++j) diagonal[static_cast<std::size_t>(j)] = a.coeff(j, j);
  for (index c = 0; c < n; c += width) {
    index const end = std::min(c + width, n);
    for (index q = 0; q < c; q += width) {
      for (index j = c; j < end;) {
        index const together = j + 4 <= end ? 4 : 1;
        S p[4 * width];
        for (index k = 0; k < together * width; ++k) {
          index const column = q + k % width;
          p[k] = a.coeff(j + k / width, column) * a.coeff(column, column);
        }
        // From row c on for all columns: what stands above the diagonal is not used.
        subtract(panel(a, c, q), p, {a.data() + j * n + c, 1, n, together}, n - c);
        j += together;
      }
    }
    for (index j = c; j < end; ++j) {
      S* const column = a.data() + j * n;
      for (index q = c; q < j; ++q) {
        S const* const before = a.data() + q * n;
        S const factor = before[j] * before[q];
        for (index i = j; i < n; ++i) column[i] -= factor * before[i];
      }
      detail::require_positive_pivot("K", n, j, j, column[j], diagonal[static_cast<std::size_t>(j)],
                                     exponent_);
      for (index i = j + 1; i < n; ++i) column[i] /= column[j];
    }
  }
}

template <class S>
void dense_ldlt<S>::solve_in_place(right_hand_sides const& x) const {
  matrix_type const& l = *factors_;
  index const n = l.rows();
  S p[4 * width];
  for (index c = 0; c < n; c += width) {
    index const end = std::min(c + width, n);
    for (index k = 0; k < x.count; ++k) {
      for (index j = c; j < end; ++j) {
        S const factor = p[k * width + j - c] = x(j, k);
        for (index i = j + 1; i < end; ++i) x(i, k) -= factor * l.coeff(i, j);
      }
    }
    if (end < n) subtract(panel(l, end, c), p, x.from(end), n - end);
  }
  for (index c = n == 0 ? -1 : (n - 1) / width * width; c >= 0; c -= width) {
    index const end = std::min(c + width, n);
    if (end < n) products(panel(l, end, c), x.from(end), n - end, p);
    for (index k = 0; k < x.count; ++k) {
      for (index j = end; j-- > c;) {
        S value = x(j, k) / l.coeff(j, j);
        if (end < n) value -= p[k * width + j - c];
        for (index i = j + 1; i < end; ++i) value -= x(i, k) * l.coeff(i, j);
        x(j, k) = value;
      }
    }
  }
  for (index k = 0; k < x.count; ++k) {
    for (index i = 0; i < n; ++i) x(i, k) *= unit_;
  }
}

template <class M>
dense_ldlt(Eigen::MatrixBase<M> const&) -> dense_ldlt<typename M::Scalar>;

#if SLANT_USES_COMPILED
extern template class dense_ldlt<double>;
extern template class dense_ldlt<float>;
#endif

}  // namespace slant
