// SPDX-License-Identifier: MIT
#include "scenes.hpp"

#include <slant/contact/dual.hpp>
#include <slant/contact/optimality.hpp>
#include <slant/factorizations/ldlt.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/kprgp.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <support/allocation_guard.hpp>
#include <support/effort.hpp>
#include <utility>

namespace tresca_test {

using Eigen::VectorXd;
namespace contact = slant::contact;

template <class Friction>
void check_against_reference(Friction friction, Eigen::SparseMatrix<double> const& K,
                             contact::data<double> const& c) {
  auto const reference = test::reference(K, c);
  contact::dual const dual(friction, slant::ldlt(K), c);
  auto const qp = dual.qp();
  auto const r = slant::solve(slant::kprgp{qp}, dual.zero(),
                              slant::reduced_gradient_below(1e-12) || slant::at_most(100000));
  REQUIRE(r.converged());
  VectorXd const u = dual.displacement(r.x());
  CHECK(oracle::energy_error(K, u, reference.u) <= 1e-7);
  CHECK((r.x().head(c.nodes()) - reference.normal).norm() <= 1e-5 * r.x().norm());
  CHECK(contact::check_optimality(K, c, u, r.x()).residual() <= 1e-9);
}

TEST_CASE("bricks with friction, with one tangent, without friction: as the reference") {
  for (auto const load : fem::brick_loads) {
    CAPTURE(fem::name_of(load));
    auto const scene = fem::make_steel_brick({.k = test::effort(2, 1), .load = load});
    check_against_reference(contact::friction_disc{}, scene.K, test::contact_data(scene));
    check_against_reference(contact::friction_line{}, scene.K, test::one_tangent(scene));
    check_against_reference(contact::frictionless{}, scene.K, test::frictionless_data(scene));
  }
}

TEST_CASE("the set is what the friction law needs and no more") {
  auto const scene = fem::make_steel_brick({.k = 1});
  slant::ldlt const factor(scene.K);
  auto const count_discs = [](auto const& dual) {
    int discs = 0;
    slant::visit_blocks(dual.set(), [&](auto const& block, auto const&) {
      discs += std::is_same_v<std::remove_cvref_t<decltype(block)>, slant::ball<2>>;
    });
    return discs;
  };
  contact::dual const rough(contact::friction_disc{}, factor, test::contact_data(scene));
  contact::dual const smooth(contact::frictionless{}, factor, test::frictionless_data(scene));
  CHECK(count_discs(rough) == scene.d.size());
  CHECK(count_discs(smooth) == 0);
  CHECK(slant::dimension_of(smooth.set()) == scene.d.size());
}

template <class D> concept lends_a = requires(D&& d) { std::forward<D>(d).a(); };
template <class D> concept lends_qp = requires(D&& d) { std::forward<D>(d).qp(); };
template <class D> concept lends_b = requires(D&& d) { std::forward<D>(d).b(); };
template <class D> concept lends_set = requires(D&& d) { std::forward<D>(d).set(); };
template <class D>
concept lends_constraints = requires(D&& d) { std::forward<D>(d).constraints(); };

template <class D>
inline constexpr bool lends_all =
    lends_a<D> && lends_qp<D> && lends_b<D> && lends_set<D> && lends_constraints<D>;
template <class D>
inline constexpr bool lends_any =
    lends_a<D> || lends_qp<D> || lends_b<D> || lends_set<D> || lends_constraints<D>;

TEST_CASE("nothing can be lent by a problem that is about to go") {
  auto const scene = fem::make_steel_brick({.k = 1});
  auto const c = test::frictionless_data(scene);
  using problem = decltype(contact::dual(contact::frictionless{}, slant::ldlt(scene.K), c));
  static_assert(lends_all<problem&> && lends_all<problem const&>);
  static_assert(!lends_any<problem> && !lends_any<problem const>);
  // What is a value of its own may still be asked of it.
  CHECK(contact::dual(contact::frictionless{}, slant::ldlt(scene.K), c).zero().size() == 6);
}

/// LDLᵀ that counts its solves.
class counting_factor {
 public:
  static constexpr slant::law_set laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
  explicit counting_factor(Eigen::SparseMatrix<double> const& K) : inner_(K) {}
  [[nodiscard]] slant::index rows() const { return inner_.rows(); }
  void solve(VectorXd const& b, VectorXd& x) const {
    ++solves;
    x = inner_.solve(b);
  }
  mutable int solves = 0;

 private:
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> inner_;
};

TEST_CASE("no solve with K beyond b, the products, and u if it is asked for") {
  auto const scene = fem::make_steel_brick({.k = 2});
  counting_factor const factor(scene.K);
  contact::dual const dual(contact::friction_disc{}, factor, test::contact_data(scene));
  CHECK(factor.solves == 1);
  auto const qp = dual.qp();
  auto const r = slant::solve(slant::kprgp{qp}, dual.zero(), slant::at_most(25));
  auto const products = r.state.work.operator_applications + r.state.work.setup_applications;
  CHECK(factor.solves == 1 + products);
  static_cast<void>(dual.displacement(r.x()));
  CHECK(factor.solves == 2 + products);
}

TEST_CASE("no allocation in the iteration with a sparse factorisation inside") {
  auto const scene = fem::make_steel_brick({.k = 2});
  contact::dual const dual(contact::friction_disc{}, slant::ldlt(scene.K),
                           test::contact_data(scene));
  auto const qp = dual.qp();
  slant::kprgp method{qp};
  auto s = method.start(dual.zero());
  slant::testing::allocation_guard guard;
  for (int k = 0; k < 100; ++k) method.step(s);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
}

TEST_CASE("nodes that never meet the obstacle carry no force; infinite slip bounds stick") {
  auto const scene = fem::make_steel_brick({.k = 2});
  auto c = test::contact_data(scene);
  constexpr double inf = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < c.d.size(); i += 3) c.d(i) = inf;
  for (Eigen::Index i = 1; i < c.g.size(); i += 3) c.g(i) = inf;
  for (Eigen::Index i = 2; i < c.g.size(); i += 3) c.g(i) = 0;
  contact::dual const dual(contact::friction_disc{}, slant::ldlt(scene.K), c);
  auto const qp = dual.qp();
  auto const r = slant::solve(slant::kprgp{qp}, dual.zero(),
                              slant::reduced_gradient_below(1e-12) || slant::at_most(100000));
  REQUIRE(r.converged());
  VectorXd const u = dual.displacement(r.x());
  CHECK(contact::check_optimality(scene.K, c, u, r.x()).residual() <= 1e-9);
  VectorXd const slip = c.T * u;
  for (Eigen::Index i = 0; i < c.d.size(); i += 3) CHECK(r.x()(i) == 0);
  for (Eigen::Index i = 1; i < c.g.size(); i += 3) {
    CHECK(slip.segment(2 * i, 2).norm() <= 1e-8 * slip.norm());
  }
  for (Eigen::Index i = 2; i < c.g.size(); i += 3) {
    CHECK(r.x().segment(c.nodes() + 2 * i, 2).norm() == 0);
  }
}

TEST_CASE("interference without load beside infinite gaps: any length is as good as another") {
  Eigen::Index const n = 9;
  Eigen::MatrixXd dense = 2 * Eigen::MatrixXd::Identity(n, n);
  dense.diagonal(1).setConstant(-1);
  dense.diagonal(-1).setConstant(-1);
  Eigen::SparseMatrix<double> const K = dense.sparseView();
  Eigen::SparseMatrix<double> N(2, n);
  N.insert(0, 1) = 1;
  N.insert(1, 4) = 1;
  slant::ldlt const factor(K);
  for (double const size : {1.0, 1e-9, 1e-30, 1e30}) {
    CAPTURE(size);
    contact::data<double> const c{N, Eigen::SparseMatrix<double>(0, n), VectorXd::Zero(n),
                                  Eigen::Vector2d(-size, std::numeric_limits<double>::infinity()),
                                  VectorXd(0)};
    contact::dual const dual(contact::frictionless{}, factor, c);
    CHECK(dual.b()(0) == size);
    CHECK(dual.b()(1) == -size / 2);
    auto const qp = dual.qp();
    auto const r = slant::solve(slant::kprgp{qp}, dual.zero(),
                                slant::reduced_gradient_below(1e-8) || slant::at_most(1000));
    REQUIRE(r.converged());
    VectorXd const u = dual.displacement(r.x());
    CHECK(u(1) == doctest::Approx(-size).epsilon(1e-7));
    CHECK(r.x()(1) == 0);
    CHECK(contact::check_optimality(K, c, u, r.x()).residual() <= 1e-7);
  }
}

TEST_CASE("the load of an infinite gap is measured by the other gaps and slips") {
  auto const scene = fem::make_steel_brick({.k = 1});
  auto c = test::contact_data(scene);
  slant::ldlt const factor(scene.K);
  c.d.setConstant(1e3);  // so far away that K⁻¹f does not matter
  c.d(0) = std::numeric_limits<double>::infinity();
  contact::dual const gaps(contact::friction_disc{}, factor, c);
  double const m = static_cast<double>(c.nodes());
  CHECK(gaps.b()(0) == doctest::Approx(-1e3 / m));
  c.d.setConstant(std::numeric_limits<double>::infinity());
  contact::dual const slips(contact::friction_disc{}, factor, c);
  CHECK(slips.b()(0) == -slips.b().tail(c.T.rows()).cwiseAbs().maxCoeff() / m);
  CHECK((slips.b().head(c.nodes()).array() == slips.b()(0)).all());
  // No length at all: λ = 0 it is, at once.
  c.f.setZero();
  contact::dual const nothing(contact::friction_disc{}, factor, c);
  auto const qp = nothing.qp();
  auto const r = slant::solve(slant::kprgp{qp}, nothing.zero(), slant::reduced_gradient_below(0.0));
  CHECK(r.converged());
  CHECK(r.iterations() == 0);
  CHECK(r.x() == nothing.zero());
}

}  // namespace tresca_test
