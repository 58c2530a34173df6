// SPDX-License-Identifier: MIT
//
// Contacts with Coulomb friction whose solutions are known in closed form: every state of a
// contact, no solution, several, infinitely many. q is chosen so that r and u satisfy the law
// exactly in floating point (small integers and binary fractions).
#pragma once

#include <slant/contact/friction/friction_problem.hpp>

#include <Eigen/Core>
#include <initializer_list>
#include <string>
#include <vector>

namespace test {

using friction_problem = slant::contact::friction_problem<double>;

struct friction_case {
  std::string name;
  friction_problem problem;
  std::vector<Eigen::VectorXd> r;  ///< all solutions; of infinitely many, some
  bool infinitely_many = false;
};

[[nodiscard]] Eigen::VectorXd numbers(std::initializer_list<double> values);

[[nodiscard]] friction_problem make_friction_problem(Eigen::MatrixXd const& W, Eigen::VectorXd q,
                                                     Eigen::VectorXd mu);

/// One contact in the plane, W = [a c; c b].
[[nodiscard]] friction_problem plane_contact(double a, double c, double b, double qn, double qt,
                                             double mu);

/// One contact in space with a full W, with q such that r gives the velocity u.
[[nodiscard]] friction_problem space_contact(Eigen::Vector3d const& r, Eigen::Vector3d const& u,
                                             double mu);

/// Each with exactly one solution: open, stick, slip, in the plane and in space.
[[nodiscard]] std::vector<friction_case> single_solution_cases();

/// Sliding presses the contact together so hard that no force resists (Painlevé): W = h hᵀ,
/// h = (1, −k), q = (−1, 0). Any force changes the velocity by s h, and u_n >= 0 asks for s >= 1,
/// so u_t = −k s < 0, so r = r_n (1, μ) and s = (1 − μ k) r_n <= 0 where μ k >= 1.
[[nodiscard]] friction_case no_solution_case(slant::index dimension = 2);

/// W definite, and yet open, slip and stick all satisfy the law: u = (1, −4), (0, −0.75), (0, 0).
[[nodiscard]] friction_case three_solutions_case();

/// The contact that sticks in the plane, twice at the same place: only the sum of the forces is
/// determined, W has rank 2 of 4.
[[nodiscard]] friction_case redundant_case();

/// All of the above that have a solution.
[[nodiscard]] std::vector<friction_case> solvable_cases();

}  // namespace test
