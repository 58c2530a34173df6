// SPDX-License-Identifier: MIT
//
// Reference solutions of the wire, by nested iteration: each mesh starts from the next coarser one,
// so that a few Newton steps suffice.
#pragma once

#include <Eigen/SparseLU>
#include <oracle/dense_newton.hpp>
#include <oracle/dense_wire.hpp>

namespace oracle {

/// x on another mesh, by linear interpolation of the shape.
[[nodiscard]] inline real_vector interpolate(fem::wire<real> const& from, real_vector const& x,
                                             fem::wire<real> const& to) {
  auto const y = from.shape(x);
  auto const value = [&](Eigen::Index node, int component) {
    return node < 0 || node >= y.rows() ? real(0) : y(node, component);  // the ends are fixed
  };
  real_vector result(4 * to.m);
  for (Eigen::Index node = 0; node < 2 * to.m; ++node) {
    real const position = to.t(node) / from.h() - 1;  // in mesh widths behind the first node
    real const left = std::floor(position);
    auto const at = static_cast<Eigen::Index>(left);
    for (int component = 0; component < 2; ++component)
      result[to.unknown(node, component)] =
          value(at, component) +
          (position - left) * (value(at + 1, component) - value(at, component));
  }
  return result;
}

/// LU of a Jacobian that is nearly all zeros; the dense one would take n³ operations.
class sparse_lu {
 public:
  void compute(Eigen::MatrixXd const& J) {
    Eigen::SparseMatrix<double> const stored = J.sparseView();
    lu_.compute(stored);
    if (lu_.info() != Eigen::Success) throw std::runtime_error("sparse_lu: singular Jacobian");
  }
  [[nodiscard]] Eigen::VectorXd solve(Eigen::VectorXd const& b) { return lu_.solve(b); }

 private:
  Eigen::SparseLU<Eigen::SparseMatrix<double>> lu_;
};

struct wire_reference {
  fem::wire<real> wire;
  dense_qp qp;
  newton_report report;
};

/// Solution with m bounds and m circles; `coarse` is a solution on a coarser mesh with the same l
/// and g.
[[nodiscard]] inline wire_reference solve_wire(Eigen::Index m, double l, double g,
                                               wire_reference const* coarse = nullptr) {
  wire_reference result;
  result.wire = fem::make_wire<real>(m);
  result.qp = dense_wire(result.wire, l, g);
  if (coarse == nullptr) {
    result.report = solve_dense<sparse_lu>(result.qp);
  } else {
    result.report =
        solve_dense<sparse_lu>(result.qp, interpolate(coarse->wire, coarse->report.x, result.wire));
  }
  return result;
}

}  // namespace oracle
