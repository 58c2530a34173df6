// SPDX-License-Identifier: MIT
// expect: has_inequality_form.*'c.inequality.x.' does not satisfy return-type-requirement
// expect-clang: has_inequality_form<.*'may_have_size<
// max-lines-gcc: 20
// max-lines-clang: 30
//
// A disc that announces one inequality and returns two.
#include <slant/concepts/convex_set.hpp>

#include <Eigen/Core>

struct disc {
  static constexpr int dimension = 2;
  static constexpr int inequalities = 1;
#ifdef SLANT_COMPLETE
  using values = Eigen::Matrix<double, 1, 1>;
#else
  using values = Eigen::Vector2d;
#endif
  Eigen::Vector2d project(Eigen::Vector2d const& x) const {
    return x.norm() <= 1 ? x : x / x.norm();
  }
  bool contains(Eigen::Vector2d const& x) const { return x.norm() <= 1; }
  values inequality(Eigen::Vector2d const& x) const {
    return values::Constant(x.squaredNorm() - 1);
  }
  Eigen::Vector2d inequality_gradient(Eigen::Vector2d const& x) const { return 2 * x; }
  Eigen::Matrix2d inequality_hessian(Eigen::Vector2d const&, values const& ν) const {
    return 2 * ν[0] * Eigen::Matrix2d::Identity();
  }
};

static_assert(slant::has_inequality_form<disc, Eigen::Vector2d>);
