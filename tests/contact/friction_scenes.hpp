// SPDX-License-Identifier: MIT
//
// Problems of several contacts with friction that have a solution: many contacts whose W is
// definite, and the same with every contact twice.
#pragma once

#include "oracle/naive_friction.hpp"
#include "support/friction_cases.hpp"

#include <slant/contact/solve_friction.hpp>

#include <Eigen/Core>
#include <vector>

namespace test {

/// `contacts` contacts with W = H Hᵀ + I/10, H random with rows of length about 1; pushed together
/// where q_n < 0, about three of four, and moving along.
[[nodiscard]] friction_problem random_friction(slant::index contacts, slant::index dimension,
                                               double mu, unsigned seed);

/// Every contact `times` times: W has rank n of times · n.
[[nodiscard]] friction_problem repeated(friction_problem const& p, slant::index times);

/// A row of contacts, each coupled to its neighbours: W has blocks on three diagonals. Every second
/// contact is far from closing.
[[nodiscard]] friction_problem chain_friction(slant::index contacts);

/// The law at r, contact by contact, as the oracle finds it.
[[nodiscard]] std::vector<oracle::naive_contact> naive(friction_problem const& p,
                                                       Eigen::VectorXd const& r);

inline constexpr slant::contact::friction_method all_methods[] = {
    slant::contact::friction_method::automatic, slant::contact::friction_method::gauss_seidel,
    slant::contact::friction_method::newton, slant::contact::friction_method::interior_point};

}  // namespace test
