// SPDX-License-Identifier: MIT
//
// One mistake, one complaint. A method or a problem whose arguments lack something is another
// specialisation of its class template, which says so in a static_assert and accepts everything
// from there on: its members are declared and never defined, so whatever is done with it later,
// solve(…) included, adds no errors to the first.
//
// Rejected: constraints on the class alone. Its arguments are deduced, and of a failed deduction
// g++ 12 tells 40 to 55 lines about deduction guides around the one that matters; clang 16 leaves
// that one out.
#pragma once

#include <slant/base/report.hpp>
#include <slant/concepts/capabilities.hpp>
#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/factorization.hpp>
#include <slant/concepts/linear_operator.hpp>
#include <slant/concepts/member_names.hpp>

#include <concepts>
#include <type_traits>

namespace slant::detail {

/// Base of everything that was refused.
struct refused {};

/// The complaint was made already.
template <class T> concept was_refused = std::derived_from<T, refused>;

/// Stands in for an argument, or for a result, once a mistake has been told: an operator, vector,
/// set, face and function that can do everything and promises everything. Nothing is defined.
struct stand_in {
  static constexpr law_set laws{~0U};
  index rows() const;
  index cols() const;
  index size() const;
  void apply(auto const& x, auto& y) const;
  void apply_adjoint(auto const& x, auto& y) const;
  void solve(auto const& b, auto& x) const;
  void project(auto const& x, auto& y) const;
  bool contains(auto const& x) const;
  block_state state(auto const& x) const;
  double step_to_boundary(auto const& x, auto const& d) const;
  double support(auto const& y) const;
  void keep(auto const& x, auto& y) const;
  void value(auto const& y, auto& f) const;
  stand_in slant(auto const& y) const;
};

/// The argument T if it is to be asked, else one that has every answer: what depends on an argument
/// that was refused already is not refused as well.
template <bool Asked, class T>
using asked_t = std::conditional_t<Asked, T, stand_in>;

/// The scalar of V as a member; of what is no vector, double.
template <class V>
struct scalar_of {
  using scalar = double;
};
template <vector V>
struct scalar_of<V> {
  using scalar = scalar_t<V>;
};

/// What states have in common.
template <class X, class S>
struct common_state {
  X x;
  S residual_norm, residual_scale, reduced_gradient_norm, gradient_scale, feasibility_norm,
      feasibility_scale;
  index iteration;
  slant::status status;
  slant::work work;
};

/// A state for vectors V; if those are what was refused, for numbers.
template <class V>
using refused_state =
    common_state<std::conditional_t<vector<V>, V, double>, typename scalar_of<V>::scalar>;

struct no_options {};

/// A method that was refused. State and Options, if given, are those it would have had.
template <class V, class State = refused_state<V>, class Options = no_options>
class refused_method : public refused {
 public:
  using state_type = std::conditional_t<vector<V>, State, refused_state<V>>;

  template <class... Arguments>
  explicit refused_method(Arguments const&...);
  template <class Problem>
  refused_method(Problem const&, Options const&);
  state_type start(auto const& x0) const;
  void step(state_type& s) const;
};

// --- part to blame -------------------------------------------------------------------------------
//
// Which part makes a composition useless. B A Bᵀ can be applied to no vector if A is an operator on
// vectors of another scalar, or if apply_adjoint of B returns its result instead of writing it. The
// compiler knows, but says of such a composition no more than that it has no apply; so the parts
// are asked, innermost first, and the complaint is about the part.
//
// Parts are recognised by the template arguments of a type, so compositions need not do anything
// for it.

template <class... P>
struct part_list {};

template <class A>
struct parts_of {
  using type = part_list<>;
};
template <template <class...> class T, class... P>
struct parts_of<T<P...>> {
  using type = part_list<std::remove_cvref_t<P>...>;
};
template <template <class, class, bool> class T, class P, class Q, bool B>
struct parts_of<T<P, Q, B>> {
  using type = part_list<std::remove_cvref_t<P>, std::remove_cvref_t<Q>>;
};
template <template <auto, class, unsigned> class T, auto Name, class P, unsigned Flags>
struct parts_of<T<Name, P, Flags>> {
  using type = part_list<P>;
};

/// A letter of an expression that stands for the adjoint of its operator.
template <class A>
inline constexpr bool is_adjoint_letter = false;
template <template <auto, class, unsigned> class T, auto Name, class P, unsigned Flags>
inline constexpr bool is_adjoint_letter<T<Name, P, Flags>> = (Flags & 1) != 0;
template <template <class, law_set> class T, class P, law_set L>
struct parts_of<T<P, L>> {
  using type = part_list<std::remove_cvref_t<P>>;
};

/// Asked of a part, what has no rows being none.
template <class A> concept part_with_apply = has_rows<A> && has_apply_member<A>;
template <class A> concept part_with_adjoint = has_rows<A> && has_apply_adjoint_member<A>;
template <class A>
concept part_with_solve = has_rows<A> && has_solve_member<A> && !has_apply_member<A>;

/// What the part says it can do, it can do with vectors of type V. An adjoint is looked at only if
/// nothing else is wrong: it need not be in use.
template <class A, class V, bool Adjoint = true>
concept usable_part = linear_operator<asked_t<part_with_apply<A>, A>, V> &&
                      factorization<asked_t<part_with_solve<A>, A>, V> &&
                      has_adjoint<asked_t<Adjoint && part_with_adjoint<A>, A>, V>;

template <bool Adjoint, class V, class A>
[[nodiscard]] consteval auto flawed_part(part_list<A>);

template <bool Adjoint, class V>
[[nodiscard]] consteval auto first_flawed(part_list<>) {
  return part_list<>{};
}
template <bool Adjoint, class V, class A, class... Rest>
[[nodiscard]] consteval auto first_flawed(part_list<A, Rest...>) {
  using found = decltype(flawed_part<Adjoint, V>(part_list<A>{}));
  if constexpr (std::is_same_v<found, part_list<>>) {
    return first_flawed<Adjoint, V>(part_list<Rest...>{});
  } else {
    return found{};
  }
}

/// A list of the innermost flawed part of A (A itself, if its parts are fine), or an empty one.
template <bool Adjoint, class V, class A>
consteval auto flawed_part(part_list<A>) {
  constexpr bool adjoint = Adjoint || is_adjoint_letter<A>;
  using inside = decltype(first_flawed<adjoint, V>(typename parts_of<A>::type{}));
  if constexpr (!std::is_same_v<inside, part_list<>>) {
    return inside{};
  } else if constexpr (!usable_part<A, V, Adjoint>) {
    return part_list<A>{};
  } else {
    return part_list<>{};
  }
}

template <class A>
[[nodiscard]] A only_part(part_list<A>);

/// The part of A that keeps A from being an operator on vectors of type V: A itself if none does.
template <class A, class V>
[[nodiscard]] consteval auto find_part_to_blame() {
  using parts = typename parts_of<A>::type;
  using flawed = decltype(first_flawed<false, V>(parts{}));
  using without_adjoint = decltype(first_flawed<true, V>(parts{}));
  if constexpr (!std::is_same_v<flawed, part_list<>>) {
    return flawed{};
  } else if constexpr (!std::is_same_v<without_adjoint, part_list<>>) {
    return without_adjoint{};
  } else {
    return part_list<A>{};
  }
}

/// What a method asks of its operator A when it is to work on vectors of type V, one member for
/// each complaint that is left to make. All are without fault if V is what was wrong.
template <class A, class V>
struct questions_about {
  using vector_type = asked_t<vector<V>, V>;
  using type = asked_t<vector<V>, A>;
  static constexpr bool works = linear_operator<type, vector_type>;
  using blamed = decltype(only_part(find_part_to_blame<asked_t<!works, type>, vector_type>()));

  using whole = asked_t<std::is_same_v<blamed, type>, type>;    ///< must be a linear_operator
  using part = asked_t<!std::is_same_v<blamed, type>, blamed>;  ///< must be a usable_part
  using promise = asked_t<works, type>;                         ///< must have declared its laws
};

// --- demands -------------------------------------------------------------------------------------
//
// What is said of the arguments that many methods have. A method asserts that it was `told`; the
// compiler names the method.

/// Of b, or x0.
template <class V>
struct vector_demands {
  static_assert(vector<V>, "b must be a slant::vector; an expression, a view or a row is none");
  static constexpr bool told = true;
};

/// The law that a method asks of an operator.
enum class law_demand : unsigned char { none, semidefinite, definite };

/// What says which part of A breaks a law of L, as an error of its own; void of what cannot say, which
/// is all but expressions (operators/explain.hpp).
template <class A, law_set L>
struct complaint_about {
  using type = void;
};

/// A lacks a law of L and says why.
template <class A, law_set L>
concept explains_lack =
    !laws_of<A>.contains(L) && !std::is_void_v<typename complaint_about<A, L>::type>;

/// A, if it is to be asked for the laws L and cannot say itself why it lacks them.
template <class A, law_set L>
using asked_for_t = asked_t<!explains_lack<A, L>, A>;

/// Whatever A has to say of L was said.
template <class A, law_set L>
inline constexpr bool explained = true;
template <class A, law_set L>
  requires explains_lack<A, L>
inline constexpr bool explained<A, L> = complaint_about<A, L>::type::told;

inline constexpr law_set psd_laws = slant::laws<law::self_adjoint, law::positive_semidefinite>;
inline constexpr law_set spd_laws = slant::laws<law::self_adjoint, law::positive_definite>;

/// Of A, applied to vectors of type V.
template <class A, class V, law_demand Law>
struct operator_demands {
  using a = questions_about<A, V>;
  using semidefinite = asked_t<Law == law_demand::semidefinite, typename a::promise>;
  using definite = asked_t<Law == law_demand::definite, typename a::promise>;

  static_assert(linear_operator<typename a::whole, typename a::vector_type>,
                "A must be a linear operator on vectors like b");
  static_assert(usable_part<typename a::part, typename a::vector_type>,
                "a part of A cannot be used on vectors like b");
  static_assert(psd_operator<asked_for_t<semidefinite, psd_laws>, typename a::vector_type>,
                "A must declare self_adjoint and positive_semidefinite");
  static_assert(spd_operator<asked_for_t<definite, spd_laws>, typename a::vector_type>,
                "A must declare self_adjoint and positive_definite");
  static constexpr bool told = explained<semidefinite, psd_laws> && explained<definite, spd_laws>;
};

/// Of M ≈ A⁻¹.
template <class M, class V, law_demand Law>
struct preconditioner_demands {
  using m = questions_about<M, V>;
  using semidefinite = asked_t<Law == law_demand::semidefinite, typename m::promise>;
  using definite = asked_t<Law == law_demand::definite, typename m::promise>;

  static_assert(linear_operator<typename m::whole, typename m::vector_type>,
                "the preconditioner must be a linear operator on vectors like b");
  static_assert(usable_part<typename m::part, typename m::vector_type>,
                "a part of the preconditioner cannot be used on vectors like b");
  static_assert(psd_operator<asked_for_t<semidefinite, psd_laws>, typename m::vector_type>,
                "the preconditioner must declare self_adjoint and positive_semidefinite");
  static_assert(spd_operator<asked_for_t<definite, spd_laws>, typename m::vector_type>,
                "the preconditioner must declare self_adjoint and positive_definite");
  static constexpr bool told = explained<semidefinite, psd_laws> && explained<definite, spd_laws>;
};

}  // namespace slant::detail
