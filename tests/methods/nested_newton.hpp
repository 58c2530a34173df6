// SPDX-License-Identifier: MIT
//
// Nested iteration on the wire [T §4.1]: Newton's method on every mesh from n = 32 on.
#pragma once

#include <slant/slant.hpp>

#include <fem/active_counts.hpp>
#include <fem/wire_counts.hpp>
#include <fem/wire_prolongation.hpp>
#include <ranges>
#include <support/testing.hpp>

namespace test {

/// One mesh.
class wire_level {
 public:
  wire_level(fem::wire_counts const& row, std::size_t entry)
      : wire_(fem::make_wire(row.m(entry))),
        set_(slant::cartesian(slant::half_lines(VectorXd::Constant(wire_.m, row.l).eval()),
                              slant::discs(VectorXd::Constant(wire_.m, row.g).eval()),
                              slant::free_components(wire_.m))) {
    if (entry > 0) P_ = fem::wire_prolongation(fem::make_wire(row.m(entry - 1)), wire_);
  }
  /// ρ = 1/diag A = h/2.
  auto method() const {
    auto A = slant::matrix<slant::self_adjoint, slant::positive_definite>(wire_.A);
    return slant::semismooth_newton{
        slant::natural_residual(std::move(A), wire_.b, set_, wire_.h() / 2),
        slant::sparse_direct_solver{}};
  }
  static auto stop() { return slant::residual_below(1e-10) || slant::at_most(100); }
  auto prolongation() const { return slant::matrix(P_); }

  fem::active_counts count(VectorXd const& x) const {
    return fem::count_active(set_, wire_.A, wire_.b, x);
  }

 private:
  fem::wire<> wire_;
  decltype(slant::cartesian(slant::half_lines(VectorXd()), slant::discs(VectorXd()),
                            slant::free_components(1))) set_;
  Eigen::SparseMatrix<double> P_;
};

/// At most 6 steps on each of the first meshes, to the printed active sets, in every cell of
/// [T Tables 4.1–4.3].
inline void check_nested_newton(std::size_t meshes) {
  for (auto const& row : fem::printed_wire_counts) {
    auto const levels = std::views::iota(std::size_t(0), meshes) |
                        std::views::transform([&](std::size_t e) { return wire_level(row, e); });
    auto const nested = slant::solve_nested(levels, test::zeros(32));
    REQUIRE(nested.levels.size() == meshes);
    for (std::size_t e = 0; e < meshes; ++e) {
      CAPTURE(row.l);
      CAPTURE(row.g);
      CAPTURE(row.unknowns(e));
      CHECK(nested.levels[e].converged());
      CHECK(nested.levels[e].iterations() <= 6);
      CHECK(levels[e].count(nested.levels[e].x()) ==
            fem::active_counts{row.bounds[e], row.circles[e]});
    }
  }
}

}  // namespace test
