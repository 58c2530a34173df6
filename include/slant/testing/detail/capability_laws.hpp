// SPDX-License-Identifier: MIT
//
// Checks that the capabilities which an operator has agree with its apply.
#pragma once

#include <slant/testing/detail/operator_sampler.hpp>

#include <algorithm>
#include <limits>
#include <string>

namespace slant::testing::detail {

/// ⟨Ax, y⟩ = ⟨x, Aᵀy⟩; the adjoint overwrites.
template <class V>
void check_adjoint(operator_sampler<V>& sampler, operator_probe<V> const& a,
                   scalar_t<V> const& size) {
  using S = scalar_t<V>;
  if (!a.apply_adjoint) return;
  for (int k = 0; k < a.options.samples; ++k) {
    V const x = sampler.random(a.cols);
    V const y = sampler.random(a.rows);
    S const difference = S(slant::inner_product(sampler.image(x), y)) -
                         S(slant::inner_product(x, sampler.adjoint_image(y)));
    sampler.expect_small("adjoint, <Ax, y> = <x, A'y>", difference,
                         S(size * slant::norm(x) * slant::norm(y)));
  }
}

/// apply_add(α, x, y) = y + α A x and apply_adjoint_add(α, x, y) = y + α Aᵀx.
template <class V>
void check_accumulation(operator_sampler<V>& sampler, operator_probe<V> const& a,
                        scalar_t<V> const& size) {
  using S = scalar_t<V>;
  for (S const& α : {S(1), S(S(-3) / S(4)), S(0)}) {
    auto const check = [&](char const* law, auto const& add, V const& x, V const& start,
                           V const& image) {
      V result = start;
      add(α, x, result);
      V sum = start;
      slant::local(sum) += α * slant::local(image);
      sampler.expect_close(law, result, sum, S(size * slant::norm(x) + slant::norm(start)));
    };
    V const x = sampler.random(a.cols);
    V const y = sampler.random(a.rows);
    if (a.apply_add) {
      check("apply_add(c, x, y) = y + c A x", a.apply_add, x, y, sampler.image(x));
    }
    if (a.apply_adjoint_add) {
      check("apply_adjoint_add(c, x, y) = y + c A'x", a.apply_adjoint_add, y, x,
            sampler.adjoint_image(y));
    }
  }
}

/// diagonal_i = ⟨A e_i, e_i⟩.
template <class V>
void check_diagonal(operator_sampler<V>& sampler, operator_probe<V> const& a,
                    scalar_t<V> const& size) {
  if (!a.diagonal) return;
  V d = sampler.garbage(a.rows);
  a.diagonal(d);
  if (slant::local(d).size() != a.rows) {
    sampler.report("diagonal", "the result has a wrong size");
    return;
  }
  for (index const i : sampler.places(a.rows, 64)) {
    V const ae = sampler.image(sampler.unit(a.cols, i));
    sampler.expect_small("diagonal_i = <A e_i, e_i>",
                         scalar_t<V>(slant::local(ae)[i] - slant::local(d)[i]), size);
  }
}

/// The columns of `result` are A applied to the columns of `x`.
template <class V>
void expect_images(operator_sampler<V>& sampler, char const* law, operator_probe<V> const& a,
                   typename operator_probe<V>::matrix const& x,
                   typename operator_probe<V>::matrix const& result, scalar_t<V> const& size) {
  if (result.rows() != a.rows || result.cols() != x.cols()) {
    sampler.report(law, "the result has a wrong size");
    return;
  }
  for (index j = 0; j < x.cols(); ++j) {
    V one = sampler.garbage(a.cols);
    slant::local(one) = x.col(j);
    V column = sampler.garbage(a.rows);
    slant::local(column) = result.col(j);
    sampler.expect_close(law, column, sampler.image(one), scalar_t<V>(size * slant::norm(one)));
  }
}

/// columns(first, Y)_k = A e_{first + k}, and A [x₁ … x_k] = [A x₁ … A x_k] in either storage
/// order.
template <class V>
void check_columns(operator_sampler<V>& sampler, operator_probe<V> const& a,
                   scalar_t<V> const& size) {
  using S = scalar_t<V>;
  using matrix = typename operator_probe<V>::matrix;
  S const nan = std::numeric_limits<S>::quiet_NaN();
  if (a.columns) {
    index const k = std::min<index>(3, a.cols);
    for (index const first : {index(0), a.cols - k}) {
      matrix y = matrix::Constant(a.rows, k, nan);
      a.columns(first, y);
      matrix const units = matrix::Identity(a.cols, a.cols).middleCols(first, k);
      expect_images(sampler, "columns(j)_k = A e_{j+k}", a, units, y, size);
    }
  }
  auto const check_many = [&](char const* law, auto const& apply_to_many) {
    if (!apply_to_many) return;
    matrix x(a.cols, 3);
    for (index j = 0; j < x.cols(); ++j) x.col(j) = slant::local(sampler.random(a.cols));
    matrix y = matrix::Constant(a.rows, x.cols(), nan);
    apply_to_many(x, y);
    expect_images(sampler, law, a, x, y, size);
  };
  check_many("A [x1 x2 x3] = [A x1, A x2, A x3]", a.apply_to_many);
  check_many("stored by rows, A [x1 x2 x3] = [A x1, A x2, A x3]", a.apply_to_many_by_rows);
}

/// inverse()(A x) = x, up to the condition of A.
template <class V>
void check_inverse(operator_sampler<V>& sampler, operator_probe<V> const& a,
                   scalar_t<V> const& size) {
  using S = scalar_t<V>;
  if (!a.inverse) return;
  for (int k = 0; k < a.options.samples; ++k) {
    V const x = sampler.random(a.cols);
    V const ax = sampler.image(x);
    V back = sampler.garbage(a.cols);
    a.inverse(ax, back);
    // ‖A⁻¹‖ is at least this; the product with ‖A‖ estimates the condition.
    S const image_size = slant::norm(ax);
    S const inverse_size = image_size > S(0) ? S(slant::norm(x) / image_size) : S(0);
    sampler.expect_close("inverse()(A x) = x", back, x,
                         S((S(1) + size * inverse_size) * slant::norm(x)));
  }
}

}  // namespace slant::testing::detail
