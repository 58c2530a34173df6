// SPDX-License-Identifier: MIT
#include <slant/contact/primal_dual.hpp>
#include <slant/slant.hpp>

#include <stability/methods.hpp>
#include <stability/stopping.hpp>

namespace stability {

namespace {

template <class Solver, class Search, class Forcing>
outcome on_natural_residual(prepared const& p, request const& r) {
  auto const A = p.a();
  Eigen::VectorXd const x0 = p.start(r.start);
  auto const step = slant::mean_step(A, x0, 0.5);
  auto const F = slant::natural_residual(A, p.b(), p.set(), step.length);
  return run_until(
      slant::semismooth_newton{F, Solver{}, Search{}, Forcing{}}, x0, p, r,
      [&](Eigen::VectorXd const& x) { return Eigen::VectorXd(slant::project(p.set(), x)); });
}

outcome primal_dual(prepared const& p, request const& r) {
  auto const K = slant::matrix<slant::self_adjoint, slant::positive_definite>(p.source().K);
  slant::contact::primal_dual const contact(slant::contact::friction_disc{}, K, p.contact());
  auto const G = contact.function(p.source().K.diagonal().mean());
  Eigen::VectorXd const λ0 = p.start(r.start);
  Eigen::VectorXd y0(G.cols());
  y0 << p.answer(λ0), λ0;
  request sparse = r;  // its applications are products by a sparse matrix, where A solves with K
  sparse.applications *= 4;
  return run_until(
      slant::semismooth_newton{G, slant::bicgstab_solver{}, slant::halving_line_search{},
                               slant::adaptive_precision{}},
      y0, p, sparse, [&](Eigen::VectorXd const& y) {
        return Eigen::VectorXd(slant::project(p.set(), contact.multipliers(y)));
      });
}

template <class Solver>
outcome on_multipliers(prepared const& p, request const& r) {
  slant::separable_qp const qp{
      slant::matrix<slant::self_adjoint, slant::positive_definite>(p.dense()), p.b(), p.set()};
  slant::ssnm_options<double> options;
  double const mean = p.dense().diagonal().mean();
  options.rho = mean > 0 ? mean : 1;
  options.precision = {.r_tol = 0.1, .c_fact = 0.5};
  options.multipliers = slant::ssnm_multipliers::estimated;
  return run_until(
      slant::ssnm{qp, Solver{}, options}, p.start(r.start), p, r,
      [&](Eigen::VectorXd const& x) { return Eigen::VectorXd(slant::project(p.set(), x)); });
}

}  // namespace

std::span<method const> natural_methods() {
  static constexpr method list[]{
      {"semismooth_newton",
       on_natural_residual<slant::by_laws, slant::halving_line_search, slant::eisenstat_walker>},
      {"ssn",
       on_natural_residual<slant::bicgstab_solver, slant::full_step, slant::adaptive_precision>},
      {"ssn_primal_dual", primal_dual, scope::contact},
      {"ssnm_a", on_multipliers<slant::schur_bicgstab>},
      {"ssnm_b", on_multipliers<slant::bicgstab_solver>},
      {"ssnm_c", on_multipliers<slant::schur_cg>},
  };
  return list;
}

}  // namespace stability
