// SPDX-License-Identifier: MIT
// expect: constrained_energy_certificate: the set must be made of blocks with slant
// max-lines-gcc: 20
// max-lines-clang: 30
//
// A set that can be projected onto and does not tell its faces.
#include <slant/certificates/constrained_energy_certificate.hpp>
#include <slant/certificates/energy_error_below.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/separable_qp.hpp>
#include <slant/operators/equality_constraints.hpp>

struct not_negative {
  static constexpr int dimension = 1;
  using point = Eigen::Matrix<double, 1, 1>;
  point project(point const& x) const { return x.cwiseMax(0.0); }
  bool contains(point const& x) const { return x(0) >= 0; }
#ifdef SLANT_COMPLETE
  point slant(point const& x) const { return point(x(0) > 0 ? 1.0 : 0.0); }
#endif
};

auto error(Eigen::VectorXd const& b, slant::equality_constraints<double> const& constraints) {
  auto const qp = slant::separable_qp{slant::identity(b.size()), b,
                                      slant::power(not_negative{}, b.size())};
  slant::constrained_energy_certificate certificate(qp, constraints);
  return certificate(b).bound;
}
