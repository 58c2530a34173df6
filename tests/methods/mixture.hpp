// SPDX-License-Identifier: MIT
//
// A problem with all kinds of constraints, as a set of the library and as plain data.
#pragma once

#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>

#include <krylov/spd_matrices.hpp>
#include <limits>
#include <oracle/dense_qp.hpp>

namespace test {

/// Half lines, intervals around 0, discs and free components, of any numbers: one type of set, so
/// that a method is compiled once for many tests.
inline auto mixed_set(Eigen::VectorXd const& lower, Eigen::VectorXd const& width,
                      Eigen::VectorXd const& g, Eigen::Index free) {
  return slant::cartesian(slant::half_lines(lower), slant::intervals(width), slant::discs(g),
                          slant::free_components(free));
}

/// 20 unknowns: half lines, intervals, discs (of radius 0 and ∞ as well), free ones.
struct mixture {
  Eigen::MatrixXd A;
  Eigen::VectorXd b = 3 * random_vector(20, 5);
  Eigen::VectorXd lower{{0.0, -1.0, 0.5, -std::numeric_limits<double>::infinity(), 2.0, 0.0}};
  Eigen::VectorXd g{{0.5, 0.0, 2.0, std::numeric_limits<double>::infinity()}};

  explicit mixture(double κ, unsigned seed = 1) : A(with_spectrum(log_spaced(20, κ), seed)) {}

  [[nodiscard]] auto set() const { return mixed_set(lower, Eigen::VectorXd{{0.1, 1e-3}}, g, 4); }
  [[nodiscard]] oracle::dense_qp plain() const {
    oracle::dense_qp qp{A, b.cast<long double>(), {}, {}};
    for (Eigen::Index i = 0; i < 6; ++i) qp.intervals.push_back({i, lower(i)});
    qp.intervals.push_back({6, -0.1, 0.1});
    qp.intervals.push_back({7, -1e-3, 1e-3});
    for (Eigen::Index i = 0; i < 3; ++i) qp.circles.push_back({8 + 2 * i, 9 + 2 * i, g(i)});
    return qp;
  }
};

}  // namespace test
