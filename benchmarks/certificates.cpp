// SPDX-License-Identifier: MIT
//
// What a certificate says and costs: the error that is claimed over the true one, and the share of
// the certificate in a solve. One thread.
//
//   bench_certificates [K…]      without K: 4 6 8 12; and generic quadratic programs
//
// Bricks, at the end of contact::solve. true_error: relative, in the energy norm, beside a run with
// tolerance 0. extended, newton, proven: claimed over true with the extension of the reduced
// gradient into the body, with the Newton step (twelve iterations at most), and with a proof.
// share: seconds of a certificate of its own (matrices of the certificate, one solve with K,
// residuals, bound) over those of contact::solve, medians of runs side by side; solves: with K,
// products: with the dual operator, of the solve and in it of the certificate. expert_*:
// condensation, unconstrained_start, symmetric_newton with the largest threshold, of four a decade,
// that reaches the same true error; time_ratio: contact::solve over these lines.
//
// Generic programs: kprgp until energy_error_below. claimed over true with conjugate gradients from
// below (estimate) and, `proven`, with A⁻¹ in place of an operator that dominates it; share: of
// products by A.
//
// What is hoped for is extended <= 10, newton <= 3, share <= 0.05, time_ratio <= 1.05. Exit status
// 1 if a claim is below the true error, or a run does not converge.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Dense>
#include <fem/steel_brick.hpp>
#include <slant/certificates/energy_certificate.hpp>
#include <slant/certificates/energy_error.hpp>
#include <slant/contact/solve.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/operators/matrix.hpp>

#include "support/cpu_clock.hpp"

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
namespace contact = slant::contact;
using benchmarks::cpu_seconds;
using benchmarks::median;

bool missed = false;

double energy_norm(Eigen::SparseMatrix<double> const& K, VectorXd const& v) {
  return std::sqrt(v.dot(K * v));
}

struct expert_result {
  VectorXd u;
  double seconds = 0;
  long products = 0;
};

expert_result expert(fem::contact_scene<3> const& scene, contact::data<double> const& data,
                     double threshold) {
  expert_result r;
  double const begin = cpu_seconds();
  slant::static_condensation const factor(scene.K, contact::contact_unknowns(data));
  contact::dual const problem(contact::friction_disc{}, factor, data);
  auto const M = contact::lumped_preconditioner(scene.K, problem.constraints());
  auto const qp = problem.qp();
  auto const start = slant::unconstrained_start(qp, M);
  slant::symmetric_newton_options<> options;
  options.forcing.goal = threshold;
  auto const run = slant::solve(slant::symmetric_newton{qp, M, options}, start.x,
                                slant::reduced_gradient_below(threshold) || slant::at_most(500));
  r.u = problem.displacement(run.x());
  r.seconds = cpu_seconds() - begin;
  r.products =
      start.applications + run.state.work.operator_applications + run.state.work.setup_applications;
  return r;
}

void measure_brick(int k, fem::brick_load load) {
  auto const scene = fem::make_steel_brick({.k = k, .load = load});
  contact::data<double> const data{scene.N, scene.T, scene.f, scene.d, scene.g};
  contact::friction_disc const law;
  VectorXd const exact = contact::solve(law, scene.K, data, {.tolerance = 0}).u;
  double const size = energy_norm(scene.K, exact);
  auto const error_of = [&](VectorXd const& u) { return energy_norm(scene.K, u - exact) / size; };
  slant::static_condensation const factor(scene.K, contact::contact_unknowns(data));
  contact::dual const problem(law, factor, data);
  auto const M = contact::lumped_preconditioner(scene.K, problem.constraints());
  auto const program = problem.qp();
  contact::certificate<double> prover(scene.K, data);
  prover.prove(contact::solver(factor), [](auto const& K) { (void)slant::factorize(K); });

  for (double const tolerance : {1e-4, 1e-8, 1e-12}) {
    auto const found = contact::solve(law, scene.K, data, {.tolerance = tolerance});
    double const error = error_of(found.u);
    // What each of the three says of the same point; none is asked for less than it can say.
    long newton_products = 0;
    auto const says = [&](contact::certificate<double>& certificate, bool with_newton) {
      VectorXd λ = found.multipliers, u = found.u;
      auto e = certificate(problem.set(), λ, u, tolerance / 1000, contact::solver(factor));
      if (with_newton) {
        contact::newton_certificate newton(program, M, certificate);
        e = newton(λ);
        newton_products = long(newton.applications());
      }
      return e.relative() / error_of(u);
    };
    contact::certificate<double> certificate(scene.K, data);
    double const zero = says(certificate, false);
    double const sharp = says(certificate, true);
    double const proven = says(prover, false);

    double threshold = tolerance, expert_error = 1;
    for (; threshold > 1e-17; threshold *= std::pow(10, -0.25)) {
      expert_error = error_of(expert(scene, data, threshold).u);
      if (expert_error <= error) break;
    }
    std::vector<double> ours, theirs, certificates, ratios;
    expert_result other;
    for (int run = 0; run < (k > 8 ? 3 : 7); ++run) {
      double begin = cpu_seconds();
      (void)contact::solve(law, scene.K, data, {.tolerance = tolerance});
      ours.push_back(cpu_seconds() - begin);
      other = expert(scene, data, threshold);
      theirs.push_back(other.seconds);
      ratios.push_back(ours.back() / theirs.back());
      begin = cpu_seconds();
      contact::certificate<double> again(scene.K, data);
      VectorXd λ = found.multipliers, u = found.u;
      (void)again(problem.set(), λ, u, tolerance, contact::solver(factor));
      certificates.push_back(cpu_seconds() - begin);
    }
    std::printf(
        "%d,%s,%.0e,%s,%.2e,%.2f,%.2f,%.2f,%.4f,%.4f,%.3f,%ld,%ld,%ld,%ld,%.4f,%ld,%.2e,%.3f\n", k,
        std::string(fem::name_of(load)).c_str(), tolerance,
        std::string(slant::to_string(found.status)).c_str(), error, zero, sharp, proven,
        median(ours), median(certificates), median(certificates) / median(ours), long(found.solves),
        long(found.corrections),
        long(found.work.operator_applications + found.work.setup_applications), newton_products,
        median(theirs), other.products, expert_error, median(ratios));
    std::fflush(stdout);
    // The reference has rounding errors of its own.
    bool const is_known = error > 1e-12;
    missed = missed || !found.converged() || (is_known && (sharp < 1 || zero < 1 || proven < 1));
  }
}

/// A random program over half lines and discs, of condition 10^log_condition.
void measure_program(int nodes, double log_condition, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> uniform(0, 1);
  int const n = 3 * nodes;
  MatrixXd X(n, n);
  for (double& x : X.reshaped()) x = gauss(random);
  MatrixXd const Q = Eigen::HouseholderQR<MatrixXd>(X).householderQ();
  VectorXd values(n);
  for (int j = 0; j < n; ++j) values(j) = std::pow(10, -log_condition * j / (n - 1));
  MatrixXd A = Q * values.asDiagonal() * Q.transpose();
  A = (0.5 * (A + A.transpose())).eval();
  MatrixXd const inverse = Q * values.cwiseInverse().asDiagonal() * Q.transpose();
  VectorXd b(n), radii(nodes);
  for (double& x : b) x = gauss(random);
  for (double& x : radii) x = uniform(random);
  auto const set = slant::cartesian(slant::half_lines(slant::index(nodes)), slant::discs(radii));
  slant::separable_qp const qp{slant::matrix<slant::self_adjoint, slant::positive_definite>(A), b,
                               set};
  auto const above =
      slant::matrix<slant::self_adjoint, slant::positive_definite>(MatrixXd((1 + 1e-6) * inverse));
  VectorXd const x0 = VectorXd::Zero(n);
  VectorXd const exact = slant::solve(slant::symmetric_newton{qp}, x0,
                                      slant::reduced_gradient_below(1e-15) || slant::at_most(300))
                             .x();
  double const size = std::sqrt(exact.dot(A * exact));
  for (double const tolerance : {1e-4, 1e-8, 1e-12}) {
    auto rule = slant::energy_error_below(tolerance, slant::energy_certificate(qp));
    auto const r = slant::solve(slant::kprgp{qp}, x0, rule || slant::at_most(200000));
    VectorXd const e = r.x() - exact;
    double const error = std::sqrt(e.dot(A * e)) / size;
    slant::energy_certificate estimate(qp);
    slant::energy_certificate bound(qp, slant::dominates_inverse(above));
    double const claimed = estimate(r.x()).relative(), proven = bound(r.x()).relative();
    long const products = long(r.state.work.operator_applications);
    std::printf("program %d,1e%.0f,%.0e,%s,%.2e,,%.2f,%.2f,,,%.3f,,,%ld,%ld,,,,\n", n,
                log_condition, tolerance, std::string(slant::to_string(r.status)).c_str(), error,
                claimed / error, proven / error, double(estimate.applications()) / double(products),
                products, long(estimate.applications()));
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<int> sizes;
  for (int i = 1; i < argc; ++i) sizes.push_back(std::atoi(argv[i]));
  if (sizes.empty()) sizes = {4, 6, 8, 12};
  std::printf(
      "k,load,tolerance,status,true_error,extended,newton,proven,seconds,certificate_seconds,share,"
      "solves,corrections,products,certificate_products,expert_seconds,expert_products,"
      "expert_error,time_ratio\n");
  for (int const k : sizes) {
    for (auto const load : fem::brick_loads) measure_brick(k, load);
  }
  if (argc > 1) return missed ? 1 : 0;
  for (double const condition : {2.0, 4.0, 6.0}) measure_program(60, condition, 1);
  return missed ? 1 : 0;
}
