// SPDX-License-Identifier: MIT
//
// What a frictional contact problem costs beside one linear solve with the same matrix, and an
// application of the condensed operator beside reading its entries. One thread.
//
//   bench_condensation [--levels L] K [K…]
//
// Columns: linear_seconds is one factorisation by slant::factorize and one solve; total_seconds is
// everything from the matrices to u (ordering, factorisation, condensation, right-hand side,
// iterations, u); error that of u, relative, in the energy norm, against a solution by sweeps over
// all of the factors. Seconds are medians of five runs up to k = 16, of one beyond. Exit status 1
// if a ratio is above its limit, 2.2 up to k = 16 and 2.0 beyond, or an error above 1e-8.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <fem/steel_brick.hpp>
#include <slant/concepts/capabilities.hpp>
#include <slant/contact/contact_data.hpp>
#include <slant/contact/dual.hpp>
#include <slant/contact/preconditioners.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/factorizations/parts/panel_kernels.hpp>
#include <slant/factorizations/static_condensation.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/iteration/stopping.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/methods/unconstrained_start.hpp>

namespace {

using Eigen::VectorXd;

/// CPU seconds of this process, which has one thread: other programs disturb them less than the
/// time on the wall.
double now() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return v[v.size() / 2];
}

struct outcome {
  VectorXd u;
  double seconds = 0, iteration_seconds = 0;
  long steps = 0, products = 0, levels = 0;
  bool converged = false;
};

/// The whole of it, from the matrices to u.
outcome solve_contact(fem::contact_scene<3> const& scene, slant::contact::data<double> const& data,
                      slant::condensation_options const& condensation, double tolerance) {
  outcome o;
  double const begin = now();
  slant::static_condensation const factor(scene.K, slant::contact::contact_unknowns(data),
                                          condensation);
  slant::contact::dual const problem(slant::contact::friction_disc{}, factor, data);
  auto const M = slant::contact::lumped_preconditioner(scene.K, problem.constraints());
  double const iterate = now();
  auto const qp = problem.qp();
  auto const start = slant::unconstrained_start(qp, M);
  slant::symmetric_newton_options<> options;
  options.forcing.goal = tolerance;
  auto const r = slant::solve(slant::symmetric_newton{qp, M, options}, start.x,
                              slant::reduced_gradient_below(tolerance) || slant::at_most(200));
  o.iteration_seconds = now() - iterate;
  o.u = problem.displacement(r.x());
  o.seconds = now() - begin;
  o.converged = r.converged();
  o.steps = r.iterations();
  o.products = start.applications + r.state.work.operator_applications;
  o.levels = factor.report().chosen.levels;
  return o;
}

/// The solution to the last digits by products that sweep over all of K's factors.
VectorXd reference(fem::contact_scene<3> const& scene, slant::contact::data<double> const& data) {
  slant::contact::dual const problem(slant::contact::friction_disc{}, slant::factorize(scene.K),
                                     data);
  auto const M = slant::contact::lumped_preconditioner(scene.K, problem.constraints());
  auto const r = slant::solve(slant::symmetric_newton{problem.qp(), M}, problem.zero(),
                              slant::reduced_gradient_below(1e-12) || slant::at_most(200));
  if (!r.converged()) throw std::runtime_error("no reference: " + r.reason);
  return problem.displacement(r.x());
}

double linear_solve(fem::contact_scene<3> const& scene) {
  double const begin = now();
  auto const factor = slant::factorize(scene.K);
  VectorXd u(scene.f.size());
  slant::apply(slant::inverse(factor), scene.f, u);
  return now() - begin;
}

/// Seconds of one application, the fastest of several.
template <class A>
double application(A const& a) {
  VectorXd const x = VectorXd::Random(a.cols());
  VectorXd y(a.rows());
  auto w = slant::workspace(a, x);
  double best = 1e300;
  for (int i = 0; i < 20; ++i) {
    double const begin = now();
    slant::apply(a, x, y, w);
    best = std::min(best, now() - begin);
  }
  return best;
}

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// The same in rounded precision; unknown without SuiteSparse, where nothing is condensed.
template <class A>
double rounded_application(A const& a) {
  if constexpr (slant::has_rounded<A, VectorXd>) {
    return application(a.rounded());
  } else {
    return unknown;
  }
}

/// Bytes that an application reads; 0 without SuiteSparse.
template <class A>
Eigen::Index bytes_of(A const& a) {
  if constexpr (requires { a.bytes(); }) {
    return a.bytes();
  } else {
    return 0;
  }
}

/// Seconds to read so many bytes in so many passes over the same ones, as an application does: one
/// stream from aligned memory in large pages into sums that do not wait for each other.
double reading(Eigen::Index bytes, int passes) {
  bytes /= passes;
  using sums = Eigen::Array<double, 16, 1>;
  Eigen::ArrayXd numbers(bytes / 8 / sums::RowsAtCompileTime * sums::RowsAtCompileTime);
  slant::detail::prefer_large_pages(numbers.data(), numbers.size());
  numbers.setOnes();
  double best = 1e300;
  sums sum = sums::Zero();
  for (int i = 0; i < 10; ++i) {
    double const begin = now();
    for (int pass = 0; pass < passes; ++pass) {
      for (Eigen::Index j = 0; j < numbers.size(); j += sums::RowsAtCompileTime) {
        sum += Eigen::Map<sums const, Eigen::Aligned16>(numbers.data() + j);
      }
    }
    best = std::min(best, now() - begin);
  }
  return sum.sum() > 0 ? best : 0;
}

/// The same if nothing is in the cache: by the speed of the memory, measured once.
double reading_from_memory(Eigen::Index bytes) {
  constexpr Eigen::Index many = Eigen::Index(1) << 29;
  static double const per_byte = reading(many, 1) / double(many);
  return per_byte * double(bytes);
}

}  // namespace

int main(int argc, char** argv) {
  bool missed = false;
  std::printf(
      "k,load,unknowns,multipliers,levels,linear_seconds,total_seconds,ratio,iteration_seconds,"
      "steps,"
      "products,error,product_ms,rounded_ms,reading_ms,memory_ms,product_over_reading,"
      "product_over_memory\n");
  slant::condensation_options condensation;
  int first = 1;
  if (argc > 2 && std::string(argv[1]) == "--levels") {
    condensation.levels = std::atoi(argv[2]);
    first = 3;
  }
  for (int i = first; i < argc; ++i) {
    int const k = std::atoi(argv[i]);
    int const runs = k <= 16 ? 5 : 1;
    for (fem::brick_load const load : fem::brick_loads) {
      auto const scene = fem::make_steel_brick({.k = k, .load = load});
      slant::contact::data<double> const data{scene.N, scene.T, scene.f, scene.d, scene.g};
      std::vector<double> linear, total, iteration;
      outcome o;
      for (int run = 0; run < runs; ++run) {
        linear.push_back(linear_solve(scene));
        o = solve_contact(scene, data, condensation, 1e-10);
        total.push_back(o.seconds);
        iteration.push_back(o.iteration_seconds);
      }
      VectorXd const exact = reference(scene, data);
      VectorXd const e = o.u - exact;
      double const error = std::sqrt(e.dot(scene.K * e) / exact.dot(scene.K * exact));
      double const ratio = median(total) / median(linear);
      slant::static_condensation const factor(scene.K, slant::contact::contact_unknowns(data),
                                              condensation);
      slant::contact::dual const problem(slant::contact::friction_disc{}, factor, data);
      auto const a = problem.a();
      Eigen::Index const bytes = bytes_of(a);
      double const product = application(a), rounded = rounded_application(a),
                   read =
                       bytes > 0 ? reading(bytes, factor.report().chosen.inverse ? 1 : 2) : unknown,
                   memory = bytes > 0 ? reading_from_memory(bytes) : unknown;
      std::printf("%d,%s,%ld,%ld,%ld,%.4f,%.4f,%.3f,%.4f,%ld,%ld,%.1e,", k,
                  std::string(fem::name_of(load)).c_str(), long(scene.K.rows()), long(a.rows()),
                  o.levels, median(linear), median(total), ratio, median(iteration), o.steps,
                  o.products, error);
      std::printf("%.3f,%.3f,%.3f,%.3f,%.2f,%.2f\n", 1e3 * product, 1e3 * rounded, 1e3 * read,
                  1e3 * memory, product / read, product / memory);
      std::fflush(stdout);
      missed = missed || ratio > (k > 16 ? 2.0 : 2.2) || !(error <= 1e-8) || !o.converged;
    }
  }
  return missed ? 1 : 0;
}
