// SPDX-License-Identifier: MIT
#include <slant/sets/sets.hpp>

#include <support/testing.hpp>

namespace syntax_of_sets_test {

VectorXd const x = VectorXd::LinSpaced(6, -3, 3);

TEST_CASE("products are flat, and what cartesian makes") {
  VectorXd const g{{0.5, 2.0}};
  auto const Λ = slant::half_lines(1) * slant::discs(g) * slant::free_components(1);
  auto const twin =
      slant::cartesian(slant::half_lines(1), slant::discs(g), slant::free_components(1));
  static_assert(std::is_same_v<decltype(Λ), decltype(twin)>);
  CHECK(slant::project(Λ, x) == slant::project(twin, x));
  // Blocks make a block; a named product is referenced, not taken apart.
  static_assert(decltype(slant::half_line<>{} * slant::ball<2>{1.0})::dimension == 3);
  auto const named = Λ * slant::half_lines(2);
  static_assert(decltype(named)::part_count == 2);
  CHECK(&named.part<0>() == &Λ);
  CHECK(slant::dimension_of(named) == 8);
}

TEST_CASE("multiples and translations") {
  auto const Λ = slant::intervals(VectorXd(VectorXd::Ones(6)));
  VectorXd const c = VectorXd::LinSpaced(6, 0, 1);
  CHECK(slant::project(2.0 * Λ, x) == x.cwiseMax(-2).cwiseMin(2));
  VectorXd const moved = (x - c).cwiseMax(-1).cwiseMin(1) + c;
  CHECK((slant::project(Λ + c, x) - moved).norm() <= 1e-15);
  CHECK(slant::project(c + Λ, x) == slant::project(Λ + c, x));
  CHECK(slant::project(Λ - VectorXd(-c), x) == slant::project(Λ + c, x));
  CHECK(SLANT_COMPLAINT(-1.0 * Λ) == "c: got -1, expected a finite number > 0");
}

}  // namespace syntax_of_sets_test
