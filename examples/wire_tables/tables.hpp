// SPDX-License-Identifier: MIT
//
// Tables 4.1–4.8 of the thesis, its columns and ours.
#pragma once

#include <algorithm>
#include <cstdio>
#include <fem/thesis_tables.hpp>
#include <fem/wire_counts.hpp>
#include <iterator>
#include <string>
#include <support/text_table.hpp>
#include <vector>

#include "wire_runs.hpp"

namespace wire_tables {

using cells = std::vector<std::string>;

[[nodiscard]] inline std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

/// An entry as the document prints it.
[[nodiscard]] inline std::string printed(int value) {
  if (value == fem::failed) return "×";
  if (value == fem::illegible) return "?";
  if (value == fem::not_printed) return "-";
  return std::to_string(value);
}
/// Products / iterations, the order of the thesis.
[[nodiscard]] inline std::string printed(fem::printed_work const& work) {
  return work.products < 0 ? printed(work.products)
                           : printed(work.products) + "/" + printed(work.steps);
}
/// "8(3)", with the accuracy of QPC behind if it is not 10⁻¹: "3(69)[2]".
[[nodiscard]] inline std::string printed(fem::ssnm_after_qpc const& entry) {
  std::string text = printed(entry.iterations) + "(" + printed(entry.qpc) + ")";
  if (entry.accuracy != 1) text += "[" + printed(entry.accuracy) + "]";
  return text;
}

/// "39:25/4:60", active and free bounds, active and free circles.
[[nodiscard]] inline std::string ratios(fem::active_counts const& counts, int m) {
  auto const ratio = [m](int active) {
    return std::to_string(active) + ":" + std::to_string(m - active);
  };
  return ratio(counts.bounds) + "/" + ratio(counts.circles);
}

/// Appends b to a.
[[nodiscard]] inline cells joined(cells a, cells const& b) {
  std::copy(b.begin(), b.end(), std::back_inserter(a));
  return a;
}

/// Prints the tables; `right` stays true while every run converges to the printed active sets.
class table_printer {
 public:
  explicit table_printer(wire_runs& runs) : runs_(runs), meshes_(mesh_count(runs.options())) {}

  [[nodiscard]] bool right() const { return right_; }

  /// Tables 4.1 and 4.2.
  template <class Rows>
  void ssnm(char const* title, Rows const& rows) {
    std::printf("\n%s\n", title);
    examples::text_table const table(
        joined({"l", "g", "n", "printed counts", "our counts", "SSNM"}, our_names()));
    table.print_head();
    for (auto const& row : rows)
      for (std::size_t e = 0; e < meshes_; ++e)
        table.print_row(joined({number(row.l), number(row.g), number(fem::wire_sizes[e])},
                               with_counts(row.l, row.g, e, printed(row.iterations[e]))));
  }

  /// Tables 4.3 and 4.4.
  template <class Rows>
  void after_qpc(char const* title, Rows const& rows) {
    std::printf("\n%s\n", title);
    examples::text_table const table(
        joined({"g", "n", "printed counts", "our counts", "SSNM(QPC)"}, our_names()));
    table.print_head();
    for (auto const& row : rows)
      for (std::size_t e = 0; e < meshes_; ++e)
        table.print_row(joined({number(row.g), number(fem::wire_sizes[e])},
                               with_counts(0, row.g, e, printed(row.entries[e]))));
  }

  /// Tables 4.5 and 4.8.
  void variants() {
    std::printf(
        "\nTables 4.5 and 4.8: l = 0, g = 0.5; printed products/iterations of variants A and B\n");
    examples::text_table const table(
        joined({"n", "A fixed", "A adaptive", "A 0.01", "B 0.01", "B 0.1"}, our_names()), 8);
    table.print_head();
    for (std::size_t e = 0; e < meshes_; ++e) {
      auto const& inner = fem::thesis_table_4_5[e];
      auto const& variant = fem::thesis_table_4_8[e];
      table.print_row(
          joined({number(fem::wire_sizes[e]), printed(inner.fixed), printed(inner.adaptive),
                  printed(variant.a), printed(variant.b_001), printed(variant.b_01)},
                 ours(0, 0.5, e)));
    }
  }

  /// Table 4.6. Ours, which have no such parameters, stand in rows of their own.
  void precision_factors() {
    constexpr std::size_t first = 3;  // the table begins with n = 256
    std::printf("\nTable 4.6: l = 0, g = 0.5; products/iterations of variant A\n");
    examples::text_table const table({"r_tol", "c_fact", "n = 256", "n = 512", "n = 1024"}, 9);
    table.print_head();
    for (auto const& row : fem::thesis_table_4_6) {
      cells line{number(row.r_tol), number(row.c_fact)};
      for (auto const& entry : row.entries) line.push_back(printed(entry));
      table.print_row(line);
    }
    own_rows(table, first, row_size);
  }

  /// Table 4.7.
  void penalties() {
    constexpr std::size_t entry = 4;
    std::printf("\nTable 4.7: n = 512, l = 0, g = 0.5; products/iterations of variant A\n");
    cells head{"r_tol"};
    for (double const ρ : fem::thesis_table_4_7_penalties) head.push_back("ρ = " + number(ρ));
    examples::text_table const table(head, 9);
    table.print_head();
    for (auto const& row : fem::thesis_table_4_7) {
      cells line{number(row.r_tol)};
      for (auto const& work : row.entries) line.push_back(printed(work));
      table.print_row(line);
    }
    own_rows(table, entry, 1);
  }

 private:
  static constexpr std::size_t row_size = 3;

  [[nodiscard]] static cells our_names() { return examples::names_of(methods()); }
  /// What each method did, from zero and nested; also judges.
  [[nodiscard]] cells ours(double l, double g, std::size_t e) {
    cells result;
    auto const add = [&](std::vector<counted_run> const& runs, bool ours) {
      result.push_back(e < runs.size() ? judged(runs[e], ours, l, g, e) : "-");
    };
    for (auto const& method : runs_.of(l, g)) {
      add(method.from_zero, method.ours);
      if (method.ours) add(method.nested, true);
    }
    return result;
  }
  [[nodiscard]] std::string judged(counted_run const& entry, bool ours, double l, double g,
                                   std::size_t e) {
    bool const same = !has_counts(l, g, e) || entry.counts == counts(l, g, e);
    right_ = right_ && (!ours || (entry.run.converged() && same));
    return products_and_steps(entry.run) + (same || !entry.run.converged() ? "" : "!");
  }
  /// Printed counts, ours, the printed entry, our columns.
  [[nodiscard]] cells with_counts(double l, double g, std::size_t e, std::string const& entry) {
    int const m = fem::wire_counts::m(e);
    auto const& all = runs_.of(l, g);
    auto const last =
        std::find_if(all.rbegin(), all.rend(), [](auto const& method) { return method.ours; });
    auto const& found = last->nested;
    return joined({has_counts(l, g, e) ? ratios(counts(l, g, e), m) : "-",
                   e < found.size() ? ratios(found[e].counts, m) : "-", entry},
                  ours(l, g, e));
  }
  /// For tables of the parameters of a method: other methods below, `count` meshes from `first` on.
  void own_rows(examples::text_table const& table, std::size_t first, std::size_t count) {
    auto const names = our_names();
    for (std::size_t column = 0; column < names.size(); ++column) {
      cells line;
      for (std::size_t e = first; e < std::min(first + count, meshes_); ++e)
        line.push_back(ours(0, 0.5, e)[column]);
      if (!line.empty()) table.print_row(joined({names[column]}, line));
    }
  }

  [[nodiscard]] static fem::wire_counts const* row_of(double l, double g) {
    auto const& all = fem::printed_wire_counts;
    auto const* const found = std::find_if(
        all.begin(), all.end(), [&](auto const& row) { return row.l == l && row.g == g; });
    return found == all.end() ? nullptr : found;
  }
  [[nodiscard]] static bool has_counts(double l, double g, std::size_t e) {
    auto const* const row = row_of(l, g);
    return row != nullptr && row->bounds[e] != fem::wire_counts::not_printed;
  }
  [[nodiscard]] static fem::active_counts counts(double l, double g, std::size_t e) {
    auto const* const row = row_of(l, g);
    return {row->bounds[e], row->circles[e]};
  }

  wire_runs& runs_;
  std::size_t meshes_;
  bool right_ = true;
};

}  // namespace wire_tables
