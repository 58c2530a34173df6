// SPDX-License-Identifier: MIT
//
// A quadratic model on the faces of six discs, some of which slide.
#pragma once

#include <slant/sets/curved_face.hpp>

#include <Eigen/Dense>

#include <krylov/spd_matrices.hpp>
#include <support/dense_algebra.hpp>

namespace test {

struct sliding_discs {
  Eigen::MatrixXd A = test::with_spectrum(test::log_spaced(12, 200), 2);
  Eigen::VectorXd r = test::random_vector(12, 4);
  Eigen::VectorXd z = 2 * test::random_vector(12, 6);
  Eigen::VectorXd g{{0.5, 1.0, 3.0, 0.0, 0.1, 2.0}};
  double ρ = 0.8;
};

/// H = Π A Π + C/ρ and Π as matrices.
struct dense_face {
  Eigen::MatrixXd H{12, 12}, keep{12, 12};
  dense_face(sliding_discs const& p, slant::curved_face<> const& face) {
    for (Eigen::Index j = 0; j < 12; ++j) {
      Eigen::VectorXd const e = Eigen::VectorXd::Unit(12, j);
      Eigen::VectorXd y = Eigen::VectorXd::Zero(12);
      face.add_curvature(1 / p.ρ, e, y);
      H.col(j) = y;
      face.keep(e, y);
      keep.col(j) = y;
    }
    using namespace evaluated;
    H += keep * p.A * keep;
  }
};

}  // namespace test
