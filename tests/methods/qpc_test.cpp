// SPDX-License-Identifier: MIT
#include "example_one.hpp"

#include <slant/iteration/iterates.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <krylov/spd_matrices.hpp>
#include <oracle/dense_newton.hpp>

namespace qpc_test {

using Eigen::VectorXd;

TEST_CASE("blocks are released only from (nearly) the minimum on the face") {
  auto const M = test::with_spectrum(test::log_spaced(20, 100));
  VectorXd const b = 3 * test::random_vector(20, 5);
  auto const A = test::spd(M);
  auto const qp = slant::separable_qp{A, b, slant::half_lines(20)};
  oracle::dense_qp plain{M, b.cast<long double>(), {}, {}};
  for (Eigen::Index i = 0; i < 20; ++i) plain.intervals.push_back({i, 0});
  VectorXd const reference = oracle::solve_dense(plain).x.cast<double>();
  for (double δ : {0.5, 1e-2, 1e-8}) {
    CAPTURE(δ);
    slant::qpc const method{qp, {.face_accuracy = δ}};
    auto s = method.start(VectorXd::Ones(20));
    int releases = 0, faces = 0;
    for (int k = 0; k < 500 && s.reduced_gradient_norm > 1e-10 * s.gradient_scale; ++k) {
      double const φ = s.φr, β = s.βr, first = s.φr_at_restart;
      VectorXd const before = s.x;
      auto const face = s.face;
      method.step(s);
      if (s.last_step != slant::kprgp_step::conjugate_gradient) ++faces;
      if (s.last_step != slant::kprgp_step::proportioning) continue;
      ++releases;
      CHECK(φ <= δ * δ * std::max(first, β));
      // q is as small as it gets without releasing anything, up to that accuracy.
      VectorXd free_gradient = M * before - b;
      face.keep(free_gradient, free_gradient);
      CHECK(free_gradient.squaredNorm() <=
            1.0001 * s.unit * s.unit * δ * δ * std::max(first, β) + 1e-24 * b.squaredNorm());
    }
    CHECK(releases > 0);
    CHECK(faces > releases);
    CHECK((s.x - reference).norm() <= 1e-8 * reference.norm());
  }
}

TEST_CASE("a first phase for other methods: Example 1 to 1e-1, 1e-3, 1e-6") {
  test::example_one<double> const p;
  test::example_one_solution<double> const solution;
  auto const qp = slant::separable_qp{p.a(), p.b, p.set()};
  for (double const tolerance : {1e-1, 1e-3, 1e-6}) {
    auto const r = slant::solve(slant::qpc{qp}, p.zero(),
                                slant::reduced_gradient_below(tolerance) || slant::at_most(60));
    REQUIRE(r.converged());
    CHECK((r.x() - solution.x).norm() <= tolerance * 10 * solution.x.norm());
  }
}

TEST_CASE("options out of range are named") {
  slant::qpc_options<double> o;
  o.face_accuracy = 1;
  CHECK_THROWS_WITH_AS(o.validate(), "face_accuracy: got 1, expected a number in [0, 1)",
                       slant::bad_input);
  o = {};
  o.step_factor = 2;
  CHECK_THROWS_WITH_AS(o.validate(), "step_factor: got 2, expected a number in (0, 2)",
                       slant::bad_input);
}

}  // namespace qpc_test
