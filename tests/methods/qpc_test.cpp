// SPDX-License-Identifier: MIT
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

}  // namespace qpc_test
