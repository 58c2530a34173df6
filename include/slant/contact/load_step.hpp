// SPDX-License-Identifier: MIT
//
// What changes from one load step to the next. K, N and T stay, and with them A = B K⁻¹ Bᵀ, its
// factors, its bounds and everything else that was learnt about it:
//
//     f    b = B K⁻¹ f − c      one solve with K
//     d    c = (d, w)           no solve
//     g    Λ                    no solve
//     w    c = (d, w)           no solve
//
// w is where the contact nodes stood when friction began to act: Σ gᵢ‖(T u)ᵢ − wᵢ‖ instead of
// Σ gᵢ‖(T u)ᵢ‖. In a quasi-static sequence friction resists the increment of a step, so w is T u of
// the step before; it is 0 until it is given.
#pragma once

#include <slant/concepts/checks.hpp>
#include <slant/contact/detail/contact_checks.hpp>

#include <Eigen/SparseCore>

#include <optional>

namespace slant::contact {

/// New data of a contact problem, of the sizes and with the meaning they have in contact::data.
/// What is not given stays: load_step<>{.f = 2 * f}.
template <class S = double>
struct load_step {
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;

  std::optional<vector_type> f{};  ///< load
  std::optional<vector_type> d{};  ///< gaps; infinite exactly where they have been
  std::optional<vector_type> g{};  ///< slip bounds
  std::optional<vector_type> w{};  ///< tangential positions without friction, one per row of T
};

namespace detail {

/// Throws bad_input, as contact::data::validate does, unless the step fits a problem of n_u
/// unknowns with the gaps d and B = [N; T].
template <class S>
void check_step(load_step<S> const& step, index unknowns,
                Eigen::Matrix<S, Eigen::Dynamic, 1> const& d, Eigen::SparseMatrix<S> const& B) {
  if (step.f) {
    slant::detail::check_size("f", step.f->size(), unknowns, "one load per unknown,");
    slant::detail::check_finite("f", *step.f);
  }
  if (step.d) {
    check_gaps(*step.d, d.size());
    for (index i = 0; i < d.size(); ++i) {
      bool const closes = slant::detail::is_finite(d(i));
      if (slant::detail::is_finite((*step.d)(i)) == closes) continue;
      throw bad_input("d", slant::detail::show((*step.d)(i)),
                      closes ? "a finite number, since this gap was finite when B was made"
                             : "+inf, since this gap was infinite when B was made")
          .at(i);
    }
    check_reach(B, *step.d);
  }
  if (step.g) check_slip_bounds(*step.g, d.size(), B.rows() > d.size());
  if (step.w) {
    slant::detail::check_size("w", step.w->size(), B.rows() - d.size(), "one per row of T,");
    slant::detail::check_finite("w", *step.w);
  }
}

}  // namespace detail

}  // namespace slant::contact
