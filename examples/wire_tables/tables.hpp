// SPDX-License-Identifier: MIT
//
// Tables 4.1–4.8 of the thesis, its columns and ours.
#pragma once

#include <algorithm>
#include <cstdio>
#include <fem/thesis_ssnm_start.hpp>
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
  explicit table_printer(settings const& s)
      : ours_(our_methods(), s),
        direct_(direct_methods(), s),
        variants_(variant_methods(), s),
        meshes_(mesh_count(s)) {}

  [[nodiscard]] bool right() const { return right_; }

  /// Tables 4.1 and 4.2.
  template <class Rows>
  void ssnm(char const* title, Rows const& rows) {
    std::printf("\n%s\n", title);
    examples::text_table const table(joined({"l", "g", "n", "printed counts", "our counts", "SSNM"},
                                            joined(direct_.names(), ours_.names())));
    table.print_head();
    for (auto const& row : rows)
      for (std::size_t e = 0; e < meshes_; ++e)
        table.print_row(
            joined({number(row.l), number(row.g), number(fem::wire_sizes[e])},
                   joined(counts_and(row.l, row.g, e, printed(row.iterations[e])),
                          joined(did(direct_, row.l, row.g, e), did(ours_, row.l, row.g, e)))));
  }

  /// Tables 4.3 and 4.4.
  template <class Rows>
  void after_qpc(char const* title, Rows const& rows) {
    std::printf("\n%s\n", title);
    examples::text_table const table(
        joined({"g", "n", "printed counts", "our counts", "SSNM(QPC)", "(KPRGP)"}, ours_.names()));
    table.print_head();
    for (auto const& row : rows)
      for (std::size_t e = 0; e < meshes_; ++e)
        table.print_row(joined(
            {number(row.g), number(fem::wire_sizes[e])},
            joined(joined(counts_and(0, row.g, e, printed(row.entries[e])), {started(row.g, e)}),
                   did(ours_, 0, row.g, e))));
  }

  /// Tables 4.5 and 4.8.
  void variants() {
    std::printf(
        "\nTables 4.5 and 4.8: l = 0, g = 0.5; printed products/iterations of variants A and B\n");
    examples::text_table const table(
        joined({"n", "A fixed", "adaptive", "A 0.01", "B 0.01", "B 0.1"},
               joined(variants_.names(), ours_.names())));
    table.print_head();
    for (std::size_t e = 0; e < meshes_; ++e) {
      auto const& inner = fem::thesis_table_4_5[e];
      auto const& variant = fem::thesis_table_4_8[e];
      table.print_row(
          joined({number(fem::wire_sizes[e]), printed(inner.fixed), printed(inner.adaptive),
                  printed(variant.a), printed(variant.b_001), printed(variant.b_01)},
                 joined(did(variants_, 0, 0.5, e), did(ours_, 0, 0.5, e))));
    }
  }

  /// Table 4.6; methods without such parameters stand in rows of their own.
  void precision_factors() {
    constexpr std::size_t first = 3;  // the table begins with n = 256
    std::printf(
        "\nTable 4.6: l = 0, g = 0.5; products/iterations of variant A, printed and ours\n");
    cells head{"r_tol", "c_fact"};
    for (std::size_t e = first; e < first + 3; ++e)
      head = joined(head, {"n = " + number(fem::wire_sizes[e]), "ours"});
    examples::text_table const table(head, 9);
    table.print_head();
    for (auto const& row : fem::thesis_table_4_6) {
      cells line{number(row.r_tol), number(row.c_fact)};
      for (std::size_t e = first; e < first + 3; ++e)
        line =
            joined(line, {printed(row.entries[e - first]), variant_a(e, 1, row.r_tol, row.c_fact)});
      table.print_row(line);
    }
    own_rows(table, {"", ""}, first, 3);
  }

  /// Table 4.7.
  void penalties() {
    constexpr std::size_t entry = 4;
    std::printf(
        "\nTable 4.7: n = 512, l = 0, g = 0.5; products/iterations of variant A, printed and "
        "ours\n");
    cells head{"r_tol"};
    for (double const ρ : fem::thesis_table_4_7_penalties)
      head = joined(head, {"ρ = " + number(ρ), "ours"});
    examples::text_table const table(head, 9);
    table.print_head();
    for (auto const& row : fem::thesis_table_4_7) {
      cells line{number(row.r_tol)};
      for (std::size_t i = 0; i < row.entries.size(); ++i)
        line = joined(line, {printed(row.entries[i]),
                             variant_a(entry, fem::thesis_table_4_7_penalties[i], row.r_tol, 0.9)});
      table.print_row(line);
    }
    own_rows(table, {""}, entry, 1);
  }

 private:
  /// What each method of a list did, from zero and nested; judges ours.
  template <class Runs>
  [[nodiscard]] cells did(Runs& list, double l, double g, std::size_t e) {
    cells result;
    auto const add = [&](std::vector<counted_run> const& runs, bool ours) {
      result.push_back(e < runs.size() ? judged(runs[e], ours, l, g, e) : "-");
    };
    for (auto const& method : list.of(l, g)) {
      add(method.from_zero, method.ours);
      if (method.has_nested) add(method.nested, method.ours);
    }
    return result;
  }
  [[nodiscard]] std::string judged(counted_run const& entry, bool ours, double l, double g,
                                   std::size_t e) {
    bool const same = !has_counts(l, g, e) || entry.counts == counts(l, g, e);
    right_ = right_ && (!ours || (entry.run.converged() && same));
    if (!ours && !entry.run.converged()) return "×";
    return products_and_steps(entry.run) + (same || !entry.run.converged() ? "" : "!");
  }
  /// Printed counts, those of the last of our methods, the printed entry.
  [[nodiscard]] cells counts_and(double l, double g, std::size_t e, std::string const& entry) {
    int const m = fem::wire_counts::m(e);
    auto const& found = ours_.of(l, g).back().nested;
    return {has_counts(l, g, e) ? ratios(counts(l, g, e), m) : "-",
            e < found.size() ? ratios(found[e].counts, m) : "-", entry};
  }
  /// SSNM from the result of a first-order method.
  [[nodiscard]] static std::string started(double g, std::size_t e) {
    auto const r = fem::run_started_wire_ssnm(fem::make_thesis_wire(fem::wire_sizes[e] / 4), 0, g);
    if (!r.run.converged()) return "×";
    return printed(fem::ssnm_after_qpc{static_cast<int>(r.run.iterations),
                                       static_cast<int>(r.first_phase), r.accuracy});
  }
  /// Variant A on the wire l = 0, g = 0.5 with these parameters, if the mesh is asked for.
  [[nodiscard]] std::string variant_a(std::size_t e, double ρ, double r_tol, double c_fact) const {
    if (e >= meshes_) return "-";
    auto const method =
        wire_tables::ssnm("A", slant::schur_bicgstab{}, fem::thesis_options(ρ, r_tol, c_fact));
    wire_level const level(method, e, 0, 0.5, {});
    auto const report = slant::solve(level.method(), level.zero(), level.stop());
    return report.converged() ? products_and_steps(examples::measure(report)) : "×";
  }
  /// For tables of the parameters of a method: ours below, `count` meshes from `first` on.
  void own_rows(examples::text_table const& table, cells const& blank, std::size_t first,
                std::size_t count) {
    auto const names = ours_.names();
    for (std::size_t column = 0; column < names.size(); ++column) {
      cells line = blank;
      for (std::size_t e = first; e < std::min(first + count, meshes_); ++e)
        line = joined(line, {"", did(ours_, 0, 0.5, e)[column]});
      line.push_back(names[column]);
      if (first < meshes_) table.print_row(line);
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

  wire_runs<decltype(our_methods())> ours_;
  wire_runs<decltype(direct_methods())> direct_;
  wire_runs<decltype(variant_methods())> variants_;
  std::size_t meshes_;
  bool right_ = true;
};

}  // namespace wire_tables
