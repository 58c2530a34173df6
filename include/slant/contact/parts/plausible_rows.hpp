// SPDX-License-Identifier: MIT
//
// Checks of the rows of N and T against each other: places, lengths, angles.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/contact/contact_data.hpp>
#include <slant/contact/node_layout.hpp>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace slant::contact {

// --- plausibility warning ------------------------------------------------------------------------

/// What looks like a mistake; to_string names them in this order.
enum class suspicion : unsigned char {
  different_nodes,     ///< the rows of N and T of a contact node touch different nodes of the body
  grouped_tangents,    ///< first all rows of t₁ in T, then all of t₂
  missing_tangents,    ///< one row of T per contact node, on a body in space
  zero_row,            ///< a row of N or T without entries
  duplicate_row,       ///< a row of N or T that repeats another
  oblique_frame,       ///< normal and tangents that are not orthogonal
  other_units,         ///< rows of N and T of different lengths
  inward_normal,       ///< a normal that points into its body
  opposed_normal,      ///< a normal against all those beside it
  no_contact,          ///< no node can touch, or none does
  large_displacement,  ///< a body that moves farther than it is long
};

/// The kind in words.
[[nodiscard]] constexpr std::string_view to_string(suspicion kind) {
  constexpr std::string_view names[] = {"different_nodes", "grouped_tangents",  "missing_tangents",
                                        "zero_row",        "duplicate_row",     "oblique_frame",
                                        "other_units",     "inward_normal",     "opposed_normal",
                                        "no_contact",      "large_displacement"};
  auto const k = std::size_t(kind);
  return k < std::size(names) ? names[k] : "";
}

/// What looks odd, where first, how often, and what to do about it. Numbers count from 0.
struct plausibility_warning {
  suspicion kind;
  std::string rows;  ///< what index counts: "N", "T", "contact nodes", "bodies"
  index at = 0;      ///< the first one concerned
  index count = 1;   ///< how many there are
  std::string text;  ///< one line: what is odd, and how to mend it
};

namespace detail {

/// "row 6 of T".
struct row_name {
  index i;
  char const* of;
};

/// A part of a sentence.
template <class T>
[[nodiscard, gnu::cold]] std::string text_of(T const& number) {
  return slant::detail::show(number);
}
[[nodiscard, gnu::cold]] inline std::string text_of(char const* words) {
  return words;
}
[[nodiscard, gnu::cold]] inline std::string text_of(row_name const& row) {
  return "row " + slant::detail::show(row.i) + " of " + row.of;
}

/// One warning for all places of one kind: a file of 10⁵ wrong rows is one mistake.
class suspects {
 public:
  /// The sentence, part by part, is that of the first one.
  template <class... Part>
  void add(index at, Part const&... sentence) {
    if (count_++ > 0) return;
    first_ = at;
    text_ = (std::string() + ... + text_of(sentence));
  }
  /// "…, as in 3 other rows of N. Mend it."
  void report(suspicion kind, std::string rows, std::string_view others, std::string_view mend,
              std::vector<plausibility_warning>& found) const {
    if (count_ == 0) return;
    std::string text = text_;
    if (count_ > 1) {
      text.append("; the same holds for ")
          .append(slant::detail::show(count_ - 1))
          .append(" more of the ")
          .append(others);
    }
    text.append(". ").append(mend);
    found.push_back({kind, std::move(rows), first_, count_, std::move(text)});
  }

 private:
  index count_ = 0;
  index first_ = 0;
  std::string text_{};
};

// --- contact rows --------------------------------------------------------------------------------
//
// The rows of N and T as a check of their plausibility sees them: their entries, and the nodes of
// the body that they touch.
//
// Which unknowns belong to a node is not said anywhere in the data. It follows from the layout
// where that is given; from K, where unknowns of a node have the same neighbours (the
// supervariables of sparse elimination orders); or from one of the usual numberings, node by node
// or direction by direction. Of these the first one is taken that explains most contact nodes: one
// row of T, of any contact node, touches the same nodes as the row of N.

/// The entries of the rows of a sparse matrix, without those that are rounding errors of their row.
template <class S>
class row_entries {
 public:
  struct entry {
    index unknown;
    S value;
  };
  using row = std::vector<entry>;

  explicit row_entries(Eigen::SparseMatrix<S> const& m) : rows_(std::size_t(m.rows())) {
    using std::abs;
    slant::detail::for_each_entry(m, [&](index i, index j, S const& value) {
      if (value != S(0)) rows_[std::size_t(i)].push_back({j, value});
    });
    for (row& r : rows_) {
      S const small = S(64) * std::numeric_limits<S>::epsilon() * largest(r);
      std::erase_if(r, [&](entry const& e) { return !(abs(e.value) > small); });
    }
  }
  [[nodiscard]] index size() const { return index(rows_.size()); }
  [[nodiscard]] row const& operator[](index i) const { return rows_[std::size_t(i)]; }

  [[nodiscard]] static S largest(row const& r) {
    using std::abs;
    S most(0);
    for (entry const& e : r) most = std::max<S>(most, abs(e.value));
    return most;
  }
  /// ‖row‖₂, whatever its scale.
  [[nodiscard]] static S length(row const& r) {
    using std::sqrt;
    S const unit = largest(r);
    if (!(unit > S(0))) return S(0);
    S sum(0);
    for (entry const& e : r) sum += (e.value / unit) * (e.value / unit);
    return unit * sqrt(sum);
  }
  /// The cosine of the angle between two rows that are not zero.
  [[nodiscard]] static S cosine(row const& a, row const& b) {
    S const la = length(a), lb = length(b);
    S sum(0);
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
      if (a[i].unknown == b[j].unknown) sum += (a[i].value / la) * (b[j].value / lb);
      bool const next = a[i].unknown <= b[j].unknown;
      if (b[j].unknown <= a[i].unknown) ++j;
      if (next) ++i;
    }
    return sum;
  }

 private:
  std::vector<row> rows_;  // by increasing unknowns, since m is stored by columns
};

[[nodiscard]] inline std::uint64_t mixed(std::uint64_t x) {  // splitmix64
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31U);
}

/// A node for each unknown, its place among the unknowns of the node, and how many these are.
struct node_classes {
  std::vector<index> node{};
  std::vector<index> rank{};
  std::vector<index> size{};  ///< of each node

  /// Nodes by keys: unknowns with the same key share one.
  template <class Key>
  static node_classes by(index unknowns, Key key) {
    node_classes c;
    std::unordered_map<std::uint64_t, index> found;
    for (index j = 0; j < unknowns; ++j) {
      auto const at = found.try_emplace(key(j), index(c.size.size())).first->second;
      if (at == index(c.size.size())) c.size.push_back(0);
      c.node.push_back(at);
      c.rank.push_back(c.size[std::size_t(at)]++);
    }
    return c;
  }
  [[nodiscard]] index of(index unknown) const { return node[std::size_t(unknown)]; }
  [[nodiscard]] index size_at(index unknown) const { return size[std::size_t(of(unknown))]; }
};

/// Unknowns with the same neighbours in the graph of K.
template <class S>
[[nodiscard]] node_classes classes_of_graph(Eigen::SparseMatrix<S> const& K) {
  std::vector<std::uint64_t> keys(std::size_t(K.cols()), 0);
  slant::detail::for_each_entry(K, [&](index i, index j, S const&) {
    keys[std::size_t(j)] += mixed(static_cast<std::uint64_t>(i));
  });
  return node_classes::by(K.cols(), [&](index j) { return keys[std::size_t(j)]; });
}

/// The nodes that a row touches, as one number; 0 for an empty row.
template <class Row>
[[nodiscard]] std::uint64_t nodes_touched(Row const& row, node_classes const& classes) {
  std::vector<index> nodes;
  for (auto const& e : row) nodes.push_back(classes.of(e.unknown));
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  std::uint64_t sum = 0;
  for (index const node : nodes) sum += mixed(static_cast<std::uint64_t>(node) + 1U);
  return sum;
}

/// The rows of contact data with their nodes.
template <class S>
struct contact_rows {
  row_entries<S> N, T;
  index m, tangents;
  node_classes classes{};
  std::vector<std::uint64_t> of_N{}, of_T{};  ///< nodes_touched of each row
  bool known = false;  ///< the classes explain most contact nodes, or there is no friction

  contact_rows(Eigen::SparseMatrix<S> const& K, data<S> const& c, node_layout<S> const& layout)
      : N(c.N), T(c.T), m(c.nodes()), tangents(c.tangents()) {
    index const n = K.cols();
    auto const number = [](index i) { return static_cast<std::uint64_t>(i); };
    if (layout.is_known()) {
      if (take(node_classes::by(n, [&](index j) { return number(layout.node[std::size_t(j)]); })))
        return;
    }
    if (take(classes_of_graph(K)) || tangents == 0) return;
    for (index D = tangents + 1; D <= 3; ++D) {
      if (n % D != 0) continue;
      if (take(node_classes::by(n, [&](index j) { return number(j / D); }))) return;
      if (take(node_classes::by(n, [&](index j) { return number(j % (n / D)); }))) return;
    }
    (void)take(classes_of_graph(K));
    known = false;
  }

  /// Row k of T of a node.
  [[nodiscard]] index tangent(index i, index k) const { return tangents * i + k; }
  [[nodiscard]] std::uint64_t nodes_of_N(index i) const { return of_N[std::size_t(i)]; }
  [[nodiscard]] std::uint64_t nodes_of_T(index r) const { return of_T[std::size_t(r)]; }
  /// Unknowns of a complete node: the most common number of those that N and T touch.
  [[nodiscard]] index usual_size() const {
    std::unordered_map<index, index> counts;
    for (row_entries<S> const* rows : {&N, &T}) {
      for (index i = 0; i < rows->size(); ++i) {
        for (auto const& e : (*rows)[i]) ++counts[classes.size_at(e.unknown)];
      }
    }
    index size = 0, most = 0;
    for (auto const& [s, count] : counts) {
      if (count < most || (count == most && s < size)) continue;
      size = s;
      most = count;
    }
    return size;
  }

 private:
  bool take(node_classes found) {
    classes = std::move(found);
    of_N.clear();
    of_T.clear();
    for (index i = 0; i < m; ++i) of_N.push_back(nodes_touched(N[i], classes));
    for (index r = 0; r < T.size(); ++r) of_T.push_back(nodes_touched(T[r], classes));
    known = true;
    if (tangents == 0) return true;
    std::unordered_map<std::uint64_t, index> some_T;
    for (std::uint64_t const nodes : of_T) ++some_T[nodes];
    index explained = 0, all = 0;
    for (std::uint64_t const nodes : of_N) {
      if (nodes == 0) continue;
      ++all;
      explained += some_T.contains(nodes) ? 1 : 0;
    }
    return known = 2 * explained > all;
  }
};

// --- plausible rows ------------------------------------------------------------------------------

using warnings = std::vector<plausibility_warning>;

/// "rows 6 and 7 of T" of a contact node.
template <class S>
[[nodiscard, gnu::cold]] std::string tangents_text(contact_rows<S> const& rows, index i) {
  using slant::detail::show;
  if (rows.tangents == 1) return text_of(row_name{i, "T"});
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
  auto const& own = unknowns[std::size_t(node)];
  for (index const j : own) {
    S sum(0), size(0);
    for (typename Eigen::SparseMatrix<S>::InnerIterator e(K, j); e; ++e) {
      if (classes.size_at(e.row()) != 3) return false;
      if (classes.rank[std::size_t(e.row())] != classes.rank[std::size_t(j)]) continue;
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
  for (index j = 0; j < K.cols(); ++j) unknowns[std::size_t(classes.of(j))].push_back(j);
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
  found.push_back(
      {suspicion::missing_tangents, "T", 0, 1,
       "T has one row for each of the " + slant::detail::show(rows.m) +
           " contact nodes, but the nodes of the body have three unknowns. In space "
           "give two rows of T for each contact node, rows 2i and 2i+1 those of node i"});
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
  found.push_back({suspicion::grouped_tangents, "contact nodes", first, 1,
                   "T has all rows of the first tangent and then all of the second: " +
                       text_of(row_name{first, "N"}) + " touches the same nodes as rows " +
                       show(first) + " and " + show(rows.m + first) + " of T, not as rows " +
                       show(2 * first) + " and " + show(2 * first + 1) +
                       ". Put them node by node: rows 2i and 2i+1 of T are those of node i"});
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
    s.add(i, row_name{i, "N"}, " touches other nodes of the body than ", tangents_text(rows, i),
          ", namely those of ", tangents_text(rows, other->second / rows.tangents));
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
      of_N.add(i, row_name{i, "N"}, " is zero: this contact node never touches");
    }
    // Where a direction is prescribed its unknown is missing.
    if (rows.N[i].empty() || !is_complete(rows, i, usual)) continue;
    for (index k = 0; k < rows.tangents; ++k) {
      index const r = rows.tangent(i, k);
      if (!rows.T[r].empty()) continue;
      of_T.add(r, row_name{r, "T"}, " is zero: contact node ", i, " slides there without friction");
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
        of_N.add(i, row_name{i, "N"}, " is a positive multiple of row ", j);
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
        of_T.add(wrong, row_name{wrong, "T"}, " repeats row ", right, " of another contact node");
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
    auto const compare = [&](auto const& a, auto const& b, row_name name_a, row_name name_b) {
      if (noted || a.empty() || b.empty()) return;
      S const cosine = row_entries<S>::cosine(a, b);
      // Directions may have been written with four digits.
      if (!(abs(cosine) > S(1e-3))) return;
      noted = true;
      s.add(i, name_a, " and ", name_b, ", of contact node ", i,
            ", are not orthogonal: their cosine is ", cosine);
    };
    for (index k = 0; k < rows.tangents; ++k) {
      index const r = rows.tangent(i, k);
      compare(rows.N[i], rows.T[r], {i, "N"}, {r, "T"});
      if (k > 0) compare(rows.T[r - 1], rows.T[r], {r - 1, "T"}, {r, "T"});
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
  using slant::detail::brief;
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
      s.add(of_length[j], row_name{of_length[j], "N"}, " is ", brief(lengths[j] / middle),
            " times as long as most others");
    });
    s.report(suspicion::other_units, "N", "rows of N", mend, found);
  }
  if (ratios.empty()) return;
  S const middle = median(ratios);
  if (middle > S(2) || S(2) * middle < S(1)) {
    found.push_back(
        {suspicion::other_units, "T", 0, 1,
         "the rows of T are " + brief(middle) + " times as long as those of N. " + mend});
  }
  find_outliers(ratios, middle, S(8), [&](std::size_t j) {
    index const r = of_ratio[j];
    s.add(r, row_name{r, "T"}, " is ", brief(ratios[j]), " times as long as ",
          row_name{r / rows.tangents, "N"});
  });
  s.report(suspicion::other_units, "T", "rows of T", mend, found);
}

}  // namespace detail

}  // namespace slant::contact
