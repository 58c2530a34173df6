// SPDX-License-Identifier: MIT
//
// The archetypes of vectors, operators and factorisations do what they claim and nothing else.
#include <slant/testing/archetypes.hpp>
#include <slant/testing/operator_laws.hpp>

#include <doctest/doctest.h>

namespace operator_archetypes_test {

namespace archetype = slant::testing::archetype;
using archetype::vector;
using Eigen::MatrixXd;
using Eigen::VectorXd;

template <class V> concept has_element_access = requires(V& v) { v[0]; };
template <class V>
concept has_arithmetic = requires(V& v) { v + v; } || requires(V& v) { v *= 2.0; };

static_assert(slant::vector<vector> && slant::vector<archetype::basic_vector<float>>);
static_assert(!has_element_access<vector> && !has_arithmetic<vector>);
static_assert(!std::is_default_constructible_v<vector> && !std::is_convertible_v<VectorXd, vector>);

template <class A>
inline constexpr bool is_bare =
    slant::linear_operator<A, vector> && !slant::linear_operator<A, VectorXd> &&
    !slant::has_workspace<A, vector> && !slant::has_accumulate<A, vector> &&
    !slant::has_diagonal<A, vector> && !slant::has_columns<A, MatrixXd> &&
    !slant::has_inverse<A, vector> && !slant::applies_to_many<A, MatrixXd>;

static_assert(is_bare<archetype::linear_operator> && is_bare<archetype::spd_operator>);
static_assert(!slant::has_adjoint<archetype::linear_operator, vector>);
static_assert(slant::self_adjoint_operator<archetype::self_adjoint_operator, vector> &&
              !slant::psd_operator<archetype::self_adjoint_operator, vector>);
static_assert(slant::psd_operator<archetype::psd_operator, vector> &&
              !slant::spd_operator<archetype::psd_operator, vector>);
static_assert(slant::has_plain_solve<archetype::factorization, vector> &&
              !slant::has_cols<archetype::factorization> &&
              !slant::factorization<archetype::factorization, VectorXd>);

TEST_CASE("archetypes keep their word") {
  vector const prototype{VectorXd()};
  MatrixXd m = MatrixXd::Identity(3, 3);
  slant::testing::check_operator_laws(archetype::spd_operator(m), prototype);
  m(2, 2) = 0;
  slant::testing::check_operator_laws(archetype::psd_operator(m), prototype);
  m(2, 2) = -1;
  slant::testing::check_operator_laws(archetype::self_adjoint_operator(m), prototype);
  m(0, 2) = 5;
  slant::testing::check_operator_laws(archetype::operator_with_adjoint(m), prototype);

  vector const b(VectorXd(VectorXd::LinSpaced(3, 1, 3)));
  vector x = slant::like(b, 3);
  archetype::factorization(m).solve(b, x);
  CHECK((m * x.local() - b.local()).norm() < 1e-14);
}

}  // namespace operator_archetypes_test
