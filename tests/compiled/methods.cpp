// SPDX-License-Identifier: MIT
//
// The methods that slant::compiled has, on programs that it can have: prints every bit of the
// results and the work. Built with the component and without.
#include <slant/factorizations/dense_ldlt.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/interior_point.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/operators/diagonal.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/problems/any_qp.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>

#include <cmath>
#include <concepts>
#include <cstdio>

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Definite, of condition 100 or so; nothing in it is a short fraction.
MatrixXd stiffness(Eigen::Index n) {
  MatrixXd A(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j)
      A(i, j) = std::cos(0.7 * double((i + 1) * (j + 1))) / double(n) + (i == j ? 2 : 0);
  }
  VectorXd const d = VectorXd::LinSpaced(n, 0, 2).unaryExpr([](double e) { return std::exp(e); });
  MatrixXd const scaled = d.asDiagonal() * A * d.asDiagonal();
  return (scaled + scaled.transpose()) / 2;
}

/// A x and no more: no diagonal, so that methods have to estimate it.
struct product_only {
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_semidefinite>;
  MatrixXd const& A;
  [[nodiscard]] Eigen::Index rows() const { return A.rows(); }
  [[nodiscard]] Eigen::Index cols() const { return A.cols(); }
  void apply(auto const& x, auto& y) const { y.noalias() = A * x; }
};

template <class Run>
void print(char const* name, Run const& run) {
  auto const& work = run.state.work;
  std::printf("%s %d %td %td %td", name, static_cast<int>(run.status), run.iterations(),
              work.operator_applications, work.setup_applications);
  for (double const entry : run.x()) std::printf(" %a", entry);
  std::printf("\n");
}

template <class QP>
void all_methods(QP const& given) {
  auto const M =
      slant::diagonal<slant::positive_definite>(VectorXd(VectorXd::Constant(given.size(), 0.1)));
  // What is linked changes no type.
  static_assert(std::same_as<decltype(slant::kprgp{given}), slant::kprgp<QP const&>>);
  static_assert(std::same_as<decltype(slant::symmetric_newton{given, M}),
                             slant::symmetric_newton<QP const&, decltype(M)&>>);
  auto const qp = [&] { return slant::erased(given); };
  VectorXd const x0 = VectorXd::Zero(given.size());
  auto const stop = slant::reduced_gradient_below(1e-9) || slant::at_most(2000);
  print("kprgp", slant::solve(slant::kprgp{qp()}, x0, stop));
  print("as_s", slant::solve(slant::as_s(qp()), x0, stop));
  print("newton", slant::solve(slant::symmetric_newton{qp()}, x0, stop));
  slant::symmetric_newton_options<double> const few{.inner_steps = 2, .halvings = 1};
  print("hindered newton", slant::solve(slant::symmetric_newton{qp(), few}, x0, stop));
  print("preconditioned", slant::solve(slant::symmetric_newton{qp(), slant::erased(M)}, x0, stop));
  print("interior point", slant::solve(slant::interior_point{qp()}, x0, stop));
  print("interior point with M",
        slant::solve(slant::interior_point{qp(), slant::erased(M)}, x0, stop));
}

}  // namespace

int main() {
  Eigen::Index const m = 7, n = 5 * m;
  MatrixXd const A = stiffness(n);
  VectorXd const b = VectorXd::LinSpaced(n, -30, 41);
  VectorXd bounds = VectorXd::LinSpaced(m, 0.1, 3);
  auto intervals = slant::intervals(bounds);
  auto discs = slant::discs(bounds);
  auto const set =
      slant::cartesian(slant::half_lines(m), intervals, discs, slant::free_components(m));
  auto const definite = slant::matrix<slant::self_adjoint, slant::positive_definite>(A);
  auto const semidefinite = slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(A);
  all_methods(slant::separable_qp{definite, b, set});
  all_methods(slant::separable_qp{semidefinite, b, set});
  all_methods(slant::separable_qp{product_only{A}, VectorXd(2 * b), set});

  // Cones of friction, and a program that has no minimum.
  VectorXd const friction = VectorXd::LinSpaced(n / 5, 0.1, 0.9), some = b.head(3 * (n / 5));
  MatrixXd const part = A.topLeftCorner(some.size(), some.size());
  auto const cones = slant::friction_cones<3>(friction);
  all_methods(slant::separable_qp{
      slant::matrix<slant::self_adjoint, slant::positive_definite>(part), some, cones});
  MatrixXd const flat = MatrixXd::Zero(m, m);
  auto const lines = slant::half_lines(m);
  VectorXd const up = VectorXd::Constant(m, 1);
  slant::separable_qp const endless{
      slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(flat), up, lines};
  print("unbounded", slant::solve(slant::kprgp{slant::erased(endless)}, VectorXd(VectorXd::Zero(m)),
                                  slant::reduced_gradient_below(1e-9) || slant::at_most(100)));

  MatrixXd several(n, 5);
  for (Eigen::Index j = 0; j < 5; ++j) several.col(j) = (1.0 + double(j)) * b;
  MatrixXd solved(n, 5);
  slant::dense_ldlt(A).solve(several, solved);
  std::printf("dense_ldlt");
  for (double const entry : solved.reshaped()) std::printf(" %a", entry);
  std::printf("\n");

  // Other bounds and another b in the places of the first: the method sees them.
  VectorXd load = b;
  slant::separable_qp const qp{definite, load, set};
  slant::symmetric_newton const newton{slant::erased(qp)};
  slant::kprgp const projected{slant::erased(qp)};
  auto state = newton.start(VectorXd::Zero(n));
  auto other = projected.start(VectorXd::Zero(n));
  for (int step = 0; step < 3; ++step) {
    bounds *= 1.5;
    load *= 0.9;
    intervals.update(bounds);
    discs.update(bounds);
    VectorXd const x = state.x, z = other.x;
    newton.resume(state, x);
    projected.resume(other, z);
    for (int k = 0; k < 8; ++k) newton.step(state);
    for (int k = 0; k < 30; ++k) projected.step(other);
    std::printf("step %d: %a %a %a\n", step, state.residual_norm, other.reduced_gradient_norm,
                state.x.sum());
  }
  return 0;
}
