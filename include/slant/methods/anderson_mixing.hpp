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
    slant::local(last_p_) = slant::local(p);
    slant::local(last_f_) = slant::local(f);
    begun_ = true;
    // Gram and Schmidt, the newest difference first; `rest` is what γ leaves of f.
    slant::local(next) = slant::local(p);
    bool used = false;
    auto& rest = last_f_;  // restored below
    for (std::size_t j = 0; j < count_; ++j) {
      auto& d = newest(j);
      slant::local(d.p) = slant::local(d.step);
      slant::local(d.f) = slant::local(d.change);
      scalar const whole = norm(d.f);
      for (std::size_t i = 0; i < j; ++i) {
        auto const& e = newest(i);
        if (!e.used) continue;
        scalar const c = inner_product(e.f, d.f);
        slant::local(d.f) -= c * slant::local(e.f);
        slant::local(d.p) -= c * slant::local(e.p);
      }
      scalar const length = norm(d.f);
      d.used = length > scalar(independent_) * whole && detail::is_finite(length);
      if (!d.used) continue;
      slant::local(d.f) /= length;
      slant::local(d.p) /= length;
      scalar const γ = inner_product(d.f, rest);
      slant::local(rest) -= γ * slant::local(d.f);
      slant::local(next) -= γ * slant::local(d.p);
      used = true;
    }
    slant::local(next) += ω * slant::local(rest);
    slant::local(last_f_) = slant::local(f);
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
    slant::local(d.step) = slant::local(p) - slant::local(last_p_);
    slant::local(d.change) = slant::local(f) - slant::local(last_f_);
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
