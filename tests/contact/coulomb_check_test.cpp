// SPDX-License-Identifier: MIT
#include <slant/contact/coulomb/coulomb_certificate.hpp>

#include "counting_factor.hpp"
#include "scenes.hpp"

#include <slant/contact/dual.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace coulomb_check_test {

using Eigen::VectorXd;
namespace contact = slant::contact;

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
  problem.update_positions(VectorXd::Constant(s.T.rows(), 1e-6));
  VectorXd const λ = VectorXd::LinSpaced(problem.b().size(), -1, 2);
  VectorXd image(λ.size());
  slant::apply(problem.a(), λ, image);
  VectorXd difference = problem.openings(problem.displacement(λ)) - (image - problem.b());
  CHECK(problem.openings(problem.displacement(λ))[1] > 0);
  difference[1] = 0;
  CHECK(difference.norm() <= 1e-12 * problem.b().norm());
  CHECK(problem.load() == s.f);
}

}  // namespace coulomb_check_test
