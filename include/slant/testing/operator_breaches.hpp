// SPDX-License-Identifier: MIT
//
// The laws of linear operators, sampled; needs no test framework (operator_laws.hpp does).
//
//     A(αx + βy) = αAx + βAy,   A x into a y full of NaN,   A x with a used or copied workspace, or
//     beside another thread,   the laws that the type declares,   and of each capability it has:
//     adjoint, accumulation, diagonal, columns, several right-hand sides, inverse.
//
// Sampling proves nothing, but it looks in the right places: laws about ⟨Ax, x⟩ are also tried in
// the directions at the two ends of the spectrum. All tolerances are multiples of ε ‖A‖ ‖x‖, with
// ‖A‖ estimated from samples, so units do not matter. Operators that solve with an ill-conditioned
// matrix may need options.roundings of the order of the condition.
#pragma once

#include <slant/testing/detail/capability_laws.hpp>
#include <slant/testing/detail/concurrency.hpp>
#include <slant/testing/detail/declared_laws.hpp>
#include <slant/testing/detail/operator_sampler.hpp>

#include <algorithm>
#include <limits>
#include <vector>

namespace slant::testing {

namespace detail {

/// Sizes and overwriting. Returns an estimate of ‖A‖, NaN if what follows would make no sense.
template <class V>
[[nodiscard]] scalar_t<V> check_overwriting(operator_sampler<V>& sampler,
                                            operator_probe<V> const& a) {
  using S = scalar_t<V>;
  S const nan = std::numeric_limits<S>::quiet_NaN();
  S size(0);
  for (int k = 0; k < std::max(a.options.samples, 1); ++k) {
    V const x = sampler.random(a.cols);
    V y = sampler.constant(a.rows, S(0));
    a.apply(x, y);
    if (slant::local(y).size() != a.rows) {
      sampler.report("apply", "the result does not have rows() entries");
      return nan;
    }
    if (!slant::local(y).allFinite()) {
      sampler.report("apply", "the result of a finite vector is NaN or infinite");
      return nan;
    }
    if (!slant::local(sampler.image(x)).allFinite()) {
      sampler.report("overwriting", "a y full of NaN on entry leaves NaN in A x");
      return nan;
    }
    V from_ones = sampler.constant(a.rows, S(1));
    a.apply(x, from_ones);
    S const image_size = slant::norm(y);
    sampler.expect_close("overwriting, A x does not depend on y", from_ones, y, image_size);
    S const length = slant::norm(x);
    if (length > S(0)) size = std::max<S>(size, image_size / length);
  }
  return size;
}

template <class V>
void check_linearity(operator_sampler<V>& sampler, operator_probe<V> const& a,
                     scalar_t<V> const& size) {
  using S = scalar_t<V>;
  S const α(3);
  S const β = S(-7) / S(4);
  for (int k = 0; k < a.options.samples; ++k) {
    V const x = sampler.random(a.cols);
    V const y = sampler.random(a.cols);
    V z = x;
    slant::local(z) = α * slant::local(x) + β * slant::local(y);
    V sum = sampler.image(x);
    V const ay = sampler.image(y);
    slant::local(sum) = α * slant::local(sum) + β * slant::local(ay);
    sampler.expect_close("linearity, A(cx + dy) = cAx + dAy", sampler.image(z), sum,
                         S(size * (S(3) * slant::norm(x) + S(2) * slant::norm(y))));
  }
}

/// The result depends on x alone, not on earlier uses of the workspace.
template <class V>
void check_repeatability(operator_sampler<V>& sampler, operator_probe<V> const& a,
                         scalar_t<V> const& size) {
  using S = scalar_t<V>;
  V const x = sampler.random(a.cols);
  V const other = sampler.random(a.cols);
  V const expected = sampler.image(x);
  S const length = slant::norm(x);
  auto const apply = a.with_one_workspace(x);
  V y = sampler.garbage(a.rows);
  apply(other, y);
  apply(x, y);
  sampler.expect_close("repeatability, with a used workspace", y, expected, S(size * length));
  auto const apply_copied = apply;
  apply(other, y);
  apply_copied(x, y);
  sampler.expect_close("repeatability, with a copied workspace", y, expected, S(size * length));
  apply(x, y);
  sampler.expect_close("repeatability, with a workspace whose copy was used", y, expected,
                       S(size * length));
}

template <class V>
[[nodiscard]] std::vector<breach> operator_breaches_of(operator_probe<V> const& a,
                                                       V const& prototype) {
  operator_sampler<V> sampler(a, prototype);
  if (a.rows < 0 || a.cols < 0) {
    sampler.report("sizes", "rows() or cols() is negative");
    return sampler.found();
  }
  if (a.laws != law_set{} && a.rows != a.cols) {
    sampler.report("laws", "declared by an operator that is not square");
    return sampler.found();
  }
  auto const size = check_overwriting(sampler, a);
  if (size != size) return sampler.found();  // NaN: reported already
  check_linearity(sampler, a, size);
  check_repeatability(sampler, a, size);
  check_concurrency(sampler, a, size);
  check_declared_laws(sampler, a, size);
  check_adjoint(sampler, a, size);
  check_accumulation(sampler, a, size);
  check_diagonal(sampler, a, size);
  check_columns(sampler, a, size);
  check_inverse(sampler, a, size);
  return sampler.found();
}

}  // namespace detail

/// The laws that `a` was found to break, each once, with the numbers that show it. `prototype` is
/// any vector of the kind the operator works on; its size and contents do not matter.
template <class A, slant::vector V = Eigen::VectorXd>
  requires linear_operator<A, V>
[[nodiscard]] std::vector<breach> operator_breaches(A const& a, V const& prototype = V(),
                                                    operator_law_options const& options = {}) {
  return detail::operator_breaches_of(detail::probe_operator<V>(a, options), prototype);
}

}  // namespace slant::testing
