// SPDX-License-Identifier: MIT
//
// A client of the installed package: headers of both base directories, each dependency, and the
// components that were asked for.
#include <Eigen/SparseCore>
#include <cmath>
#include <cstdio>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/iteration/iterates.hpp>
#include <slant/operators/inverse.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/operators/product.hpp>
#include <slant/sets/ball.hpp>
#include <string>
#if defined(CONSUMER_HAS_vtu)
#include <slant/io/vtu.hpp>
#endif
#if defined(CONSUMER_HAS_compiled)
#include <slant/contact/solve.hpp>
#endif

static_assert(slant::scalar<double>);

namespace {

int failures = 0;

void check(bool right, char const* what) {
  if (right) return;
  std::fprintf(stderr, "wrong: %s\n", what);
  ++failures;
}

}  // namespace

int main() {
  Eigen::Vector2d const nearest = slant::ball<2>(1).project(Eigen::Vector2d(3, 4));
  check((nearest - Eigen::Vector2d(0.6, 0.8)).norm() < 1e-15, "the projection of (3, 4)");

  Eigen::SparseMatrix<double> k(2, 2);
  k.insert(0, 0) = 2;
  k.insert(1, 1) = 4;
  auto const factors = slant::factorize(k);
#if defined(CONSUMER_HAS_cholmod)
  check(factors.name() == "cholmod", "the component cholmod is used");
#else
  check(factors.name() != "cholmod", "the component cholmod was not asked for");
#endif
  Eigen::Vector2d const b(1, 1);
  Eigen::Vector2d x;
  auto w = factors.workspace(b);
  factors.solve(b, x, w);
  check((x - Eigen::Vector2d(0.5, 0.25)).norm() < 1e-15, "the solution of a diagonal system");

  try {
    static_cast<void>(slant::ball<2>(-1));
    check(false, "a negative radius is refused");
  } catch (slant::bad_input const& error) {
    check(std::string(error.what()).find("radius") != std::string::npos, "the radius is named");
  }

#if defined(CONSUMER_HAS_compiled)
  static_assert(SLANT_USES_COMPILED, "the installed library was built with other flags");
  slant::contact::data<double> contact;  // the second unknown rests on an obstacle at 0.1
  contact.N.resize(1, 2);
  contact.N.insert(0, 1) = 1;
  contact.T.resize(0, 2);
  contact.f = b;
  contact.d = Eigen::VectorXd::Constant(1, 0.1);
  auto const held = slant::contact::solve(k, contact);
  check(held.converged() && std::abs(held.multipliers[0] - 0.6) < 1e-8, "the force is 0.6");
#endif
#if defined(CONSUMER_HAS_vtu)
  slant::vtu_grid const grid(Eigen::MatrixXd::Zero(3, 1));
  static_cast<void>(grid);
#endif
  return failures;
}
