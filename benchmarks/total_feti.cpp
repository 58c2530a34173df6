// SPDX-License-Identifier: MIT
//
// Total-FETI: a steel brick cut into more and more cubes of 4 × 4 × 4 cells (H/h = 4), solved by
// the semismooth Newton method for multipliers and their equilibrium together (constrained_newton),
// without preconditioner, with the lumped and with the Dirichlet preconditioner in the face; and by
// SMALSE-M around KPRGP:
//
//     total_feti [LOAD...]       press, pull, lift; without names: all
//
// prints comma-separated values: outer steps, inner steps (of conjugate gradients in the face; of
// KPRGP) and products by F = B K⁺Bᵀ, those of the start too, until reduced gradient and ‖G λ − e‖
// are 1e-10; the difference of the displacements from those of the brick that is not cut; and that
// of the copies of a node from each other. With load lift half of the contact opens, and bodies
// lose what held them. Exit status 1 if a run of Newton's method does not converge or exceeds its
// limits of outer and inner steps, which are the same for 2 and for 64 subdomains; if its
// displacements differ by more than 1e-8; or if SMALSE-M does so with press or pull. With lift no
// number of steps is asked of SMALSE-M.

#include <slant/contact/dual.hpp>
#include <slant/contact/preconditioners.hpp>
#include <slant/contact/total_feti.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/iteration/stopping.hpp>
#include <slant/methods/constrained_newton.hpp>
#include <slant/methods/smalse.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/operators/any_operator.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <fem/decomposed_brick.hpp>
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
  auto const add = [&](std::string name, auto const& method) {
    auto const r =
        slant::solve(method, problem.zero(),
                     (slant::reduced_gradient_below(1e-10) && slant::feasibility_below(1e-10)) ||
                         slant::at_most(200));
    vector const u = problem.displacement(r.x(), method.multipliers(r.state));
    runs.push_back({std::move(name), r.iterations(), r.state.work.inner_iterations,
                    r.state.work.operator_applications + r.state.work.setup_applications,
                    r.converged() && reference.converged(),
                    (b.parts.mean * u - expected).norm() / expected.norm(),
                    (b.parts.glue * u).norm() / u.norm()});
  };
  sparse const K = slant::contact::block_stiffness(bodies);
  auto const newton = [&](std::string name, preconditioner const& M) {
    add(std::move(name), slant::constrained_newton{qp, problem.constraints(), M});
  };
  add("newton", slant::constrained_newton{qp, problem.constraints()});
  newton("newton_lumped", preconditioner(slant::contact::lumped_preconditioner(K, problem.rows())));
  newton("newton_dirichlet",
         preconditioner(slant::contact::dirichlet_preconditioner(K, problem.rows())));
  add("smalse", slant::smalse{qp, problem.constraints()});
  return runs;
}

std::vector<run> run_brick(fem::decomposed_brick const& b, bool friction) {
  auto const whole = examples::contact_data(b.scene, friction);
  auto const cut = examples::contact_data(b.scene, b.parts, friction);
  if (friction) return run_all(slant::contact::friction_disc{}, b, whole, cut);
  return run_all(slant::contact::frictionless{}, b, whole, cut);
}

/// The most outer and inner steps that a method may take, whatever the number of subdomains.
struct limits {
  slant::index outer, inner;
};
limits limits_of(fem::brick_load load, std::string const& method) {
  bool const opens = load == fem::brick_load::lift;
  if (method == "newton") return {opens ? 20 : 10, 220};
  if (method == "newton_lumped") return {opens ? 20 : 10, 150};
  if (method == "newton_dirichlet") return {opens ? 20 : 10, opens ? 110 : 60};
  return {40, 1200};
}

/// One load with all cuts; false if a run misses a limit.
bool table(fem::brick_load load, bool friction) {
  bool good = true;
  for (auto const& cuts : all_cuts) {
    auto const b = fem::make_decomposed_brick({.cubes = cuts, .cells = cells, .load = load});
    int const count = cuts[0] * cuts[1] * cuts[2];
    for (auto const& r : run_brick(b, friction)) {
      bool const exact = r.converged && r.difference <= 1e-8 && r.jump <= 1e-8;
      auto const most = limits_of(load, r.method);
      bool const within = exact && r.outer <= most.outer && r.inner <= most.inner;
      bool const asked = load != fem::brick_load::lift || r.method != "smalse";
      good = good && (within || !asked);
      std::printf("%s,%s,%d,%ld,%ld,%s,%ld,%ld,%ld,%.1e,%.1e,%s,%s\n",
                  std::string(fem::name_of(load)).c_str(), friction ? "tresca" : "none", count,
                  static_cast<long>(b.parts.unknowns()),
                  static_cast<long>(b.parts.glue.rows() + b.parts.N.rows() +
                                    (friction ? b.parts.T.rows() : 0)),
                  r.method.c_str(), static_cast<long>(r.outer), static_cast<long>(r.inner),
                  static_cast<long>(r.products), r.difference, r.jump, r.converged ? "yes" : "no",
                  within ? "yes" : "no");
      std::fflush(stdout);
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
  if (loads.empty()) loads = {fem::brick_load::press, fem::brick_load::pull, fem::brick_load::lift};
  std::printf(
      "load,friction,subdomains,unknowns,multipliers,method,outer_steps,inner_steps,products,"
      "difference,jump,converged,within_limits\n");
  bool good = true;
  for (auto const load : loads)
    for (bool const friction : {false, true}) good = table(load, friction) && good;
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
