// SPDX-License-Identifier: MIT
// expect: constrained_energy_certificate: the set must be made of blocks with slant
// max-lines-gcc: 20
// max-lines-clang: 30
//
// A set that can be projected onto and does not tell its faces.
#include <slant/certificates/constrained_energy_certificate.hpp>
#include <slant/problems/equality_constraints.hpp>
#include <slant/problems/separable_qp.hpp>
#include <slant/sets/power.hpp>

struct upper_half_plane {
  static constexpr int dimension = 2;
  Eigen::Vector2d project(auto const& x) const { return {x[0], x[1] < 0 ? 0 : x[1]}; }
  bool contains(auto const& x) const { return x[1] >= 0; }
#ifdef SLANT_COMPLETE
  Eigen::Matrix2d slant(auto const& x) const {
    return Eigen::Vector2d(1, x[1] < 0 ? 0 : 1).asDiagonal();
  }
#endif
};

auto error(Eigen::VectorXd const& b, slant::equality_constraints<double> const& constraints) {
  auto const set = slant::power(upper_half_plane{}, b.size() / 2);
  auto const qp = slant::separable_qp{slant::identity(b.size()), b, set};
  slant::constrained_energy_certificate certificate(qp, constraints);
  return certificate(b).bound;
}
