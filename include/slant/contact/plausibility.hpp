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
#include <slant/contact/node_layout.hpp>
#include <slant/contact/parts/plausible_rows.hpp>

#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace slant::contact::detail {

// --- plausible normals ---------------------------------------------------------------------------

/// A row of N is an outer normal: from each of its nodes the neighbours lie on the other side, but
/// for a few of a hollow or an edge. Inward: nearly all of them lie where it points.
template <class S>
void find_inward_normals(Eigen::SparseMatrix<S> const& K, node_layout<S> const& layout,
                         contact_rows<S> const& rows, warnings& found) {
  suspects s;
  for (index i = 0; i < rows.m; ++i) {
    S before(0), behind(0);
    for (auto const& e : rows.N[i]) {
      // The part of the row at this node, looked at once.
      Eigen::VectorX<S> n = Eigen::VectorX<S>::Zero(layout.x.rows());
      bool seen = false;
      for (auto const& other : rows.N[i]) {
        if (rows.classes.of(other.unknown) != rows.classes.of(e.unknown)) continue;
        seen = seen || other.unknown < e.unknown;
        n[layout.axis[std::size_t(other.unknown)]] = other.value;
      }
      if (seen) continue;
      for (typename Eigen::SparseMatrix<S>::InnerIterator k(K, e.unknown); k; ++k) {
        S const height = n.dot(layout.place(k.row()) - layout.place(e.unknown));
        (height > S(0) ? before : behind) += height;
      }
    }
    if (before > S(4) * -behind) {
      s.add(i, row_name{i, "N"}, " points into the body: N u > 0 is to mean towards the obstacle");
    }
  }
  s.report(suspicion::inward_normal, "N", "rows of N",
           "Turn the sign: a row of N is the outer normal of the body", found);
}

/// The part of a row at one node: components by the rank of the unknowns.
template <class S>
struct normal_at {
  index row, node, unknown;
  std::array<S, 3> n{};
  S length = S(0);
};

/// For each row of N the nodes that it moves at least half as much as any.
template <class S>
[[nodiscard]] std::vector<normal_at<S>> main_normals(contact_rows<S> const& rows) {
  using std::sqrt;
  std::vector<normal_at<S>> all;
  for (index i = 0; i < rows.m; ++i) {
    S const unit = row_entries<S>::largest(rows.N[i]);
    std::vector<normal_at<S>> of_row;
    for (auto const& e : rows.N[i]) {
      index const node = rows.classes.of(e.unknown), size = rows.classes.size_at(e.unknown);
      if (size != 2 && size != 3) continue;
      auto at = std::find_if(of_row.begin(), of_row.end(),
                             [&](normal_at<S> const& n) { return n.node == node; });
      if (at == of_row.end()) at = of_row.insert(at, normal_at<S>{i, node, e.unknown});
      at->n[std::size_t(rows.classes.rank[std::size_t(e.unknown)])] = e.value / unit;
    }
    S longest(0);
    for (auto& n : of_row) {
      n.length = sqrt(n.n[0] * n.n[0] + n.n[1] * n.n[1] + n.n[2] * n.n[2]);
      longest = std::max<S>(longest, n.length);
    }
    for (auto const& n : of_row) {
      if (S(2) * n.length >= longest) all.push_back(n);
    }
  }
  return all;
}

/// A normal that is against those of all contact nodes beside it, two at least. Obstacles on both
/// sides of a thin body are no mistake: beside a node there are others of its side.
template <class S>
void find_opposed_normals(Eigen::SparseMatrix<S> const& K, contact_rows<S> const& rows,
                          warnings& found) {
  auto const normals = main_normals(rows);
  std::unordered_map<index, std::vector<std::size_t>> at_node;
  for (std::size_t k = 0; k < normals.size(); ++k) at_node[normals[k].node].push_back(k);
  std::vector<std::pair<index, index>> votes(std::size_t(rows.m));
  std::vector<index> beside;
  for (auto const& own : normals) {
    beside.clear();
    for (typename Eigen::SparseMatrix<S>::InnerIterator e(K, own.unknown); e; ++e)
      beside.push_back(rows.classes.of(e.row()));
    std::sort(beside.begin(), beside.end());
    beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
    for (index const node : beside) {
      auto const others = at_node.find(node);
      if (others == at_node.end()) continue;
      for (std::size_t const k : others->second) {
        auto const& other = normals[k];
        if (other.row == own.row) continue;
        bool const comparable =
            rows.classes.size_at(other.unknown) == rows.classes.size_at(own.unknown);
        S const product = own.n[0] * other.n[0] + own.n[1] * other.n[1] + own.n[2] * other.n[2];
        bool const against = comparable && S(2) * product < -own.length * other.length;
        auto& [opposed, rest] = votes[std::size_t(own.row)];
        ++(against ? opposed : rest);
      }
    }
  }
  suspects s;
  for (index i = 0; i < rows.m; ++i) {
    auto const& [opposed, rest] = votes[std::size_t(i)];
    if (opposed < 2 || rest > 0) continue;
    s.add(i, row_name{i, "N"}, " points against those of all ", opposed,
          " contact nodes beside it");
  }
  s.report(suspicion::opposed_normal, "N", "rows of N",
           "Turn its sign: a row of N is positive towards the obstacle", found);
}

[[gnu::cold]] inline void warn_of_no_contact(std::string const& what, warnings& found) {
  found.push_back({suspicion::no_contact, "contact nodes", 0, 1,
                   what + ". If there should be contact look at the signs of N and d: N u <= d, "
                          "where N u > 0 is towards the obstacle and d is the gap"});
}

/// No node touches: each is open, and no normal force is more than a rounding error of the load.
template <class S, class V>
void find_no_contact(data<S> const& c, V const& u, V const& λ, warnings& found) {
  using std::abs;
  Eigen::VectorX<S> const moved = c.N * u;
  S const small = S(1e-6) * c.f.stableNorm();
  bool possible = false;
  for (index i = 0; i < c.nodes(); ++i) {
    if (!slant::detail::is_finite(c.d[i])) continue;
    possible = true;
    if (!(c.d[i] > moved[i]) || !(abs(λ[i]) <= small)) return;
  }
  if (!possible) return;  // was said of the data
  warn_of_no_contact("no contact node touches, and no normal force acts", found);
}

/// Small strains and rotations are assumed; a node that moves by more than its body is long is far
/// beyond these.
template <class S, class V>
void find_large_displacements(Eigen::SparseMatrix<S> const& K, node_layout<S> const& layout,
                              V const& u, warnings& found) {
  using std::abs;
  suspects s;
  auto const bodies = bodies_of(K);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    auto const [low, high] = layout.box(bodies[b]);
    S largest(0);
    index at = bodies[b].front();
    for (index const j : bodies[b]) {
      if (!(abs(u[j]) > largest)) continue;
      largest = abs(u[j]);
      at = j;
    }
    S const length = (high - low).stableNorm();
    if (!(largest > length && length > S(0))) continue;
    s.add(index(b), "unknown ", at, " of body ", index(b), " moves by ",
          slant::detail::brief(largest), ", but the body is ", slant::detail::brief(length),
          " long");
  }
  s.report(suspicion::large_displacement, "bodies", "bodies",
           "Look at the units of K and f, and at the supports: displacements have to be small",
           found);
}

}  // namespace slant::contact::detail

namespace slant::contact {

// --- plausibility --------------------------------------------------------------------------------

/// Warnings about the data alone, none for data that look sound. Throws bad_input if they are not
/// valid (see contact::data::validate), or K or the layout do not fit.
template <class S>
[[nodiscard]] std::vector<plausibility_warning> check_plausibility(
    Eigen::SparseMatrix<S> const& K, data<S> const& c, node_layout<S> const& layout = {}) {
  detail::check_scene(K, c);
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
  if (!c.d.array().isFinite().any()) {
    detail::warn_of_no_contact("all gaps in d are infinite: no node can touch", found);
  }
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
