// SPDX-License-Identifier: MIT
//
// Contact problems by the doors that slant::compiled has compiled; prints every bit of the results.
// Built with the component and without.
#include <slant/contact/certified_coulomb.hpp>
#include <slant/contact/solve.hpp>

#include <cstdio>
#include <fem/contact_scene.hpp>
#include <fem/steel_brick.hpp>

namespace {

void print(char const* name, Eigen::VectorXd const& x) {
  std::printf("%s", name);
  for (double const entry : x) std::printf(" %a", entry);
  std::printf("\n");
}

}  // namespace

int main() {
  auto const scene = fem::make_steel_brick({.k = 2, .load = fem::brick_load::lift});
  slant::contact::data<double> const data{scene.N, scene.T, scene.f, scene.d, scene.g};
  auto const tresca = slant::contact::solve(slant::contact::friction_disc{}, scene.K, data);
  print(tresca.converged() ? "tresca" : "no solution", tresca.u);
  std::printf("%td products, %td solves, error %a\n", tresca.work.operator_applications,
              tresca.solves, tresca.error.relative());
  Eigen::VectorXd const F = Eigen::VectorXd::Constant(data.nodes(), 0.3);
  auto const coulomb =
      slant::contact::certified_coulomb(slant::contact::friction_disc{}, scene.K, data, F);
  print(coulomb.converged() ? "coulomb" : "no solution", coulomb.u);
  return tresca.converged() && coulomb.converged() ? 0 : 1;
}
