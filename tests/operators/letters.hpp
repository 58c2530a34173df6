// SPDX-License-Identifier: MIT
//
// Letters in general position, so that a law that does not follow from the structure of an expression
// does not hold by accident either, and a check of inferred laws against dense eigenvalues.
#pragma once

#include "support/dense_of.hpp"

#include <slant/factorizations/dense_ldlt.hpp>
#include <slant/operators/operators.hpp>

#include <Eigen/Dense>

#include <string>

namespace test {

/// The matrices behind the letters; conditions are moderate, so that products of five of them can be
/// judged in doubles.
struct letter_data {
  static constexpr int n = 7, m = 4, p = 3;
  letter_data();

  Eigen::MatrixXd K, S;  ///< definite, n × n
  Eigen::MatrixXd P;     ///< semidefinite of rank 3
  Eigen::MatrixXd J;     ///< an orthogonal projector of rank 3
  Eigen::MatrixXd Q;     ///< symmetric, indefinite
  Eigen::MatrixXd G, H;  ///< neither symmetric nor definite, regular
  Eigen::MatrixXd T;     ///< definite, not symmetric
  Eigen::MatrixXd B;     ///< m × n of full rank
  Eigen::MatrixXd R;     ///< m × n of rank 2
  Eigen::MatrixXd C;     ///< p × m of full rank
  Eigen::MatrixXd N;     ///< definite, m × m
  Eigen::VectorXd d, e;  ///< positive, of both signs
};
[[nodiscard]] letter_data const& letters_of_test();

/// What is wrong with the law set for the dense matrix of an expression; empty if nothing.
[[nodiscard]] std::string false_laws(Eigen::MatrixXd const& a, slant::law_set laws);

/// What an operator can do, done once; what it cannot is empty. For the arguments below.
struct results {
  Eigen::MatrixXd dense;          ///< A, by unit vectors
  Eigen::VectorXd adjoint;        ///< Aᵀz
  Eigen::VectorXd added;          ///< z − 1.5 A x
  Eigen::VectorXd adjoint_added;  ///< x − 1.5 Aᵀz
  Eigen::VectorXd diagonal;
  Eigen::MatrixXd columns;  ///< the second one and the third
};
[[nodiscard]] inline Eigen::VectorXd argument_x(Eigen::Index n) {
  return Eigen::VectorXd::LinSpaced(n, -1, 2);
}
[[nodiscard]] inline Eigen::VectorXd argument_z(Eigen::Index n) {
  return Eigen::VectorXd::LinSpaced(n, 3, -1);
}
template <class A>
[[nodiscard]] results results_of(A const& a) {
  using V = Eigen::VectorXd;
  V const x = argument_x(a.cols());
  V const z = argument_z(a.rows());
  results r;
  r.dense = test::dense_of(a);
  if constexpr (slant::has_adjoint<A, V>) {
    r.adjoint.resize(a.cols());
    slant::apply_adjoint(a, z, r.adjoint);
  }
  if constexpr (slant::has_accumulate<A, V>) {
    r.added = z;
    auto w = slant::workspace(a, x);
    slant::apply_add(a, -1.5, x, r.added, w);
  }
  if constexpr (slant::has_adjoint_accumulate<A, V>) {
    r.adjoint_added = x;
    auto w = slant::adjoint_workspace(a, z);
    slant::apply_adjoint_add(a, -1.5, z, r.adjoint_added, w);
  }
  if constexpr (slant::has_diagonal<A, V>) {
    r.diagonal.resize(a.rows());
    a.diagonal(r.diagonal);
  }
  if constexpr (slant::has_columns<A, Eigen::MatrixXd>) {
    r.columns.resize(a.rows(), 2);
    a.columns(1, r.columns);
  }
  return r;
}
/// The largest difference of any of it from what the dense matrix says, relative to that matrix.
[[nodiscard]] double disagreement(results const& r);

}  // namespace test

/// The letters K⁻¹, S, P, … of a test case, named as the matrices.
#define SLANT_TEST_LETTERS                                                           \
  using slant::op, slant::self_adjoint;                                              \
  using slant::positive_definite, slant::positive_semidefinite;                      \
  auto const& o = test::letters_of_test();                                           \
  [[maybe_unused]] int const n = o.n, m = o.m;                                       \
  [[maybe_unused]] auto const Kinv = inverse(op<"K">(slant::dense_ldlt(o.K)));       \
  [[maybe_unused]] auto const S = op<"S", self_adjoint, positive_definite>(o.S);     \
  [[maybe_unused]] auto const P = op<"P", self_adjoint, positive_semidefinite>(o.P); \
  [[maybe_unused]] auto const J = op<"J", self_adjoint, slant::projector>(o.J);      \
  [[maybe_unused]] auto const Q = op<"Q", self_adjoint>(o.Q);                        \
  [[maybe_unused]] auto const G = op<"G">(o.G);                                      \
  [[maybe_unused]] auto const H = op<"H">(o.H);                                      \
  [[maybe_unused]] auto const T = op<"T", positive_definite>(o.T);                   \
  [[maybe_unused]] auto const B = op<"B">(o.B);                                      \
  [[maybe_unused]] auto const R = op<"R">(o.R);                                      \
  [[maybe_unused]] auto const C = op<"C">(o.C);                                      \
  [[maybe_unused]] auto const N = op<"N", self_adjoint, positive_definite>(o.N);     \
  [[maybe_unused]] auto const D = slant::diagonal<positive_definite>(o.d);           \
  [[maybe_unused]] auto const E = slant::diagonal(o.e);                              \
  [[maybe_unused]] auto const I = slant::identity(o.n)
