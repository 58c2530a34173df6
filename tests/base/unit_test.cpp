// SPDX-License-Identifier: MIT
#include <slant/iteration/solve.hpp>
#include <slant/krylov/krylov.hpp>

#include <support/testing.hpp>
#include "krylov/spd_matrices.hpp"

namespace unit_test {

TEST_CASE("the unit is a power of two next to the size, whose reciprocal is finite") {
  CHECK(slant::unit_near(1.0) == 2);
  CHECK(slant::unit_near(0.75) == 1);
  CHECK(slant::unit_near(3e-5f) == 0x1p-15f);
  CHECK(slant::unit_near(0.0) == 1);
  CHECK(slant::unit_near(std::nan("")) == 1);
  CHECK(slant::unit_near(std::numeric_limits<double>::infinity()) == 1);
  for (double extreme :
       {std::numeric_limits<double>::max(), std::numeric_limits<double>::denorm_min()}) {
    CHECK(std::isfinite(1 / slant::unit_near(extreme)));
    CHECK(slant::unit_near(extreme) > 0);
  }
}

TEST_CASE("A and b of size 1e±150: the same bits after the same steps") {
  auto const M = test::with_spectrum(test::log_spaced(40, 100));
  VectorXd const b = test::random_vector(40);
  auto const runs = [&](int stiffness, int load) {
    double const s = std::ldexp(1.0, stiffness), t = std::ldexp(1.0, load);
    auto const A = test::spd(MatrixXd(s * M));
    VectorXd const right = t * b, zero = VectorXd::Zero(40);
    auto const stop = slant::residual_below(1e-12) || slant::at_most(400);
    struct run {
      slant::status status;
      slant::index iterations;
      VectorXd x;
    };
    auto const summary = [&](auto const& r) {
      return run{r.status, r.iterations(), VectorXd(r.x() / t * s)};
    };
    return std::vector{summary(slant::solve(slant::cg{A, right}, zero, stop)),
                       summary(slant::solve(slant::bicgstab{A, right}, zero, stop))};
  };
  auto const plain = runs(0, 0);
  for (auto const& [stiffness, load] :
       {std::pair{498, 0}, {-498, 0}, {0, 498}, {0, -498}, {498, 498}, {-498, -498}}) {
    auto const scaled = runs(stiffness, load);
    for (std::size_t i = 0; i < plain.size(); ++i) {
      CAPTURE(i);
      CAPTURE(stiffness);
      CAPTURE(load);
      CHECK(plain[i].status == slant::status::converged);
      CHECK(scaled[i].status == plain[i].status);
      CHECK(scaled[i].iterations == plain[i].iterations);
      CHECK(scaled[i].x == plain[i].x);
    }
  }
}

}  // namespace unit_test
