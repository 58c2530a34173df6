// SPDX-License-Identifier: MIT
//
// bingham: velocity, flow rate and plug beside Bingham's law, integrated here: the shear stress at
// the radius r is f r/2, the shear rate max(0, f r/2 − g)/η.
#include <bingham/pipe.hpp>
#include <numbers>
#include "run_program.hpp"

namespace bingham_programs {
namespace {

using namespace examples_test;
using Eigen::Index;

/// Of one viscous profile on a fine grid, from the wall inwards.
struct profile {
  static constexpr int n = 20000;
  double step;
  VectorXd velocity = VectorXd::Zero(n + 1);
  double rate = 0;

  explicit profile(bingham::fluid const& p) : step(p.R / n) {
    for (int i = n; i-- > 0;) {
      double const r = (i + 0.5) * step;
      velocity[i] = velocity[i + 1] + step * std::max(0.0, p.f * r / 2 - p.g) / p.η;
      rate += std::numbers::pi * step * r * (velocity[i] + velocity[i + 1]);
    }
  }
  double operator()(double r) const {
    double const place = r / step;
    auto const i = std::min<Index>(static_cast<Index>(place), n - 1);
    double const share = place - static_cast<double>(i);
    return (1 - share) * velocity[i] + share * velocity[i + 1];
  }
};

struct errors {
  double rate, velocity, plug, energy;
};

errors errors_of(bingham::fluid const& p, int rings) {
  CAPTURE(p.g);
  CAPTURE(rings);
  auto const d = bingham::discretised(p, rings);
  auto const flow = bingham::solve(d, 1e-9);
  CHECK(flow.status == slant::status::converged);
  profile const exact(p);
  errors e{std::abs(flow.rate - exact.rate), 0,
           std::abs(flow.plug_radius - std::min(p.R, 2 * p.g / p.f)), flow.energy_error};
  for (Index i = 0; i < flow.u.size(); ++i)
    e.velocity = std::max(e.velocity, std::abs(flow.u[i] - exact(d.nodes.col(i).norm())));
  return e;
}

}  // namespace

TEST_CASE("bingham: errors fall like the square of the width of the mesh") {
  for (double const g : {0.0, 0.2, 0.25}) {
    errors before = errors_of({.g = g}, 4);
    double const coarsest = before.velocity;
    for (int const rings : {8, 16, 32}) {
      auto const e = errors_of({.g = g}, rings);
      CHECK(e.rate <= before.rate / 3.3);
      CHECK(e.rate >= before.rate / 5);
      CHECK(e.plug <= 0.7 / rings);  // the plug ends between two rings
      CHECK(e.energy <= 1e-5);
      before = e;
    }
    CHECK(before.velocity <= coarsest / 30);  // 64 where the plug ends on a ring
  }
  auto const other = errors_of({.η = 3, .g = 2, .f = 10, .R = 2}, 16);
  CHECK(other.velocity <= 2e-3 * profile({.η = 3, .g = 2, .f = 10, .R = 2}).velocity[0]);
}

TEST_CASE("bingham: nothing flows where g is at least f R/2, and something where it is less") {
  for (double const g : {0.5, 0.7}) {
    auto const still = bingham::solve(bingham::discretised({.g = g}, 8), 1e-9);
    CHECK(still.status == slant::status::converged);
    CHECK(still.u.cwiseAbs().maxCoeff() <= 1e-14);
  }
  auto const slow = bingham::solve(bingham::discretised({.g = 0.47}, 32), 1e-9);
  CHECK(slow.u.maxCoeff() == doctest::Approx(profile({.g = 0.47})(0)).epsilon(0.2));
}

TEST_CASE("bingham: the program") {
  auto const ran = output_of("bingham", "--yield 0.25");
  std::istringstream lines(ran);
  int rows = 0, still = 0;
  for (std::string line; std::getline(lines, line);) {
    double g = 0, rings = 0, triangles = 0, ours = 0, exact = 0;
    if (!(std::istringstream(line) >> g >> rings >> triangles >> ours >> exact)) continue;
    ++rows;
    CHECK(contains(line, "converged"));
    CHECK(exact == doctest::Approx(profile({.g = g}).rate).epsilon(1e-4));
    if (g >= 0.5) still += ours == 0;
  }
  CHECK(rows == 10);
  CHECK(still == 2);
  check_refused(run("bingham", "--yield -1"), "--yield");
}

}  // namespace bingham_programs
