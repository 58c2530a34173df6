// SPDX-License-Identifier: MIT
//
// Laws: what an operator promises beyond being linear.
//
// Intuition. `laws` is a constant of the type. A method asks for laws at compile time, so conjugate
// gradients cannot be called with an operator that nobody has promised to be positive definite.
//
// Minimal definition.  static constexpr auto laws = slant::laws<slant::self_adjoint, …>;
// An operator without the member promises nothing; a member of that name that is something else
// (one enumerator, not static, private) is an error.
//
// Laws (of laws).   definite ⇒ semidefinite,   firmly nonexpansive ⇒ semidefinite,
//                   self-adjoint projector ⇒ firmly nonexpansive.
//
// Each composition computes its own closure from the laws of its parts (sum of definite and
// semidefinite is definite; c·A keeps definiteness only if c > 0 is known). There is no "keep what
// both had": the product of two self-adjoint operators is not self-adjoint.
//
// Every declared law is sampled by slant::testing::check_operator_laws.
#pragma once

#include <slant/concepts/member_names.hpp>

#include <type_traits>

namespace slant {

/// One promise. Values are bits, so that a set of laws is a number.
enum class law : unsigned {
  self_adjoint = 1U,           ///< ⟨A x, y⟩ = ⟨x, A y⟩
  positive_semidefinite = 2U,  ///< ⟨A x, x⟩ ≥ 0
  positive_definite = 4U,      ///< ⟨A x, x⟩ > 0 for x ≠ 0
  projector = 8U,              ///< A A x = A x
  firmly_nonexpansive = 16U    ///< ⟨A x, x⟩ ≥ ‖A x‖²; with self_adjoint: 0 ⪯ A ⪯ I
};

inline constexpr law self_adjoint = law::self_adjoint;
inline constexpr law positive_semidefinite = law::positive_semidefinite;
inline constexpr law positive_definite = law::positive_definite;
inline constexpr law projector = law::projector;
inline constexpr law firmly_nonexpansive = law::firmly_nonexpansive;

/// A set of laws, closed under implication.
struct law_set {
  unsigned bits = 0;

  constexpr law_set() = default;
  constexpr explicit law_set(unsigned b) : bits(closed(b)) {}

  [[nodiscard]] constexpr bool contains(law l) const {
    return (bits & static_cast<unsigned>(l)) != 0;
  }
  [[nodiscard]] constexpr bool contains(law_set other) const {
    return (bits & other.bits) == other.bits;
  }
  /// Laws held by both.
  [[nodiscard]] friend constexpr law_set operator&(law_set a, law_set b) {
    return law_set{a.bits & b.bits};
  }
  /// Laws held by one or the other.
  [[nodiscard]] friend constexpr law_set operator|(law_set a, law_set b) {
    return law_set{a.bits | b.bits};
  }
  /// This set if the condition holds, else no law.
  [[nodiscard]] constexpr law_set when(bool condition) const {
    return condition ? *this : law_set{};
  }
  friend constexpr bool operator==(law_set, law_set) = default;

 private:
  static constexpr unsigned closed(unsigned b) {
    constexpr auto bit = [](law l) { return static_cast<unsigned>(l); };
    if ((b & bit(law::self_adjoint)) != 0 && (b & bit(law::projector)) != 0) {
      b |= bit(law::firmly_nonexpansive);
    }
    if ((b & (bit(law::positive_definite) | bit(law::firmly_nonexpansive))) != 0) {
      b |= bit(law::positive_semidefinite);
    }
    return b;
  }
};

/// The set of the named laws: slant::laws<slant::self_adjoint, slant::positive_definite>.
template <law... L>
inline constexpr law_set laws{(0U | ... | static_cast<unsigned>(L))};

namespace detail {

template <law_set>
struct constant_laws {};

/// Asked first: the next question, put to a non-static member, is a hard error of g++ 12.
template <class A>
concept has_static_laws = requires { requires std::is_pointer_v<decltype(&A::laws)>; };

}  // namespace detail

/// A::laws is a set of laws, known at compile time.
template <class A>
concept declares_laws =
    detail::has_static_laws<A> && requires { typename detail::constant_laws<law_set(A::laws)>; };

namespace detail {

template <class A>
[[nodiscard]] consteval law_set laws_of_type() {
  if constexpr (declares_laws<A>) {
    return A::laws;
  } else if constexpr (names_laws<A>) {
    static_assert(!names_laws<A>, "laws must be a public static constexpr slant::laws<...>");
    return law_set{~0U};  // what was complained of once is not also found missing
  } else {
    return {};
  }
}

}  // namespace detail

/// The laws that the type A declares; none if it declares nothing.
template <class A>
inline constexpr law_set laws_of = detail::laws_of_type<std::remove_cvref_t<A>>();

template <class A> concept declares_self_adjoint = laws_of<A>.contains(law::self_adjoint);
template <class A>
concept declares_positive_semidefinite = laws_of<A>.contains(law::positive_semidefinite);
template <class A> concept declares_positive_definite = laws_of<A>.contains(law::positive_definite);
template <class A> concept declares_projector = laws_of<A>.contains(law::projector);
template <class A>
concept declares_firmly_nonexpansive = laws_of<A>.contains(law::firmly_nonexpansive);

/// The rows of A are linearly independent: asserted (`full_row_rank(B)`), known of the type, or since
/// A is definite. No law, since operators that are not square have it; B A Bᵀ asks B for it.
template <class A>
concept declares_full_row_rank =
    declares_positive_definite<A> || requires { requires std::remove_cvref_t<A>::full_row_rank; };

}  // namespace slant
