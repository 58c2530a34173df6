// SPDX-License-Identifier: MIT
//
// Sets, and faces, that lie about one thing each: a law check that finds none of them would be
// worthless.
#include <slant/sets/sets.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>
#include "lying_sets.hpp"

namespace set_breaches_test {

using namespace liars;

/// Even few points must do.
slant::testing::set_options const few{.points = 20, .directions = 3};

/// Whether this law is among the broken ones.
template <class C>
bool breaks(C const& set, std::string const& law) {
  auto const found = slant::testing::set_breaches(set, few);
  for (auto const& breach : found) {
    if (breach.law == law && !breach.evidence.empty()) return true;
    INFO(breach.law, " ", breach.evidence);
  }
  return false;
}

TEST_CASE("set_breaches: the honest have none") {
  CHECK(slant::testing::set_breaches(liar(lie::none)).empty());
  CHECK(slant::testing::set_breaches(lying_product(product_lie::none)).empty());
}

TEST_CASE("set_breaches: each lie is found") {
  CHECK(breaks(liar(lie::stops_half_way), "idempotence"));
  CHECK(breaks(liar(lie::stops_half_way), "contains(P(x))"));
  CHECK(breaks(liar(lie::projects_to_square), "contains(P(x))"));
  CHECK(breaks(liar(lie::projects_along_axes), "variational inequality"));
  CHECK(breaks(liar(lie::projects_along_axes), "nonexpansiveness"));
  CHECK(breaks(liar(lie::reads_its_output), "overwriting"));
  CHECK(breaks(liar(lie::forgets_aliasing), "in place"));
  CHECK(breaks(liar(lie::contains_interior_only), "contains(P(x))"));
  CHECK(breaks(liar(lie::contains_all), "contains(x) implies P(x) = x"));
  CHECK(breaks(liar(lie::slant_too_large), "0 <= slant <= I"));
  CHECK(breaks(liar(lie::slant_indefinite), "0 <= slant <= I"));
  CHECK(breaks(liar(lie::slant_asymmetric), "slant is symmetric"));
  CHECK(breaks(liar(lie::slant_without_curvature), "slanting limit"));
  CHECK(breaks(liar(lie::slant_slightly_wrong), "slanting limit"));
  CHECK(breaks(liar(lie::slant_jumps_too_early), "slanting limit"));
  CHECK(breaks(liar(lie::slant_nan), "0 <= slant <= I"));
  CHECK(breaks(liar(lie::step_too_long), "step_to_boundary stays inside"));
  CHECK(breaks(liar(lie::step_infinite), "step_to_boundary stays inside"));
  CHECK(breaks(liar(lie::step_too_short), "step_to_boundary reaches the boundary"));
  CHECK(breaks(liar(lie::step_negative), "step_to_boundary >= 0"));
  CHECK(breaks(liar(lie::step_zero_for_no_direction), "step_to_boundary is infinite for d = 0"));
  CHECK(breaks(liar(lie::early_step_wrong), "step_to_boundary with early exit"));
  CHECK(breaks(liar(lie::support_too_small), "support is a bound"));
  CHECK(breaks(liar(lie::support_too_large), "support is attained"));
  CHECK(breaks(liar(lie::support_infinite), "support is infinite only if unbounded"));
  CHECK(breaks(liar(lie::support_with_offset), "support(0) = 0"));
  CHECK(breaks(liar(lie::always_free), "not free on the boundary"));
  CHECK(breaks(liar(lie::never_free), "free in the interior"));
  CHECK(breaks(liar(lie::pinned_on_the_rim), "fixed leaves no motion"));
  CHECK(breaks(sliding_apex{}, "sliding leaves motion"));
  CHECK(breaks(liar(lie::inequality_reversed), "f(x) <= 0 in the set"));
  CHECK(breaks(liar(lie::inequality_too_wide), "f(x) > 0 outside"));
  CHECK(breaks(liar(lie::gradient_too_long), "gradient of the inequality"));
  CHECK(breaks(liar(lie::gradient_tangential), "gradient points outwards"));
  CHECK(breaks(liar(lie::hessian_too_large), "Hessian of the inequality"));
  CHECK(breaks(liar(lie::hessian_asymmetric), "Hessian is symmetric"));
  CHECK(breaks(lying_product(product_lie::places_overlap), "places share out the components"));
  CHECK(breaks(lying_product(product_lie::numbers_repeated), "visit numbers the blocks"));
  CHECK(breaks(lying_product(product_lie::other_blocks), "projection is blockwise"));
  CHECK(breaks(lying_product(product_lie::slant), "slant is blockwise"));
  CHECK(breaks(lying_product(product_lie::step), "step is blockwise"));
  CHECK(breaks(lying_product(product_lie::support), "support is blockwise"));
}

/// A half line that says it were the whole line.
struct no_space {
  static constexpr int dimension = 1;
  static constexpr bool whole_space = true;
  using point = Eigen::Matrix<double, 1, 1>;
  [[nodiscard]] point project(point const& x) const { return x.cwiseMax(0.0); }
  [[nodiscard]] bool contains(point const& x) const { return x[0] >= 0; }
};

TEST_CASE("set_breaches: a whole space that is none") {
  CHECK(breaks(no_space{}, "whole_space implies P(x) = x"));
  CHECK(breaks(no_space{}, "whole_space implies contains(x)"));
  // The product passes over its blocks: that they would do something else shows there, too.
  CHECK_FALSE(slant::testing::set_breaches(slant::power(no_space{}, 3), few).empty());
}

/// A client's own set, of which the library knows nothing: x + y <= 1.
struct half_plane {
  static constexpr int dimension = 2;
  Vector2d project(auto const& x) const {
    double const excess = x[0] + x[1] - 1;
    return excess > 0 ? Vector2d(x[0] - excess / 2, x[1] - excess / 2) : Vector2d(x);
  }
  bool contains(auto const& x) const { return x[0] + x[1] <= 1 + 1e-15; }
};

TEST_CASE("set_laws: a set with a projection only") {
  slant::testing::check_set_laws(half_plane{}, slant::testing::set_options{.points = 200});
}

TEST_CASE("set_laws: archetypes keep the laws") {
  namespace archetype = slant::testing::archetype;
  archetype::vector const prototype(VectorXd::Zero(3));
  slant::testing::check_set_laws(archetype::convex_set(3), prototype);
  slant::testing::check_set_laws(archetype::separable_set(3), prototype,
                                 slant::testing::set_options{.seed = 2, .points = 20});
}

TEST_CASE("set_laws: a broken law makes the test fail, with its name" * doctest::should_fail()) {
  struct without_bound : half_plane {
    bool contains(Vector2d const&) const { return true; }
  };
  slant::testing::check_set_laws(without_bound{});
}

/// The laws that a face breaks, sampled:
///     keep ∘ keep = keep,   ⟨keep x, y⟩ = ⟨x, keep y⟩,   keep x + keep_complement x = x,
///     y may be x, may hold NaN on entry; an infinite entry off the face is cut to 0, not to NaN;
///     block states are those of the enumeration.
template <class F, class V>
std::string broken_laws(F const& face, V const& prototype) {
  static_assert(slant::block_partition<F, V>);
  slant::index const n = slant::local(prototype).size();
  std::string broken;
  auto const expect = [&](bool holds, std::string const& law) {
    if (!holds) broken += law + "; ";
  };
  auto const made = [&](VectorXd const& entries) {
    V v = slant::like(prototype, n);
    slant::local(v) = entries;
    return v;
  };
  auto const same = [&](V const& a, V const& b) { return slant::local(a) == slant::local(b); };

  V const x = made(VectorXd::LinSpaced(n, 1.0, 2.1)), y = made(VectorXd::LinSpaced(n, -1.5, 3.1));
  V const blank = made(VectorXd::Constant(n, std::nan("")));
  V kept = blank, rest = blank, kept_y = blank, twice = blank;
  face.keep(x, kept);
  face.keep(y, kept_y);
  face.keep_complement(x, rest);
  face.keep(kept, twice);
  expect(same(twice, kept), "keep twice is keep");
  V sum = kept;
  slant::local(sum) += slant::local(rest);
  expect(same(sum, x), "keep and keep_complement add up to x");
  V in_place = x;
  face.keep(in_place, in_place);
  expect(same(in_place, kept), "keep in place");
  in_place = x;
  face.keep_complement(in_place, in_place);
  expect(same(in_place, rest), "keep_complement in place");
  // All products but those of entries that are kept in both vanish, exactly.
  double const product = slant::inner_product(kept, kept_y);
  expect(slant::inner_product(kept, y) == product && slant::inner_product(x, kept_y) == product,
         "keep is self-adjoint");

  V cut = blank;
  face.keep(made(VectorXd::Constant(n, std::numeric_limits<double>::infinity())), cut);
  for (slant::index i = 0; i < n; ++i) {
    expect(slant::local(kept)(i) != 0 || slant::local(cut)(i) == 0,
           "an infinite entry off the face is cut");
  }
  for (slant::index i = 0; i < face.size(); ++i)
    expect(static_cast<unsigned>(face.state(i)) < 3, "every block is free, sliding or fixed");
  return broken;
}

TEST_CASE("face_laws: the face of the library and the least face keep their word") {
  auto const set = slant::cartesian(slant::half_lines(3), slant::discs(VectorXd{{1.0, 0.0}}));
  VectorXd const x{{0.0, 1.0, 2.0, 0.6, 0.8, 0.0, 0.0}};
  CHECK(broken_laws(slant::face_of(set, x), x) == "");
  slant::testing::archetype::face least;
  least.assign(set, x);
  CHECK(broken_laws(least, slant::testing::archetype::vector(x)) == "");
}

/// Keeps the first entry, in one wrong way.
struct lying_face {
  enum { honest, leaves_old, adds, multiplies, overlaps, unknown_state } how = honest;
  [[nodiscard]] slant::index size() const { return 1; }
  [[nodiscard]] slant::block_state state(slant::index) const {
    return how == unknown_state ? static_cast<slant::block_state>(7) : slant::block_state::free;
  }
  void keep(VectorXd const& x, VectorXd& y) const {
    VectorXd const old = x, before = y;
    y = VectorXd::Zero(old.size());
    y(0) = old(0);
    if (how == leaves_old) y(1) = before(1);
    if (how == adds) y(0) += 1;
    if (how == multiplies) y.tail(y.size() - 1) = 0 * old.tail(y.size() - 1);
  }
  void keep_complement(VectorXd const& x, VectorXd& y) const {
    y = x;
    if (how != overlaps) y(0) = 0;
  }
};

TEST_CASE("face_laws: each lie is found") {
  auto const finds = [](lying_face const& face, std::string const& law) {
    std::string const found = broken_laws(face, VectorXd(4));
    CHECK_MESSAGE(found.find(law) != std::string::npos, law, " not in ", found);
  };
  CHECK(broken_laws(lying_face{}, VectorXd(4)) == "");
  finds({lying_face::leaves_old}, "keep");
  finds({lying_face::adds}, "keep twice is keep");
  finds({lying_face::multiplies}, "an infinite entry off the face is cut");
  finds({lying_face::overlaps}, "keep and keep_complement add up to x");
  finds({lying_face::unknown_state}, "every block is free, sliding or fixed");
}

}  // namespace set_breaches_test
