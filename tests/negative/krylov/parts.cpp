// SPDX-License-Identifier: MIT
// case USE=inverted RETURNING_SOLVE: a part of A cannot be used on vectors like b.*'factorization<.*A = half
// case USE=inverted RETURNING_SOLVE, clang: a part of A cannot be used on vectors like b.*'has_plain_solve<half,
// case USE=congruent RETURNING_ADJOINT: a part of A cannot be used on vectors like b.*'has_adjoint<.*A = first_two
// case USE=congruent RETURNING_ADJOINT, clang: a part of A cannot be used on vectors like b.*'has_plain_adjoint<first_two,
// case USE=congruent RETURNING_ADJOINT, max-lines-clang: 43
// case USE=summed APPLY_OF_OTHER_SCALAR: a part of A cannot be used on vectors like b.*'linear_operator<.*A = twice
// case USE=summed APPLY_OF_OTHER_SCALAR, clang: a part of A cannot be used on vectors like b.*'has_plain_apply<twice,
// max-lines-gcc: 20
// max-lines-clang: 35
//
// Compositions of which one part is to blame, and named: a factorisation whose solve returns its result,
// a factor whose adjoint does, an operator on vectors of float in a sum of multiples.
#include <slant/slant.hpp>

using vector = Eigen::VectorXd;
#ifdef APPLY_OF_OTHER_SCALAR
using argument = Eigen::VectorXf;
#else
using argument = Eigen::VectorXd;
#endif

struct half {
  Eigen::Index rows() const { return 2; }
#ifdef RETURNING_SOLVE
  vector solve(vector const& b) const { return b / 2; }
#else
  void solve(vector const& b, vector& x) const { x = b / 2; }
#endif
};

struct first_two {
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 3; }
  void apply(vector const& x, vector& y) const { y = x.head(2); }
#ifdef RETURNING_ADJOINT
  vector apply_adjoint(vector const& x) const { return Eigen::Vector3d(x[0], x[1], 0); }
#else
  void apply_adjoint(vector const& x, vector& y) const { y << x, 0; }
#endif
};

struct twice {
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 2; }
  void apply(argument const& x, argument& y) const { y = 2 * x; }
};

slant::identity_operator const two(2), three(3);
auto inverted(auto const& b) {
  return slant::bicgstab{slant::inverse(half{}), b};
}
auto congruent(auto const& b) {
  return slant::cg{slant::congruence(slant::full_row_rank(first_two{}), three), b};
}
auto summed(auto const& b) {
  return slant::separable_qp{slant::sum(two, slant::scaled(slant::positive(3.0), twice{})), b,
                             slant::half_lines(2)};
}

auto use(vector const& b) {
  return USE(b);
}
