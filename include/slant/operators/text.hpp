// SPDX-License-Identifier: MIT
//
// Names of operators, and expressions as text: UTF-8 mathematics at run time (B K⁻¹ Bᵀ), ASCII in
// what the compiler says (B * inverse(K) * adjoint(B)), of which g++ prints the bytes.
//
// A name is a template argument: a text, op<"B">(M), or the place of construction, op(M). Two
// letters with one name are one operator as far as the compiler can tell; that the name stands for
// one object is checked where they meet.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/laws.hpp>

#include <bit>
#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace slant::expr {

// --- names ---------------------------------------------------------------------------------------

/// A text as a template argument: op<"B">.
template <std::size_t N>
struct text {
  char data[N]{};

  constexpr text() = default;
  constexpr text(char const (&s)[N]) {  // NOLINT(google-explicit-constructor): op<"B"> converts
    for (std::size_t i = 0; i < N; ++i) data[i] = s[i];
  }
  [[nodiscard]] constexpr std::string_view view() const { return {data, N - 1}; }
};

/// A place of construction: Closure is a type of its own for each op(M) in a program.
template <class Closure>
struct place {};

/// An operator that is the same as no other.
struct nameless {};

/// The operator at both ends of one congruence, which nothing takes apart: congruence(B, A).
struct twin {};

template <auto Name>
inline constexpr bool is_named = true;
template <>
inline constexpr bool is_named<nameless{}> = false;

/// What is printed for a name; empty for those that are no text.
template <std::size_t N>
[[nodiscard]] constexpr std::string_view text_of(text<N> const& name) {
  return name.view();
}
[[nodiscard]] constexpr std::string_view text_of(auto const&) {
  return {};
}

/// The texts in an expression and what they stand for.
class dictionary {
 public:
  /// Throws bad_input if the text stands for another object already: what is printed must be true.
  [[gnu::noinline]] void enter(std::string_view name, void const* object) {
    for (auto const& e : entries_) {
      if (e.name == name && e.object != object) {
        throw bad_input(name, "two different objects",
                        "one object: a name stands for one operator");
      }
    }
    entries_.push_back({name, object});
  }

 private:
  struct entry {
    std::string_view name;
    void const* object;
  };
  std::vector<entry> entries_;
};

// --- symbols -------------------------------------------------------------------------------------

/// my_laplacian of "… [with A = ns::my_laplacian<…>; …]".
template <class A>
[[nodiscard]] constexpr std::string_view type_name() {
  std::string_view s = __PRETTY_FUNCTION__;
  s.remove_prefix(s.find("A = ") + 4);
  s = s.substr(0, s.find_first_of("<;]"));
  std::size_t const colon = s.rfind(':');
  return colon == s.npos ? s : s.substr(colon + 1);
}

/// What stands for an operator without a name: A::symbol where there is one, else its type.
template <class A>
[[nodiscard]] constexpr std::string_view symbol_of() {
  if constexpr (requires { std::string_view(A::symbol); }) {
    return A::symbol;
  } else {
    return type_name<A>();
  }
}

// --- texts ---------------------------------------------------------------------------------------

/// Text that the compiler can build; what does not fit ends in "...".
struct ascii {
  char data[240]{};
  std::size_t size = 0;

  constexpr ascii& add(std::string_view s) {
    for (char const c : s) {
      if (size + 4 < sizeof data) {
        data[size++] = c;
      } else {
        data[size - 1] = data[size - 2] = data[size - 3] = '.';
      }
    }
    return *this;
  }
  [[nodiscard]] constexpr std::string_view view() const { return {data, size}; }
};

[[nodiscard]] inline std::string number_text(double c) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", c);
  return text;
}

[[nodiscard]] constexpr std::string_view law_name(law l) {
  constexpr std::string_view names[] = {"self_adjoint", "positive_semidefinite",
                                        "positive_definite", "projector", "firmly_nonexpansive"};
  return names[std::countr_zero(static_cast<unsigned>(l))];
}

/// "spd", "psd", "self-adjoint", …
[[nodiscard]] constexpr std::string_view laws_text(law_set l) {
  bool const definite = l.contains(law::positive_definite);
  if (!l.contains(law::self_adjoint)) {
    if (definite) return "positive definite, not self-adjoint";
    if (l.contains(law::projector)) return "projector";
    if (l.contains(law::positive_semidefinite)) return "positive semidefinite, not self-adjoint";
    return "no laws";
  }
  if (l.contains(law::projector)) return definite ? "identity" : "orthogonal projector";
  if (definite) return "spd";
  return l.contains(law::positive_semidefinite) ? "psd" : "self-adjoint";
}

}  // namespace slant::expr
