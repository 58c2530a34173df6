// SPDX-License-Identifier: MIT
// expect: erased: A must declare that it is self-adjoint and positive semidefinite
// max-lines-gcc: 12
// max-lines-clang: 12
//
// Methods ask the forgotten program for laws, so they must be promised before.
#include <slant/problems/any_qp.hpp>
#include <slant/sets/contact_sets.hpp>

struct twice {
#ifdef SLANT_COMPLETE
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_semidefinite>;
#else
  static constexpr auto laws = slant::laws<slant::self_adjoint>;
#endif
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 2; }
  void apply(auto const& x, auto& y) const { y = 2 * x; }
};

void forget(Eigen::VectorXd const& b) {
  auto const set = slant::half_lines(b.size());
  slant::separable_qp const qp{twice{}, b, set};
  auto const forgotten = slant::erased(qp);
}
