// SPDX-License-Identifier: MIT
#include <slant/sets/sets.hpp>
#include <slant/sets/block_range.hpp>

#include <range/v3/algorithm/count_if.hpp>
#include <range/v3/numeric/accumulate.hpp>
#include <range/v3/range/conversion.hpp>
#include <range/v3/view/drop.hpp>
#include <range/v3/view/filter.hpp>
#include <range/v3/view/take.hpp>
#include <range/v3/view/transform.hpp>
#include <range/v3/view/zip.hpp>
#include <support/testing.hpp>

namespace block_range_test {

using slant::block_state;

auto const is_sliding = [](auto const& b) { return b.state() == block_state::sliding; };
auto const is_free = [](auto const& b) { return b.state() == block_state::free; };

/// Pressures, then friction, first components before second ones: node 0 is open, 1 sticks, 2 and 3
/// slide, 4 has no bound of friction.
VectorXd const g{{1.0, 1.0, 0.5, 2.0, 0.0}};
VectorXd const x{{0.0, 2.0, 1.0, 3.0, 1.0,  //
                  0.2, 0.3, 0.3, 0.0, 0.0,  //
                  0.0, 0.4, 0.4, 2.0, 0.0}};
auto const Λ = slant::half_lines(5) * slant::discs<slant::planar>(g);

/// The blocks of a point against those that visit shows and the states of its face.
template <class C>
void check_against_visit(C const& set) {
  VectorXd const inside =
      slant::project(set, VectorXd(VectorXd::LinSpaced(slant::dimension_of(set), -1.5, 2.5)));
  slant::face<> const face(set, inside);
  auto const all = slant::blocks(set, inside);
  CHECK(slant::index(std::ranges::size(all)) == face.size());
  auto next = all.begin();
  slant::visit_blocks(set, [&](auto const&, auto const& p) {
    REQUIRE(next != all.end());
    auto const b = *next++;
    CHECK(b.index() == p.index());
    CHECK(all[p.index()].index() == p.index());
    REQUIRE(b.size() == p.size());
    for (slant::index j = 0; j < p.size(); ++j) CHECK(b.component(j) == p.component(j));
    CHECK(b.value() == p.value(inside));
    CHECK(b.state() == face.state(p.index()));
  });
  CHECK(next == all.end());
}

TEST_CASE("every kind of set has the blocks that visit shows") {
  auto const node = slant::cartesian(slant::half_line<>{0.5}, slant::ball<2>{1.0});
  VectorXd const c = VectorXd::LinSpaced(15, 0, 1);
  check_against_visit(Λ);
  check_against_visit(slant::ball<2>{1.0});
  check_against_visit(slant::half_lines(0));
  check_against_visit(node);
  check_against_visit(slant::power(node, 3));
  check_against_visit(slant::power<slant::planar>(node, 3));
  check_against_visit(slant::power(slant::cartesian(node, slant::point<1>{}), 2) *
                      slant::free_components(2));
  check_against_visit(slant::half_lines(2) * Λ * slant::point<2>{});
  check_against_visit(2.0 * Λ);
  check_against_visit(Λ + c);
  check_against_visit(slant::power(2.0 * node, 2));
  check_against_visit(slant::block_scaled(VectorXd(VectorXd::Constant(15, 4.0)), Λ));
  check_against_visit(slant::power(
      slant::rotated(slant::ball<2>{1.0}, Eigen::Matrix2d{{0.0, -1.0}, {1.0, 0.0}}), 3));
  check_against_visit(slant::any_set(Λ));
  check_against_visit(slant::any_set<>(slant::ball<2>{1.0}));
}

TEST_CASE("the range is a random access view of std and of range-v3") {
  using range = decltype(slant::blocks(Λ, x));
  static_assert(std::ranges::random_access_range<range> && std::ranges::view<range>);
  static_assert(ranges::random_access_range<range> && ranges::view_<range>);
  CHECK(std::ranges::count_if(slant::blocks(Λ, x), is_sliding) == 2);
  CHECK(ranges::count_if(slant::blocks(Λ, x) | ranges::views::drop(5), is_sliding) == 2);

  // Friction of the nodes in contact.
  auto const in_contact = [](auto const& node) { return is_free(std::get<0>(node)); };
  auto const friction = [](auto const& node) { return std::get<1>(node).value().norm(); };
  auto const all = slant::blocks(Λ, x);
  auto const lengths =
      ranges::views::zip(all | ranges::views::take(5), all | ranges::views::drop(5)) |
      ranges::views::filter(in_contact) | ranges::views::transform(friction) |
      ranges::to<std::vector<double>>();
  CHECK(lengths == std::vector<double>{0.5, 0.5, 2.0, 0.0});
}

/// A product that shows its blocks only all at once: to find one of them is not a matter of a step.
struct reticent {
  slant::index size() const { return 2; }
  void visit(auto&& f) const { f(slant::ball<2>{}, slant::place<2>(0, 0, 2)); }
};

template <class C, class X>
concept has_blocks =
    requires(C&& set, X&& point) { slant::blocks(std::forward<C>(set), std::forward<X>(point)); };

TEST_CASE(
    "temporaries, which the range would outlive, and products that cannot be asked are refused") {
  using set = decltype(Λ);
  static_assert(has_blocks<set&, VectorXd const&>);
  static_assert(!has_blocks<set, VectorXd const&>);
  static_assert(!has_blocks<set&, VectorXd>);
  static_assert(!has_blocks<set&, decltype(2 * x) const&>);
  static_assert(!has_blocks<reticent const&, VectorXd const&>);
}

TEST_CASE("blocks are read without an allocation") {
  auto const any = slant::any_set(Λ);
  auto const moved = 2.0 * Λ;
  slant::testing::allocation_guard guard;
  slant::index sliding = 0;
  double sum = 0;
  auto const look_at = [&](auto const& set) {
    auto const all = slant::blocks(set, x);
    sliding += ranges::count_if(all, is_sliding);
    auto lengths = all | ranges::views::filter(is_free) |
                   ranges::views::transform([](auto const& b) { return b.value().norm(); });
    sum += ranges::accumulate(lengths, 0.0);
  };
  look_at(Λ);
  look_at(any);
  look_at(moved);
  auto const allocations = guard.count();
  CHECK(allocations == 0);
  CHECK(sliding >= 4);
  CHECK(sum > 0);
}

TEST_CASE("values are those of x as it is; segments may be points; another size is refused") {
  VectorXd y = x;
  auto const all = slant::blocks(Λ, y);
  y(1) = 7;
  CHECK(all[1].value()(0) == 7);
  auto const part = x.head(5);
  CHECK(slant::blocks(Λ.part<0>(), part)[3].value()(0) == 3);
  VectorXd twice(30);
  twice << x, VectorXd::Zero(15);
  twice = VectorXd(twice.reshaped(15, 2).transpose().reshaped());
  Eigen::Map<VectorXd const, 0, Eigen::InnerStride<2>> const spread(twice.data(), 15);
  CHECK(slant::blocks(Λ, spread)[8].value() == slant::blocks(Λ, x)[8].value());
  CHECK_THROWS_WITH_AS(static_cast<void>(slant::blocks(Λ, part)),
                       "x: got 5, expected the dimension of the set, 15", slant::bad_input);
}

}  // namespace block_range_test
