// SPDX-License-Identifier: MIT
#include "grids.hpp"

#include <slant/contact/rigid_body_modes.hpp>
#include <slant/multilevel/multigrid.hpp>
#include <slant/testing/operator_laws.hpp>

#include <fem/steel_brick.hpp>
#include <support/allocation_guard.hpp>
#include <support/effort.hpp>

#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>

namespace multigrid_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using sparse = Eigen::SparseMatrix<double>;
using multigrid = slant::multigrid<double>;
using test::laplacian;

/// Keeps the unknowns whose entry is 1.
struct mask {
  VectorXd kept;
  void keep(VectorXd const& x, VectorXd& y) const { y = kept.cwiseProduct(x); }
};

/// The smallest and the largest eigenvalue of M K on the unknowns that are kept, all by dense
/// algebra but M.
std::pair<double, double> spectrum(multigrid const& m, sparse const& K, VectorXd const& kept) {
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < kept.size(); ++i) {
    if (kept[i] != 0) free.push_back(i);
  }
  auto const n = static_cast<Eigen::Index>(free.size());
  MatrixXd M(n, n);
  auto w = m.workspace(kept);
  m.enter(mask{kept}, w);
  VectorXd y(kept.size());
  for (Eigen::Index j = 0; j < n; ++j) {
    m.apply_on_face(VectorXd::Unit(kept.size(), free[static_cast<std::size_t>(j)]), y, w);
    M.col(j) = y(free);
    CHECK((y.array() == 0 || kept.array() != 0).all());
  }
  CHECK((M - M.transpose()).norm() <= 1e-12 * M.norm());
  MatrixXd const K_FF = MatrixXd(K)(free, free);
  Eigen::LLT<MatrixXd> const root(K_FF);
  MatrixXd const L = root.matrixL();
  Eigen::SelfAdjointEigenSolver<MatrixXd> const e(MatrixXd(L.transpose() * M * L));
  return {e.eigenvalues()[0], e.eigenvalues()[n - 1]};
}

/// Steps of preconditioned conjugate gradients to 1e-10 on the unknowns that are kept.
int steps(multigrid const& m, sparse const& K, VectorXd const& b, VectorXd const& kept) {
  auto w = m.workspace(b);
  m.enter(mask{kept}, w);
  VectorXd r = kept.cwiseProduct(b), z(b.size()), p = VectorXd::Zero(b.size());
  double const start = r.norm();
  double last = 1;
  int k = 0;
  for (; r.norm() > 1e-10 * start && k < 1000; ++k) {
    m.apply_on_face(r, z, w);
    double const rz = r.dot(z);
    p = z + (rz / last) * p;
    last = rz;
    VectorXd const q = kept.cwiseProduct(VectorXd(K * p));
    r -= (rz / p.dot(q)) * q;
  }
  return k;
}

TEST_CASE("a cycle is self-adjoint and definite") {
  multigrid const membrane(laplacian(15, 12), {.coarsest = 10});
  REQUIRE(membrane.sizes().size() >= 3);
  slant::testing::check_operator_laws(membrane);
  auto const brick = fem::make_steel_brick({.k = 2});
  slant::testing::check_operator_laws(multigrid(brick.K, {.sweeps = 2, .coarsest = 20}));
  slant::testing::check_operator_laws(multigrid(laplacian(4, 3)));  // factored at once
}

TEST_CASE("with one level it is the inverse") {
  sparse const K = laplacian(5, 4);
  multigrid const m(K);
  CHECK(m.sizes() == std::vector<slant::index>{20});
  VectorXd const b = VectorXd::LinSpaced(20, -1, 2);
  VectorXd x(20);
  slant::apply(m, b, x);
  CHECK((K * x - b).norm() <= 1e-13 * b.norm());
}

TEST_CASE("with one level what a face holds stays at zero, as with several") {
  auto const s = fem::make_steel_brick({.k = 2});
  VectorXd kept = VectorXd::Ones(s.f.size());
  for (slant::index i = 2; i < kept.size(); i += 7) kept[i] = 0;
  struct {
    VectorXd const& kept;
    void keep(VectorXd const& x, VectorXd& y) const { y = kept.cwiseProduct(x); }
  } const face{kept};
  for (slant::index const coarsest : {600, 60}) {
    multigrid const m(s.K, {.coarsest = coarsest});
    VectorXd x = kept.cwiseProduct(VectorXd::LinSpaced(s.f.size(), -1, 2)), y(s.f.size());
    auto w = slant::workspace(m, x);
    m.enter(face, w);
    m.apply_on_face(x, y, w);
    CHECK(y == kept.cwiseProduct(y));
    CHECK(x.dot(y) > 0);
  }
}

TEST_CASE("the spectrum on the whole space and on faces, by dense algebra") {
  auto const s = fem::make_steel_brick({.k = 3});
  multigrid const m(s.K, slant::contact::rigid_body_modes(test::moving_nodes(s)), {.coarsest = 60});
  VectorXd const all = VectorXd::Ones(s.f.size());
  auto const [least, most] = spectrum(m, s.K, all);
  CHECK(least >= 0.15);
  CHECK(most <= 1 + 1e-10);  // the energy of the error never grows
  VectorXd const held = all - VectorXd((s.N.cwiseAbs().transpose() * VectorXd::Ones(s.d.size())));
  auto const [on_face, above] = spectrum(m, s.K, held);
  // The coarse correction moves what is held, and what is left of it when that is cut off has a
  // multiple of its energy: a few large eigenvalues, which conjugate gradients find in as many
  // steps.
  CHECK(on_face >= 0.1);
  CHECK(above <= 100);
}

TEST_CASE("steps of conjugate gradients do not grow with the mesh, whatever is held") {
  for (int k = 2; k <= test::effort(6, 3); ++k) {
    auto const s = fem::make_steel_brick({.k = k, .load = fem::brick_load::lift});
    multigrid const m(s.K, slant::contact::rigid_body_modes(test::moving_nodes(s)),
                      {.coarsest = 200});
    VectorXd const all = VectorXd::Ones(s.f.size());
    VectorXd const touching = s.N.cwiseAbs().transpose() * VectorXd::Ones(s.d.size());
    VectorXd half = all;
    for (Eigen::Index i = 0; i < half.size() / 2; ++i) half[i] -= touching[i];
    CHECK(steps(m, s.K, s.f, all) <= 30);
    CHECK(steps(m, s.K, s.f, all - touching) <= 45);
    CHECK(steps(m, s.K, s.f, half) <= 38);
    CHECK(m.complexity() <= 1.7);
  }
  for (int const n : {20, 40, 80}) {
    sparse const K = laplacian(n, n);
    VectorXd const ones = VectorXd::Ones(n * n);
    CHECK(steps(multigrid(K, {.coarsest = 50}), K, ones, ones) <= 18);
  }
}

TEST_CASE("rigid-body modes are worth giving; the bits of a cycle do not depend on units") {
  auto const s = fem::make_steel_brick({.k = 4});
  auto const modes = slant::contact::rigid_body_modes(test::moving_nodes(s));
  multigrid const m(s.K, modes, {.coarsest = 100});
  VectorXd const all = VectorXd::Ones(s.f.size());
  CHECK(steps(m, s.K, s.f, all) < steps(multigrid(s.K, {.coarsest = 100}), s.K, s.f, all));
  VectorXd x(all.size()), y(all.size());
  slant::apply(m, s.f, x);
  for (int const e : {-330, 330}) {
    double const unit = std::ldexp(1.0, e);
    slant::apply(multigrid(sparse(unit * s.K), modes, {.coarsest = 100}), s.f, y);
    CHECK(y * unit == x);
  }
}

TEST_CASE("other scalars") {
  slant::multigrid<float> const m(laplacian<float>(9, 8), {.coarsest = 10});
  slant::testing::check_operator_laws(m, Eigen::VectorXf(9 * 8));
}

TEST_CASE("no allocation in a cycle; copies share the levels") {
  multigrid const m(laplacian(20, 20), {.coarsest = 30});
  multigrid const copy = m;
  VectorXd const x = VectorXd::Ones(400);
  VectorXd y(400), z(400);
  auto w = m.workspace(x);
  slant::apply(m, x, y, w);
  mask const face{VectorXd::LinSpaced(400, 0, 1).array().round().matrix()};
  slant::testing::allocation_guard guard;
  slant::apply(m, x, y, w);
  m.enter(face, w);
  m.apply_on_face(x, z, w);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
  slant::apply(copy, x, z, w);
  CHECK(z == y);
}

TEST_CASE("nothing, isolated unknowns, everything held") {
  VectorXd y(0);
  slant::apply(multigrid(sparse(0, 0)), VectorXd(0), y);
  sparse diagonal(900, 900);
  diagonal.setIdentity();
  multigrid const m(sparse(4 * diagonal), {.coarsest = 5});
  VectorXd x(900);
  slant::apply(m, VectorXd(VectorXd::Ones(900)), x);
  CHECK(x == VectorXd::Constant(900, 0.25));
  multigrid const membrane(laplacian(12, 12), {.coarsest = 20});
  VectorXd z(144);
  auto w = membrane.workspace(z);
  membrane.enter(mask{VectorXd::Zero(144)}, w);
  membrane.apply_on_face(VectorXd::Ones(144), z, w);
  CHECK(z == VectorXd::Zero(144));
}

TEST_CASE("an unknown by itself, where damping leaves nothing of its smoothed column") {
  int const n = 901;  // of the ring λ_max(D⁻¹K) = 4/3, the damping
  sparse K(n, n);
  for (int i = 0; i + 1 < n; ++i) {
    int const next = (i + 1) % (n - 1);
    K.coeffRef(i, i) = 4;
    K.coeffRef(i, next) = K.coeffRef(next, i) = -2.0 / 3;
  }
  K.coeffRef(n - 1, n - 1) = 4;
  K.makeCompressed();
  multigrid const m(K);
  VectorXd const x = VectorXd::LinSpaced(n, -1, 1);
  VectorXd y(n);
  slant::apply(m, x, y);
  CHECK(x.dot(y) > 0);
  CHECK(y[n - 1] == doctest::Approx(x[n - 1] / 4));
}

TEST_CASE("what cannot be used is named") {
  sparse K = laplacian(10, 10);
  CHECK_THROWS_AS(multigrid(sparse(3, 4)), slant::bad_input);
  CHECK_THROWS_WITH_AS(multigrid(K, {.block_size = 3}),
                       "block_size: got 3, expected a divisor of 100", slant::bad_input);
  CHECK_THROWS_AS(multigrid(K, MatrixXd::Ones(99, 1)), slant::bad_input);
  CHECK_THROWS_AS(multigrid(K, MatrixXd::Constant(100, 1, std::nan(""))), slant::bad_input);
  CHECK_THROWS_AS(multigrid(K, {.damping = 3}), slant::bad_input);
  sparse negative = K;
  negative.coeffRef(7, 7) = -4;
  CHECK_THROWS_WITH_AS(multigrid{negative},
                       "K: got diagonal entry 7 = -4 on level 0, expected a symmetric positive "
                       "definite matrix",
                       slant::bad_input);
  sparse shifted = K;
  for (int i = 0; i < 100; ++i) shifted.coeffRef(i, i) -= 1;  // a negative eigenvalue, smooth
  CHECK_THROWS_AS(multigrid(shifted, {.coarsest = 20}), slant::bad_input);
  K.coeffRef(3, 4) = 2;
  CHECK_THROWS_AS(multigrid{K}, slant::bad_input);
  K.coeffRef(3, 4) = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(multigrid{K}, slant::bad_input);
}

}  // namespace multigrid_test
