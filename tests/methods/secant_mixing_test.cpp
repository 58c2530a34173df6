// SPDX-License-Identifier: MIT
#include <slant/methods/successive_approximations.hpp>

#include <support/testing.hpp>

namespace secant_mixing_test {

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

TEST_CASE(
    "one unknown: a secant step is the end, at any scale; n of them: faster than plain steps") {
  for (double const unit : {1.0, 1e-150, 1e150}) {
    for (double const rate : {0.8, -3.0}) {
      affine_map const Ψ(1, rate, unit);
      slant::secant_mixing<VectorXd> mixing(Ψ.c, 1);
      VectorXd p = VectorXd::Zero(1), next(1);
      for (int k = 0; k < 2; ++k) {
        CHECK(mixing.mix(p, VectorXd(Ψ.M * p + Ψ.c - p), 1.0, next) == (k > 0));
        p = next;
      }
      CHECK((p - Ψ.fixed).norm() <= 1e-14 * unit);
    }
  }
  affine_map const Ψ(20, 0.7, 1);
  slant::secant_mixing<VectorXd> mixing(Ψ.c, 20);
  VectorXd p = VectorXd::Zero(20), q = p, next(20);
  for (int k = 0; k < 15; ++k) {
    q = Ψ.M * q + Ψ.c;
    static_cast<void>(mixing.mix(p, VectorXd(Ψ.M * p + Ψ.c - p), 1.0, next));
    p = next;
  }
  CHECK((p - Ψ.fixed).norm() <= 0.5 * (q - Ψ.fixed).norm());
}

TEST_CASE("what is forgotten is not used") {
  affine_map const Ψ(3, 0.5, 1);
  slant::secant_mixing<VectorXd> mixing(Ψ.c, 3);
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
  slant::secant_mixing<VectorXd> mixing(VectorXd::Zero(2), 2);
  VectorXd next(2);
  VectorXd const f = VectorXd::Ones(2);
  CHECK_FALSE(mixing.mix(VectorXd::Zero(2), f, 1.0, next));
  CHECK_FALSE(mixing.mix(VectorXd::Ones(2), f, 1.0, next));  // Δf = 0
  CHECK(next == 2 * VectorXd::Ones(2));
}

}  // namespace secant_mixing_test
