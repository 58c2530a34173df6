// SPDX-License-Identifier: MIT
//
// That the contacts with known solutions have these solutions and no other, by enumeration.
#include <doctest/doctest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <oracle/naive_friction.hpp>
#include <vector>

#include "friction_cases.hpp"

namespace friction_cases_test {

using Eigen::VectorXd;

Eigen::MatrixXd dense(test::friction_problem const& p) {
  return p.W;
}

/// Open and stick, where they satisfy the law. A W without inverse sticks for no q but special
/// ones.
std::vector<VectorXd> without_slip(test::friction_problem const& p) {
  std::vector<VectorXd> found;
  if (p.q[0] >= 0) found.push_back(VectorXd::Zero(p.q.size()));
  Eigen::FullPivLU<Eigen::MatrixXd> const lu(dense(p));
  if (!lu.isInvertible()) return found;
  VectorXd const r = lu.solve(-p.q);
  if (r[0] > 0 && r.tail(r.size() - 1).norm() <= p.mu[0] * r[0]) found.push_back(r);
  return found;
}

/// The force that keeps u_n = 0 when the contact slips in direction e, and the velocity then;
/// r_n <= 0 if there is none.
struct sliding {
  sliding(test::friction_problem const& p, VectorXd const& e) {
    r.resize(p.q.size());
    r << 1, -p.mu[0] * e;
    double const pushed = dense(p).row(0).dot(r);
    r *= pushed == 0 ? -1 : -p.q[0] / pushed;
    u = dense(p) * r + p.q;
  }
  VectorXd r{}, u{};
};

/// All solutions of one contact in the plane.
std::vector<VectorXd> plane_solutions(test::friction_problem const& p) {
  auto found = without_slip(p);
  for (double const side : {-1., 1.}) {
    sliding const s(p, test::numbers({side}));
    if (s.r[0] > 0 && s.u[1] * side > 0) found.push_back(s.r);
  }
  return found;
}

/// Directions in space in which one contact slips: sign changes of the component of u_t across e
/// where u_t points along e.
int directions_of_slip(test::friction_problem const& p) {
  int const steps = 3600;
  int changes = 0;
  double before = 0;
  for (int i = 0; i <= steps; ++i) {
    double const angle = 2 * std::numbers::pi * (i + 0.5) / steps;
    VectorXd const e = test::numbers({std::cos(angle), std::sin(angle)});
    sliding const s(p, e);
    double const across = s.u[1] * e[1] - s.u[2] * e[0];
    bool const along = s.r[0] > 0 && s.u.tail(2).dot(e) > 0;
    if (i > 0 && along && across * before < 0) ++changes;
    before = along ? across : 0;
  }
  return changes;
}

bool is_among(VectorXd const& r, std::vector<VectorXd> const& found) {
  for (auto const& other : found) {
    if ((r - other).norm() <= 1e-14 * (1 + r.norm())) return true;
  }
  return false;
}

TEST_CASE("cases: these are all solutions") {
  auto cases = test::single_solution_cases();
  cases.push_back(test::three_solutions_case());
  for (auto const& c : cases) {
    CAPTURE(c.name);
    if (c.problem.dimension() == 2) {
      auto const found = plane_solutions(c.problem);
      CHECK(found.size() == c.r.size());
      for (auto const& r : c.r) CHECK(is_among(r, found));
    } else {
      auto const found = without_slip(c.problem);
      bool const slips = c.name.find("open") == std::string::npos && !is_among(c.r[0], found);
      CHECK(found.size() == (slips ? 0 : 1));
      CHECK(directions_of_slip(c.problem) == (slips ? 1 : 0));
    }
  }
  CHECK(plane_solutions(test::no_solution_case(2).problem).empty());
  auto const none = test::no_solution_case(3).problem;
  CHECK(without_slip(none).empty());
  // u_t is along −t₁ whatever the force, so friction along t₁, and then r_n <= 0.
  CHECK(sliding(none, test::numbers({-1, 0})).r[0] < 0);
  CHECK(directions_of_slip(none) == 0);
}

TEST_CASE("cases: a redundant contact satisfies the law in many ways") {
  auto const c = test::redundant_case();
  CHECK(Eigen::FullPivLU<Eigen::MatrixXd>(dense(c.problem)).rank() == 2);
  for (auto const& r : c.r) {
    for (auto const& f : oracle::naive_friction(
             dense(c.problem).cast<long double>(), c.problem.q.cast<long double>(),
             c.problem.mu.cast<long double>(), r.cast<long double>())) {
      CHECK(double(f.natural_map) < 1e-15);
    }
  }
}

}  // namespace friction_cases_test
