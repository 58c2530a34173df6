// SPDX-License-Identifier: MIT
// expect: has_plain_solve
// expect-clang: constraints not satisfied for class template 'dual'
//
// A factorisation of K minus its solve.
#include <slant/contact/dual.hpp>

struct half {
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
  slant::index n;
  slant::index rows() const { return n; }
#ifdef SLANT_COMPLETE
  void solve(auto const& b, auto& x) const { x = b / 2; }
#endif
};

auto bound(slant::contact::data<double> const& scene) {
  half const factors{scene.f.size()};
  slant::contact::dual const problem(slant::contact::frictionless{}, factors, scene);
  return problem.b();
}
