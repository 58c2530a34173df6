// SPDX-License-Identifier: MIT
#include <slant/slant.hpp>

#include <iostream>

int main() {
  // A cord of n nodes lies on a rough floor. Displacements of a node: down, along, across.
  // Node 2 is dragged along the floor, node 4 is lifted; friction resists up to 0.5.
  int const n = 5;
  Eigen::MatrixXd K = 2 * Eigen::MatrixXd::Identity(3 * n, 3 * n);
  K.diagonal(3).setConstant(-1);
  K.diagonal(-3).setConstant(-1);
  Eigen::VectorXd f(3 * n);
  f << 1, 0, 0, 1, 0, 0, 1, 1, 0.75, 1, 0, 0, -1, 0, 0;
  Eigen::VectorXd const g = Eigen::VectorXd::Constant(n, 0.5);

  // minimise ½ λᵀAλ − bᵀλ over λ = (pressures ≥ 0, friction forces in discs of radius g)
  auto const B =
      slant::op<"B">(slant::restriction(3 * n, {0, 3, 6, 9, 12, 1, 2, 4, 5, 7, 8, 10, 11, 13, 14}));
  auto const Kinv = inverse(slant::op<"K">(slant::dense_ldlt(K)));
  auto const A = B * Kinv * adjoint(B);  // never formed; the compiler knows its laws
  Eigen::VectorXd const b = B * Kinv * f;
  auto const Λ = slant::half_lines(n) * slant::discs(g);

  Eigen::VectorXd const λ0 = Eigen::VectorXd::Zero(3 * n);
  auto const run = slant::solve(slant::symmetric_newton{slant::separable_qp{A, b, Λ}}, λ0,
                                slant::reduced_gradient_below(1e-12) || slant::at_most(50));

  std::cout << A << '\n' << to_string(run.status) << std::fixed << "\npressure  friction\n";
  std::cout.precision(4);
  for (int i = 0; i < n; ++i) {
    std::cout << run.x()[i] << "    " << run.x().segment<2>(n + 2 * i).norm() << '\n';
  }
}
