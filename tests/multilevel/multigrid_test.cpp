// SPDX-License-Identifier: MIT
#include "grids.hpp"

#include <slant/contact/free_motions.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/krylov/cg.hpp>
#include <slant/krylov/preconditioner.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/multilevel/multigrid.hpp>
#include <slant/operators/applied.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/problems/separable_qp.hpp>
#include <slant/sets/contact_sets.hpp>
#include <slant/sets/curved_face.hpp>
#include <slant/testing/laws.hpp>

#include <fem/box_prolongations.hpp>
#include <fem/steel_brick.hpp>
#include <support/testing.hpp>

namespace multigrid_test {

using namespace test::evaluated;
using Eigen::Matrix3d;
using multigrid = slant::multigrid<double>;
using exact_multigrid = slant::multigrid<double, double>;
using test::laplacian;

static_assert(slant::spd_operator<multigrid, VectorXd>);
static_assert(slant::preconditions_faces<multigrid, VectorXd, slant::curved_face<double>>);

/// Keeps the unknowns whose entry is 1.
struct mask {
  VectorXd kept;
  void keep(VectorXd const& x, VectorXd& y) const { y = kept.cwiseProduct(x); }
  void block_entries(auto const& f) const {
    for (Eigen::Index i = 0; i < kept.size(); ++i) f(i, i, kept(i), 0.0);
  }
};

/// Projectors and curvatures on nodes of three unknowns.
struct surface {
  sparse Π, C;

  explicit surface(Eigen::Index n) : Π(n, n), C(n, n) {
    Π.setIdentity();
    C.setZero();
  }
  void set(int i, Matrix3d const& p, Matrix3d const& c = Matrix3d::Zero()) {
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) {
        Π.coeffRef(3 * i + a, 3 * i + b) = p(a, b);
        C.coeffRef(3 * i + a, 3 * i + b) = c(a, b);
      }
    }
  }
  void keep(VectorXd const& x, VectorXd& y) const { y = Π * x; }
  void block_entries(auto const& f) const {
    for (Eigen::Index i = 0; i < Π.rows(); ++i) {
      for (Eigen::Index j = i / 3 * 3; j < i / 3 * 3 + 3; ++j)
        f(i, j, Π.coeff(i, j), C.coeff(i, j));
    }
  }
  [[nodiscard]] sparse operator_on(sparse const& K, double α) const {
    return sparse(Π * sparse(K * Π)) + sparse(α * C);
  }
};

/// Of the contact nodes a quarter each is free, held, in a plane across a direction, and slides
/// along one with a curvature.
surface mixed(fem::contact_scene<3> const& s, double bend) {
  surface all(s.f.size());
  for (std::size_t k = 0; k < s.contact_nodes.size(); ++k) {
    int const i = s.unknowns.first[s.contact_nodes[k]] / 3;
    Vector3d const n = Vector3d(std::sin(double(k)), std::cos(double(k)), 2).normalized();
    if (k % 4 == 1) all.set(i, Matrix3d::Zero());
    if (k % 4 == 2) all.set(i, Matrix3d::Identity() - n * n.transpose());
    if (k % 4 == 3) {
      Vector3d const t = n.cross(Vector3d::UnitX()).normalized();
      Matrix3d const plane = Matrix3d::Identity() - n * n.transpose();
      all.set(i, plane, bend * (plane - t * t.transpose()));
    }
  }
  return all;
}

/// Of the mesh of a brick and those of cells twice as long.
std::vector<sparse> interpolation(int k) {
  auto const s = fem::make_steel_brick({.k = k});
  return fem::box_prolongations(fem::make_brick_mesh(k, {3, 1, 1}), s.unknowns);
}

/// A face and where it is entered.
template <class M, class Face>
MatrixXd dense_on_face(M const& m, Face const& face, double weight, Eigen::Index n) {
  VectorXd y(n);
  auto w = m.workspace(y);
  m.enter(face, weight, w);
  MatrixXd dense(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    VectorXd x = VectorXd::Unit(n, j);
    face.keep(VectorXd(x), x);
    m.apply_on_face(x, y, w);
    dense.col(j) = y;
  }
  return dense;
}

struct extent {
  double least, most;
};

/// The spectrum of M H on range(Π), by dense algebra; M has to be self-adjoint and to stay there.
extent spectrum(MatrixXd const& M, MatrixXd const& Π, MatrixXd const& H, double rounding) {
  CHECK((M - M.transpose()).norm() <= rounding * M.norm());
  CHECK((Π * M - M).norm() <= rounding * M.norm());
  Eigen::SelfAdjointEigenSolver<MatrixXd> const range(Π);
  auto const rank = Eigen::Index(std::lround(Π.trace()));
  MatrixXd const Q = range.eigenvectors().rightCols(rank);
  Eigen::LLT<MatrixXd> const root(Q.transpose() * H * Q);
  REQUIRE(root.info() == Eigen::Success);
  MatrixXd const L = root.matrixL();
  MatrixXd const whole = L.transpose() * Q.transpose() * M * Q * L;
  VectorXd const λ = test::eigenvalues_of(0.5 * (whole + whole.transpose()));
  return {λ[0], λ[rank - 1]};
}

/// Steps of preconditioned conjugate gradients for H t = Π b until the residual is 1e-10 of it.
template <class M, class Face>
int steps(M const& m, sparse const& H, VectorXd const& b, Face const& face, double weight = 0) {
  auto w = m.workspace(b);
  m.enter(face, weight, w);
  VectorXd r = b, z(b.size()), p = VectorXd::Zero(b.size());
  face.keep(b, r);
  double const start = r.norm();
  double last = 1;
  int k = 0;
  for (; r.norm() > 1e-10 * start && k < 1000; ++k) {
    m.apply_on_face(r, z, w);
    double const rz = r.dot(z);
    REQUIRE(rz > 0);
    p = z + (rz / last) * p;
    last = rz;
    VectorXd const q = H * p;
    r -= (rz / p.dot(q)) * q;
  }
  return k;
}
mask all_free(Eigen::Index n) {
  return {VectorXd::Ones(n)};
}
/// Nothing moves towards the obstacle at the contact nodes of the first part of the brick.
mask touching(fem::contact_scene<3> const& s, double part) {
  VectorXd kept = VectorXd::Ones(s.f.size());
  VectorXd const normal = s.N.cwiseAbs().transpose() * VectorXd::Ones(s.d.size());
  for (Eigen::Index i = 0; i < Eigen::Index(part * double(kept.size())); ++i) kept[i] -= normal[i];
  return {kept};
}
sparse masked(sparse const& K, mask const& m) {
  return m.kept.asDiagonal() * K * m.kept.asDiagonal();
}

// --- the cycle -----------------------------------------------------------------------------------

TEST_CASE("a cycle is self-adjoint and definite") {
  slant::testing::check_operator_laws(exact_multigrid(laplacian(15, 12), {.coarsest = 10}));
  auto const brick = fem::make_steel_brick({.k = 2});
  slant::testing::check_operator_laws(exact_multigrid(brick.K, {.coarsest = 20}));
  slant::testing::check_operator_laws(
      slant::multigrid<float>(laplacian<float>(9, 8), {.coarsest = 10}), Eigen::VectorXf(72));
}

TEST_CASE("with one level it is the inverse") {
  sparse const K = laplacian(5, 4);
  VectorXd const b = VectorXd::LinSpaced(20, -1, 2);
  VectorXd x(20);
  exact_multigrid const exact(K);
  CHECK(exact.sizes() == std::vector<slant::index>{20});
  CHECK(exact.complexity() == 1);
  slant::apply(exact, b, x);
  CHECK((K * x - b).norm() <= 1e-13 * b.norm());
  slant::apply(multigrid(K), b, x);
  CHECK((K * x - b).norm() <= 1e-5 * b.norm());
}

TEST_CASE("the spectrum on the whole space and on faces, by dense algebra") {
  auto const s = fem::make_steel_brick({.k = 2});
  auto const n = s.f.size();
  MatrixXd const K(s.K), I = MatrixXd::Identity(n, n);
  auto const check = [&](auto const& m, double rounding) {
    auto const whole = spectrum(dense_on_face(m, all_free(n), 0, n), I, K, rounding);
    CHECK(whole.least >= 0.15);
    CHECK(whole.most <= 1 + 10 * rounding);  // the energy of the error never grows
    for (double const bend : {0.0, 1.0, 1e3, 1e6, 1e10}) {
      auto const face = mixed(s, bend * 1e5);
      MatrixXd const Π(face.Π), H(face.operator_on(s.K, 0.5));
      auto const found = spectrum(dense_on_face(m, face, 0.5, n), Π, H, rounding);
      CHECK(found.least >= 0.12);
      CHECK(found.most <= 1.05);
    }
    auto const held = touching(s, 1);
    auto const found = spectrum(dense_on_face(m, held, 0, n), MatrixXd(held.kept.asDiagonal()),
                                MatrixXd(masked(s.K, held)), rounding);
    CHECK(found.least >= 0.15);
    CHECK(found.most <= 1 + 10 * rounding);
  };
  for (slant::index const coarsest : {20, 70}) {
    slant::multigrid_options const o{.coordinates = test::moving_nodes(s), .coarsest = coarsest};
    check(exact_multigrid(s.K, o), 1e-12);
    check(multigrid(s.K, o), 1e-5);
  }
  for (slant::index const degree : {0, 2, 4}) {
    check(multigrid(s.K, {.prolongations = interpolation(2), .coarsest = 60, .chebyshev = degree}),
          1e-5);
    check(exact_multigrid(
              s.K, {.coordinates = test::moving_nodes(s), .coarsest = 20, .chebyshev = degree}),
          1e-12);
  }
  check(multigrid(s.K), 1e-5);  // one level
}

TEST_CASE("polynomials are definite beside a body a million times as stiff") {
  sparse const stiff = fem::make_steel_brick({.k = 2}).K;
  sparse const soft = 1e-6 * fem::make_steel_brick({.k = 2, .nu = 0.49}).K;
  auto const n = stiff.rows();
  MatrixXd const I = MatrixXd::Identity(2 * n, 2 * n);
  MatrixXd K = 0 * I;
  K.topLeftCorner(n, n) = stiff;
  K.bottomRightCorner(n, n) = soft;
  for (slant::index const degree : {2, 4}) {
    exact_multigrid const m(K.sparseView(), {.block_size = 3, .coarsest = 60, .chebyshev = degree});
    CHECK(spectrum(dense_on_face(m, all_free(2 * n), 0, 2 * n), I, K, 1e-9).least > 1e-3);
  }
}

TEST_CASE("on tangent planes in any direction the factors are self-adjoint") {
  auto const s = fem::make_steel_brick({.k = 2});
  auto const n = s.f.size();
  auto const balls = slant::power(slant::ball<3>(0.5), int(n / 3));
  multigrid const m(s.K);
  slant::curved_face<double> face(balls);
  for (int seed = 1; seed <= 20; ++seed) {
    auto const entry = [seed](Eigen::Index i) { return std::sin(double(i * i + 31 * seed)); };
    face.assign(balls, VectorXd(VectorXd::NullaryExpr(n, entry)), 1.0);
    MatrixXd const M = dense_on_face(m, face, 0.5, n);
    CHECK((M - M.transpose()).norm() <= 1e-5 * M.norm());
  }
}

TEST_CASE("steps of conjugate gradients do not grow with the mesh, on any face") {
  int last = 0;
  for (int k = 4; k <= test::effort(12, 4); k += 4) {
    CAPTURE(k);
    auto const s = fem::make_steel_brick({.k = k, .load = fem::brick_load::lift});
    auto const check = [&](multigrid const& m, int most) {
      CAPTURE(m.description());
      int const whole = steps(m, s.K, s.f, all_free(s.f.size()));
      CHECK(whole <= most);
      for (double const part : {0.5, 1.0}) {
        auto const held = touching(s, part);
        CHECK(steps(m, masked(s.K, held), s.f, held) <= most);
      }
      auto const face = mixed(s, 1e5);
      CHECK(steps(m, face.operator_on(s.K, 0.5), s.f, face, 0.5) <= most + 2);
      return whole;
    };
    multigrid const aggregated(s.K, {.coordinates = test::moving_nodes(s), .coarsest = 200});
    int const now = check(aggregated, 26);
    CHECK((k <= 8 || now <= last + 2));
    last = now;
    CHECK(aggregated.complexity() <= 2);
    CHECK(aggregated.sizes().size() >= 2);
    check(multigrid(s.K, {.prolongations = interpolation(k)}), 18);
    check(multigrid(s.K, {.prolongations = interpolation(k), .chebyshev = 2}), 18);
  }
  for (int const n : {20, 40, 80}) {
    sparse const K = laplacian(n, n);
    CHECK(steps(multigrid(K, {.coarsest = 50}), K, VectorXd::Ones(n * n), all_free(n * n)) <= 20);
  }
}

TEST_CASE("rigid-body modes are worth giving, as coordinates or as candidates") {
  auto const s = fem::make_steel_brick({.k = test::effort(6, 4)});
  auto const nodes = test::moving_nodes(s);
  auto const free = all_free(s.f.size());
  multigrid const with(s.K, {.coordinates = nodes, .coarsest = 100});
  multigrid const candidates(s.K, slant::contact::rigid_body_modes(nodes), {.coarsest = 100});
  multigrid const without(s.K, {.coarsest = 100});
  int const few = steps(with, s.K, s.f, free);
  CHECK(steps(candidates, s.K, s.f, free) <= few + 1);
  CHECK(few < steps(without, s.K, s.f, free));
  CHECK(with.description().find("rigid-body modes of the coordinates") != std::string::npos);
  CHECK(candidates.description().find("6 candidates") != std::string::npos);
  CHECK(without.description().find("translations only") != std::string::npos);
}

TEST_CASE("nested meshes of odd cells: rotations below" * doctest::skip(!test::is_optimised)) {
  auto const s = fem::make_steel_brick({.k = 10, .load = fem::brick_load::lift});
  auto const P = interpolation(10);
  multigrid const moved(s.K, {.coordinates = test::moving_nodes(s), .prolongations = P});
  multigrid const shifted(s.K, {.prolongations = P});
  for (auto const& held : {all_free(s.f.size()), touching(s, 0.5)}) {
    auto const K = masked(s.K, held);
    CHECK(10 * steps(moved, K, s.f, held) <= 8 * steps(shifted, K, s.f, held));
  }
}

TEST_CASE("limits of complexity") {
  auto const s = fem::make_steel_brick({.k = test::effort(8, 4)});
  auto const nodes = test::moving_nodes(s);
  for (double const limit : {1.2, 1.5, 2.0}) {
    for (double const θ : {0.02, 0.08, 0.3}) {
      multigrid const m(
          s.K, {.coordinates = nodes, .strength = θ, .coarsest = 100, .complexity = limit});
      CAPTURE(m.description());
      CHECK(m.complexity() <= limit);
      CAPTURE(θ);
      CAPTURE(limit);
      CHECK(steps(m, s.K, s.f, all_free(s.f.size())) <= 60);
    }
  }
  // Cells 1 : 10, whose strong couplings are those of a line.
  auto const thin = fem::make_steel_brick({.k = test::effort(8, 4), .size = {0.3, 1, 1}});
  multigrid const m(thin.K, {.coordinates = test::moving_nodes(thin), .coarsest = 100});
  CHECK(m.complexity() <= 2);
  CHECK(steps(m, thin.K, thin.f, all_free(thin.f.size())) <= 100);
}

// --- precision and scales ------------------------------------------------------------------------

TEST_CASE("levels of floats under an iteration in double") {
  auto const s = fem::make_steel_brick({.k = 4});
  multigrid const m(s.K, {.coordinates = test::moving_nodes(s), .coarsest = 100});
  VectorXd const zero = VectorXd::Zero(s.f.size());
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(s.K);
  auto const r =
      slant::solve(slant::cg{A, s.f, m}, zero, slant::residual_below(1e-12) || slant::at_most(60));
  CHECK((s.K * r.state.x - s.f).norm() <= 1e-10 * s.f.norm());
  CHECK(r.state.iteration <= 30);
  VectorXd const exact = Eigen::LLT<MatrixXd>(MatrixXd(s.K)).solve(s.f);
  CHECK((r.state.x - exact).norm() <= 1e-9 * exact.norm());

  // What they know of K itself.
  auto w = m.workspace(zero);
  for (double const size : {1e-200, 1.0, 1e200}) {
    VectorXd const x = size * VectorXd::Random(zero.size());
    VectorXd y(x.size());
    m.multiply_roughly(x, y, w);
    double const largest = MatrixXd(s.K).cwiseAbs().rowwise().sum().maxCoeff();
    double const error = ((y - s.K * x) / size).norm();
    CHECK(error <= m.roughness * largest * (x / size).norm());
    CHECK(error > 0);
  }

  // And for what they have found last: with nothing held, on a face, also with curvature that the
  // levels do not know, and once more.
  for (double const bend : {0.0, 1e5, 1e9}) {
    VectorXd const x = VectorXd::Random(zero.size());
    VectorXd z(x.size()), y(x.size());
    CAPTURE(bend);
    if (bend > 0) {
      m.enter(mixed(s, bend), 0.5, w);
      m.apply_on_face(x, z, w);
    } else {
      m.apply(x, z, w);
    }
    if (bend == 0) m.multiply_roughly(x, y, w);  // another one in between
    for (int k = 0; k < 2; ++k) {
      m.multiply_last_roughly(z, y, w);
      CHECK((y - s.K * z).norm() <= 1e-5 * (s.K * z).norm());
      y.setZero();
    }
  }
}

TEST_CASE("the bits of a cycle do not depend on units") {
  auto const s = fem::make_steel_brick({.k = 2});
  slant::multigrid_options const o{.coordinates = test::moving_nodes(s), .coarsest = 60};
  VectorXd x(s.f.size()), y(s.f.size());
  slant::apply(multigrid(s.K, o), s.f, x);
  for (int const e : {-500, -100, 100, 500}) {
    double const unit = std::ldexp(1.0, e);
    multigrid const m(sparse(unit * s.K), o);
    slant::apply(m, s.f, y);
    CHECK(y * unit == x);
    slant::apply(m, VectorXd(unit * s.f), y);
    CHECK(y == x);
  }
  for (double const unit : {1e-150, 1e150}) {
    sparse const K = unit * s.K;
    multigrid const m(K, o);
    slant::apply(m, VectorXd(unit * s.f), y);
    CHECK((y - x).norm() <= 256 * double(std::numeric_limits<float>::epsilon()) * x.norm());
    auto const face = mixed(s, 1e5 * unit);
    auto w = m.workspace(y);
    m.enter(face, 0.5, w);
    VectorXd b = unit * s.f;
    face.keep(VectorXd(b), b);
    m.apply_on_face(b, y, w);
    CHECK(y.allFinite());
    CHECK(b.dot(y) > 0);
  }
  VectorXd const nothing = VectorXd::Zero(s.f.size());
  slant::apply(multigrid(s.K, o), nothing, y);
  CHECK(y == nothing);
}

// --- faces ---------------------------------------------------------------------------------------

TEST_CASE("rows are formed where the face has changed, and nowhere else") {
  auto const s = fem::make_steel_brick({.k = test::effort(8, 4)});
  multigrid const m(s.K, {.coordinates = test::moving_nodes(s), .coarsest = 100});
  VectorXd const x = s.f;
  VectorXd y(x.size()), again(x.size());
  auto w = m.workspace(x);
  auto const entering = [&](auto const& face) {
    auto const before = w.rows_formed;
    m.enter(face, w);
    return w.rows_formed - before;
  };
  CHECK(entering(all_free(x.size())) == 0);
  auto const half = touching(s, 0.5);
  auto const first = entering(half);
  CHECK(first > 0);
  CHECK(entering(half) == 0);
  auto one = half;
  one.kept[2] = 1 - one.kept[2];
  auto const few = entering(one);
  CHECK(few > 0);
  CHECK(few < first);
  CHECK(entering(half) == few);

  // What follows is what a workspace that begins with that face finds.
  VectorXd b = half.kept.cwiseProduct(x);
  m.apply_on_face(b, y, w);
  auto fresh = m.workspace(x);
  m.enter(half, fresh);
  m.apply_on_face(b, again, fresh);
  CHECK((again - y).norm() <= 1e-5 * y.norm());
  auto const copy = w;
  auto second = copy;
  m.apply_on_face(b, again, second);
  CHECK(again == y);
  // The levels themselves know no face.
  slant::apply(m, x, y, w);
  slant::apply(m, x, again);
  CHECK(y == again);
}

TEST_CASE("no allocation in a cycle, nor where a face has only nodes that had been met") {
  auto const s = fem::make_steel_brick({.k = 3});
  for (slant::index const degree : {0, 2}) {
    multigrid const m(s.K,
                      {.coordinates = test::moving_nodes(s), .coarsest = 60, .chebyshev = degree});
    multigrid const copy = m;
    VectorXd const x = s.f;
    VectorXd y(x.size()), z(x.size());
    auto w = m.workspace(x);
    auto const all = touching(s, 1), half = touching(s, 0.5);
    m.enter(all, w);
    slant::testing::allocation_guard guard;
    slant::apply(m, x, y, w);
    m.enter(half, w);
    m.apply_on_face(x, z, w);
    m.enter(all, w);
    m.apply_on_face(x, z, w);
    auto const allocations = guard.count();
    CHECK(allocations == 0);
    slant::apply(copy, x, z, w);
    CHECK(z == y);
  }
}

TEST_CASE("a workspace forgets a face, whatever kind the next one is of") {
  auto const s = fem::make_steel_brick({.k = 3});
  multigrid const m(s.K, {.coordinates = test::moving_nodes(s), .coarsest = 60});
  auto const n = s.f.size();
  auto const lines = slant::intervals(VectorXd(VectorXd::Ones(n)));
  VectorXd far = VectorXd::Zero(n);
  for (Eigen::Index i = 0; i < n; i += 7) far[i] = 2;
  slant::curved_face<> curved(lines);
  curved.assign(lines, far, 1.0);
  auto const half = touching(s, 0.5);
  auto w = m.workspace(s.f);
  auto const of = [&](auto const& face) {
    VectorXd y(n);
    m.enter(face, w);
    m.apply_on_face(s.f, y, w);
    return y;
  };
  VectorXd const first = of(half), second = of(curved);
  // Coarse levels may lag behind.
  double const lag = 0.02;
  CHECK((first - second).norm() > 2 * lag * first.norm());
  CHECK((of(half) - first).norm() <= lag * first.norm());
  CHECK((of(curved) - second).norm() <= lag * second.norm());
}

TEST_CASE("after 256 changes a workspace begins again; a face that is refused leaves the last") {
  auto const s = fem::make_steel_brick({.k = 3});
  multigrid const m(s.K, {.coordinates = test::moving_nodes(s), .coarsest = 60});
  auto const bent = mixed(s, 1000 * s.K.diagonal().mean());
  auto const half = touching(s, 0.5);
  auto w = m.workspace(s.f), other = m.workspace(s.f);
  VectorXd y(s.f.size()), fresh(s.f.size());
  auto const difference = [&] {
    m.apply_on_face(s.f, y, w);
    m.apply_on_face(s.f, fresh, other);
    return (y - fresh).norm() / fresh.norm();
  };
  for (int k = 0; k < 128; ++k) {
    m.enter(bent, 1, w);
    m.enter(half, w);
  }
  m.enter(half, other);
  CHECK(difference() > 0);
  CHECK(difference() <= 2e-3);
  other = m.workspace(s.f);
  m.enter(bent, 1, w);  // the 257th
  m.enter(bent, 1, other);
  CHECK(difference() == 0);
  m.enter(half, w);
  m.enter(half, other);
  CHECK(difference() == 0);
  // Bad on its last node.
  auto bad = mixed(s, 1);
  bad.set(static_cast<int>(s.f.size()) / 3 - 1, 2 * Matrix3d::Identity());
  for (int k = 0; k < 2; ++k) CHECK_THROWS_AS(m.enter(bad, 1, w), slant::bad_input);
  CHECK(difference() == 0);
  m.enter(bent, 1, w);
  m.enter(bent, 1, other);
  CHECK(difference() == 0);
}

TEST_CASE("everything held, nodes held, all but one node held") {
  auto const s = fem::make_steel_brick({.k = 2});
  auto const n = s.f.size();
  for (slant::index const coarsest : {60, 600}) {
    multigrid const m(s.K, {.coordinates = test::moving_nodes(s), .coarsest = coarsest});
    VectorXd y(n);
    auto w = m.workspace(y);
    m.enter(mask{VectorXd::Zero(n)}, w);
    m.apply_on_face(s.f, y, w);
    CHECK(y == VectorXd::Zero(n));
    VectorXd kept = VectorXd::Zero(n);
    kept.segment(9, 3).setOnes();
    m.enter(mask{kept}, w);
    m.apply_on_face(kept, y, w);
    Vector3d const exact = MatrixXd(s.K).block<3, 3>(9, 9).inverse() * Vector3d::Ones();
    CHECK((y.segment(9, 3) - exact).norm() <= 1e-5 * exact.norm());
    CHECK(y == kept.cwiseProduct(y));
    for (Eigen::Index i = 0; i < n; i += 3) kept.segment(i, 3).setConstant(i % 2 == 0 ? 0 : 1);
    m.enter(mask{kept}, w);
    m.apply_on_face(kept, y, w);
    CHECK(y == kept.cwiseProduct(y));
    CHECK(y.dot(kept) > 0);
  }
}

TEST_CASE("contact of the brick by symmetric Newton, K never factored") {
  auto const s = fem::make_steel_brick({.k = 4, .load = fem::brick_load::lift});
  auto const n = s.f.size();
  VectorXd lower = VectorXd::Constant(n, -infinity);  // N u ≤ d, N of −1 at normal displacements
  for (int j = 0; j < n; ++j)
    for (sparse::InnerIterator e(s.N, j); e; ++e) lower[j] = s.d[e.row()] / e.value();
  slant::separable_qp const qp{slant::matrix<slant::self_adjoint, slant::positive_definite>(s.K),
                               s.f,
                               slant::intervals(lower, VectorXd(VectorXd::Constant(n, infinity)))};
  multigrid const m(s.K, {.coordinates = test::moving_nodes(s), .coarsest = 100});
  auto const r = slant::solve(slant::symmetric_newton{qp, m}, VectorXd(VectorXd::Zero(n)),
                              slant::reduced_gradient_below(1e-10) || slant::at_most(60));
  CHECK(r.status == slant::status::converged);
  CHECK(r.state.work.inner_iterations <= 120);
}

// --- singular matrices ---------------------------------------------------------------------------

TEST_CASE("bodies that float") {
  auto const s = fem::make_steel_brick({.k = test::effort(4, 2)});
  auto const unknowns = fem::number_unknowns(s.mesh, [](Eigen::Index) { return false; });
  sparse const K = fem::stiffness<3>(s.mesh, unknowns, fem::lame(2.119e5, 0.277));
  auto const n = K.rows();
  MatrixXd const kernel = slant::contact::rigid_body_modes(MatrixXd(s.mesh.nodes));
  REQUIRE((K * kernel).norm() <= 1e-8 * 2e5);
  VectorXd b = VectorXd::LinSpaced(n, -1, 2);
  for (Eigen::Index i = 0; i < n; i += 5) b[i] *= -3;
  b -= kernel * (kernel.transpose() * b);
  for (slant::index const coarsest : {60, 400}) {
    multigrid const m(K, {.coordinates = MatrixXd(s.mesh.nodes), .coarsest = coarsest});
    VectorXd y(n);
    for (Eigen::Index c = 0; c < 6; ++c) {
      VectorXd const rigid = kernel.col(c);
      slant::apply(m, rigid, y);
      CHECK(y.allFinite());
      CHECK(rigid.dot(y) > 0);
    }
    CHECK(steps(m, K, b, all_free(n)) <= 40);
    // Contact as the only support.
    VectorXd kept = VectorXd::Ones(n);
    for (Eigen::Index i = 0; i < s.mesh.nodes.cols(); ++i)
      if (s.mesh.nodes(2, i) == 0) kept.segment(3 * i, 3).setZero();
    CHECK(steps(m, masked(K, {kept}), b, mask{kept}) <= 40);
  }
  // Constants of a membrane that is held nowhere.
  sparse L = laplacian(12, 9);
  for (int i = 0; i < 108; ++i) L.coeffRef(i, i) -= VectorXd(L * VectorXd::Ones(108))[i];
  VectorXd load = VectorXd::LinSpaced(108, -1, 1);
  load.array() -= load.mean();
  CHECK(steps(multigrid(L, {.coarsest = 10}), L, load, all_free(108)) <= 30);
}

TEST_CASE("nothing, isolated unknowns") {
  VectorXd y(0);
  slant::apply(multigrid(sparse(0, 0)), VectorXd(0), y);
  sparse diagonal(2000, 2000);
  diagonal.setIdentity();
  multigrid const m(sparse(4 * diagonal), {.coarsest = 5});
  VectorXd x(2000);
  slant::apply(m, VectorXd(VectorXd::Ones(2000)), x);
  CHECK(x == VectorXd::Constant(2000, 0.25));
  // A mesh among nodes without neighbours.
  sparse K = laplacian(20, 20);
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < K.outerSize(); ++j) {
    for (sparse::InnerIterator e(K, j); e; ++e)
      entries.emplace_back(int(5 * e.row()), int(5 * e.col()), e.value());
    for (int l = 1; l < 5; ++l) entries.emplace_back(5 * j + l, 5 * j + l, 1 + l);
  }
  sparse sparse_mesh(2000, 2000);
  sparse_mesh.setFromTriplets(entries.begin(), entries.end());
  multigrid const mixed(sparse_mesh, {.coarsest = 30});
  CHECK(mixed.sizes().back() <= 30);
  CHECK(steps(mixed, sparse_mesh, VectorXd::Ones(2000), all_free(2000)) <= 20);
}

TEST_CASE("plane bodies, and blocks that the pattern hides") {
  // The springs of a plane grid: couplings along and across, and a shear.
  sparse const L = laplacian(14, 11);
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < L.outerSize(); ++j) {
    for (sparse::InnerIterator e(L, j); e; ++e) {
      double const along = std::abs(e.row() - e.col()) == 1 ? 3 : 1;
      for (int a = 0; a < 2; ++a) {
        double const v = e.row() == e.col() ? 8.4 : (a == 0 ? along : 4 - along) * e.value();
        entries.emplace_back(int(2 * e.row() + a), int(2 * e.col() + a), v);
      }
    }
  }
  sparse K(308, 308);
  K.setFromTriplets(entries.begin(), entries.end());
  VectorXd const b = VectorXd::Ones(308);
  MatrixXd nodes(2, 154);
  for (int j = 0; j < 154; ++j) nodes.col(j) << j % 14, j / 14;
  for (auto const& o : {slant::multigrid_options{.coordinates = nodes, .coarsest = 40},
                        slant::multigrid_options{.block_size = 2, .coarsest = 40},
                        slant::multigrid_options{.coarsest = 40}}) {
    CHECK(steps(multigrid(K, o), K, b, all_free(308)) <= 24);
  }
  CHECK(steps(multigrid(K, slant::contact::rigid_body_modes(nodes), {.coarsest = 40}), K, b,
              all_free(308)) <= 24);
}

TEST_CASE("unknowns that mix those of several nodes: the levels are those of K") {
  auto const s = fem::make_steel_brick({.k = 4, .load = fem::brick_load::lift});
  auto const n = s.K.rows();
  MatrixXd const modes = slant::contact::rigid_body_modes(test::moving_nodes(s));
  // Sums and differences of the unknowns of nodes that lie far apart; and a shear, not orthogonal.
  std::vector<Eigen::Triplet<double>> g, inverse;
  for (int i = 0; i < int(n); ++i) {
    int const half = int(n) / 6 * 3, other = (i + half) % (2 * half);
    double const r = std::sqrt(0.5);
    if (i >= 2 * half) {
      g.emplace_back(i, i, 1);
      inverse.emplace_back(i, i, 1);
    } else if (i % 2 == 0) {
      g.emplace_back(i, i, i < half ? r : -r);
      g.emplace_back(i, other, r);
      inverse.emplace_back(i, i, i < half ? r : -r);
      inverse.emplace_back(i, other, r);
    } else {
      g.emplace_back(i, i, 1);
      inverse.emplace_back(i, i, 1);
      if (i >= half) continue;
      g.emplace_back(i, other, 0.5);
      inverse.emplace_back(i, other, -0.5);
    }
  }
  Eigen::SparseMatrix<double, Eigen::RowMajor> G(n, n);
  sparse back(n, n);
  G.setFromTriplets(g.begin(), g.end());
  back.setFromTriplets(inverse.begin(), inverse.end());
  REQUIRE(MatrixXd(G * back).isIdentity(1e-14));
  sparse const A = sparse(back.transpose()) * s.K * back;
  VectorXd const b = back.transpose() * s.f;
  slant::mixed_unknowns<double> const mixed{s.K, G};
  auto const free = all_free(n);
  auto const with = steps(multigrid(A, mixed, modes, {.coarsest = 60}), A, b, free);
  CHECK(with <= steps(multigrid(s.K, modes, {.coarsest = 60}), s.K, s.f, free) + 6);
  CHECK(multigrid(A, mixed, modes, {.coarsest = 60}).aggregates().of ==
        multigrid(s.K, modes, {.coarsest = 60}).aggregates().of);
  CHECK_THROWS_WITH_AS(multigrid(A, slant::mixed_unknowns<double>{sparse(6, 6), G}, modes),
                       doctest::Contains("rows of K: got 6"), slant::bad_input);
}

TEST_CASE("level 1 as a problem of its own: the cycle is that of the same P, given") {
  auto const s = fem::make_steel_brick({.k = 8});
  using rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  rows const none;
  // `rest` leads from level 2 on.
  auto const check = [&](exact_multigrid const& M, int width, std::vector<sparse> const& rest) {
    REQUIRE(M.sizes().size() == 3 + rest.size());
    auto const n = M.sizes()[1];
    sparse const K1 = M.coarse_matrix();
    // Unknowns of a node mixed; those of the first and the last one, which are far apart.
    rows within(n, n), across(n, n);
    within.setIdentity();
    for (int a = 0; a < width; ++a) within.coeffRef(a, (a + 1) % width) = 0.5;
    across.setIdentity();
    for (int a = 0; a < width; ++a) across.coeffRef(a, n - width + a) = -1;
    MatrixXd P1;
    for (rows const* G : {&none, &std::as_const(within), &std::as_const(across)}) {
      MatrixXd const dense = G->rows() == 0 ? MatrixXd::Identity(n, n) : MatrixXd(*G);
      MatrixXd const back = dense.inverse();
      sparse const k = MatrixXd(back.transpose() * K1 * back).sparseView();
      auto const coarser = M.coarser(k, *G);
      REQUIRE(coarser.sizes().size() == M.sizes().size() - 1);
      MatrixXd P(n, coarser.sizes()[1]);
      for (Eigen::Index j = 0; j < P.cols(); ++j)
        P.col(j) = coarser.prolonged(VectorXd::Unit(P.cols(), j));
      if (G == &none) P1 = P;
      CHECK((P - dense * P1).norm() <= 1e-14 * P.norm());
      MatrixXd const galerkin = P.transpose() * k * P;
      CHECK((MatrixXd(coarser.coarse_matrix()) - galerkin).norm() <= 1e-13 * galerkin.norm());
      // Candidates B and what is left of them, Q R: BᵀB = RᵀR on an aggregate.
      MatrixXd const B = M.coarse_kernel(), R = coarser.coarse_kernel();
      MatrixXd squares = MatrixXd::Zero(R.rows(), width);
      auto const& of = coarser.aggregates().of;
      REQUIRE(Eigen::Index(of.size()) * 3 == n);
      for (int i = 0; i < int(of.size()); ++i) {
        auto const own = B.middleRows(3 * i, 3);
        squares.middleRows(width * of[std::size_t(i)], width) += own.transpose() * own;
      }
      for (Eigen::Index J = 0; width == 6 && J < R.rows(); J += width) {
        auto const block = R.middleRows(J, width);
        CHECK((squares.middleRows(J, width) - block.transpose() * block).norm() <=
              1e-12 * squares.norm());
      }
      std::vector<sparse> prolongations{P.sparseView()};
      prolongations.insert(prolongations.end(), rest.begin(), rest.end());
      exact_multigrid const given(
          k, {.prolongations = prolongations, .block_size = 3, .coarsest = 100});
      REQUIRE(given.sizes() == coarser.sizes());
      auto const same = [&](auto const& face) {
        MatrixXd const one = dense_on_face(coarser, face, 0, n);
        CHECK((one - dense_on_face(given, face, 0, n)).norm() <= 1e-10 * one.norm());
      };
      same(all_free(n));
      mask held = all_free(n);
      for (Eigen::Index const i : {0, 1, 6, 20}) held.kept[i] = held.kept[n - 1 - i] = 0;
      same(held);
    }
  };
  MatrixXd const modes = slant::contact::rigid_body_modes(test::moving_nodes(s));
  check(exact_multigrid(s.K, modes, {.coarsest = 100}), 6, {});
  auto const three = interpolation(8);
  check(exact_multigrid(s.K, {.prolongations = three, .coarsest = 100}), 3, {three[2]});
  CHECK_THROWS_AS(static_cast<void>(exact_multigrid(s.K, {.coarsest = 100}).coarser(s.K, none)),
                  slant::bad_input);
  CHECK(SLANT_COMPLAINT(exact_multigrid(laplacian(3, 3)).coarser(laplacian(3, 3), none)) ==
        "levels: got 1, expected a level 1 to begin with");
}

TEST_CASE("options out of range are named") {
  using options = slant::multigrid_options;
  CHECK_NOTHROW(options{}.validate());
  for (auto const& [o, complaint] : std::vector<std::pair<options, std::string>>{
           {{.coordinates = MatrixXd::Zero(4, 2)}, "rows of coordinates: got 4, expected 2 or 3"},
           {{.coordinates = MatrixXd::Constant(3, 2, quiet_nan)}, "coordinates(0, 0): got nan"},
           {{.block_size = -1}, "block_size: got -1, expected a number from 0 to 3"},
           {{.block_size = 4}, "block_size: got 4"},
           {{.coordinates = MatrixXd::Ones(2, 3), .block_size = 3},
            "block_size: got 3, expected 0, or the rows of coordinates"},
           {{.strength = -0.1}, "strength: got -0.1"},
           {{.strength = 1}, "strength: got 1"},
           {{.strength = quiet_nan}, "strength: got nan"},
           {{.damping = 0}, "damping: got 0"},
           {{.damping = 2}, "damping: got 2"},
           {{.damping = quiet_nan}, "damping: got nan"},
           {{.coarsest = 0}, "coarsest: got 0, expected at least 1"},
           {{.levels = 0}, "levels: got 0, expected at least 1"},
           {{.complexity = 1}, "complexity: got 1"},
           {{.complexity = quiet_nan}, "complexity: got nan"},
           {{.chebyshev = 5}, "chebyshev: got 5, expected a degree from 0 to 4"}}) {
    CHECK_THROWS_WITH_AS(o.validate(), doctest::Contains(complaint.c_str()), slant::bad_input);
  }
}

TEST_CASE("rows of a matrix as vectors") {
  multigrid const m(laplacian(10, 4), {.coarsest = 10});
  VectorXd const x = VectorXd::LinSpaced(40, -1, 2), y = m * x;
  MatrixXd both = MatrixXd::Ones(2, 40);
  both.row(0) = x.transpose();
  CHECK((VectorXd(m * both.row(0).transpose()) - y).norm() == 0);
  both.row(0).transpose() = m * x;
  CHECK((both.row(0).transpose() - y).norm() == 0);
  CHECK(both.row(1) == MatrixXd::Ones(1, 40));
}

TEST_CASE("what cannot be used is named") {
  sparse K = laplacian(10, 10);
  multigrid const levels(K, {.coarsest = 30});
  CHECK_THROWS_AS(static_cast<void>(levels.restricted(VectorXd::Ones(400))), slant::bad_input);
  CHECK_THROWS_AS(static_cast<void>(levels.prolonged(VectorXd::Ones(3))), slant::bad_input);
  CHECK_THROWS_AS(static_cast<void>(multigrid(K).coarse_matrix()), slant::bad_input);
  CHECK_THROWS_AS(multigrid(sparse(3, 4)), slant::bad_input);
  CHECK_THROWS_WITH_AS(multigrid(K, {.block_size = 3}),
                       "block_size: got 3, expected a divisor of 100", slant::bad_input);
  CHECK_THROWS_AS(multigrid(K, MatrixXd::Ones(99, 1)), slant::bad_input);
  CHECK_THROWS_AS(multigrid(K, MatrixXd::Ones(100, 7)), slant::bad_input);
  CHECK_THROWS_AS(multigrid(K, MatrixXd::Constant(100, 1, std::nan(""))), slant::bad_input);
  CHECK_THROWS_AS(multigrid(K, {.damping = 3}), slant::bad_input);
  CHECK_THROWS_AS(multigrid(K, {.coordinates = MatrixXd::Ones(2, 49)}), slant::bad_input);
  CHECK_THROWS_AS(multigrid(K, {.prolongations = {sparse(99, 50)}}), slant::bad_input);
  sparse negative = K;
  negative.coeffRef(7, 7) = -4;
  CHECK(SLANT_COMPLAINT(multigrid{negative}) ==
        "K: got diagonal entry 7 = -4, expected a symmetric positive definite matrix");
  sparse shifted = K;
  for (int i = 0; i < 100; ++i) shifted.coeffRef(i, i) -= 1;  // a negative eigenvalue, smooth
  CHECK_THROWS_AS(multigrid(shifted, {.coarsest = 20}), slant::bad_input);
  K.coeffRef(3, 4) = 2;
  CHECK_THROWS_AS(multigrid{K}, slant::bad_input);
  K.coeffRef(3, 4) = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(multigrid{K}, slant::bad_input);
}

}  // namespace multigrid_test
