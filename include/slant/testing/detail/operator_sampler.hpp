// SPDX-License-Identifier: MIT
//
// What the checks of operator laws share: random vectors, the tolerance, the list of broken laws.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/testing/breach.hpp>
#include <slant/testing/detail/operator_probe.hpp>

#include <algorithm>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace slant::testing::detail {

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

}  // namespace slant::testing::detail
