// SPDX-License-Identifier: MIT
#include "methods.hpp"

#include <slant/methods/ssnm.hpp>
#include <slant/newton/krylov_solvers.hpp>
#include <slant/newton/saddle_solvers.hpp>

namespace random_programs {

namespace {

template <class Solver>
outcome on_multipliers(prepared const& p, request const& r) {
  slant::ssnm_options<double> options;
  options.rho = p.p.A.diagonal().mean();
  options.precision = {.r_tol = 0.1, .c_fact = 0.5};
  options.multipliers = slant::ssnm_multipliers::estimated;
  return run_from_zero(slant::ssnm{p.qp, Solver{}, options}, p, r);
}

}  // namespace

std::span<method const> multiplier_methods() {
  static constexpr method list[]{{"ssnm_a", on_multipliers<slant::schur_bicgstab>},
                                 {"ssnm_b", on_multipliers<slant::bicgstab_solver>},
                                 {"ssnm_c", on_multipliers<slant::schur_cg>}};
  return list;
}

}  // namespace random_programs
