// SPDX-License-Identifier: MIT
#pragma once

#include <fem/string_1d.hpp>
#include <oracle/dense_qp.hpp>

namespace oracle {

/// The wire as a dense problem. The entries of A are whole numbers, so nothing is rounded.
[[nodiscard]] inline dense_qp dense_wire(fem::wire<real> const& wire, double l, double g) {
  dense_qp qp{Eigen::MatrixXd(wire.A.cast<double>()), wire.b};
  for (Eigen::Index node = 0; node < wire.m; ++node)
    qp.intervals.push_back({wire.unknown(node, 1), l});
  for (Eigen::Index node = wire.m; node < 2 * wire.m; ++node)
    qp.circles.push_back({wire.unknown(node, 0), wire.unknown(node, 1), g});
  return qp;
}

}  // namespace oracle
