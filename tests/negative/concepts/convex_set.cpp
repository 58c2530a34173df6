// SPDX-License-Identifier: MIT
// case CONCEPT=convex_set WITHOUT_CONTAINS: 'has_contains['<]
// case CONCEPT=convex_set PROJECT_OF_OTHER_SIZE: 'may_have_size<.*'projects_to_points<
// case CONCEPT=convex_set PROJECT_OF_OTHER_SIZE, clang: 'projects_to_points<.*'may_have_size<
// case CONCEPT=has_slant SLANT_OF_OTHER_SIZE: has_slant.*'c.slant.x.' does not satisfy return-type-requirement
// case CONCEPT=has_slant SLANT_OF_OTHER_SIZE, clang: 'slant_like<.*'may_have_size<
// case CONCEPT=has_slant SLANT_OF_OTHER_SIZE, max-lines-clang: 40
// case CONCEPT=has_inequality_form INEQUALITY_OF_OTHER_SIZE: has_inequality_form.*'c.inequality.x.' does not satisfy return-type-requirement
// case CONCEPT=has_inequality_form INEQUALITY_OF_OTHER_SIZE, clang: has_inequality_form<.*'may_have_size<
// max-lines-gcc: 20
// max-lines-clang: 30
//
// A disc minus the test of membership; one whose projection returns three components, whose slanting
// operator has one row, or that announces one inequality and returns two.
#include <slant/slant.hpp>

struct disc {
  static constexpr int dimension = 2;
  static constexpr int inequalities = 1;
#ifdef INEQUALITY_OF_OTHER_SIZE
  using values = Eigen::Vector2d;
#else
  using values = Eigen::Matrix<double, 1, 1>;
#endif
#ifdef PROJECT_OF_OTHER_SIZE
  Eigen::Vector3d project(auto const&) const { return {0, 0, 0}; }
#else
  Eigen::Vector2d project(auto const& x) const { return x.norm() <= 1 ? x : x / x.norm(); }
#endif
#ifndef WITHOUT_CONTAINS
  bool contains(auto const& x) const { return x.norm() <= 1; }
#endif
#ifdef SLANT_OF_OTHER_SIZE
  Eigen::RowVector2d slant(auto const&) const { return {0, 0}; }
#else
  Eigen::Matrix2d slant(auto const&) const { return Eigen::Matrix2d::Zero(); }
#endif
  values inequality(Eigen::Vector2d const& x) const {
    return values::Constant(x.squaredNorm() - 1);
  }
  Eigen::Vector2d inequality_gradient(Eigen::Vector2d const& x) const { return 2 * x; }
  Eigen::Matrix2d inequality_hessian(Eigen::Vector2d const&, values const& ν) const {
    return 2 * ν[0] * Eigen::Matrix2d::Identity();
  }
};

static_assert(slant::CONCEPT<disc, Eigen::Vector2d>);
