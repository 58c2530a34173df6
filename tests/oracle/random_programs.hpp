// SPDX-License-Identifier: MIT
//
// Random quadratic programs with hard data, and their solutions in quadruple precision:
//
//     minimise   ½ xᵀA x − bᵀx   over   x ∈ half lines × intervals × discs × ellipses × cones × Rᵏ
//
// A is dense with a prescribed spectrum. Most programs are planted: a point x* and a normal of Λ
// there are drawn first, and b is A x* plus that normal, rounded. The solution of the rounded
// program is then next to x*, and Newton's method started there, with residuals in quadruple
// precision, finds it at any condition number. Three suites:
//
//     nasty       κ ≤ 1e12, ellipses of aspect 1e8, cones with μ from 1e-8 to 1e8, l = u, discs of
//                 radius 0, gaps between 1e-6 and 1e6 times the solution
//     degenerate  multipliers 0 on active constraints, solutions at kinks and apexes, duplicated
//                 spectra, and singular A (one program in four, consistent: a solution exists)
//     tiny        1 to 6 unknowns, κ ≤ 100, b drawn at random
//
// The same (suite, number) is the same program always. Nothing here includes the library; what
// turns a program into sets of the library is tests/support/program_sets.hpp.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <vector>

namespace oracle {

#ifdef __SIZEOF_FLOAT128__
__extension__ using quad = __float128;
#else
using quad = long double;
#endif

/// Numbers of 113 bits, and the vectors of them.
using quad_vector = std::vector<quad>;

/// A program as plain data. Unknowns in the order of the members: lower.size() of half lines,
/// left.size() of intervals, two for each disc, two for each ellipse, three for each cone (axis
/// first), free_unknowns.
struct random_program {
  Eigen::MatrixXd A;  ///< symmetric
  Eigen::VectorXd b;
  Eigen::VectorXd lower;        ///< x_i ≥ lower_i
  Eigen::VectorXd left, right;  ///< left_i ≤ x_i ≤ right_i, equal in some of the intervals
  Eigen::VectorXd radius;       ///< ‖(x₁, x₂)‖ ≤ radius, 0 in some of the discs
  Eigen::VectorXd first_axis, second_axis;  ///< (x₁/a)² + (x₂/b)² ≤ 1
  Eigen::VectorXd mu;                       ///< ‖(x₂, x₃)‖ ≤ μ x₁
  Eigen::Index free_unknowns = 0;
  bool definite = true;     ///< A is positive definite; else singular and consistent
  double condition = 1;     ///< λ_max/λ_min before rounding, without the eigenvalues 0
  Eigen::VectorXd planted;  ///< next to a solution; empty: unknown

  [[nodiscard]] Eigen::Index size() const { return b.size(); }
};

enum class program_suite : unsigned char { nasty, degenerate, tiny };

/// Sizes of the suites in full: 1500, 800, 1000.
[[nodiscard]] int programs_in(program_suite s);

/// Program `number` ≥ 0 of a suite.
[[nodiscard]] random_program make_program(program_suite s, std::uint64_t number);

/// The shape of a program, for searches of other kinds than the suites.
struct program_shape {
  int half_lines = 0, intervals = 0, discs = 0, ellipses = 0, cones = 0, free_unknowns = 0;
  double condition = 1;   ///< κ of A
  int kernel = 0;         ///< eigenvalues 0
  double degenerate = 0;  ///< share of the active blocks with multiplier 0
  double pinned = 0;      ///< share of intervals with l = u, of discs with radius 0
  double aspect = 1;      ///< of the ellipses, at most
  double friction = 1;    ///< μ from 1/friction to friction
  double gap = 1;         ///< sizes of the sets from 1/gap to gap
};

/// A planted program of that shape.
[[nodiscard]] random_program make_program(program_shape const& shape, std::uint64_t seed);

/// The same program with A in units of 2^stiffness and x in units of 2^length.
[[nodiscard]] random_program in_units(random_program p, int stiffness, int length);

/// x − P(x − α r) over α in quadruple precision, α = 1/‖A‖∞; its norm divided by what one rounding
/// of the terms of A x − b is worth, ε (‖A‖∞ ‖x‖ + ‖b‖): about 1 to 100 at the floor of double.
/// Infinity if x is not finite.
[[nodiscard]] double floors_above(random_program const& p, Eigen::VectorXd const& x,
                                  double epsilon = 0x1p-52);

/// ‖x − P(x − α r)‖ over that of P(0), α = 1/‖A‖∞: what a relative tolerance should bound.
[[nodiscard]] double relative_residual(random_program const& p, Eigen::VectorXd const& x);

/// The solution of a definite program to some thirty digits less those of κ, by Newton's method for
/// the natural residual; nothing if that does not converge. A reference may fail, but not be wrong.
[[nodiscard]] std::optional<quad_vector> exact_solution(random_program const& p);

/// ‖x − x*‖_A / ‖x*‖_A; ‖x − x*‖_A alone if x* = 0. Of a singular A less what its rounding may make
/// of x − x*: in its null space solutions differ by any amount.
[[nodiscard]] double energy_error(random_program const& p, Eigen::VectorXd const& x,
                                  quad_vector const& exact);

}  // namespace oracle
