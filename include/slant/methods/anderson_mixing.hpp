// SPDX-License-Identifier: MIT
//
// Anderson's acceleration of a fixed point iteration p ← Ψ(p) [Anderson 1965; Walker, Ni 2011,
// "type II"]. With f_k = Ψ(p_k) − p_k and the last few differences Δp_j, Δf_j
//
//     γ = argmin ‖f_k − Σ γ_j Δf_j‖,      p_{k+1} = p_k + ω f_k − Σ γ_j (Δp_j + ω Δf_j),
//
// a secant method in as many directions as there are differences: GMRES, if Ψ is affine. It costs
// no evaluation of Ψ.
//
// Values of Ψ that are known to a few digits only make differences of old, small steps noise. So
// the least squares are solved from the newest difference to the oldest, and one that is nearly a
// combination of newer ones is left out.
#pragma once

#include <slant/base/vector_algebra.hpp>
#include <slant/concepts/vector.hpp>

#include <cstddef>
#include <utility>
#include <vector>

namespace slant {

/// The last differences of a fixed point iteration, at most as many as there is room for.
template <class V>
class anderson_mixing {
 public:
  using scalar = scalar_t<V>;

  anderson_mixing() = default;
  /// Room for `window` >= 0 differences of vectors with n entries. Allocates; nothing later does.
  anderson_mixing(V const& prototype, index n, index window)
      : last_p_(like(prototype, n)), last_f_(like(prototype, n)) {
    for (index i = 0; i < window; ++i) {
      differences_.push_back(
          {like(prototype, n), like(prototype, n), like(prototype, n), like(prototype, n)});
    }
  }

  /// Number of differences in use.
  [[nodiscard]] index size() const { return static_cast<index>(count_); }

  /// Forgets everything: the next step is a plain one.
  void forget() {
    count_ = 0;
    begun_ = false;
  }

  /// next ← p_{k+1} from p_k and f_k = Ψ(p_k) − p_k, which are remembered. Whether a difference was
  /// used. `next` must not alias the others.
  bool mix(V const& p, V const& f, scalar const& ω, V& next) {
    if (begun_) record(p, f);
    vectors::copy(p, last_p_);
    vectors::copy(f, last_f_);
    begun_ = true;
    // Gram and Schmidt, the newest difference first; `rest` is what γ leaves of f.
    vectors::copy(p, next);
    bool used = false;
    auto& rest = last_f_;  // restored below
    for (std::size_t j = 0; j < count_; ++j) {
      auto& d = newest(j);
      vectors::copy(d.step, d.p);
      vectors::copy(d.change, d.f);
      scalar const whole = norm(d.f);
      for (std::size_t i = 0; i < j; ++i) {
        auto const& e = newest(i);
        if (!e.used) continue;
        scalar const c = inner_product(e.f, d.f);
        vectors::axpy(-c, e.f, d.f);
        vectors::axpy(-c, e.p, d.p);
      }
      scalar const length = norm(d.f);
      d.used = length > scalar(independent_) * whole && detail::is_finite(length);
      if (!d.used) continue;
      vectors::divide(length, d.f);
      vectors::divide(length, d.p);
      scalar const γ = inner_product(d.f, rest);
      vectors::axpy(-γ, d.f, rest);
      vectors::axpy(-γ, d.p, next);
      used = true;
    }
    vectors::axpy(ω, rest, next);
    vectors::copy(f, last_f_);
    return used;
  }

 private:
  static constexpr double independent_ = 0.05;  // of a difference has to be new

  struct difference {
    V step, change;  // Δp, Δf
    V p, f;          // the same, f orthonormal to newer ones
    bool used = false;
  };
  /// The j-th newest.
  difference& newest(std::size_t j) {
    return differences_[(head_ + differences_.size() - 1 - j) % differences_.size()];
  }
  void record(V const& p, V const& f) {
    if (differences_.empty()) return;
    auto& d = differences_[head_];
    vectors::difference(p, last_p_, d.step);
    vectors::difference(f, last_f_, d.change);
    head_ = (head_ + 1) % differences_.size();
    if (count_ < differences_.size()) ++count_;
  }

  V last_p_{}, last_f_{};
  std::vector<difference> differences_{};
  std::size_t head_ = 0;
  std::size_t count_ = 0;
  bool begun_ = false;
};

}  // namespace slant
