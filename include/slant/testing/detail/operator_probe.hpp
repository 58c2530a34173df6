// SPDX-License-Identifier: MIT
//
// An operator as the law checks see it: its type forgotten, what it cannot do left empty. So the
// checks are compiled once for each vector type, not once for each operator.
#pragma once

#include <slant/concepts/capabilities.hpp>

#include <Eigen/Core>

#include <functional>
#include <memory>

namespace slant::testing {

/// How hard to look, and how much rounding to allow.
struct operator_law_options {
  int samples = 8;         ///< random vectors per law
  int lanczos_steps = 60;  ///< of the search for directions that break a law about ⟨Ax, x⟩
  double roundings = 0;  ///< rounding errors allowed, in units of ε ‖A‖ ‖x‖; 0: 64 + 8 (m + n)
  unsigned seed = 20230817;
};

namespace detail {

template <class V>
struct operator_probe {
  using scalar = scalar_t<V>;
  using matrix = Eigen::Matrix<scalar, Eigen::Dynamic, Eigen::Dynamic>;
  using map = std::function<void(V const&, V&)>;
  using scaled_map = std::function<void(scalar, V const&, V&)>;

  index rows = 0;
  index cols = 0;
  law_set laws;
  operator_law_options options;

  map apply;  ///< with a new workspace each time
  /// apply with one workspace for many calls; a copy of this map has a copy of the workspace
  std::function<map(V const&)> with_one_workspace;
  map apply_adjoint;
  scaled_map apply_add;
  scaled_map apply_adjoint_add;
  std::function<void(V&)> diagonal;
  std::function<void(index, matrix&)> columns;
  std::function<void(matrix const&, matrix&)> apply_to_many;
  std::function<void(matrix const&, matrix&)> apply_to_many_by_rows;  ///< on row-major copies
  map inverse;
};

/// `a` must outlive the probe.
template <class V, class A>
[[nodiscard]] operator_probe<V> probe_operator(A const& a, operator_law_options const& options) {
  using S = scalar_t<V>;
  using matrix = typename operator_probe<V>::matrix;
  operator_probe<V> probe;
  probe.rows = a.rows();
  probe.cols = a.cols();
  probe.laws = laws_of<A>;
  probe.options = options;
  probe.apply = [&a](V const& x, V& y) { slant::apply(a, x, y); };
  probe.with_one_workspace = [&a](V const& like) -> typename operator_probe<V>::map {
    return
        [&a, w = slant::workspace(a, like)](V const& x, V& y) mutable { slant::apply(a, x, y, w); };
  };
  if constexpr (has_adjoint<A, V>) {
    probe.apply_adjoint = [&a](V const& x, V& y) { slant::apply_adjoint(a, x, y); };
  }
  if constexpr (has_accumulate<A, V>) {
    probe.apply_add = [&a](S α, V const& x, V& y) {
      auto w = slant::workspace(a, x);
      slant::apply_add(a, α, x, y, w);
    };
  }
  if constexpr (has_adjoint_accumulate<A, V>) {
    probe.apply_adjoint_add = [&a](S α, V const& x, V& y) {
      auto w = slant::adjoint_workspace(a, x);
      slant::apply_adjoint_add(a, α, x, y, w);
    };
  }
  if constexpr (has_diagonal<A, V>) {
    if (a.rows() == a.cols()) probe.diagonal = [&a](V& d) { a.diagonal(d); };
  }
  if constexpr (has_columns<A, matrix>) {
    probe.columns = [&a](index first, matrix& y) { a.columns(first, y); };
  }
  if constexpr (applies_to_many<A, matrix>) {
    probe.apply_to_many = [&a](matrix const& x, matrix& y) { slant::apply(a, x, y); };
  }
  using matrix_by_rows = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  if constexpr (applies_to_many<A, matrix_by_rows>) {
    probe.apply_to_many_by_rows = [&a](matrix const& x, matrix& y) {
      matrix_by_rows const from = x;
      matrix_by_rows to = y;
      slant::apply(a, from, to);
      y = to;
    };
  }
  if constexpr (has_inverse<A, V>) {
    using inverse_type = std::remove_cvref_t<decltype(a.inverse())>;
    auto inverse = std::make_shared<inverse_type>(a.inverse());
    probe.inverse = [inverse](V const& x, V& y) { slant::apply(*inverse, x, y); };
  }
  return probe;
}

}  // namespace detail

}  // namespace slant::testing
