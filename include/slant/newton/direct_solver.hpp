// SPDX-License-Identifier: MIT
//
// Gaussian elimination for F°(y) dy = −F, where the operator can be taken apart:
//
//     G offers its inverse (has_inverse)     one application of G⁻¹
//     G is a sparse matrix                   sparse LU by Eigen
//     G has columns                          dense LU by Eigen with row pivoting
//
// No threshold says what is singular: the residual of dy is looked at, one application of G, as
// that of every other solver. A matrix that has no solution shows it there.
#pragma once

#include <slant/base/lu.hpp>
#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/capabilities.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/newton/direction.hpp>
#include <slant/operators/letter.hpp>
#include <slant/operators/matrix.hpp>

#include <algorithm>
#include <optional>
#include <type_traits>
#include <utility>

namespace slant {

namespace detail {

template <class V>
using dense_matrix_t = Eigen::Matrix<scalar_t<V>, Eigen::Dynamic, Eigen::Dynamic>;

/// "Factors" of an operator that offers its inverse; W is the workspace of that.
template <class W>
class known_inverse {
 public:
  static constexpr index factorizations = 0;

  template <class G, class V>
  known_inverse(G const& g, V const& f) {
    try {
      w_.emplace(slant::workspace(g.inverse(), f));
    } catch (bad_input const&) {  // this one has none, which is for solve to say
    }
  }

  template <class G, class V>
  void solve(G const& g, V const& b, V& x) {
    auto const& inverse = g.inverse();
    if (!w_) w_.emplace(slant::workspace(inverse, b));
    slant::apply(inverse, b, x, *w_);
  }

 private:
  std::optional<W> w_;
};

/// What direct solvers keep: factors, and what the residual needs.
template <class V, class Factors, class W>
struct direct_workspace {
  Factors factors;
  V residual;     ///< F + G dy
  W g_workspace;  ///< temporaries of G
};
template <class Factors, class V, class W>
direct_workspace(Factors, V, W) -> direct_workspace<V, Factors, W>;

/// solve(dy) makes dy = G⁻¹ F and says whether it could; what comes of it.
template <class G, class V, class P, class Solve>
[[nodiscard]] report_of<V> direct_direction(G const& g, V const& f, request_of<V> const& request,
                                            V& dy, P& p, Solve solve) {
  using S = scalar_t<V>;
  constexpr index factored = std::remove_cvref_t<decltype(p.factors)>::factorizations;
  direction_report<S> report{status::breakdown, request.residual_norm, 0, 1 - factored, factored};
  bool const solved = slant::everywhere(dy, solve(dy));
  vectors::negate(dy, dy);
  if (solved && is_finite(S(norm(dy)))) {
    if constexpr (requires { p.factors.multiply(dy, p.residual); }) {
      p.factors.multiply(dy, p.residual);
    } else {
      slant::apply(g, dy, p.residual, p.g_workspace);
      ++report.operator_applications;
    }
    vectors::add(f, p.residual);
    report.residual_norm = norm(p.residual);
    // LU is as accurate as this precision allows, if not as η wants.
    bool const enough = report.residual_norm <= request.tolerance * request.residual_norm;
    if (is_finite(report.residual_norm)) {
      report.status = enough ? status::converged : status::stalled;
      return report;
    }
  }
  report.residual_norm = request.residual_norm;
  vectors::set_zero(dy);
  return report;
}

}  // namespace detail

/// A direct solution costs no more than the operator's own inverse, or the factors of its matrix.
template <class G, class V>
concept solved_cheaply =
    linear_operator<G, V> && (has_inverse<G, V> || detail::matrix_behind<G>::exists);

/// A direct solution is possible.
template <class G, class V>
concept solved_directly =
    solved_cheaply<G, V> || (linear_operator<G, V> && has_columns<G, detail::dense_matrix_t<V>>);

/// LU of F°(y), or its inverse; for operators that are `solved_directly`. Factorisations allocate.
struct direct_solver {
  template <class G, class V>
    requires solved_directly<G, V>
  [[nodiscard]] auto prepare(G const& g, V const& f) const {
    return detail::direct_workspace{factors_for(g, f), like(f, slant::local(f).size()),
                                    slant::workspace(g, f)};
  }

  template <class G, class V, class P>
    requires solved_directly<G, V>
  report_of<V> solve(G const& g, V const& f, request_of<V> const& request, V& dy, P& p) const {
    return detail::direct_direction(g, f, request, dy, p, [&](V& x) {
      if constexpr (has_inverse<G, V>) {
        try {
          p.factors.solve(g, f, x);
        } catch (bad_input const&) {  // an inverse that this very operator has not
          return false;
        }
      } else {
        if (!factor(g, p.factors)) return false;
        p.factors.solve(f, x);
      }
      return true;
    });
  }

  template <class G, class V>
  static consteval void refuse() {
    static_assert(solved_directly<G, V>,
                  "direct_solver: F°(y) must be a matrix, or have columns or an inverse");
  }

 private:
  template <class G, class V>
  [[nodiscard]] static auto factors_for(G const& g, V const& f) {
    using S = scalar_t<V>;
    if constexpr (has_inverse<G, V>) {
      return detail::known_inverse<workspace_t<decltype(g.inverse()), V>>(g, f);
    } else if constexpr (detail::matrix_behind<G>::sparse) {
      return detail::sparse_lu<S>();
    } else {
      return detail::dense_lu<S>(g.rows());
    }
  }
  template <class G, class Factors>
  [[nodiscard]] static bool factor(G const& g, Factors& factors) {
    if constexpr (detail::matrix_behind<G>::sparse) {
      return factors.factor(detail::matrix_behind<G>::of(g));
    } else {
      return factors.factor(g);
    }
  }
};

// --- sparse direct solver ------------------------------------------------------------------------
//
// Sparse Gaussian elimination for F°(y) dy = −F where F°(y) is no matrix but made of sparse ones: a
// natural residual I − G (I − ρA) with a sparse matrix A, say. The columns of the operator are
// taken some dozens at a time, and what is not zero of them becomes a sparse matrix: n² numbers are
// looked at, which up to some ten thousand unknowns is little beside the factorisation.

namespace detail {

/// Collects a sparse matrix from the columns of an operator, and factors it.
template <class S>
class sparse_columns {
  using block_type = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
  static constexpr index width = 32;

 public:
  static constexpr index factorizations = 1;

  explicit sparse_columns(index n) : matrix_(n, n) {}

  template <class G>
  [[nodiscard]] bool factor(G const& g) {
    index const n = matrix_.cols();
    matrix_.setZero();
    for (index first = 0; first < n; first += width) {
      block_type block(n, std::min(width, n - first));
      g.columns(first, block);
      append(first, block);
    }
    matrix_.finalize();
    return factors_.factor(matrix_);
  }
  template <class V>
  void solve(V const& b, V& x) const {
    factors_.solve(b, x);
  }
  /// y = G x, by the matrix.
  template <class V>
  void multiply(V const& x, V& y) const {
    slant::local(y).noalias() = matrix_ * slant::local(x);
  }

 private:
  void append(index first, block_type const& block) {
    for (index j = 0; j < index(block.cols()); ++j) {
      matrix_.startVec(first + j);
      for (index i = 0; i < index(block.rows()); ++i) {
        if (!(block(i, j) == S(0))) matrix_.insertBack(i, first + j) = block(i, j);
      }
    }
  }

  typename sparse_lu<S>::matrix_type matrix_;
  sparse_lu<S> factors_;
};

}  // namespace detail

/// Sparse LU of F°(y); for operators with columns, most of whose entries are zero. Allocates.
struct sparse_direct_solver {
  template <class G, class V>
    requires linear_operator<G, V> && has_columns<G, detail::dense_matrix_t<V>>
  [[nodiscard]] auto prepare(G const& g, V const& f) const {
    return detail::direct_workspace{detail::sparse_columns<scalar_t<V>>(g.rows()),
                                    like(f, slant::local(f).size()), slant::workspace(g, f)};
  }

  template <class G, class V, class P>
    requires linear_operator<G, V> && has_columns<G, detail::dense_matrix_t<V>>
  report_of<V> solve(G const& g, V const& f, request_of<V> const& request, V& dy, P& p) const {
    return detail::direct_direction(g, f, request, dy, p, [&](V& x) {
      if (!p.factors.factor(g)) return false;
      p.factors.solve(f, x);
      return true;
    });
  }

  template <class G, class V>
  static consteval void refuse() {
    static_assert(has_columns<G, detail::dense_matrix_t<V>>,
                  "sparse_direct_solver: F°(y) must have columns");
  }
};

}  // namespace slant
