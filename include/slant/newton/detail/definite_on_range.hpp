// SPDX-License-Identifier: MIT
//
// H = G (I − G) + ρ G A G is semidefinite. Its kernel is that of G, and right-hand sides lie in
// range(G): there it is definite, ⟨H x, x⟩ ≥ ρ ⟨A G x, G x⟩ > 0, and conjugate gradients need no
// more. The library's CG asks for a promise, which is given here for that reason.
#pragma once

#include <slant/concepts/linear_operator.hpp>
#include <slant/slanting/symmetrized.hpp>

#include <utility>

namespace slant::detail {

/// H as CG meets it.
template <class M>
class definite_on_range {
 public:
  static constexpr law_set laws = slant::laws<slant::self_adjoint, slant::positive_definite>;

  explicit definite_on_range(symmetrized_operator<M> h) : h_(std::move(h)) {}

  [[nodiscard]] index rows() const { return h_.rows(); }
  [[nodiscard]] index cols() const { return h_.cols(); }

  template <class X>
  [[nodiscard]] auto workspace(X const& x) const {
    return h_.workspace(x);
  }
  template <class X, class Y, class W>
  void apply(X const& x, Y& y, W& w) const {
    h_.apply(x, y, w);
  }

 private:
  symmetrized_operator<M> h_;
};

}  // namespace slant::detail
