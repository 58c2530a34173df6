// SPDX-License-Identifier: MIT
//
// One row of a table of two bodies, and the pictures of its runs.
#pragma once

#include <algorithm>
#include <cstdio>
#include <fem/contact_field.hpp>
#include <fem/plots/contact_line_plot.hpp>
#include <fem/plots/contact_plot.hpp>
#include <fem/plots/history_plot.hpp>
#include <filesystem>
#include <iterator>
#include <string>
#include <support/named_method.hpp>
#include <support/problem_ladder.hpp>
#include <support/run_recorder.hpp>
#include <support/text_table.hpp>
#include <tuple>
#include <vector>

namespace two_bodies {

using cells = std::vector<std::string>;

[[nodiscard]] inline cells joined(cells a, cells const& b) {
  std::copy(b.begin(), b.end(), std::back_inserter(a));
  return a;
}

/// What each method does from zero and nested, as in [K]: steps/products.
template <class Methods, class Ladder>
[[nodiscard]] cells run_row(Methods const& methods, Ladder& problems, int size,
                            examples::run_limits const& limits, bool& converged) {
  cells result;
  examples::for_each_method(methods, [&](auto const& method) {
    auto const add = [&](examples::measured const& run) {
      result.push_back(steps_and_products(run));
      converged = converged && (run.converged() || !method.ours);
    };
    add(examples::measure(examples::run_from_zero(method, problems.at(size), limits)));
    if (method.nested)
      add(examples::measure(examples::run_nested(method, problems.ladder(size), limits).finest()));
  });
  return result;
}

/// Draws the histories of all methods and the solution of the last one, which goes on to an
/// accuracy that no table asks for: its last q is taken for the least one.
template <class Methods, int D>
void draw(Methods const& methods, examples::contact_problem<D> const& problem,
          examples::run_limits const& limits, std::filesystem::path const& folder,
          std::string const& name, std::string const& stress_unit) {
  std::vector<fem::history_series> energy;
  std::vector<fem::history_series> residual;
  Eigen::VectorXd λ = problem.zero();
  examples::for_each_method(methods, [&](auto const& method) {
    examples::run_recorder recorder(problem.qp());
    auto const report = examples::run_from_zero(method, problem, limits, recorder);
    energy.push_back(recorder.energy(method.name));
    residual.push_back(recorder.residual(method.name));
    λ = report.x();
  });
  auto const& best = std::get<std::tuple_size_v<Methods> - 1>(methods);
  examples::run_limits further = limits;
  further.tolerance = 1e-6 * limits.tolerance;
  λ = slant::solve(best.make(problem), λ, best.stop(further)).x();
  auto const qp = problem.qp();
  Eigen::VectorXd r(λ.size());
  slant::apply(qp.a(), λ, r);
  r -= qp.b();
  for (auto& series : energy) fem::subtract(series, slant::energy(qp, λ, r));

  auto const tell = [](fem::plot_result const& result) {
    std::printf("%s\n", result.message.c_str());
    return result.written;
  };
  bool const drawn = tell(fem::history_plot(folder / (name + "_residual.png"), residual,
                                            {.title = name, .vertical = "relative residual"}));
  if (!drawn) return;  // the others would fail for the same reason
  tell(fem::history_plot(folder / (name + "_energy.png"), energy,
                         {.title = name, .vertical = "q - min q"}));
  auto const& scene = problem.scene();
  Eigen::Index const m = scene.contact_count();
  auto const field = fem::make_contact_field(scene, problem.displacement(λ), λ.head(m).eval(),
                                             λ.tail((D - 1) * m).eval());
  tell(fem::contact_plot(folder / (name + "_contact.png"), field,
                         {.title = name, .stress_unit = stress_unit}));
}

}  // namespace two_bodies
