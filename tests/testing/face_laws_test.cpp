// SPDX-License-Identifier: MIT
#include <slant/sets/sets.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>

namespace face_laws_test {

TEST_CASE("the face of the library and the least face keep their word") {
  auto const set = slant::cartesian(slant::half_lines(3), slant::discs(VectorXd{{1.0, 0.0}}));
  VectorXd const x{{0.0, 1.0, 2.0, 0.6, 0.8, 0.0, 0.0}};
  slant::testing::check_face_laws(slant::face_of(set, x), x);
  slant::testing::archetype::face least;
  least.assign(set, x);
  slant::testing::check_face_laws(least, slant::testing::archetype::vector(x));
}

/// Keeps the first entry, in one wrong way.
struct liar {
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

std::string found(liar const& face) {
  std::string laws;
  for (auto const& breach : slant::testing::face_breaches(face, VectorXd(4))) {
    laws += breach.law + "; ";
  }
  return laws;
}

TEST_CASE("each lie is found") {
  auto const finds = [](liar const& face, std::string const& law) {
    CHECK_MESSAGE(found(face).find(law) != std::string::npos, law, " not in ", found(face));
  };
  CHECK(found({}).empty());
  finds({liar::leaves_old}, "keep");
  finds({liar::adds}, "keep twice is keep");
  finds({liar::multiplies}, "an infinite entry off the face is cut");
  finds({liar::overlaps}, "keep and keep_complement add up to x");
  finds({liar::unknown_state}, "every block is free, sliding or fixed");
}

}  // namespace face_laws_test
