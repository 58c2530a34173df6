// SPDX-License-Identifier: MIT
//
// A scene pressed, dragged and released, in load steps. Quasi-static: in each step friction resists
// the increment of the slip, so the solution depends on the path, and what was dragged is held
// back.
#pragma once

#include <cstdio>
#include <slant/contact/contact_data.hpp>
#include <slant/contact/dual.hpp>
#include <slant/factorizations/static_condensation.hpp>
#include <support/command_line.hpp>
#include <type_traits>

#include "history.hpp"

namespace coulomb {

template <int D>
void print_problem(settings const& s, loaded_scene<D> const& loaded) {
  auto const& scene = loaded.scene;
  std::printf("%s: pressed, dragged and released in %d load steps\n", loaded.title.c_str(),
              3 * s.steps);
  std::printf("  friction       %g", s.friction);
  if (s.orthotropic()) std::printf(" along x, %g along y (orthotropic)", s.across);
  std::printf(" (Coulomb)");
  if (s.variation > 0) {
    std::printf(", times %g ... %g along x", 1 - s.variation, 1 + s.variation);
  }
  std::printf("\n  mesh           %td %s, %td unknowns\n", scene.mesh.cell_count(),
              D == 2 ? "triangles" : "tetrahedra", scene.unknowns.count);
  std::printf("  contact        %td nodes\n\n", scene.contact_count());
}

/// Goes along the path until a step fails; returns the exit status.
template <int D>
[[nodiscard]] int follow(settings const& s, loaded_scene<D> const& loaded) {
  namespace contact = slant::contact;
  using law = std::conditional_t<D == 2, contact::friction_line, contact::friction_disc>;
  if (!s.output.empty()) examples::make_folder("--output", s.output);
  auto const& scene = loaded.scene;
  print_problem(s, loaded);

  Eigen::VectorXd const rest = Eigen::VectorXd::Zero(scene.f.size());
  contact::data<double> const data{scene.N, scene.T, rest, scene.d, scene.g};
  slant::static_condensation const factor(scene.K, contact::contact_unknowns(data));
  contact::dual problem(law{}, factor, data);
  friction const F = friction_of(s, scene);
  history<D> seen(s, loaded, F);
  bool good = true;
  with_method(s, problem, scene.K, F, [&](auto const& advance) {
    for (int i = 1; i <= 3 * s.steps && good; ++i) {
      auto const share = share_at(static_cast<double>(i) / s.steps);
      step_result const step = advance(contact::load_step<>{
          .f = share.press * loaded.press + share.drag * loaded.drag, .w = seen.position()});
      good = step.converged();
      if (good) {
        seen.record(i, share, step, problem.displacement(step.λ));
      } else {
        seen.record_failure(i, share, step);
      }
    }
  });
  seen.finish();
  return good ? examples::succeeded : examples::not_converged;
}

}  // namespace coulomb
