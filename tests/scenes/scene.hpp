// SPDX-License-Identifier: MIT
//
// A scene as every method sees it. All have one type, so that a method is compiled once for all of
// them: A is an any_operator, and the set has parts of every kind, of which most scenes leave some
// empty.
#pragma once

#include <slant/operators/any_operator.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>

#include <cmath>
#include <memory>
#include <optional>
#include <oracle/dense_qp.hpp>
#include <string>
#include <utility>
#include <vector>

namespace scenes {

using Eigen::VectorXd;

using definite_operator =
    slant::any_operator<VectorXd, slant::laws<slant::self_adjoint, slant::positive_definite>>;
using semidefinite_operator =
    slant::any_operator<VectorXd, slant::laws<slant::self_adjoint, slant::positive_semidefinite>>;

/// Bounds and radii; what a scene does not have stays empty.
struct constraints {
  VectorXd half_lines{};       ///< lower ends
  VectorXd lower{}, upper{};   ///< of intervals
  VectorXd radii{};            ///< of discs of consecutive pairs
  Eigen::Index free = 0;       ///< components
  Eigen::Index more_free = 0;  ///< of another size than these
};

/// half lines × intervals × discs × free × free, in this order.
[[nodiscard]] inline auto make_set(constraints const& c) {
  return slant::cartesian(slant::half_lines(c.half_lines), slant::intervals(c.lower, c.upper),
                          slant::discs(c.radii), slant::free_components(c.free),
                          slant::free_components(c.more_free));
}

/// min ½ xᵀA x − bᵀx over the set, the same as plain data, and its solution by other means.
struct scene {
  std::string name;
  std::shared_ptr<void const> data;  ///< what A and M refer to
  definite_operator A;
  semidefinite_operator M;  ///< ≈ A⁻¹
  VectorXd b;
  decltype(make_set({})) set;
  oracle::dense_qp plain;
  oracle::real_vector exact;  ///< by the oracle, before it is rounded
  bool slow_sliding = false;  ///< of so many discs that gradient steps take long
  /// Known numbers of active bounds and discs.
  std::optional<std::pair<int, int>> active{};

  /// ‖x − x*‖_A / ‖x*‖_A, with the oracle's A.
  [[nodiscard]] double energy_error(VectorXd const& x) const {
    auto const square = [&](VectorXd const& v) { return v.dot(plain.A * v); };
    VectorXd const e = x - exact.cast<double>();
    return std::sqrt(square(e) / square(exact.cast<double>()));
  }
};

/// The lecture's first example, the wire, membranes.
[[nodiscard]] std::vector<scene> obstacle_scenes();
/// Bricks, two bodies in the plane and in space.
[[nodiscard]] std::vector<scene> contact_scenes();
/// A flow around an obstacle on which it slips.
[[nodiscard]] std::vector<scene> channel_scenes();
/// All of them; those of a light effort are smaller. Made once.
[[nodiscard]] inline std::vector<scene> const& all_scenes() {
  static std::vector<scene> const all = [] {
    std::vector<scene> list = obstacle_scenes();
    for (auto& s : contact_scenes()) list.push_back(std::move(s));
    for (auto& s : channel_scenes()) list.push_back(std::move(s));
    return list;
  }();
  return all;
}

/// The solution by the oracle.
[[nodiscard]] oracle::real_vector solved(oracle::dense_qp const& plain);

}  // namespace scenes
