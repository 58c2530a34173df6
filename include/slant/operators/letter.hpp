// SPDX-License-Identifier: MIT
//
// The letters of an expression: an operator with or without a name, its adjoint and its inverse.
//
//     auto B = slant::op<"B">(Bm);                           // references Bm
//     auto K = slant::op<"K">(slant::factorize(Km));         // owns the factors; K is no operator,
//     auto Kinv = slant::inverse(K);                         // K⁻¹ is
//     auto L = slant::op(my_laplacian{n});                   // named after the place of this call
//
// A letter is a handle: copies share the object, so an expression owns its letters, costs nothing to
// copy, and can tell whether two letters are the same object. Nothing dangles but what was named by
// an lvalue, which is referenced.
#pragma once

#include <slant/operators/composition.hpp>
#include <slant/operators/identity.hpp>
#include <slant/operators/inverse.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/operators/text.hpp>

#include <memory>
#include <string>
#include <type_traits>
#include <utility>

namespace slant {

/// Base of products and sums, for which + − * and << are looked up in namespace slant.
struct node_base {};

/// Base of what a name gives: a handle, which compositions copy.
struct handle_base : node_base {
  static constexpr bool is_handle = true;
};

/// Base of expressions.
struct expression_base : handle_base {};

/// An expression of linear operators: a letter, or a product or sum of letters. (Products and sums
/// of other operators, such as a slanting operator that is renewed in place, own those and are none.)
template <class A> concept expression = std::is_base_of_v<expression_base, std::remove_cvref_t<A>>;

namespace expr {

/// What a letter is of the object that bears its name; and what its user asserts of that object.
inline constexpr unsigned adjointed = 1, inverted = 2, independent_rows = 4,
                          independent_columns = 8;

template <class... A>
using base_of_node = std::conditional_t<(expression<A> && ...), expression_base, node_base>;

// --- what is done to a part, expression or not ---------------------------------------------------

/// y = A x and y ← y + α A x, of sizes that were checked.
template <class A, class X, class Y, class W>
void apply_unchecked(A const& a, X const& x, Y& y, W& w) {
  if constexpr (requires { a.apply(x, y, w); }) {
    a.apply(x, y, w);
  } else {
    a.apply(x, y);
  }
}
template <class A, class S, class X, class Y, class W>
void apply_add_unchecked(A const& a, S const& α, X const& x, Y& y, W& w) {
  if constexpr (requires { a.apply_add(α, x, y, w); }) {
    a.apply_add(α, x, y, w);
  } else {
    a.apply_add(α, x, y);
  }
}

/// An operator that adds something to one that it holds, which is what is printed.
template <class A> concept decorates = requires { requires A::is_decorator; };

template <class A>
inline constexpr bool is_letter = false;

template <class A>
void enter_part(A const& a, dictionary& names) {
  if constexpr (requires { a.enter(names); }) {
    a.enter(names);
  } else if constexpr (decorates<A>) {
    expr::enter_part(a.get(), names);
  }
}
/// An operator without a name: a formula in parentheses, else its symbol. `marked`: ᵀ or ⁻¹ follows.
template <class A>
void print_nameless(A const& a, bool marked, std::string& out) {
  if constexpr (decorates<A>) {
    expr::print_nameless(a.get(), marked, out);
  } else if constexpr (requires { a.print(out); }) {
    bool is_bare = false;
    if constexpr (is_letter<A>) is_bare = !(marked && A::is_marked);
    if (!is_bare) out += "(";
    a.print(out);
    if (!is_bare) out += ")";
  } else {
    out += symbol_of<A>();
  }
}
template <class A>
constexpr void spell_nameless(bool in_call, ascii& out) {
  if constexpr (decorates<A>) {
    expr::spell_nameless<std::remove_cvref_t<decltype(std::declval<A const&>().get())>>(in_call,
                                                                                        out);
  } else if constexpr (requires { A::spell(out); }) {
    bool const is_bare = in_call || is_letter<A>;
    if (!is_bare) out.add("(");
    A::spell(out);
    if (!is_bare) out.add(")");
  } else {
    out.add(symbol_of<A>());
  }
}
template <class A>
void print_part(A const& a, std::string& out) {
  if constexpr (requires { a.print(out); }) {
    a.print(out);
  } else {
    expr::print_nameless(a, false, out);
  }
}
template <class A>
constexpr void spell_part(ascii& out) {
  if constexpr (requires { A::spell(out); }) {
    A::spell(out);
  } else {
    expr::spell_nameless<A>(false, out);
  }
}

// --- letters -------------------------------------------------------------------------------------

/// A handle of an object passed as T&&: lvalues are referenced, rvalues owned.
template <class T>
[[nodiscard]] auto handle_of(T&& object) {
  using U = std::remove_cvref_t<T>;
  if constexpr (std::is_lvalue_reference_v<T>) {
    return std::shared_ptr<U const>(std::shared_ptr<void>(), std::addressof(object));
  } else {
    return std::make_shared<U const>(std::forward<T>(object));
  }
}

/// The object itself: a matrix that is referenced, whatever wrapped it.
template <class A>
[[nodiscard]] void const* identity_of(A const& a) {
  return std::addressof(a);
}
template <class M, law_set L>
[[nodiscard]] void const* identity_of(matrix_operator<M, L> const& a) {
  return std::addressof(a.get());
}

/// What a letter applies: A, or A⁻¹, which is made once and shared.
template <class A, bool Inverted>
struct applied_part {
  using type = A;
  explicit applied_part(A const&) {}
  [[nodiscard]] A const& get(A const& a) const noexcept { return a; }
};
template <class A>
struct applied_part<A, true> {
  using type = std::remove_cvref_t<decltype(std::declval<A const&>().inverse())>;
  explicit applied_part(A const& a) : inverse(std::make_shared<type const>(a.inverse())) {}
  [[nodiscard]] type const& get(A const&) const noexcept { return *inverse; }
  std::shared_ptr<type const> inverse;
};
template <slant::detail::factorization_like F>
struct applied_part<F, true> {
  using type = inverse_operator<F const&>;
  explicit applied_part(F const& f) : inverse(held<F const&>(f)) {}
  [[nodiscard]] type const& get(F const&) const noexcept { return inverse; }
  type inverse;
};

template <class A>
concept has_known_inverse =
    slant::detail::factorization_like<A> || slant::detail::knows_its_inverse<A>;

/// A, Aᵀ, A⁻¹ or A⁻ᵀ.
template <auto Name, class A, unsigned Flags>
class letter : public expression_base {
  static constexpr bool is_inverse = (Flags & inverted) != 0;
  static constexpr bool is_adjoint = (Flags & adjointed) != 0;
  using part = applied_part<A, is_inverse>;
  using target = typename part::type;

 public:
  static constexpr law_set laws =
      laws_of<target> | slant::detail::inverse_laws(laws_of<A>).when(is_inverse);
  /// Of what is applied. An operator with inverse() is regular; K⁺ of a singular K is none.
  static constexpr bool full_row_rank =
      laws.contains(law::positive_definite) ||
      (is_inverse ? !slant::detail::factorization_like<A>
                  : !is_adjoint && declares_full_row_rank<A>) ||
      (Flags & (is_adjoint ? independent_columns : independent_rows)) != 0;
  /// It is printed with ᵀ or ⁻¹.
  static constexpr bool is_marked = is_adjoint || is_inverse;

  explicit letter(std::shared_ptr<A const> object) : letter(object, part(*object)) {}
  /// Of an operator that is referenced.
  explicit letter(A const& object) : letter(expr::handle_of(object)) {}
  /// With what is applied made already.
  letter(std::shared_ptr<A const> object, part applied)
      : object_(std::move(object)), part_(std::move(applied)) {}

  /// What is applied, or whose adjoint is.
  [[nodiscard]] target const& get() const noexcept { return part_.get(*object_); }
  /// What bears the name.
  [[nodiscard]] std::shared_ptr<A const> const& object() const noexcept { return object_; }
  /// The address by which it is known.
  [[nodiscard]] void const* origin() const { return identity_of(*object_); }

  [[nodiscard]] index rows() const { return is_adjoint ? get().cols() : get().rows(); }
  [[nodiscard]] index cols() const { return is_adjoint ? get().rows() : get().cols(); }

  template <class X>
    requires(is_adjoint ? has_adjoint<target, plain_t<X>> : linear_operator<target, plain_t<X>>)
  [[nodiscard]] auto workspace(X const& x) const {
    return slant::detail::oriented_workspace<is_adjoint>(get(), x);
  }
  template <class X, class Y, class W>
    requires(is_adjoint ? slant::detail::applies_adjoint<target, X, Y>
                        : slant::detail::applies<target, X, Y>)
  void apply(X const& x, Y& y, W& w) const {
    run<is_adjoint>(x, y, w);
  }
  template <class X, class Y, class W>
    requires(is_adjoint ? slant::detail::accumulates_adjoint<target, X, Y>
                        : slant::detail::accumulates<target, X, Y>)
  void apply_add(scalar_t<X> α, X const& x, Y& y, W& w) const {
    slant::detail::apply_add_oriented<is_adjoint>(get(), α, x, y, w);
  }

  template <class X>
    requires(is_adjoint ? linear_operator<target, plain_t<X>> : has_adjoint<target, plain_t<X>>)
  [[nodiscard]] auto adjoint_workspace(X const& x) const {
    return slant::detail::oriented_workspace<!is_adjoint>(get(), x);
  }
  template <class X, class Y, class W>
    requires(is_adjoint ? slant::detail::applies<target, X, Y>
                        : slant::detail::applies_adjoint<target, X, Y>)
  void apply_adjoint(X const& x, Y& y, W& w) const {
    run<!is_adjoint>(x, y, w);
  }
  template <class X, class Y, class W>
    requires(is_adjoint ? slant::detail::accumulates<target, X, Y>
                        : slant::detail::accumulates_adjoint<target, X, Y>)
  void apply_adjoint_add(scalar_t<X> α, X const& x, Y& y, W& w) const {
    slant::detail::apply_add_oriented<!is_adjoint>(get(), α, x, y, w);
  }

  template <class D>
    requires has_diagonal<target, D>
  void diagonal(D& d) const {
    get().diagonal(d);
  }
  template <class D>
    requires(may_have_diagonal<target, D> && !has_diagonal<target, D>)
  [[nodiscard]] bool diagonal_if_known(D& d) const {
    return get().diagonal_if_known(d);
  }
  /// The rounded twin, which bears no name.
  [[nodiscard]] auto rounded() const
    requires(!is_adjoint && requires(target const& a) { a.rounded(); })
  {
    return get().rounded();
  }
  template <class Y>
    requires(is_adjoint ? has_adjoint<target, plain_t<Y>> : has_columns<target, Y>)
  void columns(index first, Y& y) const {
    if constexpr (is_adjoint) {
      slant::apply_adjoint(get(), slant::detail::unit_columns(y, cols(), first), y);
    } else {
      get().columns(first, y);
    }
  }
  /// A x as a view of x, where A is a choice of neighbouring components.
  template <class X>
    requires(!is_adjoint && slant::detail::shows_segment<target, X>)
  [[nodiscard]] auto segment(X const& x) const {
    return get().segment(x);
  }

  /// Aᵀ; A itself if it is self-adjoint.
  [[nodiscard]] auto adjoint() const {
    if constexpr (laws.contains(law::self_adjoint)) {
      return *this;
    } else {
      return letter<Name, A, Flags ^ adjointed>(object_, part_);
    }
  }
  /// A⁻¹; (A⁻¹)⁻¹ is A.
  [[nodiscard]] auto inverse() const
    requires(is_inverse || has_known_inverse<A>)
  {
    return letter<Name, A, Flags ^ inverted>(object_);
  }
  /// The same with the assertion that the rows of what this letter stands for are independent.
  [[nodiscard]] auto with_full_row_rank() const {
    constexpr unsigned assertion = is_adjoint ? independent_columns : independent_rows;
    return letter<Name, A, Flags | assertion>(object_, part_);
  }

  void enter(dictionary& names) const {
    if constexpr (text_of(Name).empty()) {
      expr::enter_part(*object_, names);
    } else {
      names.enter(text_of(Name), origin());
    }
  }
  void print(std::string& out) const {
    if constexpr (text_of(Name).empty()) {
      expr::print_nameless(*object_, is_marked, out);
    } else {
      out += text_of(Name);
    }
    out += is_inverse ? (is_adjoint ? "⁻ᵀ" : "⁻¹") : (is_adjoint ? "ᵀ" : "");
  }
  static constexpr void spell(ascii& out) {
    if (is_adjoint) out.add("adjoint(");
    if (is_inverse) out.add("inverse(");
    if constexpr (text_of(Name).empty()) {
      expr::spell_nameless<A>(is_marked, out);
    } else {
      out.add(text_of(Name));
    }
    if (is_inverse) out.add(")");
    if (is_adjoint) out.add(")");
  }

 private:
  // Sizes were checked by whoever applies the expression, and letters before and after this one fit.
  template <bool Adjoint, class X, class Y, class W>
  void run(X const& x, Y& y, W& w) const {
    auto const& a = get();
    if constexpr (!Adjoint) {
      expr::apply_unchecked(a, x, y, w);
    } else if constexpr (requires { a.apply_adjoint(x, y, w); }) {
      a.apply_adjoint(x, y, w);
    } else if constexpr (requires { a.apply_adjoint(x, y); }) {
      a.apply_adjoint(x, y);
    } else {
      run<false>(x, y, w);
    }
  }

  std::shared_ptr<A const> object_;
  [[no_unique_address]] part part_;
};

/// A factorisation under a name: no operator, but its inverse is one.
template <auto Name, class F>
class factored : public handle_base {
 public:
  static constexpr law_set laws = laws_of<F>;

  explicit factored(std::shared_ptr<F const> factors) : factors_(std::move(factors)) {}

  [[nodiscard]] index rows() const { return factors_->rows(); }
  [[nodiscard]] auto inverse() const { return letter<Name, F, inverted>(factors_); }
  /// The factorisation.
  [[nodiscard]] F const& get() const noexcept { return *factors_; }

 private:
  std::shared_ptr<F const> factors_;
};

/// (K⁻¹)⁻¹ of a factorisation is that factorisation again.
template <auto Name, slant::detail::factorization_like F, unsigned Flags>
  requires((Flags & inverted) == 0)
class letter<Name, F, Flags> : public factored<Name, F> {
  using factored<Name, F>::factored;
};

template <auto Name, class A, unsigned Flags>
inline constexpr bool is_letter<letter<Name, A, Flags>> = true;

/// A letter that bears a name in turn is one operator under both.
template <auto Name, class A, unsigned Flags>
  requires((Flags & (adjointed | inverted)) == 0)
[[nodiscard]] void const* identity_of(letter<Name, A, Flags> const& a) {
  return a.origin();
}

template <auto Name, class A>
[[nodiscard]] auto make_letter(A&& a) {
  using U = std::remove_cvref_t<A>;
  if constexpr (slant::detail::factorization_like<U>) {
    return factored<Name, U>(handle_of(std::forward<A>(a)));
  } else if constexpr (eigen_matrix<A>) {
    return expr::make_letter<Name>(slant::matrix(std::forward<A>(a)));
  } else {
    return letter<Name, U, 0>(handle_of(std::forward<A>(a)));
  }
}

}  // namespace expr

/// What can have a name: an operator, an Eigen matrix, a factorisation.
template <class A>
concept can_be_named = operand<A> || detail::factorization_like<std::remove_cvref_t<A>>;

/// The operator a under a name, which is printed and by which the compiler knows it. An lvalue is
/// referenced. Laws of a matrix are asserted by the caller: op<"K", self_adjoint>(Km).
template <expr::text Name, law... L, can_be_named A>
[[nodiscard]] auto op(A&& a) {
  if constexpr (sizeof...(L) > 0) {
    return expr::make_letter<Name>(slant::matrix<L...>(std::forward<A>(a)));
  } else {
    return expr::make_letter<Name>(std::forward<A>(a));
  }
}

/// The operator a, known to the compiler by the place of this call; for local use. (A class in a
/// header that keeps such a letter has another type in each file: there a name is due.)
template <class Place = decltype([] {}), can_be_named A>
[[nodiscard]] auto op(A&& a) {
  return expr::make_letter<expr::place<Place>{}>(std::forward<A>(a));
}

namespace expr {

/// Expressions are copied, which copies handles, and so is an identity; everything else becomes a
/// letter without a name.
template <operand A>
[[nodiscard]] decltype(auto) as_expression(A&& a) {
  if constexpr (expression<A>) {
    return std::forward<A>(a);
  } else if constexpr (std::is_same_v<std::remove_cvref_t<A>, identity_operator>) {
    return expr::make_letter<nameless{}>(identity_operator(a));
  } else {
    return expr::make_letter<nameless{}>(std::forward<A>(a));
  }
}

/// Aᵀ by reference, for as long as A lives.
template <class A>
using adjoint_view = letter<nameless{}, A, adjointed>;

/// A or its adjoint_view.
template <bool Adjoint, class A>
using oriented_t = std::conditional_t<Adjoint, adjoint_view<A>, A>;
template <bool Adjoint, class A>
[[nodiscard]] decltype(auto) oriented(A const& a) {
  if constexpr (Adjoint) {
    return adjoint_view<A>(a);
  } else {
    return (a);
  }
}

/// The operator that a letter stands for; anything else itself.
template <class A>
[[nodiscard]] A const& operator_behind(A const& a) noexcept {
  return a;
}
template <auto Name, class A>
[[nodiscard]] A const& operator_behind(letter<Name, A, 0> const& a) noexcept {
  return a.get();
}

}  // namespace expr

/// Aᵀ; of an operator that knows its adjoint, such as an expression, what it says.
template <adjoint_operand A>
[[nodiscard]] auto adjoint(A&& a) {
  if constexpr (!eigen_matrix<A> && requires { a.adjoint(); }) {
    return a.adjoint();
  } else {
    return expr::as_expression(std::forward<A>(a)).adjoint();
  }
}

/// The same operator as one that is the same as no other.
template <auto Name, class A, unsigned Flags>
[[nodiscard]] auto distinct(expr::letter<Name, A, Flags> const& a) {
  return expr::letter<expr::nameless{}, A, Flags>(a.object());
}

}  // namespace slant

namespace slant::detail {

/// The matrix that an operator is, perhaps behind the reference that a linear function hands out.
template <class G>
struct matrix_behind {
  static constexpr bool exists = false;
  static constexpr bool sparse = false;
};
template <class M, law_set L>
struct matrix_behind<matrix_operator<M, L>> {
  static constexpr bool exists = true;
  static constexpr bool sparse = is_sparse_matrix<M>;
  static auto const& of(matrix_operator<M, L> const& g) { return g.get(); }
};
template <auto Name, class A>
struct matrix_behind<expr::letter<Name, A, 0>> : matrix_behind<A> {
  static auto const& of(expr::letter<Name, A, 0> const& g) { return matrix_behind<A>::of(g.get()); }
};

}  // namespace slant::detail
