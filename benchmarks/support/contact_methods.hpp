// SPDX-License-Identifier: MIT
//
// Our methods for contact with friction, by name: a line of `contact_methods` is all that a further
// one takes. Each starts from the matrices of the scene, those without factors also from the
// coordinates of nodes or prolongations, and ends with the displacements.
#pragma once

#include <slant/contact/contact_data.hpp>
#include <slant/contact/dual.hpp>
#include <slant/contact/node_layout.hpp>
#include <slant/contact/preconditioners.hpp>
#include <slant/contact/solve.hpp>
#include <slant/factorizations/static_condensation.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/interior_point.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/methods/mssn.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/methods/unconstrained_start.hpp>
#include <tuple>
#include <utility>

#include "contact_case.hpp"
#include "precision_table.hpp"

namespace benchmarks {

/// run(contact_case, request) → outcome whose x are displacements.
template <class Run>
struct contact_method {
  char const* name;
  char const* formulation;
  Run run;
};
template <class Run>
contact_method(char const*, char const*, Run) -> contact_method<Run>;

/// A method on the dual problem, A = B K⁻¹Bᵀ by triangular sweeps; solve(dual, K, request) →
/// report.
template <class Solve>
[[nodiscard]] auto by_sweeps(char const* name, Solve solve) {
  auto run = [solve](auto const& c, request const& asked) {
    contact_setup const setup(c);
    auto const& dual = setup.dual();
    auto const report = solve(dual, c.scene.K, asked);
    if constexpr (requires { report.state; }) {
      return outcome{dual.displacement(report.x()), all_products(report.state.work),
                     status_name(report.status)};
    } else {  // of two methods, one after the other
      return outcome{dual.displacement(report.x()), all_products(report.work()),
                     status_name(report.status())};
    }
  };
  return contact_method{name, "dual by sweeps", run};
}

/// Accuracy that the last Newton step need not exceed, and the largest inner tolerance.
[[nodiscard]] inline auto newton_options(request const& asked, double largest_inner = 0.5) {
  slant::symmetric_newton_options<double> o;
  o.forcing.goal = asked.tolerance;
  o.forcing.η_max = largest_inner;
  o.forcing.η_first = std::min(largest_inner, o.forcing.η_first);
  return o;
}

/// The way of README.md: condensation, start from the unconstrained minimum, symmetric Newton.
struct condensed_newton {
  template <class Case>
  outcome operator()(Case const& c, request const& asked) const {
    auto const data = c.data();
    slant::static_condensation const factor(c.scene.K, slant::contact::contact_unknowns(data));
    slant::contact::dual const dual(typename Case::friction{}, factor, data);
    auto const M = slant::contact::lumped_preconditioner(c.scene.K, dual.constraints());
    auto const qp = dual.qp();
    auto const start = slant::unconstrained_start(qp, M);
    auto const report =
        slant::solve(slant::symmetric_newton{qp, M, newton_options(asked)}, start.x, asked.stop());
    return {dual.displacement(report.x()), start.applications + all_products(report.state.work),
            status_name(report.status)};
  }
};

/// contact::solve by multigrid for the displacements, K never factored; the tolerance is that of
/// the certified error. Levels by aggregation, or `nested`: those of the case, if it has any.
struct multigrid_newton {
  bool nested;

  template <class Case>
  [[nodiscard]] bool fits(Case const& c) const {
    return !nested || !c.nested.empty();
  }
  template <class Case>
  outcome operator()(Case const& c, request const& asked) const {
    slant::contact::solve_options<double> o{.tolerance = asked.tolerance};
    o.route = slant::contact::solution_route::iterate;
    if (nested) {
      o.multigrid.prolongations = c.nested;
    } else {
      o.layout = slant::contact::layout_of(c.scene.mesh.nodes, c.scene.unknowns.first);
    }
    auto const s = slant::contact::solve(typename Case::friction{}, c.scene.K, c.data(), o);
    return {s.u, all_products(s.work), status_name(s.status)};
  }
};

[[nodiscard]] inline auto contact_methods() {
  using slant::contact::dirichlet_preconditioner, slant::contact::lumped_preconditioner;
  return std::tuple{
      contact_method{"multigrid", "displacements", multigrid_newton{.nested = false}},
      contact_method{"multigrid_nested", "displacements", multigrid_newton{.nested = true}},
      contact_method{"condensed_newton", "dual by condensation", condensed_newton{}},
      by_sweeps("symmetric_newton",
                [](auto const& dual, auto const&, request const& r) {
                  return slant::solve(slant::symmetric_newton{dual.qp(), newton_options(r)},
                                      dual.zero(), r.stop());
                }),
      by_sweeps("symmetric_newton_lumped",
                [](auto const& dual, auto const& K, request const& r) {
                  return slant::solve(
                      slant::symmetric_newton{dual.qp(),
                                              lumped_preconditioner(K, dual.constraints()),
                                              newton_options(r)},
                      dual.zero(), r.stop());
                }),
      by_sweeps("symmetric_newton_dirichlet",
                [](auto const& dual, auto const& K, request const& r) {
                  return slant::solve(
                      slant::symmetric_newton{dual.qp(),
                                              dirichlet_preconditioner(K, dual.constraints()),
                                              newton_options(r, 0.1)},
                      dual.zero(), r.stop());
                }),
      by_sweeps("interior_point",
                [](auto const& dual, auto const& K, request const& r) {
                  return slant::solve(slant::interior_point{dual.qp(), lumped_preconditioner(
                                                                           K, dual.constraints())},
                                      dual.zero(), r.stop());
                }),
      by_sweeps("interior_then_newton",
                [](auto const& dual, auto const& K, request const& r) {
                  auto const qp = dual.qp();
                  auto const M = lumped_preconditioner(K, dual.constraints());
                  auto const newton = [&](auto const& s) {
                    auto o = newton_options(r);
                    o.step_length = s.step_length;
                    return slant::symmetric_newton{qp, M, o};
                  };
                  request const handover{0.1, r.deadline};
                  return slant::solve_then(slant::interior_point{qp, M}, handover.stop(), newton,
                                           dual.zero(), r.stop());
                }),
      by_sweeps("kprgp",
                [](auto const& dual, auto const&, request const& r) {
                  return slant::solve(slant::kprgp{dual.qp()}, dual.zero(), r.stop());
                }),
      by_sweeps("imssn",
                [](auto const& dual, auto const&, request const& r) {
                  return slant::solve(slant::imssn{dual.qp()}, dual.zero(), r.stop());
                }),
      by_sweeps("gimssn", [](auto const& dual, auto const&, request const& r) {
        return slant::solve(slant::gimssn{dual.qp()}, dual.zero(), r.stop());
      })};
}

}  // namespace benchmarks
