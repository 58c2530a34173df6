// SPDX-License-Identifier: MIT
// expect: a part of A cannot be used on vectors like b.*'linear_operator<.*A = twice
// expect-clang: a part of A cannot be used on vectors like b.*'has_plain_apply<twice,
// max-lines-gcc: 20
// max-lines-clang: 35
//
// A sum of multiples, one of which is of an operator on vectors of float: that one is named.
#include <slant/operators/identity.hpp>
#include <slant/operators/product.hpp>
#include <slant/operators/sum.hpp>
#include <slant/problems/separable_qp.hpp>
#include <slant/sets/contact_sets.hpp>

struct twice {
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 2; }
#ifdef SLANT_COMPLETE
  void apply(auto const& x, auto& y) const { y = 2 * x; }
#else
  void apply(Eigen::VectorXf const& x, Eigen::VectorXf& y) const { y = 2 * x; }
#endif
};

auto problem(Eigen::VectorXd const& b) {
  return slant::separable_qp{
      slant::sum(slant::identity_operator(2), slant::scaled(slant::positive(3.0), twice{})), b,
      slant::half_lines(2)};
}
