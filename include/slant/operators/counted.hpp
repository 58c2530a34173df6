// SPDX-License-Identifier: MIT
//
// Counts how often an operator is applied; everything else is unchanged, laws and capabilities
// included. What "n applications of K⁻¹" means in every report is counted here.
#pragma once

#include <slant/operators/declare.hpp>
#include <slant/operators/matrix.hpp>

#include <atomic>
#include <memory>
#include <utility>

namespace slant {

/// Work done through a counted operator. A call with k right-hand sides counts as k applications.
struct application_counts {
  index applications = 0;          ///< right-hand sides of apply and apply_add
  index adjoint_applications = 0;  ///< right-hand sides of apply_adjoint and apply_adjoint_add
  index columns = 0;               ///< columns delivered by columns(first, Y)
};

namespace detail {

class application_counter {
 public:
  struct nothing {};

  nothing enter(application_kind kind, index columns) const noexcept {
    auto& n = *counts_;
    (kind == application_kind::forward   ? n.applications
     : kind == application_kind::adjoint ? n.adjoint_applications
                                         : n.columns) += columns;
    return {};
  }

  [[nodiscard]] application_counts read() const noexcept {
    auto const& n = *counts_;
    return {n.applications, n.adjoint_applications, n.columns};
  }
  void reset() const noexcept {
    auto& n = *counts_;
    n.applications = n.adjoint_applications = n.columns = 0;
  }

 private:
  struct counts {
    std::atomic<index> applications{0}, adjoint_applications{0}, columns{0};
  };
  std::shared_ptr<counts> counts_ = std::make_shared<counts>();
};

}  // namespace detail

/// The operator A, counting. Safe to apply from several threads. Copies count together, so a count
/// can be read from the original after a method has taken a copy.
template <class A>
class counted_operator : public detail::decorator<A, detail::application_counter> {
 public:
  using detail::decorator<A, detail::application_counter>::decorator;

  [[nodiscard]] application_counts counts() const noexcept { return this->probe().read(); }
  /// counts().applications, what is asked for most.
  [[nodiscard]] index applications() const noexcept { return counts().applications; }
  void reset_counts() const noexcept { this->probe().reset(); }
};

/// A with its applications counted.
template <operand A>
[[nodiscard]] auto counted(A&& a) {
  return counted_operator<part_t<A>>{held<part_t<A>>(slant::as_operator(std::forward<A>(a)))};
}

}  // namespace slant
