// SPDX-License-Identifier: MIT
//
// The conjugate projector of the Schur complement contact algorithm [D]:
//
//     projector steps [K...]    steel brick, load lift: steps of conjugate gradients for the linear
//                               problem with the rows held that are closed at the solution, with
//                               and without the projector, on 3k x k x k cells (all) and on 12 x 4
//                               x k (inside: the contact side stays as it is)
//     projector contact [K...]  frictionless contact of the brick by schur_contact: steps,
//                               products, applications of Q, changes of the active set, factors
//     projector search [K...]   stacks of bricks with gaps: the same with 0, 1, 3 trial points of
//                               the search along the boundary, and for three values of `release`
//     projector threads [K...]  seconds of factoring and of a run with one and with two threads,
//                               and whether all bits agree; needs OpenMP, without it exit status 1
//
// prints comma-separated values. Exit status 1 if a run does not converge, if more than one factor
// per body is made, if bits differ, or if the steps with the projector grow by more than a quarter
// with the unknowns inside, or by more than a third beyond the square root of k with all of them.
#include <slant/contact/bodies.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/krylov/range_cg.hpp>
#include <slant/methods/schur_contact.hpp>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fem/stacked_bricks.hpp>
#include <fem/steel_brick.hpp>
#include <string>
#include <vector>
#ifdef _OPENMP
#include <omp.h>
#endif

namespace {

using vector = Eigen::VectorXd;
using sparse = Eigen::SparseMatrix<double>;
using bodies = slant::contact::bodies<double>;

[[maybe_unused]] double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

auto run(bodies const& problem, slant::schur_contact_options<double> const& options = {}) {
  auto const qp = problem.qp();
  return slant::solve(slant::schur_contact{qp, options}, problem.zero(),
                      slant::residual_below(1e-9) || slant::at_most(20000));
}

/// C of the rows that are closed at a solution, as an operator with a fixed active set.
struct face {
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::projector>;
  vector free;  ///< 0 for unknowns that are held; rows of B have one entry each
  [[nodiscard]] Eigen::Index rows() const { return free.size(); }
  [[nodiscard]] Eigen::Index cols() const { return free.size(); }
  void apply(vector const& x, vector& y) const { y = free.cwiseProduct(x); }
};

fem::contact_scene<3> brick(int k, bool all) {
  auto const loading = fem::loading_of(fem::brick_load::lift);
  std::array<int, 3> const cells = all ? std::array{3 * k, k, k} : std::array{12, 4, k};
  return fem::make_contact_scene<3>({.mesh = fem::make_box_mesh<3>(cells, {3, 1, 1}),
                                     .material = fem::lame(2.119e5, 0.277),
                                     .fixed = fem::brick_side::left,
                                     .contact = fem::brick_side::bottom,
                                     .loads = loading.tractions});
}

bool steps(std::vector<int> const& sizes) {
  std::printf("refined,k,unknowns,inside,steps,steps_with_projector\n");
  bool good = true;
  for (bool const all : {true, false}) {
    double first = 0;
    for (int const k : sizes) {
      auto const scene = brick(k, all);
      bodies const problem(scene.K, scene.f, scene.N, scene.d);
      auto const contact = run(problem);
      face held{vector::Ones(scene.f.size())};
      vector const λ = contact.state.multipliers();
      for (int j = 0; j < scene.N.outerSize(); ++j) {
        for (sparse::InnerIterator e(scene.N, j); e; ++e) {
          if (λ[e.row()] > 0) held.free[j] = 0;
        }
      }
      auto const qp = problem.qp();
      auto const accurate = slant::residual_below(1e-8) || slant::at_most(20000);
      auto const plain =
          slant::solve(slant::range_cg{qp.k(), qp.f(), held}, problem.zero(), accurate);
      auto const quick = slant::solve(slant::range_cg{qp.k(), qp.f(), held, qp.projection()},
                                      problem.zero(), accurate);
      std::printf("%s,%d,%td,%td,%td,%td\n", all ? "all" : "inside", k, scene.f.size(),
                  problem.inside_size(), plain.iterations(), quick.iterations());
      auto const count = static_cast<double>(quick.iterations());
      if (first == 0) first = count / (all ? 0.75 : 0.8);
      double const growth = all ? std::sqrt(double(k) / sizes.front()) : 1.0;
      good = good && contact.converged() && plain.converged() && quick.converged() &&
             count <= first * growth;
    }
  }
  return good;
}

bool contact(std::vector<int> const& sizes) {
  std::printf("load,k,unknowns,rows,steps,products,projections,changes,releases,factors\n");
  bool good = true;
  for (auto const load : fem::brick_loads) {
    for (int const k : sizes) {
      auto const scene = fem::make_steel_brick({.k = k, .load = load});
      bodies const problem(scene.K, scene.f, scene.N, scene.d);
      auto const r = run(problem);
      std::printf("%s,%d,%td,%td,%td,%td,%td,%td,%td,%td\n", std::string(name_of(load)).c_str(), k,
                  scene.f.size(), scene.d.size(), r.iterations(),
                  r.state.work.operator_applications, r.state.projector_applications,
                  r.state.rows.changes, r.state.releases, problem.factorizations());
      good = good && r.converged() && problem.factorizations() == problem.count();
    }
  }
  return good;
}

bool search(std::vector<int> const& sizes) {
  std::printf("gap,k,release,trials,steps,products,projections,changes,rows_changed\n");
  bool good = true;
  for (double const gap : {0.0, 2e-6, 2e-5}) {
    for (int const k : sizes) {
      auto const scene = fem::make_stack({.bricks = 3, .cells = {2 * k, k, k}, .gap = gap});
      bodies const problem(scene.K, scene.f, scene.B, scene.c);
      for (double const release : {0.0, 0.1, 0.5, 1.0}) {
        for (slant::index const trials : {0, 1, 3}) {
          auto const r = run(problem, {.release = release, .projected_trials = trials});
          std::printf("%g,%d,%g,%td,%td,%td,%td,%td,%td\n", gap, k, release, trials, r.iterations(),
                      r.state.work.operator_applications, r.state.projector_applications,
                      r.state.rows.changes, r.state.rows.rows_changed);
          good = good && r.converged();
        }
      }
    }
  }
  return good;
}

bool threads(std::vector<int> const& sizes) {
#ifndef _OPENMP
  static_cast<void>(sizes);
  std::fprintf(stderr, "projector threads: not measured, this was compiled without OpenMP\n");
  return false;
#else
  std::printf("k,bodies,unknowns,threads,factor_seconds,run_seconds,steps,same_bits\n");
  bool good = true;
  for (int const k : sizes) {
    auto const scene = fem::make_stack({.bricks = 4, .cells = {2 * k, k, k}, .gap = 1e-6});
    vector first;
    for (int const count : {1, 2}) {
      omp_set_num_threads(count);
      auto const begin = std::chrono::steady_clock::now();
      bodies const problem(scene.K, scene.f, scene.B, scene.c);
      double const factoring = seconds_since(begin);
      auto const start = std::chrono::steady_clock::now();
      auto const r = run(problem);
      double const running = seconds_since(start);
      if (first.size() == 0) first = r.x();
      bool const same = r.x() == first;
      std::printf("%d,4,%td,%d,%.3f,%.3f,%td,%s\n", k, scene.f.size(), count, factoring, running,
                  r.iterations(), same ? "yes" : "no");
      good = good && r.converged() && same;
    }
  }
  return good;
#endif
}

}  // namespace

int main(int argc, char** argv) {
  std::string const what = argc > 1 ? argv[1] : "steps";
  std::vector<int> sizes;
  for (int i = 2; i < argc; ++i) sizes.push_back(std::atoi(argv[i]));
  if (sizes.empty()) sizes = {4, 6, 8, 10, 12};
  if (what == "steps") return steps(sizes) ? 0 : 1;
  if (what == "contact") return contact(sizes) ? 0 : 1;
  if (what == "search") return search(sizes) ? 0 : 1;
  if (what == "threads") return threads(sizes) ? 0 : 1;
  std::fprintf(stderr, "projector: steps, contact, search or threads\n");
  return 2;
}
