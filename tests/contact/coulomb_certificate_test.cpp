// SPDX-License-Identifier: MIT
#include <slant/contact/coulomb/coulomb_certificate.hpp>

#include <slant/contact/dual.hpp>

#include <support/testing.hpp>
#include "coulomb_scenes.hpp"
#include "counting_factor.hpp"
#include "scenes.hpp"
#include "spring_scenes.hpp"

namespace coulomb_certificate_test {

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
      {.k = 1, .load = fem::brick_load::lift, .size = Vector3d(length, 1, 1)});
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

TEST_CASE("coulomb_certificate: bodies, slender ones, and such that nearly move rigidly") {
  auto sound = brick(3), slender = brick(60), loose = on_springs(1e-3);
  check_bounds(sound, 1e-10);
  check_bounds(slender, 1e-7);
  check_bounds(loose, 1e-7);
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

/// Two nodes on springs of their own in the plane, K = 4 I: pressed by 8 and 4, drawn along by 1
/// and 2. With F = 0.25 the first sticks at λ_t = 1, the second slips, λ_t = 1 and T u = 0.25.
struct two_nodes {
  Eigen::SparseMatrix<double> K{4, 4}, N{2, 4}, T{2, 4};
  VectorXd f{4}, λ{4}, F = VectorXd::Constant(2, 0.25);
  contact::data<double> data;

  two_nodes() {
    for (int i = 0; i < 4; ++i) K.insert(i, i) = 4;
    for (int i = 0; i < 2; ++i) {
      N.insert(i, 2 * i) = 1;
      T.insert(i, 2 * i + 1) = 1;
    }
    f << 8, 1, 4, 2;
    λ << 8, 4, 1, 1;
    data = {N, T, f, VectorXd::Zero(2), VectorXd::Zero(2)};
  }
};

TEST_CASE("coulomb_check: nothing at a solution, and what is wrong elsewhere, by node") {
  two_nodes const s;
  test::counting_factor const factor{s.K};
  contact::dual const problem(contact::friction_line{}, factor, s.data);
  contact::coulomb_check const check(problem, s.F);
  auto const at = [&](VectorXd const& λ) { return check(λ, problem.displacement(λ)); };
  CHECK(at(s.λ).relative <= 1e-15);
  VectorXd wrong = s.λ;
  wrong[1] = 3;  // too little pressure: the second node enters the foundation by ¼
  auto const v = at(wrong);
  CHECK(v.contact == 1);
  CHECK(v.largest > 0.05);
  CHECK(v.relative >= v.largest);
  wrong = s.λ;
  wrong[2] = -1;  // friction that drives
  CHECK(at(wrong).contact == 0);
  CHECK(at(wrong).largest > 0.1);
  wrong[2] = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isnan(at(wrong).relative));
  CHECK(at(wrong).contact == 0);
  CHECK_THROWS_AS((void)check(VectorXd::Zero(3), VectorXd::Zero(4)), slant::bad_input);
  CHECK_THROWS_AS((void)check(s.λ, VectorXd::Zero(3)), slant::bad_input);
}

TEST_CASE("coulomb_check: any units") {
  for (double const unit : {1e-150, 1e-3, 1e150}) {
    two_nodes s;
    s.data.f *= unit;
    s.λ *= unit;
    s.λ[1] *= 0.75;
    double const rows = unit < 1 ? 1e-12 : 1e12;  // of N and T
    s.data.N *= rows;
    s.data.T *= rows;
    s.data.d *= rows;
    s.λ /= rows;
    test::counting_factor const factor{s.K};
    contact::dual const problem(contact::friction_line{}, factor, s.data);
    auto const v = contact::coulomb_check(problem, s.F)(s.λ, problem.displacement(s.λ));
    CHECK(v.contact == 1);
    CHECK(v.relative == doctest::Approx(0.14).epsilon(0.5));
  }
}

TEST_CASE("dual::openings: A λ − b, from the displacements") {
  auto const s = fem::make_steel_brick({.k = 2, .load = fem::brick_load::lift});
  auto data = test::contact_data(s);
  data.d[1] = std::numeric_limits<double>::infinity();
  test::counting_factor const factor{s.K};
  contact::dual problem(contact::friction_disc{}, factor, data);
  problem.update({.w = VectorXd::Constant(s.T.rows(), 1e-6)});
  VectorXd const λ = VectorXd::LinSpaced(problem.b().size(), -1, 2);
  VectorXd image(λ.size());
  slant::apply(problem.a(), λ, image);
  VectorXd difference = problem.openings(problem.displacement(λ)) - (image - problem.b());
  CHECK(problem.openings(problem.displacement(λ))[1] > 0);
  difference[1] = 0;
  CHECK(difference.norm() <= 1e-12 * problem.b().norm());
  CHECK(problem.load() == s.f);
}

}  // namespace coulomb_certificate_test
