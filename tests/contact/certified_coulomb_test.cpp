// SPDX-License-Identifier: MIT
#include <slant/contact/certified_coulomb.hpp>

#include "coulomb_scenes.hpp"
#include "spring_scenes.hpp"

#include <slant/contact/optimality.hpp>

#include <doctest/doctest.h>
#include <support/optimised.hpp>

#include <cmath>
#include <random>
#include <string>
#include <utility>

#include "support/message.hpp"

namespace certified_coulomb_test {

using Eigen::VectorXd;
using slant::status;
namespace contact = slant::contact;

constexpr contact::coulomb_method methods[] = {
    contact::coulomb_method::automatic, contact::coulomb_method::newton,
    contact::coulomb_method::radii, contact::coulomb_method::cones};

auto solve(Eigen::SparseMatrix<double> const& K, contact::data<double> const& c, VectorXd const& F,
           contact::certified_coulomb_options const& o = {}) {
  return contact::certified_coulomb(contact::friction_disc{}, K, c, F, o);
}

/// The residual of Tresca's conditions with the bounds F λ_ν.
template <class Result>
double kkt(Eigen::SparseMatrix<double> const& K, contact::data<double> c, VectorXd const& F,
           Result const& r) {
  c.g = F.cwiseProduct(r.λ.head(F.size()).cwiseMax(0));
  return contact::check_optimality(K, c, r.u, r.λ).residual();
}

TEST_CASE("certified_coulomb: a brick by every method, the same solution") {
  auto const s = fem::make_steel_brick({.k = 2, .load = fem::brick_load::lift});
  auto const c = test::contact_data(s);
  VectorXd const F = VectorXd::Constant(c.nodes(), 0.3);
  VectorXd first;
  for (auto const method : methods) {
    CAPTURE(int(method));
    auto const r = solve(s.K, c, F, {.method = method});
    CAPTURE(r.reason);
    REQUIRE(r.converged());
    CHECK_FALSE(r.scaled);
    CHECK(r.error.relative() <= 1e-8);
    CHECK(kkt(s.K, c, F, r) <= 1e-7);
    CHECK(test::natural_map(test::dense_dual(s.K, c), F, r.λ) <= 1e-7);
    if (first.size() == 0) first = r.u;
    CHECK((r.u - first).norm() <= 1e-7 * first.norm());
  }
}

TEST_CASE("certified_coulomb: thin, slender and nearly floating bodies, no wrong verdict" *
          doctest::skip(!test::is_optimised)) {
  auto const judge = [](Eigen::SparseMatrix<double> const& K, contact::data<double> const& c,
                        int at_least) {
    VectorXd const F = VectorXd::Constant(c.nodes(), 0.3);
    int solved = 0;
    for (auto const method : methods) {
      CAPTURE(int(method));
      auto const r = solve(K, c, F, {.method = method});
      CAPTURE(r.reason);
      CHECK(r.condition > 1e4);
      solved += r.converged();
      if (r.converged()) {
        CHECK(kkt(K, c, F, r) <= 1e-7);
        CHECK(r.reason.ends_with(", at most 1e-08"));
      } else {
        CHECK((r.status == status::stalled || r.status == status::iteration_limit));
        CHECK(r.error.relative() > 1e-8);
        CHECK(r.reason.find("condition of K about") != std::string::npos);
      }
    }
    CHECK(solved >= at_least);
  };
  auto const brick = [](double length, double height) {
    return fem::make_steel_brick(
        {.k = 1, .load = fem::brick_load::lift, .size = Eigen::Vector3d(length, 1, height)});
  };
  auto const slender = brick(300, 1), thin = brick(3, 1e-4);
  judge(slender.K, test::contact_data(slender), 3);  // Newton's alone finds no way
  judge(thin.K, test::contact_data(thin), 0);
  auto const loose = test::spring_block<3>(2, 1e-4);
  judge(loose.K, loose.contact, 2);
}

TEST_CASE("certified_coulomb: rows of a contact in any units, the cone unchanged") {
  auto const s = fem::make_steel_brick({.k = 2, .load = fem::brick_load::lift});
  auto const given = test::contact_data(s);
  VectorXd const F = VectorXd::Constant(given.nodes(), 0.3);
  auto const reference = solve(s.K, given, F);
  REQUIRE(reference.converged());
  auto c = given;
  std::mt19937 random(1);
  std::uniform_int_distribution<int> exponent(-25, 25);
  VectorXd rows(c.nodes()), pairs(2 * c.nodes());
  for (slant::index i = 0; i < c.nodes(); ++i) {
    rows(i) = std::ldexp(1.0, exponent(random));
    pairs.segment<2>(2 * i).setConstant(rows(i));
    c.d(i) *= rows(i);
  }
  c.N = Eigen::SparseMatrix<double>(rows.asDiagonal() * given.N);
  c.T = Eigen::SparseMatrix<double>(pairs.asDiagonal() * given.T);
  for (auto const method : {contact::coulomb_method::newton, contact::coulomb_method::radii}) {
    auto const r = solve(s.K, c, F, {.method = method});
    CAPTURE(r.reason);
    CHECK(r.scaled);
    CHECK((r.u - reference.u).norm() <= 1e-6 * reference.u.norm());
    VectorXd const λ = r.λ.head(F.size()).cwiseProduct(rows);
    CHECK((λ - reference.λ.head(F.size())).norm() <= 1e-6 * reference.λ.norm());
    auto const unscaled = solve(s.K, c, F, {.method = method, .scale = false});
    CHECK_FALSE(unscaled.scaled);
    CHECK(unscaled.work.operator_applications > 2 * r.work.operator_applications);
    if (unscaled.converged()) CHECK((unscaled.u - reference.u).norm() <= 1e-6 * reference.u.norm());
  }
}

TEST_CASE("certified_coulomb: any units of stiffness and load") {
  auto const s = fem::make_steel_brick({.k = 1, .load = fem::brick_load::lift});
  auto const given = test::contact_data(s);
  VectorXd const F = VectorXd::Constant(given.nodes(), 0.3);
  auto const reference = solve(s.K, given, F);
  REQUIRE(reference.converged());
  for (auto const& [stiffness, load] :
       {std::pair{0, 480}, {0, -480}, {300, -100}, {-300, 100}, {480, 480}, {-480, -480}}) {
    CAPTURE(stiffness);
    CAPTURE(load);
    auto c = given;
    c.f *= std::ldexp(1.0, load);
    c.d *= std::ldexp(1.0, load - stiffness);
    auto const r = solve(Eigen::SparseMatrix<double>(std::ldexp(1.0, stiffness) * s.K), c, F);
    CAPTURE(r.reason);
    CHECK(r.converged());
    VectorXd const u = std::ldexp(1.0, stiffness - load) * r.u;
    CHECK((u - reference.u).norm() <= 1e-7 * reference.u.norm());
  }
}

TEST_CASE("certified_coulomb: options and coefficients that do not fit are refused") {
  auto const s = fem::make_steel_brick({.k = 1});
  auto const c = test::contact_data(s);
  VectorXd const F = VectorXd::Constant(c.nodes(), 0.3);
  auto const message = [&](VectorXd const& coefficients,
                           contact::certified_coulomb_options const& o = {}) -> std::string {
    return test::complaint([&] { static_cast<void>(solve(s.K, c, coefficients, o)); });
  };
  CHECK(message(-F) == "F[0]: got -0.3, expected a finite number >= 0");
  CHECK(message(F.head(2)).starts_with("number of friction coefficients: got 2"));
  CHECK(message(F, {.tolerance = 1}).starts_with("tolerance: got 1"));
  CHECK(message(F, {.newton_steps = 0}) == "newton_steps: got 0, expected at least 1");
  CHECK(message(F, {.outer_steps = 0}) == "outer_steps: got 0, expected at least 1");
}

}  // namespace certified_coulomb_test
