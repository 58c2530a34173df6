// SPDX-License-Identifier: MIT
//
// What the checks of operator laws share: random vectors, the tolerance, the list of broken laws.
#pragma once

#include <slant/base/entries.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/capabilities.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/testing/breach.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <any>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace slant::testing {

// --- operator probe ------------------------------------------------------------------------------
//
// An operator as the law checks see it: its type forgotten, what it cannot do left empty. So the
// checks are compiled once for each vector type, not once for each operator.

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
  using map = ability<void(V const&, V&)>;
  using scaled_map = ability<void(scalar, V const&, V&)>;
  using map_of_many = ability<void(matrix const&, matrix&)>;

  index rows = 0;
  index cols = 0;
  law_set laws;
  operator_law_options options;

  map apply;  ///< with a new workspace each time
  ability<std::any(V const&)> workspace;
  ability<void(V const&, V&, std::any&)> apply_with;  ///< a workspace
  map apply_adjoint;
  scaled_map apply_add;
  scaled_map apply_adjoint_add;
  ability<void(V&)> diagonal;
  ability<void(index, matrix&)> columns;
  map_of_many apply_to_many;
  map_of_many apply_to_many_by_rows;  ///< on row-major copies
  map inverse;
};

/// `a` must outlive the probe.
template <class V, class A>
[[nodiscard]] operator_probe<V> probe_operator(A const& a, operator_law_options const& options) {
  using S = scalar_t<V>;
  using probe_type = operator_probe<V>;
  using matrix = typename probe_type::matrix;
  using workspace_type = decltype(slant::workspace(a, std::declval<V const&>()));
  probe_type probe;
  probe.rows = a.rows();
  probe.cols = a.cols();
  probe.laws = laws_of<A>;
  probe.options = options;
  probe.apply = {a, [](A const& op, V const& x, V& y) { slant::apply(op, x, y); }};
  probe.workspace = {
      a, [](A const& op, V const& like) { return std::any(slant::workspace(op, like)); }};
  probe.apply_with = {a, [](A const& op, V const& x, V& y, std::any& w) {
                        slant::apply(op, x, y, *std::any_cast<workspace_type>(&w));
                      }};
  if constexpr (has_adjoint<A, V>) {
    probe.apply_adjoint = {a,
                           [](A const& op, V const& x, V& y) { slant::apply_adjoint(op, x, y); }};
  }
  if constexpr (has_accumulate<A, V>) {
    probe.apply_add = {a, [](A const& op, S α, V const& x, V& y) {
                         auto w = slant::workspace(op, x);
                         slant::apply_add(op, α, x, y, w);
                       }};
  }
  if constexpr (has_adjoint_accumulate<A, V>) {
    probe.apply_adjoint_add = {a, [](A const& op, S α, V const& x, V& y) {
                                 auto w = slant::adjoint_workspace(op, x);
                                 slant::apply_adjoint_add(op, α, x, y, w);
                               }};
  }
  if constexpr (has_diagonal<A, V>) {
    if (a.rows() == a.cols()) probe.diagonal = {a, [](A const& op, V& d) { op.diagonal(d); }};
  }
  if constexpr (has_columns<A, matrix>) {
    probe.columns = {a, [](A const& op, index first, matrix& y) { op.columns(first, y); }};
  }
  if constexpr (applies_to_many<A, matrix>) {
    probe.apply_to_many = {a,
                           [](A const& op, matrix const& x, matrix& y) { slant::apply(op, x, y); }};
  }
  using matrix_by_rows = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  if constexpr (applies_to_many<A, matrix_by_rows>) {
    probe.apply_to_many_by_rows = {a, [](A const& op, matrix const& x, matrix& y) {
                                     matrix_by_rows const from = x;
                                     matrix_by_rows to = y;
                                     slant::apply(op, from, to);
                                     y = to;
                                   }};
  }
  if constexpr (has_inverse<A, V>) {
    probe.inverse = {a, [](A const& op, V const& x, V& y) {
                       auto const inverse = op.inverse();
                       for (int k = 0; k < 2; ++k) slant::apply(inverse, x, y);
                     }};
  }
  return probe;
}

// --- operator sampler ----------------------------------------------------------------------------

/// Draws vectors of the kind of a prototype, applies the operator, and judges differences.
template <class V>
class operator_sampler {
 public:
  using scalar = scalar_t<V>;

  operator_sampler(operator_probe<V> const& a, V const& prototype)
      : a_(a), prototype_(prototype), generator_(a.options.seed) {
    double const roundings =
        a.options.roundings > 0 ? a.options.roundings : 64 + 8 * double(a.rows + a.cols);
    tolerance_ = scalar(roundings) * std::numeric_limits<scalar>::epsilon();
  }

  /// A vector with n entries from a normal distribution.
  [[nodiscard]] V random(index n) {
    V x = slant::like(prototype_, n);
    auto&& entries = slant::local(x);
    for (index i = 0; i < n; ++i) entries[i] = scalar(normal_(generator_));
    return x;
  }
  [[nodiscard]] V constant(index n, scalar const& value) const {
    V x = slant::like(prototype_, n);
    slant::local(x).setConstant(value);
    return x;
  }
  /// A vector with n entries that are NaN: what an operator must overwrite.
  [[nodiscard]] V garbage(index n) const {
    return constant(n, std::numeric_limits<scalar>::quiet_NaN());
  }
  [[nodiscard]] V unit(index n, index i) const {
    V x = constant(n, scalar(0));
    slant::local(x)[i] = scalar(1);
    return x;
  }
  /// Up to `count` different numbers below n, the first and the last among them.
  [[nodiscard]] std::vector<index> places(index n, index count) {
    std::vector<index> all(static_cast<std::size_t>(n));
    for (index i = 0; i < n; ++i) all[static_cast<std::size_t>(i)] = i;
    if (n > count) {
      std::shuffle(all.begin() + 1, all.end() - 1, generator_);
      std::swap(all[1], all.back());
      all.resize(static_cast<std::size_t>(count));
    }
    return all;
  }

  /// A x, from a result vector full of NaN.
  [[nodiscard]] V image(V const& x) const {
    V y = garbage(a_.rows);
    a_.apply(x, y);
    return y;
  }
  [[nodiscard]] V adjoint_image(V const& x) const {
    V y = garbage(a_.cols);
    a_.apply_adjoint(x, y);
    return y;
  }

  /// Rounding allowed in a number of this size.
  [[nodiscard]] scalar allowed(scalar const& size) const { return tolerance_ * size; }

  /// `law` is broken: `measured` was found where rounding would be at most `bound`.
  void report(std::string const& law, scalar const& measured, scalar const& bound) {
    report(law, std::string("off by ")
                    .append(slant::detail::show(measured))
                    .append(", rounding would be at most ")
                    .append(slant::detail::show(bound)));
  }
  void report(std::string const& law, std::string evidence) { log_(law, std::move(evidence)); }

  /// Reports a breach unless |difference| ≤ allowed(size); NaN is a breach.
  void expect_small(std::string const& law, scalar const& difference, scalar const& size) {
    scalar const bound = allowed(size);
    if (!(difference <= bound && -difference <= bound)) report(law, difference, bound);
  }
  /// Reports a breach unless ‖x − y‖ ≤ allowed(size).
  void expect_close(std::string const& law, V const& x, V const& y, scalar const& size) {
    if (slant::local(x).size() != slant::local(y).size()) {
      report(law, "the result has a wrong size");
      return;
    }
    V difference = x;
    slant::local(difference) -= slant::local(y);
    expect_small(law, slant::norm(difference), size);
  }

  [[nodiscard]] std::vector<breach> const& found() const noexcept { return log_.found(); }
  [[nodiscard]] bool has_found(std::string const& law) const { return log_.has(law); }

 private:
  operator_probe<V> const& a_;
  V const& prototype_;
  std::mt19937 generator_;
  std::normal_distribution<double> normal_;
  scalar tolerance_;
  breach_log log_;
};

// --- extreme directions --------------------------------------------------------------------------
//
// Directions in which a quadratic form ⟨Ax, x⟩ is smallest and largest, by Lanczos with full
// reorthogonalisation. Random vectors alone miss a single negative eigenvalue among many positive
// ones; these do not.

/// Unit vectors near the two ends of the spectrum of a symmetric map x ↦ image(x). With as many
/// steps as unknowns they are eigenvectors up to rounding.
template <class V, class Image>
[[nodiscard]] std::vector<V> extreme_directions(Image image, V const& start, index steps) {
  using S = scalar_t<V>;
  steps = std::min<index>(steps, slant::local(start).size());
  S const length = slant::norm(start);
  if (!(length > S(0))) return {};
  std::vector<V> basis;
  std::vector<V> images;
  V next = start;
  slant::local(next) /= length;
  S size(0);
  while (static_cast<index>(basis.size()) < steps) {
    basis.push_back(next);
    images.push_back(image(next));
    next = images.back();
    size = std::max<S>(size, slant::norm(next));
    for (int pass = 0; pass < 2; ++pass) {
      for (V const& b : basis) {
        S const part = slant::inner_product(b, next);
        slant::local(next) -= part * slant::local(b);
      }
    }
    S const rest = slant::norm(next);
    // An invariant subspace: what follows would be rounding errors. (NaN stops, too.)
    if (!(rest > S(16) * std::numeric_limits<S>::epsilon() * size)) break;
    slant::local(next) /= rest;
  }

  auto const n = static_cast<index>(basis.size());
  auto const at = [](auto& list, index i) -> auto& { return list[static_cast<std::size_t>(i)]; };
  Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> projected(n, n);
  for (index i = 0; i < n; ++i) {
    for (index j = 0; j <= i; ++j) {
      S const entry = slant::inner_product(at(basis, j), at(images, i));
      if (!(entry - entry == S(0))) return {};
      projected.coeffRef(i, j) = projected.coeffRef(j, i) = entry;
    }
  }
  slant::detail::symmetric_eigen<S, Eigen::Dynamic> const eigen(std::move(projected));
  index least = 0;
  index most = 0;
  for (index i = 1; i < n; ++i) {
    if (eigen.values[i] < eigen.values[least]) least = i;
    if (eigen.values[i] > eigen.values[most]) most = i;
  }
  std::vector<V> directions;
  for (index const which : {least, most}) {
    V x = start;
    slant::local(x).setZero();
    for (index j = 0; j < n; ++j) {
      S const weight = eigen.vectors.coeff(j, which);
      slant::local(x) += weight * slant::local(at(basis, j));
    }
    directions.push_back(x);
  }
  return directions;
}

}  // namespace detail

}  // namespace slant::testing
