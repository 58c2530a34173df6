// SPDX-License-Identifier: MIT
//
// Checks of matrices and operators: their sizes, and passes over the entries of a dense or sparse
// Eigen matrix: finiteness, largest entry, symmetry; and columns of the identity.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/scalar.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace slant::detail {

// --- sizes ---------------------------------------------------------------------------------------

[[nodiscard, gnu::cold]] inline std::string size_text(index rows, index cols) {
  return std::to_string(rows) + " x " + std::to_string(cols);
}

/// Throws unless the operator called `name` is rows × cols; `why` says where that size comes from.
void require_size(std::string_view name, auto const& a, index rows, index cols,
                  std::string_view why) {
  if (a.rows() != rows || a.cols() != cols) {
    throw bad_input(name, size_text(a.rows(), a.cols()),
                    size_text(rows, cols).append(" (").append(why).append(")"));
  }
}

/// Throws unless the operator called `name` has that many rows.
void require_rows(std::string_view name, auto const& a, index rows, std::string_view why) {
  if (a.rows() != rows) {
    throw bad_input(name, size_text(a.rows(), a.cols()),
                    std::to_string(rows).append(" rows (").append(why).append(")"));
  }
}

/// Throws unless the operator called `name` has that many columns.
void require_cols(std::string_view name, auto const& a, index cols, std::string_view why) {
  if (a.cols() != cols) {
    throw bad_input(name, size_text(a.rows(), a.cols()),
                    std::to_string(cols).append(" columns (").append(why).append(")"));
  }
}

/// Throws unless the rows can be independent.
void require_wide(std::string_view name, auto const& a) {
  if (a.rows() > a.cols()) {
    throw bad_input(name, size_text(a.rows(), a.cols()),
                    "at most as many rows as columns (independent rows)");
  }
}

void require_square(std::string_view name, auto const& a) {
  if (a.rows() != a.cols()) {
    throw bad_input(name, size_text(a.rows(), a.cols()), "a square operator");
  }
}

// --- entries -------------------------------------------------------------------------------------

template <class M>
inline constexpr bool is_sparse_matrix =
    std::is_base_of_v<Eigen::SparseMatrixBase<std::remove_cvref_t<M>>, std::remove_cvref_t<M>>;

/// A sparse matrix, or a view of one, whose entries can be reached as arrays.
template <class M>
inline constexpr bool is_compressed_matrix =
    std::is_base_of_v<Eigen::SparseCompressedBase<M>, M> && !M::IsVectorAtCompileTime;

/// f(row, column, value) for each stored entry.
template <class M, class F>
void for_each_entry(M const& m, F f) {
  if constexpr (is_sparse_matrix<M>) {
    for (index k = 0; k < m.outerSize(); ++k) {
      for (typename M::InnerIterator entry(m, k); entry; ++entry) {
        f(static_cast<index>(entry.row()), static_cast<index>(entry.col()), entry.value());
      }
    }
  } else {
    for (index j = 0; j < m.cols(); ++j) {
      for (index i = 0; i < m.rows(); ++i) f(i, j, m.coeff(i, j));
    }
  }
}

[[nodiscard, gnu::cold]] inline std::string entry_text(std::string_view name, index i, index j) {
  return std::string(name) + "(" + std::to_string(i) + ", " + std::to_string(j) + ")";
}

/// d = diag m. In meshes the diagonal entry of a column stands about where that of the one before
/// stood in its own; a search from the middle waits for memory several times.
template <class M, class D>
void copy_diagonal(M const& m, D&& d) {
  index const n = std::min<index>(m.rows(), m.cols());
  if constexpr (requires { d.resize(n); }) d.resize(n);
  if constexpr (is_compressed_matrix<M>) {
    auto const* const inner = m.innerIndexPtr();
    std::ptrdiff_t place = 0;
    for (index j = 0; j < n; ++j) {
      std::ptrdiff_t const first = m.outerIndexPtr()[j];
      std::ptrdiff_t const end =
          m.isCompressed() ? m.outerIndexPtr()[j + 1] : first + m.innerNonZeroPtr()[j];
      std::ptrdiff_t at = std::min(first + place, end);
      while (at < end && inner[at] < j) ++at;
      while (at > first && inner[at - 1] >= j) --at;
      bool const there = at < end && inner[at] == j;
      d.coeffRef(j) = there ? m.valuePtr()[at] : typename M::Scalar(0);
      place = at - first;
    }
  } else {
    for (index j = 0; j < n; ++j) d.coeffRef(j) = m.coeff(j, j);
  }
}

/// Throws bad_input naming the first entry that is NaN or infinite.
template <class M>
void require_finite_entries(std::string_view name, M const& m) {
  using S = typename M::Scalar;
  if constexpr (is_compressed_matrix<M> && std::is_floating_point_v<S>) {
    // One pass over the numbers alone; which one it is, is asked where there is one.
    if (m.outerSize() > 0 && m.isCompressed()) {
      Eigen::Map<Eigen::Array<S, Eigen::Dynamic, 1> const> const values(
          m.valuePtr() + m.outerIndexPtr()[0], m.nonZeros());
      if ((values - values).sum() == S(0)) return;
    }
  }
  for_each_entry(m, [&](index i, index j, auto const& value) {
    if (!is_finite(value)) {
      throw bad_input(entry_text(name, i, j), show(value), "a finite number");
    }
  });
}

/// max |m_ij|; 0 for an empty matrix. Entries are finite.
template <class M>
[[nodiscard]] auto largest_entry(M const& m) {
  using std::abs;
  typename M::Scalar largest(0);
  for_each_entry(m, [&](index, index, auto const& value) {
    typename M::Scalar const size = abs(value);
    if (size > largest) largest = size;
  });
  return largest;
}

/// The largest sum of |K_ij| over a row i: ‖K‖ in the maximum norm, and a bound of its eigenvalues.
template <class S>
[[nodiscard]] S largest_row_sum(Eigen::SparseMatrix<S> const& K) {
  using std::abs;
  Eigen::VectorX<S> sums = Eigen::VectorX<S>::Zero(K.rows());
  for_each_entry(K, [&](index i, index, S const& value) { sums[i] += abs(value); });
  return K.rows() > 0 ? S(sums.maxCoeff()) : S(0);
}

/// The columns of I ∈ ℝⁿˣⁿ with these numbers.
template <class S>
[[nodiscard]] Eigen::SparseMatrix<S> columns_of_identity(index n,
                                                         std::vector<index> const& numbers) {
  Eigen::SparseMatrix<S> columns(n, index(numbers.size()));
  columns.reserve(columns.cols());
  for (index j = 0; j < columns.cols(); ++j) {
    columns.startVec(j);
    columns.insertBack(numbers[std::size_t(j)], j) = S(1);
  }
  columns.finalize();
  return columns;
}

/// The largest 2^e ≤ max |m_ij| as its exponent e; 0 for a zero matrix. Division by 2^e is exact,
/// so that what is computed from m / 2^e is bit for bit the same in all units 2^k.
template <class M>
[[nodiscard]] int scale_exponent(M const& m) {
  using S = typename M::Scalar;
  S const largest = largest_entry(m);
  // 2^e and 2^-e must both be numbers; denormal matrices are scaled as far as that allows.
  return largest > S(0)
             ? std::max(binary_exponent(largest) - 1, 2 - std::numeric_limits<S>::max_exponent)
             : 0;
}

/// Throws bad_input for a diagonal entry that no positive semidefinite matrix has: a negative one,
/// or 0 in a row with other entries. The matrix is sparse, symmetric and finite.
template <class M>
void require_semidefinite_diagonal(std::string_view name, M const& m) {
  using S = typename M::Scalar;
  Eigen::Matrix<S, Eigen::Dynamic, 1> const diagonal = m.diagonal();
  auto const refuse = [&](index i, std::string const& expectation) {
    throw bad_input(entry_text(name, i, i), show(diagonal[i]), expectation);
  };
  for (index i = 0; i < diagonal.size(); ++i) {
    if (diagonal[i] < S(0)) refuse(i, "a number >= 0 on the diagonal of a semidefinite matrix");
  }
  for_each_entry(m, [&](index i, index j, S const& value) {
    using std::abs;
    S const noise = S(32) * std::numeric_limits<S>::epsilon() * diagonal[j];
    if (diagonal[i] == S(0) && abs(value) > noise) {
      refuse(i, "a number > 0, since row " + show(i) + " has other entries");
    }
  });
}

/// Throws bad_input naming the worst pair unless
///     |m_ij − m_ji| ≤ 1024 ε √(|m_ii| |m_jj|)   for all i, j,
/// the size of the rounding errors of an assembly from many symmetric parts. Measured by the
/// diagonal, so it is the same in all units and under diagonal scaling of a definite matrix.
template <class M>
void require_symmetric_entries(std::string_view name, M const& m) {
  using std::abs;
  using std::sqrt;
  using S = typename M::Scalar;
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  S const unit = power_of_two<S>(-scale_exponent(m));
  vector_type root = m.diagonal();
  for (index i = 0; i < root.size(); ++i) root[i] = sqrt(S(abs(root[i]) * unit));
  S const tolerance = S(1024) * std::numeric_limits<S>::epsilon();
  S worst(0);
  index row = -1, col = -1;
  auto const compare = [&](index i, index j, S const& upper, S const& lower) {
    S const difference = abs(S(upper * unit - lower * unit));
    S const allowed = tolerance * root[i] * root[j];
    if (difference > allowed) {
      S const excess = allowed > S(0) ? S(difference / allowed) : std::numeric_limits<S>::max();
      if (excess > worst) {
        worst = excess;
        row = i;
        col = j;
      }
    }
  };
  if constexpr (is_sparse_matrix<M>) {
    // The transposed copy has the storage order of m: both are then walked side by side.
    typename M::PlainObject const t = m.transpose();
    for (index k = 0; k < m.outerSize(); ++k) {
      typename M::InnerIterator a(m, k);
      typename M::PlainObject::InnerIterator b(t, k);
      while (a || b) {
        bool const take_a = a && (!b || a.index() <= b.index());
        bool const take_b = b && (!a || b.index() <= a.index());
        index const i = take_a ? index(a.row()) : index(b.row());
        index const j = take_a ? index(a.col()) : index(b.col());
        compare(i, j, take_a ? S(a.value()) : S(0), take_b ? S(b.value()) : S(0));
        if (take_a) ++a;
        if (take_b) ++b;
      }
    }
  } else {
    for (index j = 0; j < m.cols(); ++j) {
      for (index i = 0; i < j; ++i) compare(i, j, m.coeff(i, j), m.coeff(j, i));
    }
  }
  if (row >= 0) {
    throw bad_input(
        entry_text(name, row, col), show(m.coeff(row, col)),
        "a symmetric matrix, but " + entry_text(name, col, row) + " is " + show(m.coeff(col, row)));
  }
}

// --- spd checks ----------------------------------------------------------------------------------
//
// What every factorisation of a symmetric positive definite matrix checks, in the same words.
//
// Singularity. The pivot of row p is d = K_pp − Σ ℓ²d, a difference whose rounding error is a small
// multiple of ε K_pp for each term subtracted. A pivot d ≤ 4 max(n, 16) ε K_pp is thus
// indistinguishable from zero, and is refused. (Floating bricks of linear elasticity, six rigid
// motions each, are refused up to the 2·10⁴ unknowns that were tried.) The measure is the diagonal
// entry of the same row, not the largest one, so that a soft body beside a stiff one is not called
// singular.

/// Throws bad_input unless K is square, finite and symmetric up to rounding.
void require_symmetric_matrix(std::string_view name, auto const& k) {
  require_square(name, k);
  require_finite_entries(name, k);
  require_symmetric_entries(name, k);
}

/// Throws bad_input unless b and x have the sizes of right-hand sides and solutions.
void check_solve(index n, auto const& b, auto const& x) {
  check_rows("b", b, n, "rows() of the factorisation");
  check_rows("x", x, n, "rows() of the factorisation");
  check_same_columns("x", x, b, "one for each column of b");
}

/// Throws bad_input unless order is a permutation of 0 … n − 1.
inline void check_permutation(std::string_view name, std::vector<int> const& order, index n) {
  check_size(name, static_cast<index>(order.size()), n, "one entry for each row of K,");
  std::vector<bool> seen(order.size(), false);
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (order[i] < 0 || order[i] >= n || seen[static_cast<std::size_t>(order[i])]) {
      throw bad_input(name, show(order[i]), "each of 0, …, rows − 1 once")
          .at(static_cast<index>(i));
    }
    seen[static_cast<std::size_t>(order[i])] = true;
  }
}

/// The smallest pivot of a row with that diagonal entry that can be told from zero.
template <class S>
[[nodiscard]] S smallest_pivot(index n, S const& diagonal) {
  return S(4) * S(std::max<index>(n, 16)) * std::numeric_limits<S>::epsilon() * diagonal;
}

/// Throws bad_input that names the pivot: its position in the elimination, its row, its value.
[[noreturn]] void refuse_pivot(std::string_view name, index pivot, index row, auto const& value,
                               bool singular) {
  std::string text("pivot ");
  text.append(show(pivot)).append(" (row ").append(show(row)).append(") = ").append(show(value));
  if (singular) text.append(", zero up to rounding");
  throw bad_input(name, text, "a symmetric positive definite matrix");
}

/// Throws unless pivot number k, of the given row, belongs to a positive definite matrix. Values
/// are those of K / 2^e; the message shows them in the units of K.
template <class S>
void require_positive_pivot(std::string_view name, index n, index k, index row, S const& pivot,
                            S const& diagonal, int e) {
  using std::ldexp;
  S const least = smallest_pivot(n, diagonal);
  if (pivot > least) return;
  refuse_pivot(name, k, row, S(ldexp(pivot, e)), diagonal >= S(0) && pivot >= -least);
}

}  // namespace slant::detail
