// SPDX-License-Identifier: MIT
//
// A small scene with the scalar that counts digits: each method runs on it unchanged, and says how
// many digits of its solution rounding has left.
#pragma once

#include <slant/factorizations/ldlt.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/iteration/stopping.hpp>
#include <slant/krylov/cg.hpp>
#include <slant/methods/interior_point.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/newton/semismooth_newton.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>
#include <slant/slanting/projection.hpp>
#include <slant/testing/stochastic.hpp>

#include <cmath>

namespace stochastic_scene {

/// Four half lines and four discs; A has eigenvalues from 1/κ to 1, equally spaced in their
/// logarithms. A and b are numbers of double, the same for every scalar.
template <class S>
struct scene {
  using vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
  static constexpr Eigen::Index size = 12;

  matrix A{size, size};
  vector b{size}, g{4};

  explicit scene(double κ) {
    Eigen::VectorXd v(size);
    for (Eigen::Index i = 0; i < size; ++i) v[i] = std::sin(1.0 + 3.0 * double(i));
    Eigen::MatrixXd const H =
        Eigen::MatrixXd::Identity(size, size) - 2 / v.dot(v) * v * v.transpose();
    Eigen::VectorXd spectrum(size);
    for (Eigen::Index i = 0; i < size; ++i)
      spectrum[i] = std::pow(κ, -double(i) / double(size - 1));
    Eigen::MatrixXd M = H * spectrum.asDiagonal() * H;
    M = (0.5 * (M + M.transpose())).eval();
    for (Eigen::Index i = 0; i < size; ++i) {
      b[i] = S(std::cos(2.0 + double(i)));
      for (Eigen::Index j = 0; j < size; ++j) A(i, j) = S(M(i, j));
    }
    for (Eigen::Index i = 0; i < 4; ++i) g[i] = S(0.25 * double(i + 1));
  }

  [[nodiscard]] vector zero() const { return vector::Zero(size); }
  [[nodiscard]] auto a() const {
    return slant::matrix<slant::self_adjoint, slant::positive_definite>(A);
  }
  [[nodiscard]] auto set() const {
    return slant::cartesian(slant::half_lines<S>(4), slant::discs(g));
  }
};

template <class S>
struct outcome {
  char const* method;
  slant::status status;
  slant::index steps;
  typename scene<S>::vector x;
};

/// Runs every method; `see` gets the outcome of each.
template <class S, class See>
void run_all(scene<S> const& p, double tolerance, See see) {
  auto const A = p.a();
  auto const set = p.set();
  auto const qp = slant::separable_qp{A, p.b, set};
  auto const note = [&](char const* method, auto const& r) {
    see(outcome<S>{method, r.status, r.iterations(), r.x()});
  };
  auto const reduced = slant::reduced_gradient_below(S(tolerance)) || slant::at_most(5000);
  auto const residual = slant::residual_below(S(tolerance)) || slant::at_most(200);
  note("kprgp", slant::solve(slant::kprgp{qp}, p.zero(), reduced));
  note("symmetric_newton", slant::solve(slant::symmetric_newton{qp}, p.zero(), reduced));
  note("interior_point", slant::solve(slant::interior_point{qp}, p.zero(),
                                      slant::step_below(S(tolerance)) || slant::at_most(100)));
  auto const F = slant::natural_residual(A, p.b, set, S(1));
  note("semismooth_newton", slant::solve(slant::semismooth_newton{F}, p.zero(), residual));
  note("cg", slant::solve(slant::cg{A, p.b}, p.zero(), residual));

  Eigen::SparseMatrix<S> const K = p.A.sparseView();
  typename scene<S>::vector x(scene<S>::size);
  slant::ldlt<S> const factor(K);
  auto w = factor.workspace(x);
  factor.solve(p.b, x, w);
  see(outcome<S>{"ldlt", slant::status::converged, 0, x});
}

}  // namespace stochastic_scene
