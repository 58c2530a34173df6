// SPDX-License-Identifier: MIT
//
// Numbers, vectors and matrices for rapidcheck, of the whole range that the library is made for.
#pragma once

#include <rapidcheck.h>

#include <Eigen/Core>

#include <cmath>

namespace properties {

/// A multiple of 1/4 of [−4, 4]; shrinks to 0.
inline rc::Gen<double> quarter() {
  return rc::gen::map(rc::gen::inRange(-16, 17), [](int i) { return i / 4.0; });
}

/// Mostly a multiple of 1/4; else with digits, of any magnitude up to 1e±150, or a zero.
inline rc::Gen<double> number() {
  return rc::gen::weightedOneOf<double>(
      {{6, quarter()},
       {2, rc::gen::map(rc::gen::inRange(-1000, 1000), [](int i) { return i / 37.0; })},
       {2, rc::gen::map(rc::gen::pair(rc::gen::inRange(-9, 10), rc::gen::inRange(-150, 151)),
                        [](std::pair<int, int> const& p) {
                          return p.first / 7.0 * std::pow(10.0, p.second);
                        })},
       {1, rc::gen::element(0.0, -0.0, 1e150, -1e150, 1e-150)}});
}

template <class Generator>
Eigen::VectorXd vector_of(Eigen::Index size, Generator generator) {
  Eigen::VectorXd x(size);
  for (double& entry : x) entry = *generator();
  return x;
}

template <class Generator>
Eigen::MatrixXd matrix_of(Eigen::Index rows, Eigen::Index cols, Generator generator) {
  Eigen::MatrixXd A(rows, cols);
  for (Eigen::Index i = 0; i < rows; ++i) A.row(i) = vector_of(cols, generator);
  return A;
}

// Defined in a file each; true if all properties hold.
bool operators_keep_their_laws();
bool programs_are_solved();

}  // namespace properties
