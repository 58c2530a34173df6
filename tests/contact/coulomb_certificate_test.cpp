// SPDX-License-Identifier: MIT
#include <slant/contact/coulomb/coulomb_certificate.hpp>

#include "coulomb_scenes.hpp"
#include "counting_factor.hpp"
#include "spring_scenes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace coulomb_certificate_test {

using Eigen::VectorXd;
namespace contact = slant::contact;

/// A scene, its certificate, and an oracle for Tresca's problem with any slip bounds.
struct scene {
  Eigen::SparseMatrix<double> K;
  contact::data<double> data;
  VectorXd F;
  test::counting_factor factor;
  contact::dual<contact::friction_disc, test::counting_factor const&, double> problem;
  contact::coulomb_certificate<decltype(problem), test::counting_factor> certificate;

  scene(Eigen::SparseMatrix<double> stiffness, contact::data<double> c, double coefficient)
      : K(std::move(stiffness)),
        data(std::move(c)),
        F(VectorXd::Constant(data.nodes(), coefficient)),
        factor(K),
        problem(contact::friction_disc{}, factor, data),
        certificate(problem, factor, K, data, F) {}

  oracle::contact_reference tresca(VectorXd const& λ) const {
    auto c = data;
    c.g = F.cwiseProduct(λ.head(F.size()).cwiseMax(0));
    return test::reference(K, c);
  }
  double energy(VectorXd const& v) const { return std::sqrt(v.dot(K * v)); }
  /// The fixed point, by Tresca's problems of the oracle.
  VectorXd solution() const {
    VectorXd λ = VectorXd::Constant(problem.b().size(), 1e-3);
    for (int k = 0; k < 40; ++k) λ = tresca(λ).multipliers();
    return λ;
  }
};

scene brick(double length) {
  auto const s = fem::make_steel_brick(
      {.k = 1, .load = fem::brick_load::lift, .size = Eigen::Vector3d(length, 1, 1)});
  return {s.K, test::contact_data(s), 0.3};
}
scene on_springs(double spring) {
  auto const s = test::spring_block<3>(1, spring);
  return {s.K, s.contact, 0.3};
}

/// Nothing at the solution; a bound of the error of Tresca's problem beside it.
void check_bounds(scene& s, double attainable) {
  VectorXd const exact = s.solution();
  auto const at_solution = s.certificate(exact);
  CAPTURE(at_solution.sentence());
  CHECK(at_solution.relative() <= attainable);
  std::mt19937 random(3);
  std::normal_distribution<double> gauss;
  for (double const size : {1e-2, 1e-4, 1e-6}) {
    VectorXd λ = exact;
    double const largest = exact.cwiseAbs().maxCoeff();
    for (double& entry : λ) entry += entry == 0 ? 0 : size * largest * gauss(random);
    auto const e = s.certificate(λ);
    auto const reference = s.tresca(s.certificate.multipliers());
    double const error = s.energy(s.certificate.displacement() - reference.u);
    CHECK(e.frozen.bound >= error - 2 * reference.energy_error * e.frozen.size);
    CHECK(e.relative() >= e.law.relative);
    CHECK(e.relative() >= e.frozen.relative());
  }
}

TEST_CASE("coulomb_certificate: nothing at a solution, and a bound beside it") {
  auto s = brick(3);
  check_bounds(s, 1e-10);
}

TEST_CASE("coulomb_certificate: bodies that nearly move rigidly, slender ones") {
  SUBCASE("slender") {
    auto slender = brick(60);
    check_bounds(slender, 1e-7);
  }
  SUBCASE("loose") {
    auto loose = on_springs(1e-3);
    check_bounds(loose, 1e-7);
  }
}

TEST_CASE("coulomb_certificate: tangential positions and new loads are those of the problem") {
  auto s = brick(3);
  VectorXd const w = 1e-6 * VectorXd::LinSpaced(2 * s.data.nodes(), -1, 2);
  s.problem.update({.f = VectorXd(1.5 * s.data.f), .w = w});
  // The oracle knows no w: the problem for u − v, T v = w.
  VectorXd const v = s.data.T.transpose() * w;
  REQUIRE((s.data.T * v - w).norm() <= 1e-14 * w.norm());
  s.data.f = 1.5 * s.data.f - s.K * v;
  VectorXd const exact = s.solution();
  auto const e = s.certificate(exact);
  CHECK(e.relative() <= 1e-9);
  auto const reference = s.tresca(exact);
  CHECK((s.certificate.displacement() - (reference.u + v)).norm() <= 1e-9 * v.norm());
}

TEST_CASE("coulomb_certificate: the sentence names the contact; no number, no error; sizes") {
  auto s = brick(3);
  VectorXd λ = VectorXd::Constant(s.problem.b().size(), 0.1);
  auto const e = s.certificate(λ);
  CHECK(e.relative() > 1e-2);
  CHECK(e.sentence().find("most at contact " + slant::detail::show(e.law.contact)) !=
        std::string::npos);
  λ[1] = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isnan(s.certificate(λ).relative()));
  CHECK_THROWS_AS((void)s.certificate(VectorXd::Zero(2)), slant::bad_input);
  CHECK_THROWS_AS(contact::coulomb_certificate(s.problem, s.factor, s.K, s.data, VectorXd::Zero(1)),
                  slant::bad_input);
  CHECK_THROWS_AS(contact::coulomb_certificate(s.problem, s.factor, s.K, s.data, VectorXd(-s.F)),
                  slant::bad_input);
}

}  // namespace coulomb_certificate_test
