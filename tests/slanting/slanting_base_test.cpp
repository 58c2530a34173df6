// SPDX-License-Identifier: MIT
#include <slant/sets/contact_sets.hpp>
#include <slant/slanting/slanting.hpp>

#include <support/testing.hpp>

namespace slanting_base_test {

// A function with all members but without the mark: factories take it, operators do not.
struct unmarked {
  [[nodiscard]] slant::index rows() const { return 1; }
  [[nodiscard]] slant::index cols() const { return 1; }
  [[nodiscard]] VectorXd value(VectorXd const& y) const { return y; }
  [[nodiscard]] auto slant(VectorXd const& y) const { return slant::identity_operator(y.size()); }
};
struct marked : unmarked, slant::slanting_base {};
struct only_marked : slant::slanting_base {};

static_assert(slant::slanting_part<unmarked> && !slant::slanting_map<unmarked>);
static_assert(slant::slanting_part<marked> && slant::slanting_map<marked>);
static_assert(!slant::slanting_part<only_marked> && !slant::slanting_map<only_marked>);
static_assert(slant::slanting_map<marked const&> && slant::slanting_part<marked&&>);

TEST_CASE("the mark costs no memory") {
  struct payload {
    double number;
  };
  struct with_mark : payload, slant::slanting_base {};
  CHECK(sizeof(with_mark) == sizeof(payload));
}

}  // namespace slanting_base_test
