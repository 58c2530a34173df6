// SPDX-License-Identifier: MIT
//
// Sets that lie about one thing each, for the test of the check that must find them.
#pragma once

#include <slant/sets/ball.hpp>
#include <slant/sets/power.hpp>
#include <slant/sets/second_order_cone.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace liars {

using disc = slant::ball<2>;
using vector = Eigen::Vector2d;
using matrix = Eigen::Matrix2d;

/// What is wrong with a liar.
enum class lie {
  none,
  stops_half_way,       // P(x) is half way to the disc
  projects_to_square,   // a projection, but onto another set
  projects_along_axes,  // into the disc, but not to the nearest point
  reads_its_output,     // project(x, y) depends on what was in y
  forgets_aliasing,     // project(x, x) destroys x before it is read
  contains_interior_only,
  contains_all,
  slant_too_large,
  slant_indefinite,
  slant_asymmetric,
  slant_without_curvature,  // the radial part is right, the tangential is not
  slant_slightly_wrong,
  slant_jumps_too_early,  // at 0.9 instead of 1
  slant_nan,
  step_too_long,
  step_too_short,
  step_infinite,
  step_negative,
  step_zero_for_no_direction,
  early_step_wrong,
  support_too_small,
  support_too_large,
  support_infinite,
  support_with_offset,
  always_free,
  never_free,
  pinned_on_the_rim,
  inequality_reversed,
  inequality_too_wide,
  gradient_too_long,
  gradient_tangential,
  hessian_too_large,
  hessian_asymmetric
};

/// The unit disc with one lie. One class for all of them compiles in a tenth of the time.
class liar : public disc {
  using value = Eigen::Matrix<double, 1, 1>;
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr double quiet_nan = std::numeric_limits<double>::quiet_NaN();
  lie lie_;

 public:
  explicit liar(lie what) : lie_(what) {}

  vector project(vector const& x) const {
    vector const p = disc::project(x);
    if (lie_ == lie::stops_half_way) return (x + p) / 2;
    if (lie_ == lie::projects_to_square) return x.cwiseMax(-1.0).cwiseMin(1.0);
    if (lie_ == lie::projects_along_axes && !disc::contains(x)) {
      double const a = std::clamp(x[0], -1.0, 1.0);
      double const room = std::sqrt(1 - a * a);
      return {a, std::clamp(x[1], -room, room)};
    }
    return p;
  }
  void project(vector const& x, vector& y) const {
    if (lie_ == lie::forgets_aliasing) y.setZero();
    vector const p = project(x);
    y = lie_ == lie::reads_its_output ? vector(p + 0 * y) : p;
  }
  bool contains(vector const& x) const {
    if (lie_ == lie::contains_all) return true;
    if (lie_ == lie::contains_interior_only) return x.norm() < 1 - 1e-9;
    return disc::contains(x);
  }

  matrix slant(vector const& x) const {
    matrix g = disc::slant(x);
    if (lie_ == lie::slant_too_large) g *= 1.001;
    if (lie_ == lie::slant_slightly_wrong) g *= 1 - 1e-4;
    if (lie_ == lie::slant_indefinite) g -= 1e-6 * matrix::Identity();
    if (lie_ == lie::slant_asymmetric) g(0, 1) += 1e-9;
    if (lie_ == lie::slant_without_curvature && !disc::contains(x)) g.setZero();
    if (lie_ == lie::slant_jumps_too_early && x.norm() > 0.9)
      g = disc::slant(1.001 * x.normalized());
    if (lie_ == lie::slant_nan) g.setConstant(quiet_nan);
    return g;
  }

  double step_to_boundary(vector const& x, vector const& d, double enough = 0) const {
    double const step = disc::step_to_boundary(x, d);
    if (lie_ == lie::step_too_long) return (1 + 1e-9) * step;
    if (lie_ == lie::step_too_short) return 0.98 * step;
    if (lie_ == lie::step_infinite) return infinity;
    if (lie_ == lie::step_negative) return step - 1e-3;
    if (lie_ == lie::step_zero_for_no_direction && d.isZero(0)) return 0;
    if (lie_ == lie::early_step_wrong && enough > 0) return enough / 2;
    return step;
  }
  double support(vector const& y) const {
    double const s = disc::support(y);
    if (lie_ == lie::support_too_small) return 0.999999 * s;
    if (lie_ == lie::support_too_large) return 1.000001 * s;
    if (lie_ == lie::support_infinite && !y.isZero(0)) return infinity;
    return lie_ == lie::support_with_offset ? s + 1e-3 : s;
  }

  slant::block_state state(vector const& x) const {
    auto const s = disc::state(x);
    if (lie_ == lie::always_free) return slant::block_state::free;
    if (lie_ == lie::never_free) return slant::block_state::sliding;
    bool const pinned = lie_ == lie::pinned_on_the_rim && s == slant::block_state::sliding;
    return pinned ? slant::block_state::fixed : s;
  }

  value inequality(vector const& x) const {
    if (lie_ == lie::inequality_reversed) return -disc::inequality(x);
    if (lie_ == lie::inequality_too_wide) return disc(1.01).inequality(x);
    return disc::inequality(x);
  }
  vector inequality_gradient(vector const& x) const {
    vector const g = disc::inequality_gradient(x);
    if (lie_ == lie::gradient_too_long) return 1.001 * g;
    if (lie_ == lie::gradient_tangential) return {-g[1], g[0]};
    return g;
  }
  matrix inequality_hessian(vector const& x, value const& ν) const {
    matrix h = disc::inequality_hessian(x, ν);
    if (lie_ == lie::hessian_too_large) h *= 1.001;
    if (lie_ == lie::hessian_asymmetric) h(0, 1) += 1e-9;
    return h;
  }
};

/// A cone that says it slides at the apex.
struct sliding_apex : slant::second_order_cone<3> {
  auto state(Eigen::Vector3d const& x) const {
    auto const s = slant::second_order_cone<3>::state(x);
    return s == slant::block_state::fixed ? slant::block_state::sliding : s;
  }
};

enum class product_lie {
  none,
  places_overlap,
  numbers_repeated,
  other_blocks,
  slant,
  step,
  support
};

/// Two unit discs with one lie about how they form a product.
class lying_product {
  decltype(slant::power(disc{}, 2)) discs_ = slant::power(disc{}, 2);
  product_lie lie_;

 public:
  explicit lying_product(product_lie what) : lie_(what) {}

  slant::index size() const { return 4; }
  slant::index block_count() const { return 2; }
  void project(auto const& x, auto& y) const { discs_.project(x, y); }
  bool contains(auto const& x) const { return discs_.contains(x); }
  Eigen::Matrix4d slant(auto const& x) const {
    Eigen::Matrix4d g = Eigen::Matrix4d::Zero();
    discs_.visit([&](auto const& b, auto const& p) {
      g.block<2, 2>(p.component(0), p.component(0)) = b.slant(p.value(x));
    });
    if (lie_ == product_lie::slant) g(1, 2) = g(2, 1) = 1e-9;
    return g;
  }
  double step_to_boundary(auto const& x, auto const& d) const {
    return (lie_ == product_lie::step ? 0.9999999 : 1) * discs_.step_to_boundary(x, d);
  }
  double support(auto const& y) const {
    return (lie_ == product_lie::support ? 0.9999999 : 1) * discs_.support(y);
  }
  void visit(auto&& f) const {
    discs_.visit([&](auto const& b, auto const& p) {
      auto const number = lie_ == product_lie::numbers_repeated ? 0 : p.index();
      auto const first = lie_ == product_lie::places_overlap ? p.index() : p.component(0);
      f(lie_ == product_lie::other_blocks ? disc(1.001) : b, slant::place<2>(number, first, 2));
    });
  }
};

}  // namespace liars
