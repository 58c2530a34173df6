// SPDX-License-Identifier: MIT
#include <slant/concepts/member_names.hpp>

#include <support/testing.hpp>

namespace member_names_test {

struct plain {
  void apply(int const&, int&) const {}
};
struct overloaded {
  void apply(auto const&, auto&) const {}
  void apply(auto const&, auto&, auto&) const {}
};
struct inherited : overloaded {};
struct misspelt {
  void aply(auto const&, auto&) const {}
};
struct sealed final {};
class hidden {
  void apply(int const&, int&) const;
};
struct abstract {
  virtual ~abstract() = default;
  virtual void apply(int const&, int&) const = 0;
};
TEST_CASE("a member is found by its name, whatever its kind") {
  CHECK(slant::has_apply_member<plain>);
  CHECK(slant::has_apply_member<overloaded>);
  CHECK(slant::has_apply_member<inherited>);
  CHECK(slant::has_apply_member<abstract>);
  CHECK(slant::has_apply_member<hidden>);  // the name is there; calling it is another question
}

TEST_CASE("a misspelt member is not found") {
  CHECK_FALSE(slant::has_apply_member<misspelt>);
}

TEST_CASE("what cannot be derived from is believed") {
  CHECK(slant::has_apply_member<sealed>);
  CHECK(slant::has_apply_member<int>);
}

struct with_laws {
  static constexpr int laws = 1;
};
struct with_own_laws {
  int laws = 1;
};
class with_hidden_laws {
  static constexpr int laws = 1;
};
struct sealed_with_laws final {
  static constexpr int laws = 1;
};

TEST_CASE("laws are found in whatever form; a final class without them has none") {
  CHECK(slant::detail::names_laws<with_laws>);
  CHECK(slant::detail::names_laws<with_own_laws>);
  CHECK(slant::detail::names_laws<with_hidden_laws>);
  CHECK(slant::detail::names_laws<sealed_with_laws>);
  CHECK_FALSE(slant::detail::names_laws<plain>);
  CHECK_FALSE(slant::detail::names_laws<sealed>);
  CHECK_FALSE(slant::detail::names_laws<double>);
}

}  // namespace member_names_test
