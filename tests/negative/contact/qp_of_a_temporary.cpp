// SPDX-License-Identifier: MIT
// expect: use of deleted function
// expect-clang: call to deleted member function 'qp'
// max-lines-gcc: 12
// max-lines-clang: 12
//
// The quadratic program refers to its contact problem, which is gone after the same line.
#include <slant/contact/dual.hpp>
#include <slant/factorizations/ldlt.hpp>

auto unknowns(slant::ldlt<> const& factor, slant::contact::data<double> const& scene) {
  using slant::contact::dual;
#ifdef SLANT_COMPLETE
  dual const problem(slant::contact::frictionless{}, factor, scene);
  auto const qp = problem.qp();
#else
  auto const qp = dual(slant::contact::frictionless{}, factor, scene).qp();
#endif
  return qp.size();
}
