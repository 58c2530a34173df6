// SPDX-License-Identifier: MIT
//
// Warnings about contact data: kinds, and their text. See contact/plausibility.hpp.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/scalar.hpp>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace slant::contact {

/// What looks like a mistake.
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

[[nodiscard]] constexpr std::string_view to_string(suspicion kind) {
  switch (kind) {
    case suspicion::different_nodes:
      return "different_nodes";
    case suspicion::grouped_tangents:
      return "grouped_tangents";
    case suspicion::missing_tangents:
      return "missing_tangents";
    case suspicion::zero_row:
      return "zero_row";
    case suspicion::duplicate_row:
      return "duplicate_row";
    case suspicion::oblique_frame:
      return "oblique_frame";
    case suspicion::other_units:
      return "other_units";
    case suspicion::inward_normal:
      return "inward_normal";
    case suspicion::opposed_normal:
      return "opposed_normal";
    case suspicion::no_contact:
      return "no_contact";
    case suspicion::large_displacement:
      return "large_displacement";
  }
  return "";
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

/// One warning for all places of one kind: a file of 10⁵ wrong rows is one mistake.
class suspects {
 public:
  /// The sentence is that of the first one.
  template <class Sentence>
  void add(index at, Sentence sentence) {
    if (count_++ > 0) return;
    first_ = at;
    text_ = sentence();
  }
  [[nodiscard]] index count() const { return count_; }
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

}  // namespace detail

}  // namespace slant::contact
