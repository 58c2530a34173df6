// SPDX-License-Identifier: MIT
#include <slant/factorizations/static_condensation.hpp>
#include <slant/slant.hpp>

#include <support/minimise.hpp>
#include <support/testing.hpp>
#include "factorizations/spd_examples.hpp"
#include "second_differences.hpp"

namespace rounded_products_test {

using slant::index;

/// An operator whose twin is wrong by a relative 2⁻²⁰.
struct imprecise {
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
  MatrixXd a;
  double error = 0;
  [[nodiscard]] index rows() const { return a.rows(); }
  [[nodiscard]] index cols() const { return a.rows(); }
  void apply(VectorXd const& x, VectorXd& y) const { y.noalias() = (1 + error) * (a * x); }
  [[nodiscard]] imprecise rounded() const {
    imprecise twin{a, std::ldexp(1.0, -20)};
    twin.a.diagonal().array() *= 1 + twin.error;
    return twin;
  }
};
static_assert(slant::has_rounded<decltype(slant::op<"A">(imprecise{})), VectorXd>);

TEST_CASE("a method with rounded products finds the solution of the exact ones") {
  index const n = 30;
  MatrixXd const A = test::second_differences(n);
  VectorXd b(n);
  for (index i = 0; i < n; ++i) b[i] = std::sin(double(i));
  auto const set = slant::half_lines(test::zeros(n));
  auto const rule = slant::reduced_gradient_below(1e-13) || slant::at_most(60);
  slant::separable_qp const exact{slant::matrix<slant::self_adjoint, slant::positive_definite>(A),
                                  b, set};
  auto const a = slant::counted(imprecise{A});
  slant::separable_qp const rounded{a, b, set};
  auto const r = slant::solve(slant::symmetric_newton{exact}, test::zeros(n), rule);
  auto const q = slant::solve(slant::symmetric_newton{rounded}, test::zeros(n), rule);
  REQUIRE(r.converged());
  REQUIRE(q.converged());
  CHECK((r.x() - q.x()).norm() <= 1e-11 * r.x().norm());
  CHECK(q.state.products.at_work());
  // Rounded products are counted as others are.
  auto const& work = q.state.work;
  CHECK(a.applications() == work.operator_applications + work.setup_applications);
  a.reset_counts();
  auto const start = slant::unconstrained_start(rounded);
  CHECK(start.applications == a.applications());
}

TEST_CASE("a twin that is of no use is given up") {
  index const n = 6;
  MatrixXd const A = test::second_differences(n);
  VectorXd const b = VectorXd::LinSpaced(n, -1, 2);
  struct useless : imprecise {
    [[nodiscard]] imprecise rounded() const { return {-100 * a, 0}; }
  };
  slant::separable_qp const qp{useless{{A, 0}}, b, slant::half_lines(test::zeros(n))};
  auto const r = test::minimise(slant::symmetric_newton{qp}, test::zeros(n), 1e-12, 60);
  CHECK(r.converged());
  CHECK(!r.state.products.at_work());
}

/// Contact on the bottom of a cube that is held almost not at all: κ(A) is about 1/shift.
void check_ill_conditioned(double shift, index unknowns, double tolerance) {
  CAPTURE(shift);
  auto const K = test::grid_laplacian(6, shift);
  std::vector<index> contact(static_cast<std::size_t>(unknowns));
  std::iota(contact.begin(), contact.end(), 0);
  Eigen::SparseMatrix<double> B(unknowns, K.cols());
  for (index i = 0; i < unknowns; ++i) B.insert(i, i) = 1;
  slant::static_condensation const factor(K, contact);
  VectorXd f(K.rows()), u(K.rows());
  for (index i = 0; i < f.size(); ++i) f[i] = std::sin(double(i * i)) + 0.2;
  slant::apply(slant::inverse(factor), f, u);
  VectorXd const b = B * u;
  auto const a = factor.restricted(B);
  auto const set = slant::half_lines(test::zeros(unknowns));
  slant::separable_qp const qp{a, b, set};
  auto const rule = slant::reduced_gradient_below(tolerance) || slant::at_most(60);
  auto const r = slant::solve(slant::symmetric_newton{qp}, test::zeros(unknowns), rule);
  CHECK(r.converged());
}

TEST_CASE(
    "where A is too badly conditioned for a twin of floats the digits are found all the same") {
  check_ill_conditioned(0.1, 1, 1e-13);
  for (double const shift : {1e-7, 1e-8, 1e-9, 1e-10}) check_ill_conditioned(shift, 36, 1e-11);
}

}  // namespace rounded_products_test
