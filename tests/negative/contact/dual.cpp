// SPDX-License-Identifier: MIT
// case WITHOUT_SOLVE: has_plain_solve
// case WITHOUT_SOLVE, clang: constraints not satisfied for class template 'dual'
// case TEMPORARY: use of deleted function
// case TEMPORARY, clang: call to deleted member function 'qp'
// case TEMPORARY, max-lines-gcc: 12
// case TEMPORARY, max-lines-clang: 12
//
// A factorisation of K minus its solve. The quadratic program refers to its contact problem, which is
// gone after the same line.
#include <slant/contact/dual.hpp>

struct half {
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
  slant::index n;
  slant::index rows() const { return n; }
#ifndef WITHOUT_SOLVE
  void solve(auto const& b, auto& x) const { x = b / 2; }
#endif
};

auto unknowns(slant::contact::data<double> const& scene) {
  half const factors{scene.f.size()};
#ifdef TEMPORARY
  auto const qp = slant::contact::dual(slant::contact::frictionless{}, factors, scene).qp();
#else
  slant::contact::dual const problem(slant::contact::frictionless{}, factors, scene);
  auto const qp = problem.qp();
#endif
  return qp.size();
}
