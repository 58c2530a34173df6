// SPDX-License-Identifier: MIT
//
// Displacements under loads that are combinations of loads solved before: K⁻¹(α f₁ + β f₂) is
// α K⁻¹f₁ + β K⁻¹f₂. Load steps on a line, such as a constant load and one that grows, need two
// solves however many they are.
#pragma once

#include <slant/concepts/vector.hpp>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace slant::contact::detail {

/// The last two loads that a solve was spent on, with their displacements.
template <class V>
class known_loads {
 public:
  using scalar = scalar_t<V>;

  [[nodiscard]] bool empty() const { return pairs_.empty(); }

  /// A load that was solved for, in place of the older one of the two.
  void add(V f, V u) {
    if (pairs_.size() == 2) pairs_.erase(pairs_.begin());
    pairs_.emplace_back(std::move(f), std::move(u));
  }

  /// u = K⁻¹f if f is such a combination up to rounding in each component; else false. Coefficients
  /// beyond 64, which would multiply the errors of the displacements, are none.
  [[nodiscard]] bool combine(V const& f, V& u) const {
    scalar α(0), β(0);
    V rest = f;
    if (!pairs_.empty()) {
      V const& f1 = pairs_.front().first;
      V const& f2 = pairs_.back().first;
      scalar const length = f1.squaredNorm();
      scalar const shared = length > scalar(0) ? scalar(f1.dot(f2) / length) : scalar(0);
      V const across = f2 - shared * f1;  // 0 if there is only one
      scalar const width = across.squaredNorm();
      scalar const least = std::numeric_limits<scalar>::epsilon() * f2.squaredNorm();
      for (int pass = 0; pass < 2; ++pass) {  // the second one mends rounding errors of the first
        scalar const δ = width > least ? scalar(across.dot(rest) / width) : scalar(0);
        scalar const γ =
            length > scalar(0) ? scalar(f1.dot(rest) / length - δ * shared) : scalar(0);
        α += γ;
        β += δ;
        rest = f - α * f1 - β * f2;
      }
    }
    using std::abs;
    if (!(abs(α) + abs(β) <= scalar(64))) return false;  // also if it is a NaN
    // Component by component: beside a large one, such as that of a penalty, others matter too.
    scalar const rounding = scalar(8) * std::numeric_limits<scalar>::epsilon();
    for (Eigen::Index i = 0; i < f.size(); ++i) {
      scalar size = abs(f[i]);
      if (!pairs_.empty()) {
        size += abs(α * pairs_.front().first[i]) + abs(β * pairs_.back().first[i]);
      }
      if (!(abs(rest[i]) <= rounding * size)) return false;
    }
    u.setZero();
    if (!pairs_.empty()) u = α * pairs_.front().second + β * pairs_.back().second;
    return true;
  }

 private:
  std::vector<std::pair<V, V>> pairs_;
};

}  // namespace slant::contact::detail
