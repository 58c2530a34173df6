// SPDX-License-Identifier: MIT
#include "methods.hpp"

#include <slant/krylov/spectrum.hpp>
#include <slant/newton/krylov_solvers.hpp>
#include <slant/newton/semismooth_newton.hpp>
#include <slant/slanting/projection.hpp>

namespace random_programs {

namespace {

template <class Solver, class Search, class Forcing>
outcome on_natural_residual(prepared const& p, request const& r) {
  auto const step = slant::mean_step(p.qp.a(), p.qp.b(), 0.5);
  auto const F = slant::natural_residual(p.qp.a(), p.qp.b(), p.qp.set(), step.length);
  return run_from_zero(slant::semismooth_newton{F, Solver{}, Search{}, Forcing{}}, p, r);
}

}  // namespace

std::span<method const> natural_methods() {
  static constexpr method list[]{
      {"semismooth_newton",
       on_natural_residual<slant::by_laws, slant::halving_line_search, slant::eisenstat_walker>},
      {"ssn",
       on_natural_residual<slant::bicgstab_solver, slant::full_step, slant::adaptive_precision>}};
  return list;
}

}  // namespace random_programs
