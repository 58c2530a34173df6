// SPDX-License-Identifier: MIT
//
// Total-FETI: a steel brick cut into more and more cubes of 4 × 4 × 4 cells (H/h = 4), solved by
// SMALSE-M around KPRGP and around the symmetric Newton method, the latter without preconditioner,
// with the lumped and with the Dirichlet preconditioner in the face; each of them also with Newton
// steps for the multipliers of G λ = e (marked by +):
//
//     total_feti [LOAD...]       press, pull, lift; without names: press and pull
//
// prints comma-separated values: outer steps, inner steps and products by F = B K⁺Bᵀ until reduced
// gradient and ‖G λ − e‖ are 1e-10; the difference of the displacements from those of the brick
// that is not cut; and that of the copies of a node from each other. Exit status 1 if a run does
// not converge, a difference exceeds 1e-8, or 16 to 64 subdomains take more than twice as many
// outer steps or products as the most that 2 to 8 take. With load lift half of the contact opens,
// and bodies lose what held them: only the runs with + are asked to converge, and in any number of
// steps.

#include <slant/contact/dirichlet_preconditioner.hpp>
#include <slant/contact/preconditioner.hpp>
#include <slant/contact/total_feti.hpp>
#include <slant/contact/tresca.hpp>
#include <slant/iteration/feasible.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/smalse.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/operators/any_operator.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <fem/decomposed_brick.hpp>
#include <map>
#include <string>
#include <support/floating_parts.hpp>
#include <vector>

namespace {

using vector = Eigen::VectorXd;
using sparse = Eigen::SparseMatrix<double>;
using preconditioner =
    slant::any_operator<vector, slant::laws<slant::self_adjoint, slant::positive_semidefinite>>;

constexpr int cells = 4;
constexpr std::array<std::array<int, 3>, 7> all_cuts{
    {{2, 1, 1}, {2, 2, 1}, {2, 2, 2}, {4, 2, 2}, {3, 3, 3}, {4, 4, 2}, {4, 4, 4}}};

struct run {
  std::string method;
  slant::index outer = 0, inner = 0, products = 0;
  bool converged = false;
  double difference = 0, jump = 0;
};

/// All methods on one brick.
template <class Friction>
std::vector<run> run_all(Friction friction, fem::decomposed_brick const& b,
                         slant::contact::data<double> const& whole,
                         slant::contact::data<double> const& cut) {
  auto const factor = slant::factorize(b.scene.K);
  slant::contact::dual const dual(friction, factor, whole);
  auto const reference = slant::solve(slant::symmetric_newton{dual.qp()}, dual.zero(),
                                      slant::reduced_gradient_below(1e-12) || slant::at_most(200));
  vector const expected = dual.displacement(reference.x());

  auto const bodies = examples::floating_parts(b.parts);
  slant::contact::total_feti const problem(friction, bodies, cut);
  auto const qp = problem.qp();
  std::vector<run> runs;
  auto const solve = [&](std::string name, auto options, bool newton_multipliers) {
    options.newton_multipliers = newton_multipliers;
    slant::smalse const method{qp, problem.constraints(), options};
    auto const r =
        slant::solve(method, problem.zero(),
                     (slant::reduced_gradient_below(1e-10) && slant::feasibility_below(1e-10)) ||
                         slant::at_most(200));
    vector const u = problem.displacement(r.x(), method.multipliers(r.state));
    runs.push_back({std::move(name), r.iterations(), r.state.work.inner_iterations,
                    r.state.work.operator_applications, r.converged() && reference.converged(),
                    (b.parts.mean * u - expected).norm() / expected.norm(),
                    (b.parts.glue * u).norm() / u.norm()});
  };
  auto const add = [&](std::string const& name, auto const& options) {
    solve(name, options, false);
    solve(name + "+", options, true);
  };
  sparse const K = slant::contact::block_stiffness(bodies);
  preconditioner const lumped(slant::contact::lumped_preconditioner(K, problem.rows()));
  preconditioner const dirichlet(slant::contact::dirichlet_preconditioner(K, problem.rows()));
  using preconditioned = slant::smalse_options<double, slant::newton_inner<double, preconditioner>>;
  add("kprgp", slant::smalse_options<double>{});
  add("newton", slant::smalse_options<double, slant::newton_inner<double>>{});
  add("newton_lumped", preconditioned{.inner = {.preconditioner = &lumped}});
  add("newton_dirichlet", preconditioned{.inner = {.preconditioner = &dirichlet}});
  return runs;
}

std::vector<run> run_brick(fem::decomposed_brick const& b, bool friction) {
  auto const whole = examples::contact_data(b.scene, friction);
  auto const cut = examples::contact_data(b.scene, b.parts, friction);
  if (friction) return run_all(slant::contact::friction_disc{}, b, whole, cut);
  return run_all(slant::contact::frictionless{}, b, whole, cut);
}

/// One load with all cuts; false if a run misses a limit.
bool table(fem::brick_load load, bool friction) {
  bool good = true;
  std::map<std::string, std::array<slant::index, 2>> few;  // the most of up to 8 subdomains
  for (auto const& cuts : all_cuts) {
    auto const b = fem::make_decomposed_brick({.cubes = cuts, .cells = cells, .load = load});
    int const count = cuts[0] * cuts[1] * cuts[2];
    for (auto const& r : run_brick(b, friction)) {
      std::printf("%s,%s,%d,%ld,%ld,%s,%ld,%ld,%ld,%.1e,%.1e,%s\n",
                  std::string(fem::name_of(load)).c_str(), friction ? "tresca" : "none", count,
                  static_cast<long>(b.parts.unknowns()),
                  static_cast<long>(b.parts.glue.rows() + b.parts.N.rows() +
                                    (friction ? b.parts.T.rows() : 0)),
                  r.method.c_str(), static_cast<long>(r.outer), static_cast<long>(r.inner),
                  static_cast<long>(r.products), r.difference, r.jump, r.converged ? "yes" : "no");
      std::fflush(stdout);
      bool const exact = r.converged && r.difference <= 1e-8 && r.jump <= 1e-8;
      if (load == fem::brick_load::lift) {
        good = good && (exact || r.method.back() != '+');
        continue;
      }
      auto& [outer, products] = few[r.method];
      if (count <= 8) {
        outer = std::max(outer, r.outer);
        products = std::max(products, r.products);
      }
      good = good && exact && r.outer <= 2 * std::max<slant::index>(outer, 3) &&
             r.products <= 2 * products;
    }
  }
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<fem::brick_load> loads;
  for (int i = 1; i < argc; ++i) {
    auto const load = fem::brick_load_named(argv[i]);
    if (!load) {
      std::fprintf(stderr, "total_feti: no load %s; there are press, pull, lift\n", argv[i]);
      return 2;
    }
    loads.push_back(*load);
  }
  if (loads.empty()) loads = {fem::brick_load::press, fem::brick_load::pull};
  std::printf(
      "load,friction,subdomains,unknowns,multipliers,method,outer_steps,inner_steps,products,"
      "difference,jump,converged\n");
  bool good = true;
  for (auto const load : loads)
    for (bool const friction : {false, true}) good = table(load, friction) && good;
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
