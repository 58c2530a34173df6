// SPDX-License-Identifier: MIT
//
// Support functions of all sets, sums of functions of parts: the laws of functions with a proximal
// map. And functions that lie about one thing each: the check finds them.
#include <slant/sets/sets.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>

namespace functions_test {

using slant::separable_sum;
using slant::support;
using slant::testing::check_function_laws;

VectorXd const radii = Vector3d(1, 0.3, 0);

slant::testing::set_options few(unsigned seed = 1, double size = 1) {
  return {.seed = seed, .points = 24, .directions = 3, .size = size};
}
template <class... Functions>
void check(Functions const&... functions) {
  (check_function_laws(functions, few()), ...);
}

TEST_CASE("laws: support functions of blocks") {
  check(support(slant::half_line<>{}), support(slant::half_line<>{-1.5}),
        support(slant::interval<>{0.5, 2.0}), support(slant::interval<>{-infinity, 2.0}),
        support(slant::interval<>{3.0, 3.0}), support(slant::symmetric_interval<>{0.25}),
        support(slant::ball<2>{}), support(slant::ball<2>{0.0}), support(slant::ball<3>{0.7}),
        support(slant::ellipse<>{1.0, 0.2}), support(slant::second_order_cone<3>{0.4}),
        support(slant::free_space<2>{}),
        support(slant::shifted(slant::ball<2>{}, Vector2d(0.5, -2))));
  check_function_laws(support(slant::ball<2>{1e3}), few(2, 1e3));
  check_function_laws(support(slant::ball<2>{1e-7}), few(3, 1e-7));
}

TEST_CASE("laws: support functions of products, and sums with sets") {
  auto const Λ = slant::discs(radii);
  check(slant::power(support(slant::ellipse<>{1.0, 0.2}), 3),
        separable_sum(slant::power<slant::planar>(support(slant::ball<2>{0.7}), 2), Λ));
  check(support(Λ), support(slant::intervals(radii)), support(slant::half_lines(2) * Λ),
        separable_sum(slant::half_lines(3), support(Λ)),
        separable_sum(support(slant::ball<2>{}), slant::free_components(2),
                      support(slant::discs<slant::planar>(radii))));
}

TEST_CASE("block_scaled: a function in other units of its blocks") {
  VectorXd const d{{2, 0.5, 8, 4, 4, 0.125, 0.125, 1, 1}};
  auto const sum = separable_sum(slant::half_lines(3), support(slant::discs(radii)));
  auto const φ = slant::block_scaled(d, sum);
  check(φ);
  // g‖x/c‖ = (g/c)‖x‖.
  VectorXd const weights{{radii[0] / 4, radii[1] * 8, radii[2]}};
  auto const same = separable_sum(slant::half_lines(3), support(slant::discs(weights)));
  VectorXd const z{{-1, 2, -3, 0.5, 2, 2, 2.5, -1, 0}};
  for (double const ρ : {0.1, 1.0, 30.0}) {
    VectorXd const x = slant::prox(φ, ρ, z);
    CHECK((x - slant::prox(same, ρ, z)).norm() <= 1e-15 * z.norm());
    CHECK(φ.value(x) == doctest::Approx(same.value(x)));
  }
  VectorXd wrong = d;
  wrong[4] = 2;
  CHECK_THROWS_WITH(static_cast<void>(slant::block_scaled(wrong, sum)),
                    "d(4): got 2, expected 4 as for the other unknowns of its block");
}

TEST_CASE("support: the soft threshold, the norm, and a kink that is met exactly") {
  auto const σ = support(slant::symmetric_interval<>{2.0});
  using point = Eigen::Matrix<double, 1, 1>;
  for (double const z : {-5.0, -2.0, -0.3, 0.0, 0.7, 1.0, 1.1, 9.0}) {
    double const expected = std::max(std::abs(z) - 1.0, 0.0) * (z < 0 ? -1 : 1);
    CHECK(σ.prox(0.5, point(z))[0] == doctest::Approx(expected).epsilon(1e-15));
  }
  auto const norm = support(slant::ball<3>{0.1});
  Vector3d const z(3, 4, 12);
  CHECK((norm.prox(10.0, z) - z * (12.0 / 13.0)).norm() <= 1e-15 * z.norm());
  CHECK(norm.value(z) == doctest::Approx(1.3));
  // 0.1 · 3 is not 0.3: in Λ is decided at z/ρ, and what is in it sticks without rest.
  for (double const ρ : {0.1, 0.3, 3.0, 1e-7, 1e9}) {
    Vector3d const x = norm.prox(ρ, Vector3d(z * (ρ * 0.0999999 / 13.0)));
    CHECK((x.array() == 0.0).all());
  }
}

// --- liars ---------------------------------------------------------------------------------------

enum class lie { none, prox_of_another, value, conjugate, slant, state, reads_its_output };

/// |x| on the line.
struct modulus {
  static constexpr int dimension = 1;
  using point = Eigen::Matrix<double, 1, 1>;
  lie told;

  [[nodiscard]] point prox(double ρ, point const& z) const {
    double const g = told == lie::prox_of_another ? 1.5 : 1.0;
    return point(std::max(std::abs(z[0]) - ρ * g, 0.0) * (z[0] < 0 ? -1 : 1));
  }
  [[nodiscard]] double value(point const& x) const {
    return told == lie::value ? x[0] * x[0] : std::abs(x[0]);
  }
  [[nodiscard]] double conjugate(point const& v) const {
    double const bound = told == lie::conjugate ? 0.5 : 1 + 1e-12;
    return std::abs(v[0]) <= bound ? 0 : infinity;
  }
  [[nodiscard]] point slant(double ρ, point const& z) const {
    double const g = std::abs(z[0]) > ρ ? 1 : 0;
    return point(told == lie::slant ? 1 - g : g);
  }
  [[nodiscard]] slant::block_state state(double ρ, point const& z) const {
    bool const moves = std::abs(z[0]) > ρ;
    return moves != (told == lie::state) ? slant::block_state::free : slant::block_state::fixed;
  }
};

bool breaks(lie told, std::string const& law) {
  for (auto const& breach : slant::testing::function_breaches(modulus{told}, few()))
    if (breach.law == law) return true;
  return false;
}

TEST_CASE("function_breaches: finds each lie") {
  CHECK(slant::testing::function_breaches(modulus{lie::none}, few()).empty());
  CHECK(breaks(lie::prox_of_another, "subgradient inequality"));
  CHECK(breaks(lie::value, "Fenchel-Young"));
  CHECK(breaks(lie::conjugate, "conjugate is finite at subgradients"));
  CHECK(breaks(lie::slant, "slanting limit"));
  CHECK(breaks(lie::state, "state and slant"));
}

}  // namespace functions_test
