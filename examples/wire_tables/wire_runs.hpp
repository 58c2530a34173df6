// SPDX-License-Identifier: MIT
//
// Runs of all methods on one wire over all mesh sizes, from zero and by nested iteration.
#pragma once

#include <cstddef>
#include <fem/active_counts.hpp>
#include <fem/string_1d.hpp>
#include <fem/thesis_tables.hpp>
#include <fem/wire_prolongation.hpp>
#include <map>
#include <ranges>
#include <slant/factorizations/ldlt.hpp>
#include <slant/iteration/nested.hpp>
#include <slant/operators/inverse.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/problems/separable_qp.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>
#include <support/measured.hpp>
#include <utility>
#include <vector>

#include "methods.hpp"

namespace wire_tables {

struct settings {
  int largest = 512;  ///< unknowns of the finest mesh
  examples::run_limits limits{.tolerance = 1e-9, .max_iterations = 1000000};
};

/// Numbers of meshes n = 32, 64, … up to the largest.
[[nodiscard]] inline std::size_t mesh_count(settings const& s) {
  std::size_t count = 0;
  while (count < fem::wire_sizes.size() && fem::wire_sizes[count] <= s.largest) ++count;
  return count;
}

/// The wire on one mesh as a level of nested iteration, for one of the methods. A and b are those
/// of [T], h times those of the elements: A = tridiag(−1, 2, −1), σ_max(A) < 4.
template <class Method>
class wire_level {
 public:
  wire_level(Method const& method, std::size_t entry, double l, double g, settings const& s)
      : method_(method),
        limits_(s.limits),
        wire_(fem::make_wire(fem::wire_sizes[entry] / 4)),
        set_(slant::cartesian(slant::half_lines(Eigen::VectorXd::Constant(wire_.m, l).eval()),
                              slant::discs(Eigen::VectorXd::Constant(wire_.m, g).eval()),
                              slant::free_components(wire_.m))) {
    wire_.b *= wire_.h();
    wire_.A *= wire_.h();
    if (entry > 0)
      P_ = fem::wire_prolongation(fem::make_wire(fem::wire_sizes[entry - 1] / 4), wire_);
  }
  wire_level(wire_level const&) = delete;
  wire_level& operator=(wire_level const&) = delete;

  [[nodiscard]] auto method() const { return method_.make(*this); }
  [[nodiscard]] auto qp() const {
    return slant::separable_qp{
        slant::matrix<slant::self_adjoint, slant::positive_definite>(wire_.A), wire_.b, set_};
  }
  [[nodiscard]] double sigma() const { return 4; }
  /// A⁻¹ itself, two bidiagonal sweeps.
  [[nodiscard]] auto preconditioner() const { return slant::inverse(slant::ldlt(wire_.A)); }
  [[nodiscard]] auto stop() const { return method_.stop(limits_); }
  [[nodiscard]] auto prolongation() const { return slant::matrix(P_); }

  [[nodiscard]] Eigen::VectorXd zero() const { return Eigen::VectorXd::Zero(4 * wire_.m); }
  [[nodiscard]] fem::active_counts count(Eigen::VectorXd const& x) const {
    return fem::count_active(set_, wire_.A, wire_.b, x);
  }

 private:
  using set_type =
      decltype(slant::cartesian(slant::half_lines(Eigen::VectorXd()),
                                slant::discs(Eigen::VectorXd()), slant::free_components(1)));
  Method const& method_;
  examples::run_limits limits_;
  fem::wire<> wire_;
  set_type set_;
  Eigen::SparseMatrix<double> P_;
};

/// A run and the constraints that are active in its result.
struct counted_run {
  examples::measured run;
  fem::active_counts counts;
};

/// What one method does on one wire, an entry for each mesh.
struct method_runs {
  std::vector<counted_run> from_zero{};
  std::vector<counted_run> nested{};
  bool ours = true;
  bool has_nested = true;
};

template <class Method>
[[nodiscard]] method_runs run_method(Method const& method, double l, double g, settings const& s) {
  method_runs runs{.ours = method.ours, .has_nested = method.nested};
  auto const levels =
      std::views::iota(std::size_t(0), mesh_count(s)) |
      std::views::transform([&](std::size_t e) { return wire_level<Method>(method, e, l, g, s); });
  for (auto const& level : levels) {
    auto const report = slant::solve(level.method(), level.zero(), level.stop());
    runs.from_zero.push_back({examples::measure(report), level.count(report.x())});
  }
  if (!method.nested) return runs;
  auto const nested = slant::solve_nested(levels, Eigen::VectorXd::Zero(fem::wire_sizes[0]).eval());
  for (std::size_t e = 0; e < nested.levels.size(); ++e) {
    auto const& report = nested.levels[e];
    runs.nested.push_back({examples::measure(report), levels[e].count(report.x())});
  }
  return runs;
}

/// Runs of all methods of a list, made when they are asked for and kept: the same wires stand in
/// many tables.
template <class Methods>
class wire_runs {
 public:
  wire_runs(Methods methods, settings const& s) : methods_(std::move(methods)), settings_(s) {}

  /// One entry per method.
  [[nodiscard]] std::vector<method_runs> const& of(double l, double g) {
    auto const [at, is_new] = runs_.try_emplace({l, g});
    if (is_new)
      examples::for_each_method(methods_, [&, &all = at->second](auto const& method) {
        all.push_back(run_method(method, l, g, settings_));
      });
    return at->second;
  }
  /// The names of the columns.
  [[nodiscard]] std::vector<std::string> names() const { return examples::names_of(methods_); }

 private:
  Methods methods_;
  settings settings_;
  std::map<std::pair<double, double>, std::vector<method_runs>> runs_{};
};

}  // namespace wire_tables
