// SPDX-License-Identifier: MIT
#include <slant/base/held.hpp>
#include <slant/base/long_arrays.hpp>

#include <support/testing.hpp>

namespace held_test {

struct traced {
  inline static int copies = 0;
  inline static int moves = 0;
  int value = 0;

  explicit traced(int v) : value(v) {}
  traced(traced const& other) : value(other.value) { ++copies; }
  traced(traced&& other) noexcept : value(other.value) { ++moves; }
  traced& operator=(traced const&) = default;
  traced& operator=(traced&&) = default;
  ~traced() = default;
};

template <class T>
auto keep(T&& t) {
  return slant::held<slant::kept_t<T>>(std::forward<T>(t));
}

static_assert(std::is_same_v<slant::kept_t<int&>, int const&>);
static_assert(std::is_same_v<slant::kept_t<int const&>, int const&>);
static_assert(std::is_same_v<slant::kept_t<int>, int>);
static_assert(std::is_same_v<slant::kept_t<int const>, int>);
static_assert(std::is_copy_assignable_v<slant::held<int const&>>);
static_assert(std::is_copy_assignable_v<slant::held<int>>);
static_assert(!std::is_copy_constructible_v<slant::held<std::unique_ptr<int>>>);
static_assert(std::is_move_constructible_v<slant::held<std::unique_ptr<int>>>);

TEST_CASE("an lvalue is referenced: no copy, and changes show") {
  traced::copies = traced::moves = 0;
  traced a(1);
  auto const kept = keep(a);
  a.value = 2;
  CHECK(kept.get().value == 2);
  CHECK(&kept.get() == &a);
  CHECK(traced::copies + traced::moves == 0);
}

TEST_CASE("an rvalue is moved in and owned") {
  traced::copies = traced::moves = 0;
  auto const kept = keep(traced(3));
  CHECK(kept.get().value == 3);
  CHECK(traced::copies == 0);
  auto const unique = keep(std::make_unique<int>(7));
  CHECK(*unique.get() == 7);
}

TEST_CASE("copies of a reference refer to the same object, copies of an owner own") {
  std::vector<int> v{1, 2, 3};
  auto reference = keep(v);
  auto const second = reference;
  CHECK(&second.get() == &v);
  std::vector<int> other{4};
  reference = keep(other);
  CHECK(&reference.get() == &other);

  auto const owner = keep(std::vector<int>{5, 6});
  auto const copy = owner;
  CHECK(copy.get() == owner.get());
  CHECK(copy.get().data() != owner.get().data());
}

TEST_CASE("a long array is a vector, long or short") {
  for (std::size_t const n : {std::size_t{3}, std::size_t{1} << 21}) {
    slant::detail::long_array<int> a(n / 2, 7);
    a.resize(n, 9);
    std::iota(a.begin(), a.end(), 0);
    auto b = a;
    a.resize(2 * n);  // moves what is there
    CHECK(std::equal(b.begin(), b.end(), a.begin()));
    CHECK(b.back() == static_cast<int>(n - 1));
    if (n > 3) CHECK(reinterpret_cast<std::uintptr_t>(b.data()) % (std::size_t{1} << 21) == 0);
  }
  slant::detail::long_array<int> a;
  CHECK_THROWS_AS(a.reserve(a.max_size() + 1), std::length_error);
}

TEST_CASE("reading ahead of an array does no harm") {
  int const a = 1;
  slant::detail::read_ahead<256>(&a, 1 << 30);
  slant::detail::read_ahead<256>(&a, -(1 << 30));
  slant::detail::read_ahead<64>(nullptr, -1);
  CHECK(a == 1);
}

}  // namespace held_test
