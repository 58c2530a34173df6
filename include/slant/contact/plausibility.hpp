// SPDX-License-Identifier: MIT
//
// Signs of mistakes in contact data that are valid, so that a solver takes them: warnings, each
// with the row or contact node concerned and how to mend it.
//
// What a row should be. Contact node i has a unit normal n and unit tangents t across it, and rows
// that are its displacement or a jump of it: Nᵢ u = Σ φ_j n·u_j, Tᵢ u = Σ φ_j t·u_j over nodes j of
// the bodies, with the same weights φ. So its rows touch the same nodes, have the same length, are
// orthogonal, and none of them is zero or that of another contact node. Rows of nodes some of whose
// unknowns are prescribed, and so left out, are shorter and may be zero or oblique; the number of
// unknowns of their nodes shows it.
//
// Every criterion is free of units: rows are compared with rows of the same data, by ratios and
// cosines. A check costs a few passes over the entries of K, N and T.
//
// What cannot be seen. All normals turned round, where no layout is given: the data are those of an
// obstacle on the other side, and only a solution without contact is a hint. Lengths of bodies, and
// so displacements that are too large for them, where no layout is given: K alone does not
// determine them. N and T both in other units than d. Rows that depend on several others.
#pragma once

#include <slant/compiled.hpp>
#include <slant/contact/contact_data.hpp>
#include <slant/contact/detail/contact_rows.hpp>
#include <slant/contact/detail/plausibility_warning.hpp>
#include <slant/contact/detail/plausible_normals.hpp>
#include <slant/contact/detail/plausible_rows.hpp>
#include <slant/contact/node_layout.hpp>

#include <Eigen/SparseCore>

#include <limits>
#include <string>
#include <vector>

namespace slant::contact {

/// Warnings about the data alone, none for data that look sound. Throws bad_input if they are not
/// valid (see contact::data::validate), or K or the layout do not fit.
template <class S>
[[nodiscard]] std::vector<plausibility_warning> check_plausibility(
    Eigen::SparseMatrix<S> const& K, data<S> const& c, node_layout<S> const& layout = {}) {
  c.validate();
  slant::detail::check_size("rows of K", K.rows(), c.f.size(), "the size of f,");
  slant::detail::check_size("columns of K", K.cols(), c.f.size(), "the size of f,");
  layout.validate(c.f.size());
  detail::contact_rows<S> const rows(K, c, layout);
  std::vector<plausibility_warning> found;
  bool const missing = detail::find_missing_tangents(K, layout, rows, found);
  bool const grouped = detail::find_grouped_tangents(rows, found);
  if (!missing && !grouped) detail::find_foreign_rows(rows, found);
  detail::find_zero_rows(c, rows, found);
  detail::find_duplicate_rows(c, rows, found);
  if (!grouped) detail::find_oblique_frames(rows, found);
  detail::find_other_units(rows, found);
  if (layout.is_known())
    detail::find_inward_normals(K, layout, rows, found);
  else
    detail::find_opposed_normals(K, rows, found);
  detail::find_no_contact(c, found);
  return found;
}

/// The same, and warnings about a solution u with the forces λ = (λ_ν, λ_t) of [N; T].
template <class S, class V>
[[nodiscard]] std::vector<plausibility_warning> check_plausibility(
    Eigen::SparseMatrix<S> const& K, data<S> const& c, V const& u, V const& λ,
    node_layout<S> const& layout = {}) {
  slant::detail::check_size("u", u.size(), c.f.size());
  slant::detail::check_size("lambda", λ.size(), c.N.rows() + c.T.rows());
  auto found = check_plausibility(K, c, layout);
  detail::find_no_contact(c, u, λ, found);
  if (layout.is_known()) detail::find_large_displacements(K, layout, u, found);
  return found;
}

#if SLANT_USES_COMPILED
extern template std::vector<plausibility_warning> check_plausibility<double>(
    Eigen::SparseMatrix<double> const&, data<double> const&, node_layout<double> const&);
extern template std::vector<plausibility_warning> check_plausibility<double, Eigen::VectorXd>(
    Eigen::SparseMatrix<double> const&, data<double> const&, Eigen::VectorXd const&,
    Eigen::VectorXd const&, node_layout<double> const&);
#endif

}  // namespace slant::contact
