// SPDX-License-Identifier: MIT
//
// The accuracy at which the symmetric Newton method ends when it is asked for all digits:
//
//     newton_floor        on a mixture of constraints with κ(A) = 1e2 … 1e14, the wire, the steel
//                         brick, two plates, two bricks
//
// prints comma-separated values:
//
//     gradient     ‖r̃‖ / ε (‖A‖ ‖x‖ + ‖b‖): the terms of A x − b and what they are rounded against
//     kkt          the relative residual of the contact problem in (u, λ), from its data alone
//     kkt_over     kkt / ε (1 + κ ‖u‖ / F), κ = ‖K‖_F / √n, F = max(‖f‖, ‖Bᵀλ‖): the terms of
//                  K u + Bᵀλ − f, of which the first is what a backward stable solve leaves
//
// Exit status 1 if a run ends otherwise than at its floor, or one of the ratios exceeds 100.

#include <slant/contact/optimality.hpp>
#include <slant/factorizations/ldlt.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/operators/inverse.hpp>
#include <slant/operators/matrix.hpp>

#include <fem/steel_brick.hpp>
#include <fem/string_1d.hpp>
#include <fem/two_bricks.hpp>
#include <fem/two_plates.hpp>
#include <methods/mixture.hpp>
#include <support/contact_problem.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>

namespace {

using vector = Eigen::VectorXd;

double const ε = std::numeric_limits<double>::epsilon();

/// A method run until it can get no further.
template <class Method>
auto exhaust(Method const& method, vector const& x0) {
  return slant::solve(method, x0, slant::reduced_gradient_below(0.0) || slant::at_most(3000));
}

bool at_floor(slant::status s) {
  return s == slant::status::stalled || s == slant::status::converged;
}

template <class Report>
bool print(std::string const& scene, Report const& r, double gradient, double kkt,
           double kkt_over) {
  std::printf("%s,%td,%s,%.2g,%.2g,%.2g\n", scene.c_str(), r.iterations(),
              slant::to_string(r.status).data(), gradient, kkt, kkt_over);
  std::fflush(stdout);
  return at_floor(r.status) && gradient <= 100 && kkt_over <= 100;
}

bool mixture(double κ) {
  test::mixture const p(κ);
  auto const A = test::spd(p.A);
  auto const set = p.set();
  slant::separable_qp const qp{A, p.b, set};
  auto const r = exhaust(slant::symmetric_newton{qp}, vector::Zero(20));
  double const terms = p.A.norm() * r.x().norm() + p.b.norm();
  char name[40];
  std::snprintf(name, sizeof name, "mixture with condition %g", κ);
  return print(name, r, r.state.reduced_gradient_norm / (ε * terms), 0, 0);
}

bool wire(Eigen::Index m, double l, double g) {
  auto const wire = fem::make_wire(m);
  auto const set =
      slant::cartesian(slant::half_lines(vector::Constant(m, l).eval()),
                       slant::discs(vector::Constant(m, g).eval()), slant::free_components(m));
  slant::separable_qp const qp{slant::matrix<slant::self_adjoint, slant::positive_definite>(wire.A),
                               wire.b, set};
  auto const r = exhaust(slant::symmetric_newton{qp, slant::inverse(slant::ldlt(wire.A))},
                         vector::Zero(4 * m));
  double const terms = 4 / wire.h() * r.x().norm() + wire.b.norm();  // ‖A‖ < 4/h
  return print("wire with " + std::to_string(4 * m) + " unknowns", r,
               r.state.reduced_gradient_norm / (ε * terms), 0, 0);
}

template <int D>
bool contact(std::string const& name, fem::contact_scene<D> scene) {
  examples::contact_problem<D> const p(std::move(scene));
  auto const r = exhaust(slant::symmetric_newton{p.qp(), p.preconditioner()}, p.zero());
  vector const u = p.displacement(r.x());
  auto const& s = p.scene();
  slant::contact::data<double> const data{s.N, s.T, s.f, s.d, s.g};
  double const terms = p.sigma() * r.x().norm() + p.qp().b().norm();
  double const kkt = slant::contact::check_optimality(s.K, data, u, r.x()).residual();
  vector const force = p.dual().constraints().transpose() * r.x();
  double const F = std::max(s.f.norm(), force.norm());
  double const κ = s.K.norm() / std::sqrt(static_cast<double>(s.K.rows()));
  return print(name + " with " + std::to_string(s.K.rows()) + " unknowns", r,
               r.state.reduced_gradient_norm / (ε * terms), kkt,
               kkt / (ε * (1 + κ * u.norm() / F)));
}

}  // namespace

int main() {
  std::printf("scene,steps,status,gradient,kkt,kkt_over\n");
  bool good = true;
  for (double const κ : {1e2, 1e4, 1e6, 1e8, 1e10, 1e12, 1e14}) good = mixture(κ) && good;
  for (Eigen::Index const m : {64, 256}) good = wire(m, 0, 1.4) && good;
  for (int const k : {4, 8}) {
    for (auto const load : fem::brick_loads) {
      good = contact<3>(std::string("brick ") + fem::name_of(load).data(),
                        fem::make_steel_brick({.k = k, .load = load})) &&
             good;
    }
  }
  good = contact<2>("plates", fem::make_two_plates(20)) && good;
  good = contact<3>("bricks", fem::make_two_bricks(3)) && good;
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
