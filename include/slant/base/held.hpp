// SPDX-License-Identifier: MIT
//
// How compositions keep their parts: what was passed as an lvalue is referenced, what was passed as
// an rvalue is owned (the rule of std::views). So `sum(A, scaled(2, B))` copies neither A nor B,
// and owns the small object that scaled() made. A handle is copied, as std::views copies views: what
// a function returns of local expressions refers to none of them.
#pragma once

#include <memory>
#include <type_traits>
#include <utility>

namespace slant {

/// A type whose copies share what they stand for says so by `static constexpr bool is_handle = true`.
template <class T> concept handle = requires { requires std::remove_cvref_t<T>::is_handle; };

/// How an argument of deduced type T (of a parameter T&&) is kept: `U const&` for an lvalue that is
/// no handle, else the plain type.
template <class T>
using kept_t = std::conditional_t<std::is_lvalue_reference_v<T> && !handle<T>,
                                  std::remove_reference_t<T> const&, std::remove_cvref_t<T>>;

/// A type that is made of others and forgets which they were says so by
/// `static constexpr bool forgets_types = true`.
template <class T> concept forgets_types = requires { requires T::forgets_types; };

/// One kept part. held<U const&> points to an object that must outlive it, held<U> owns a U. Both
/// can be copied and moved if U can; access is read-only, but for who owns a held<U>.
template <class T>
class held {
  static_assert(std::is_same_v<T, std::remove_cvref_t<T>>, "use kept_t<T> for the type of a part");

 public:
  using type = T;

  held(T&& value) : value_(std::move(value)) {}  // NOLINT(google-explicit-constructor)
  held(T const& value)                           // NOLINT(google-explicit-constructor)
    requires std::is_copy_constructible_v<T>
      : value_(value) {}

  /// A T made of `value`, where T forgets what it is made of.
  template <class U>
    requires forgets_types<T> && (!std::is_same_v<std::remove_cvref_t<U>, T>) &&
             (!std::is_same_v<std::remove_cvref_t<U>, held>) && std::is_convertible_v<U, T>
  held(U&& value) : value_(std::forward<U>(value)) {}  // NOLINT(google-explicit-constructor)

  [[nodiscard]] T const& get() const noexcept { return value_; }
  [[nodiscard]] T& get() noexcept { return value_; }

 private:
  T value_;
};

template <class T>
class held<T const&> {
 public:
  using type = T;

  held(T const& value) noexcept  // NOLINT(google-explicit-constructor)
      : pointer_(std::addressof(value)) {}

  [[nodiscard]] T const& get() const noexcept { return *pointer_; }

 private:
  T const* pointer_;
};

}  // namespace slant
