// SPDX-License-Identifier: MIT
#include <slant/methods/successive_approximations.hpp>

#include <support/testing.hpp>

namespace anderson_mixing_test {

/// Ψ(p) = M p + c with a fixed point of size `unit`.
struct affine_map {
  MatrixXd M;
  VectorXd c, fixed;
  explicit affine_map(Eigen::Index n, double rate, double unit) {
    M = MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      M(i, i) = rate * static_cast<double>(i + 1) / static_cast<double>(n);
      if (i + 1 < n) M(i, i + 1) = 0.1;
    }
    fixed = unit * VectorXd::LinSpaced(n, 1, 2);
    c = fixed - M * fixed;
  }
};

/// Error after some steps from 0, relative to the fixed point.
double error_after(affine_map const& Ψ, Eigen::Index window, int steps) {
  Eigen::Index const n = Ψ.c.size();
  slant::anderson_mixing<VectorXd> mixing(Ψ.c, n, window);
  VectorXd p = VectorXd::Zero(n), next(n), f(n);
  slant::testing::allocation_guard guard;
  for (int k = 0; k < steps; ++k) {
    f.noalias() = Ψ.M * p;
    f += Ψ.c - p;
    bool const used = mixing.mix(p, f, 1.0, next);
    if (used != (k > 0 && window > 0)) return -1;
    p.swap(next);
  }
  auto const allocations = guard.count();
  CHECK(allocations == 0);
  return (p - Ψ.fixed).cwiseAbs().maxCoeff() / Ψ.fixed.cwiseAbs().maxCoeff();
}

TEST_CASE("an affine map of n unknowns is done after n differences, at any scale") {
  for (double const unit : {1.0, 1e-150, 1e150}) {
    CAPTURE(unit);
    affine_map const contraction(4, 0.8, unit), expansion(4, -3, unit);
    CHECK(error_after(contraction, 4, 6) <= 1e-12);
    CHECK(error_after(contraction, 4, 4) >= 1e-6);
    CHECK(error_after(expansion, 4, 6) <= 1e-11);
  }
}

TEST_CASE("fewer differences than unknowns: faster than none, which is the plain iteration") {
  affine_map const Ψ(20, 0.7, 1);
  VectorXd p = VectorXd::Zero(20);
  for (int k = 0; k < 15; ++k) p = Ψ.M * p + Ψ.c;
  double const plain = (p - Ψ.fixed).cwiseAbs().maxCoeff() / 2;
  CHECK(error_after(Ψ, 0, 15) == doctest::Approx(plain).epsilon(1e-10));
  CHECK(error_after(Ψ, 5, 15) <= 0.01 * plain);
}

TEST_CASE("what is forgotten is not used") {
  affine_map const Ψ(3, 0.5, 1);
  slant::anderson_mixing<VectorXd> mixing(Ψ.c, 3, 3);
  VectorXd p = VectorXd::Zero(3), next(3);
  for (int k = 0; k < 3; ++k) {
    static_cast<void>(mixing.mix(p, VectorXd(Ψ.M * p + Ψ.c - p), 1.0, next));
    p = next;
  }
  mixing.forget();
  VectorXd const f = Ψ.M * p + Ψ.c - p;
  CHECK_FALSE(mixing.mix(p, f, 0.5, next));
  CHECK(next == p + 0.5 * f);
}

TEST_CASE("a difference that tells nothing new is left out") {
  slant::anderson_mixing<VectorXd> mixing(VectorXd::Zero(2), 2, 3);
  VectorXd next(2);
  VectorXd const f = VectorXd::Ones(2);
  CHECK_FALSE(mixing.mix(VectorXd::Zero(2), f, 1.0, next));
  CHECK_FALSE(mixing.mix(VectorXd::Ones(2), f, 1.0, next));  // Δf = 0
  CHECK(next == 2 * VectorXd::Ones(2));
}

}  // namespace anderson_mixing_test
