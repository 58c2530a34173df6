// SPDX-License-Identifier: MIT
// expect: equilibrated: A must have diagonal\(d\); without it, give the factors d
// max-lines-gcc: 14
// max-lines-clang: 14
//
// An operator that does not give its diagonal.
#include <slant/slant.hpp>

struct twice {
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 2; }
  void apply(auto const& x, auto& y) const { y = 2 * x; }
#ifdef SLANT_COMPLETE
  void diagonal(auto& d) const { d.setConstant(2); }
#endif
};

auto factors(Eigen::VectorXd const& b) {
  auto const set = slant::half_lines(b.size());
  slant::separable_qp const qp{twice{}, b, set};
  return slant::equilibrated(qp).d();
}
