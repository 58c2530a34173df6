// SPDX-License-Identifier: MIT
//
// Denoising by total variation on the line,
//
//     minimise  ½‖x − y‖² + μ Σ |xᵢ₊₁ − xᵢ|,
//
// as its dual problem: minimise ½‖Dᵀp‖² − (D y)ᵀp over |pᵢ| ≤ μ, D the differences, x = y − Dᵀp.
// pᵢ is ±μ at the jumps of x and free between them, so the matrix of a Newton step is that of
// separate chains tridiag(−1, 2, −1), and elimination solves it. (The jumps of x as unknowns lead to
// A = SᵀS, S the sums, as badly conditioned, and to a number of steps that grows like n.)
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <random>
#include <slant/concepts/laws.hpp>
#include <slant/operators/operators.hpp>
#include <slant/problems/minimise.hpp>
#include <slant/sets/contact_sets.hpp>
#include <utility>

namespace total_variation {

using Eigen::Index;
using vector = Eigen::VectorXd;

/// D: x ↦ (x₂ − x₁, …, xₙ − xₙ₋₁).
struct differences {
  Index n;
  [[nodiscard]] Index rows() const { return n - 1; }
  [[nodiscard]] Index cols() const { return n; }
  void apply(vector const& x, vector& p) const { p = x.tail(n - 1) - x.head(n - 1); }
  void apply_adjoint(vector const& p, vector& x) const {
    x << 0, p;
    x.head(n - 1) -= p;
  }
};

/// (D Dᵀ)⁻¹, and on a face the inverse of what remains of D Dᵀ there.
struct chains_inverse {
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
  struct workspace_type {
    vector ones, free, factor;
  };

  Index n;
  [[nodiscard]] Index rows() const { return n - 1; }
  [[nodiscard]] Index cols() const { return n - 1; }
  [[nodiscard]] workspace_type workspace(vector const& p) const {
    vector const ones = vector::Ones(p.size());
    return {ones, ones, ones};
  }
  void apply(vector const& q, vector& p, workspace_type& w) const {
    eliminate(q, p, w.ones, w.factor);
  }
  void enter(auto const& face, workspace_type& w) const { face.keep(w.ones, w.free); }
  void apply_on_face(vector const& q, vector& p, workspace_type& w) const {
    eliminate(q, p, w.free, w.factor);
  }

 private:
  /// A component that is held is 0 and ends a chain.
  static void eliminate(vector const& q, vector& p, vector const& free, vector& factor) {
    double before = 0, p_before = 0;
    for (Index i = 0; i < q.size(); ++i) {
      before = factor[i] = free[i] / (2 - before);
      p_before = p[i] = (q[i] + p_before) * before;
    }
    for (Index i = q.size() - 1; i-- > 0;) p[i] += factor[i] * p[i + 1];
  }
};

/// The dual problem.
[[nodiscard]] inline auto program(vector const& y, double μ) {
  auto const D = slant::op<"D">(differences{y.size()});
  vector b = D * y, bounds = vector::Constant(y.size() - 1, μ);
  return slant::minimise(slant::quadratic(full_row_rank(D) * adjoint(D), std::move(b)))
      .over(slant::intervals(std::move(bounds)));
}

/// x = y − Dᵀp.
[[nodiscard]] inline vector denoised(vector const& y, vector const& p) {
  vector noise(y.size());
  differences{y.size()}.apply_adjoint(p, noise);
  return y - noise;
}

/// Five levels.
[[nodiscard]] inline vector steps_signal(Index n) {
  return vector::NullaryExpr(n, [n](Index i) {
    double const t = double(i) / double(n);
    return t < 0.2 ? 0.0 : t < 0.5 ? 2.0 : t < 0.65 ? -1.0 : t < 0.9 ? 1.0 : 0.0;
  });
}

/// The signal with uniform noise between ±size, the same everywhere.
[[nodiscard]] inline vector with_noise(vector const& signal, double size) {
  std::mt19937 bits(7);
  return signal + vector::NullaryExpr(signal.size(),
                                      [&] { return size * (double(bits()) / 2147483647.5 - 1); });
}

}  // namespace total_variation
