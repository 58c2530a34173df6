// SPDX-License-Identifier: MIT
//
// Checks of the rows of N and T against each other: places, lengths, angles.
#pragma once

#include <slant/contact/detail/contact_rows.hpp>
#include <slant/contact/detail/plausibility_warning.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <unordered_map>
#include <vector>

namespace slant::contact::detail {

using warnings = std::vector<plausibility_warning>;

/// "row 6 of T".
[[nodiscard, gnu::cold]] inline std::string row_text(index i, char const* of) {
  return "row " + slant::detail::show(i) + " of " + of;
}
/// "rows 6 and 7 of T" of a contact node.
template <class S>
[[nodiscard, gnu::cold]] std::string tangents_text(contact_rows<S> const& rows, index i) {
  using slant::detail::show;
  if (rows.tangents == 1) return row_text(i, "T");
  return "rows " + show(2 * i) + " and " + show(2 * i + 1) + " of T";
}

/// Is the node of a contact complete: has it as many unknowns as most others?
template <class S>
[[nodiscard]] bool is_complete(contact_rows<S> const& rows, index i, index usual) {
  auto const complete = [&](auto const& row) {
    for (auto const& e : row) {
      if (rows.classes.size_at(e.unknown) < usual) return false;
    }
    return true;
  };
  bool all = complete(rows.N[i]);
  for (index k = 0; k < rows.tangents; ++k) all = all && complete(rows.T[rows.tangent(i, k)]);
  return all;
}

/// Do the entries of K for a node in three directions add up to zero in each? A body in space does
/// not resist its translation, wherever its nodes have no neighbour that is held; that a node of a
/// beam or a frame in the plane has three unknowns as well is thus no mistake.
template <class S>
[[nodiscard]] bool moves_in_space(Eigen::SparseMatrix<S> const& K, node_classes const& classes,
                                  std::vector<std::vector<index>> const& unknowns, index node) {
  using std::abs;
  auto const& own = unknowns[static_cast<std::size_t>(node)];
  for (index const j : own) {
    S sum(0), size(0);
    for (typename Eigen::SparseMatrix<S>::InnerIterator e(K, j); e; ++e) {
      if (classes.size_at(e.row()) != 3) return false;
      if (classes.rank[static_cast<std::size_t>(e.row())] !=
          classes.rank[static_cast<std::size_t>(j)])
        continue;
      sum += e.value();
      size += abs(e.value());
    }
    // Entries may have been written with seven digits.
    if (!(abs(sum) <= S(1e-6) * size)) return false;
  }
  return !own.empty();
}

/// Does a division of the unknowns by threes say that the body is in space?
template <class S>
[[nodiscard]] bool is_in_space(Eigen::SparseMatrix<S> const& K, contact_rows<S> const& rows,
                               node_classes const& classes) {
  std::vector<std::vector<index>> unknowns(classes.size.size());
  for (index j = 0; j < K.cols(); ++j)
    unknowns[static_cast<std::size_t>(classes.of(j))].push_back(j);
  for (index i = 0; i < rows.m; ++i) {
    for (auto const& e : rows.N[i]) {
      if (classes.size_at(e.unknown) == 3 &&
          moves_in_space(K, classes, unknowns, classes.of(e.unknown)))
        return true;
    }
  }
  return false;
}

template <class S>
bool find_missing_tangents(Eigen::SparseMatrix<S> const& K, node_layout<S> const& layout,
                           contact_rows<S> const& rows, warnings& found) {
  if (rows.tangents != 1) return false;
  bool in_space = layout.dimension() == 3;
  if (!layout.is_known()) {
    in_space = is_in_space(K, rows, classes_of_graph(K));
    if (!in_space && K.cols() % 3 == 0) {
      in_space = is_in_space(K, rows, node_classes::by(K.cols(), [](index j) {
                               return static_cast<std::uint64_t>(j / 3);
                             }));
    }
  }
  if (!in_space) return false;
  suspects s;
  s.add(0, [&] {
    return "T has one row for each of the " + slant::detail::show(rows.m) +
           " contact nodes, but the nodes of the body have three unknowns";
  });
  s.report(suspicion::missing_tangents, "T", "",
           "In space give two rows of T for each contact "
           "node, rows 2i and 2i+1 those of node i",
           found);
  return true;
}

template <class S>
bool find_grouped_tangents(contact_rows<S> const& rows, warnings& found) {
  if (rows.tangents != 2 || !rows.known) return false;
  auto const same = [&](index i, index r) {
    return rows.nodes_of_N(i) != 0 && rows.nodes_of_T(r) == rows.nodes_of_N(i);
  };
  index grouped = 0, interleaved = 0, all = 0, first = -1;
  for (index i = 0; i < rows.m; ++i) {
    all += rows.nodes_of_N(i) != 0 ? 1 : 0;
    grouped += same(i, i) && same(i, rows.m + i) ? 1 : 0;
    bool const own = same(i, 2 * i) && same(i, 2 * i + 1);
    interleaved += own ? 1 : 0;
    if (!own && first < 0) first = i;
  }
  if (grouped <= interleaved || 2 * grouped <= all) return false;
  using slant::detail::show;
  suspects s;
  s.add(first, [&] {
    return "T has all rows of the first tangent and then all of the second: " +
           row_text(first, "N") + " touches the same nodes as rows " + show(first) + " and " +
           show(rows.m + first) + " of T, not as rows " + show(2 * first) + " and " +
           show(2 * first + 1);
  });
  s.report(suspicion::grouped_tangents, "contact nodes", "",
           "Put them node by node: rows 2i and 2i+1 of T are those of node i", found);
  return true;
}

template <class S>
void find_foreign_rows(contact_rows<S> const& rows, warnings& found) {
  if (rows.tangents == 0 || !rows.known) return;
  std::unordered_map<std::uint64_t, index> owner;  // of the nodes that a row of T touches
  for (index r = 0; r < rows.T.size(); ++r) owner.try_emplace(rows.nodes_of_T(r), r);
  suspects s;
  for (index i = 0; i < rows.m; ++i) {
    if (rows.nodes_of_N(i) == 0) continue;
    bool own = false, empty = true;
    for (index k = 0; k < rows.tangents; ++k) {
      std::uint64_t const nodes = rows.nodes_of_T(rows.tangent(i, k));
      own = own || nodes == rows.nodes_of_N(i);
      empty = empty && nodes == 0;
    }
    auto const other = owner.find(rows.nodes_of_N(i));
    if (own || empty || other == owner.end()) continue;
    s.add(i, [&] {
      return row_text(i, "N") + " touches other nodes of the body than " + tangents_text(rows, i) +
             ", namely those of " + tangents_text(rows, other->second / rows.tangents);
    });
  }
  s.report(suspicion::different_nodes, "contact nodes", "rows of N",
           "Put the rows of N, T, d and g in one order of the contact nodes", found);
}

template <class S>
void find_zero_rows(data<S> const& c, contact_rows<S> const& rows, warnings& found) {
  suspects of_N, of_T;
  index const usual = rows.usual_size();
  for (index i = 0; i < rows.m; ++i) {
    if (rows.N[i].empty() && slant::detail::is_finite(c.d[i])) {
      of_N.add(i, [&] { return row_text(i, "N") + " is zero: this contact node never touches"; });
    }
    // Where a direction is prescribed its unknown is missing.
    if (rows.N[i].empty() || !is_complete(rows, i, usual)) continue;
    for (index k = 0; k < rows.tangents; ++k) {
      index const r = rows.tangent(i, k);
      if (rows.T[r].empty()) {
        of_T.add(r, [&] {
          return row_text(r, "T") + " is zero: contact node " + slant::detail::show(i) +
                 " slides there without friction";
        });
      }
    }
  }
  of_N.report(suspicion::zero_row, "N", "rows of N",
              "Give the normal of the node, or leave the node out of N, T, d and g", found);
  of_T.report(suspicion::zero_row, "T", "rows of T",
              "Give the tangent of the node, or 0 for its slip bound", found);
}

template <class S>
void find_duplicate_rows(data<S> const& c, contact_rows<S> const& rows, warnings& found) {
  // Rows of the same unknowns, found by these.
  auto const key = [](auto const& row) {
    std::uint64_t sum = 0;
    for (auto const& e : row) sum += mixed(static_cast<std::uint64_t>(e.unknown));
    return sum;
  };
  S const nearly = S(1) - S(1e-9);
  auto const repeats = [&](row_entries<S> const& of, auto skip, auto note) {
    std::unordered_map<std::uint64_t, std::vector<index>> earlier;
    for (index r = 0; r < of.size(); ++r) {
      if (of[r].empty() || skip(r)) continue;
      auto& same = earlier[key(of[r])];
      bool repeated = false;
      // More than a few normals at one node are all that a cone or a polytope has.
      for (std::size_t j = 0; j < same.size() && j < 16 && !repeated; ++j) {
        S const cosine = row_entries<S>::cosine(of[r], of[same[j]]);
        repeated = note(r, same[j], cosine);
      }
      if (!repeated) same.push_back(r);
    }
  };
  suspects of_N, of_T;
  repeats(
      rows.N, [&](index i) { return !slant::detail::is_finite(c.d[i]); },
      [&](index i, index j, S const& cosine) {
        if (!(cosine >= nearly)) return false;
        of_N.add(i, [&] {
          return row_text(i, "N") + " is a positive multiple of row " + slant::detail::show(j);
        });
        return true;
      });
  // Two sides of a corner share a tangent; a row of T without its own node is a mistake.
  repeats(
      rows.T, [&](index r) { return !rows.known || rows.nodes_of_N(r / rows.tangents) == 0; },
      [&](index r, index s, S const& cosine) {
        using std::abs;
        index const i = r / rows.tangents, j = s / rows.tangents;
        bool const both =
            rows.nodes_of_N(i) == rows.nodes_of_T(r) && rows.nodes_of_N(j) == rows.nodes_of_T(r);
        if (i == j || both || !(abs(cosine) >= nearly)) return false;
        bool const first = rows.nodes_of_N(i) == rows.nodes_of_T(r);
        index const wrong = first ? s : r, right = first ? r : s;
        if (rows.nodes_of_N(right / rows.tangents) != rows.nodes_of_T(right)) return false;
        of_T.add(wrong, [&] {
          return row_text(wrong, "T") + " repeats row " + slant::detail::show(right) +
                 " of another contact node";
        });
        return true;
      });
  of_N.report(suspicion::duplicate_row, "N", "rows of N",
              "Leave the contact node out of N, T, d and g, or give it its own normal", found);
  of_T.report(suspicion::duplicate_row, "T", "rows of T", "Give the tangent of its own node",
              found);
}

template <class S>
void find_oblique_frames(contact_rows<S> const& rows, warnings& found) {
  using std::abs;
  suspects s;
  index const usual = rows.usual_size();
  for (index i = 0; i < rows.m && rows.tangents > 0; ++i) {
    if (!is_complete(rows, i, usual)) continue;
    bool noted = false;
    auto const compare = [&](auto const& a, auto const& b, auto name_a, auto name_b) {
      if (noted || a.empty() || b.empty()) return;
      S const cosine = row_entries<S>::cosine(a, b);
      // Directions may have been written with four digits.
      if (!(abs(cosine) > S(1e-3))) return;
      noted = true;
      s.add(i, [&] {
        return name_a + " and " + name_b + ", of contact node " + slant::detail::show(i) +
               ", are not orthogonal: their cosine is " + slant::detail::show(cosine);
      });
    };
    for (index k = 0; k < rows.tangents; ++k) {
      index const r = rows.tangent(i, k);
      compare(rows.N[i], rows.T[r], row_text(i, "N"), row_text(r, "T"));
      if (k > 0) compare(rows.T[r - 1], rows.T[r], row_text(r - 1, "T"), row_text(r, "T"));
    }
  }
  s.report(suspicion::oblique_frame, "contact nodes", "contact nodes",
           "Take unit vectors that are orthogonal to each other", found);
}

/// The middle one of some numbers, none of which is NaN.
template <class S>
[[nodiscard]] S median(std::vector<S> values) {
  auto const middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Numbers that are far from the median of all, where most are close to it.
template <class S, class Note>
void find_outliers(std::vector<S> const& values, S const& middle, S const& factor, Note note) {
  std::size_t close = 0;
  for (S const& v : values) close += v <= S(2) * middle && middle <= S(2) * v ? 1 : 0;
  if (4 * close < 3 * values.size()) return;
  for (std::size_t j = 0; j < values.size(); ++j) {
    if (values[j] > factor * middle || middle > factor * values[j]) note(j);
  }
}

template <class S>
void find_other_units(contact_rows<S> const& rows, warnings& found) {
  using slant::detail::show;
  index const usual = rows.usual_size();
  std::vector<S> ratios, lengths;
  std::vector<index> of_ratio, of_length;
  for (index i = 0; i < rows.m; ++i) {
    if (rows.N[i].empty() || !is_complete(rows, i, usual)) continue;
    S const length = row_entries<S>::length(rows.N[i]);
    lengths.push_back(length);
    of_length.push_back(i);
    for (index k = 0; k < rows.tangents; ++k) {
      index const r = rows.tangent(i, k);
      if (rows.T[r].empty()) continue;
      ratios.push_back(row_entries<S>::length(rows.T[r]) / length);
      of_ratio.push_back(r);
    }
  }
  std::string const mend =
      "Rows are displacements, or jumps of displacements, along unit vectors, in the unit of d";
  suspects s;
  if (rows.tangents == 0 && !lengths.empty()) {
    S const middle = median(lengths);
    find_outliers(lengths, middle, S(100), [&](std::size_t j) {
      s.add(of_length[j], [&] {
        return row_text(of_length[j], "N") + " is " +
               show(static_cast<float>(lengths[j] / middle)) + " times as long as most others";
      });
    });
    s.report(suspicion::other_units, "N", "rows of N", mend, found);
  }
  if (ratios.empty()) return;
  S const middle = median(ratios);
  if (middle > S(2) || S(2) * middle < S(1)) {
    suspects all;
    all.add(0, [&] {
      return "the rows of T are " + show(static_cast<float>(middle)) +
             " times as long as those of N";
    });
    all.report(suspicion::other_units, "T", "", mend, found);
  }
  find_outliers(ratios, middle, S(8), [&](std::size_t j) {
    index const r = of_ratio[j];
    s.add(r, [&] {
      return row_text(r, "T") + " is " + show(static_cast<float>(ratios[j])) +
             " times as long as " + row_text(r / rows.tangents, "N");
    });
  });
  s.report(suspicion::other_units, "T", "rows of T", mend, found);
}

}  // namespace slant::contact::detail
