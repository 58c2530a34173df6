// SPDX-License-Identifier: MIT
//
// A product c F₁ F₂ … F_n: a number and one flat sequence of factors, which are letters and sums.
// y = c F₁ (F₂ (… (F_n x))) with one temporary between two factors. Laws: factors.hpp.
//
//     (A B) C, A (B C)      one flat sequence
//     (c A) (d B)           (c d) A B
//     A I, I A              A
//     (A B)ᵀ, (A B)⁻¹       reverse and transform
//     D₁ D₂                 one diagonal with entries of its own, of those without a name
//
// product(A, B), scaled(c, A) are A * B, c * A under the names that generic code looks for.
// congruence(B, A) is B * A * adjoint(B) whether B has a name or not.
#pragma once

#include <slant/base/diagnosis.hpp>
#include <slant/operators/diagonal.hpp>
#include <slant/operators/factors.hpp>

#include <boost/hana/at.hpp>
#include <boost/hana/back.hpp>
#include <boost/hana/concat.hpp>
#include <boost/hana/drop_back.hpp>
#include <boost/hana/drop_front.hpp>
#include <boost/hana/front.hpp>
#include <boost/hana/reverse.hpp>
#include <boost/hana/transform.hpp>
#include <boost/hana/tuple.hpp>
#include <boost/hana/unpack.hpp>

#include <array>
#include <string>

namespace slant::expr {

namespace hana = boost::hana;

template <class V, std::size_t N, class Inner>
struct product_workspace {
  std::array<V, N - 1> between;  ///< between[k] = F_{k+2} … F_n x, of the adjoint F_{k+1}ᵀ … F₁ᵀ x
  Inner inner;                   ///< a workspace for each factor
};
template <class V, class Inner>
struct product_workspace<V, 1, Inner> {
  Inner inner;
};

/// The product with the factors F and a number in front; one factor without a number is itself.
template <class C, class... F>
[[nodiscard]] auto make_product(C const& c, hana::tuple<F...> factors) {
  if constexpr (sizeof...(F) == 1 && std::is_same_v<C, one>) {
    return hana::at_c<0>(std::move(factors));
  } else {
    return product<C, F...>(c, std::move(factors));
  }
}

template <class C, class... F>
class product : public base_of_node<F...> {
  static constexpr std::size_t n = sizeof...(F);
  static constexpr bool has_number = !std::is_same_v<C, one>;
  using first = nth<0, F...>;
  using last = nth<n - 1, F...>;

  /// F_n x is handed on as a view of x, to a factor that takes one.
  template <class X>
  static constexpr bool no_copy = [] {
    if constexpr (n > 1 && slant::detail::shows_segment<last, X>) {
      return slant::detail::takes_segments<nth<n - 2, F...>, X>;
    } else {
      return false;
    }
  }();

 public:
  /// Without the number.
  static constexpr law_set core_laws = product_laws<F...>();
  static constexpr law_set laws =
      has_number ? slant::detail::scaled_laws(core_laws, sign_of<C> == sign::plus) : core_laws;
  static constexpr bool full_row_rank = !has_number && (declares_full_row_rank<F> && ...);

  /// Throws bad_input if sizes do not fit, names stand for two objects, or the number has not the
  /// sign that the laws need.
  product(C c, hana::tuple<F...> factors) : c_(std::move(c)), factors_(std::move(factors)) {
    dictionary names;
    if constexpr (n > 1) enter(names);
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      expr::require_same_letters((expr::same_letters(factor<I>(), factor<n - 1 - I>()) && ...));
    }(std::make_index_sequence < n == 1 ? 0 : mirrored_pairs<F...>() > {});
    if constexpr (laws.contains(law::positive_semidefinite)) {
      expr::require_sign(c_, laws.contains(law::positive_definite));
    }
  }

  [[nodiscard]] C const& coefficient() const noexcept { return c_; }
  [[nodiscard]] C& coefficient() noexcept { return c_; }
  [[nodiscard]] hana::tuple<F...> const& factors() const noexcept { return factors_; }
  template <std::size_t I>
  [[nodiscard]] auto const& factor() const noexcept {
    return hana::at_c<I>(factors_);
  }
  template <std::size_t I>
  [[nodiscard]] auto& factor() noexcept {
    return hana::at_c<I>(factors_);
  }

  [[nodiscard]] index rows() const { return factor<0>().rows(); }
  [[nodiscard]] index cols() const { return factor<n - 1>().cols(); }

  template <class X>
    requires(linear_operator<F, plain_t<X>> && ...)
  [[nodiscard]] auto workspace(X const& x) const {
    return make_workspace<false>(x);
  }
  template <class X, class Y, class W>
    requires(linear_operator<F, plain_t<X>> && ...) &&
            slant::detail::applies<last, X, plain_t<X>> &&
            slant::detail::applies<first, plain_t<X>, Y>
  void apply(X const& x, Y& y, W& w) const {
    apply_core(x, y, w);
    scale(y);
  }
  /// y = F₁ … F_n x, without the number.
  template <class X, class Y, class W>
  void apply_core(X const& x, Y& y, W& w) const {
    from_the_right(
        x, w, [&](auto const& z, auto& inner) { expr::apply_unchecked(factor<0>(), z, y, inner); });
  }
  template <class X, class Y, class W>
    requires(linear_operator<F, plain_t<X>> && ...) &&
            slant::detail::applies<last, X, plain_t<X>> &&
            slant::detail::accumulates<first, plain_t<X>, Y>
  void apply_add(scalar_t<X> α, X const& x, Y& y, W& w) const {
    scalar_t<X> const c = times(α);
    from_the_right(x, w, [&](auto const& z, auto& inner) {
      expr::apply_add_unchecked(factor<0>(), c, z, y, inner);
    });
  }

  template <class X>
    requires(has_adjoint<F, plain_t<X>> && ...)
  [[nodiscard]] auto adjoint_workspace(X const& x) const {
    return make_workspace<true>(x);
  }
  template <class X, class Y, class W>
    requires(has_adjoint<F, plain_t<X>> && ...) &&
            slant::detail::applies_adjoint<first, X, plain_t<X>> &&
            slant::detail::applies_adjoint<last, plain_t<X>, Y>
  void apply_adjoint(X const& x, Y& y, W& w) const {
    from_the_left<0>(x, w, [&](auto const& z, auto& inner) {
      slant::apply_adjoint(factor<n - 1>(), z, y, inner);
    });
    scale(y);
  }
  template <class X, class Y, class W>
    requires(has_adjoint<F, plain_t<X>> && ...) &&
            slant::detail::applies_adjoint<first, X, plain_t<X>> &&
            slant::detail::accumulates_adjoint<last, plain_t<X>, Y>
  void apply_adjoint_add(scalar_t<X> α, X const& x, Y& y, W& w) const {
    scalar_t<X> const c = times(α);
    from_the_left<0>(x, w, [&](auto const& z, auto& inner) {
      slant::apply_adjoint_add(factor<n - 1>(), c, z, y, inner);
    });
  }

  template <class D>
    requires(n == 1 && has_diagonal<first, D>)
  void diagonal(D& d) const {
    factor<0>().diagonal(d);
    scale(d);
  }
  template <class Y>
    requires has_columns<last, plain_t<Y>> && (applies_to_many<F, plain_t<Y>> && ...)
  void columns(index first_column, Y& y) const {
    if constexpr (n == 1) {
      factor<0>().columns(first_column, y);
    } else {
      auto z = slant::like(y, factor<n - 1>().rows());
      factor<n - 1>().columns(first_column, z);
      multiply_from<n - 2>(z, y);
    }
    scale(y);
  }

  /// Reverse and transform.
  [[nodiscard]] auto adjoint() const
    requires(expression<F> && ...)
  {
    if constexpr (laws.contains(law::self_adjoint)) {
      return *this;
    } else {
      return expr::make_product(
          c_, hana::transform(hana::reverse(factors_), [](auto const& f) { return f.adjoint(); }));
    }
  }
  [[nodiscard]] auto inverse() const
    requires(slant::detail::knows_its_inverse<F> && ...)
  {
    return expr::make_product(
        expr::reciprocal_number(c_),
        hana::transform(hana::reverse(factors_), [](auto const& f) { return f.inverse(); }));
  }

  void enter(dictionary& names) const {
    hana::unpack(factors_, [&](auto const&... f) { (expr::enter_part(f, names), ...); });
  }
  void print(std::string& out) const {
    out += expr::text_in_front(c_);
    print_core(out);
  }
  /// Without the number; in parentheses sums, and products with a number that stand behind others.
  void print_core(std::string& out) const {
    bool next = false;
    auto const print_factor = [&]<class G>(G const& g) {
      bool const closed = is_sum<G> || (starts_with_number<G> && (next || has_number));
      if (next) out += " ";
      if (closed) out += "(";
      expr::print_part(g, out);
      if (closed) out += ")";
      next = true;
    };
    hana::unpack(factors_, [&](auto const&... f) { (print_factor(f), ...); });
  }
  static constexpr void spell(ascii& out) {
    if (sign_of<C> == sign::minus) out.add("-");
    bool next = !std::is_empty_v<C>;
    if (next) out.add("c");
    (((next ? out.add(" * ") : out), spell_factor<F>(out, next || has_number), next = true), ...);
  }

 private:
  template <class G>
  static constexpr void spell_factor(ascii& out, bool next) {
    bool const closed = is_sum<G> || (starts_with_number<G> && next);
    if (closed) out.add("(");
    expr::spell_part<G>(out);
    if (closed) out.add(")");
  }

  template <class Y>
  void scale(Y& y) const {
    if constexpr (has_number) vectors::scale(expr::value_as<scalar_t<Y>>(c_), y);
  }
  template <class S>
  [[nodiscard]] S times(S const& α) const {
    if constexpr (has_number) {
      return S(α * expr::value_as<S>(c_));
    } else {
      return α;
    }
  }

  template <bool Adjoint, class X>
  [[nodiscard]] auto make_workspace(X const& x) const {
    // The argument of factor J (of its adjoint) has the size of its columns (rows).
    auto const part = [&]<std::size_t J>() {
      auto const& f = factor<J>();
      if constexpr (J == (Adjoint ? 0 : n - 1)) {
        return slant::detail::oriented_workspace<Adjoint>(f, x);
      } else {
        return slant::detail::oriented_workspace<Adjoint>(
            f, slant::like(x, Adjoint ? f.rows() : f.cols()));
      }
    };
    return [&]<std::size_t... I, std::size_t... B>(std::index_sequence<I...>,
                                                   std::index_sequence<B...>) {
      auto inner = hana::make_tuple(part.template operator()<I>()...);
      using workspace_type = product_workspace<plain_t<X>, n, decltype(inner)>;
      if constexpr (n == 1) {
        return workspace_type{std::move(inner)};
      } else {
        return workspace_type{{slant::like(x, factor<B>().cols())...}, std::move(inner)};
      }
    }(std::make_index_sequence<n>{}, std::make_index_sequence<n - 1>{});
  }

  /// y = F₁ … F_K z of many columns.
  template <std::size_t K, class Z, class Y>
  void multiply_from(Z const& z, Y& y) const {
    if constexpr (K == 0) {
      slant::apply(factor<0>(), z, y);
    } else {
      auto next = slant::like(z, factor<K>().rows());
      slant::apply(factor<K>(), z, next);
      multiply_from<K - 1>(next, y);
    }
  }

  /// finish(F₂ … F_n x, workspace of F₁).
  template <class X, class W, class Finish>
  void from_the_right(X const& x, W& w, Finish const& finish) const {
    if constexpr (no_copy<X>) {
      auto const segment = factor<n - 1>().segment(x);
      down_from<n - 2>(segment, w, finish);
    } else {
      down_from<n - 1>(x, w, finish);
    }
  }
  template <std::size_t K, class X, class W, class Finish>
  void down_from(X const& x, W& w, Finish const& finish) const {
    if constexpr (K == 0) {
      finish(x, hana::at_c<0>(w.inner));
    } else {
      expr::apply_unchecked(factor<K>(), x, w.between[K - 1], hana::at_c<K>(w.inner));
      down_from<K - 1>(w.between[K - 1], w, finish);
    }
  }
  /// finish(F_{n−1}ᵀ … F₁ᵀ x, workspace of F_nᵀ).
  template <std::size_t K, class X, class W, class Finish>
  void from_the_left(X const& x, W& w, Finish const& finish) const {
    if constexpr (K == n - 1) {
      finish(x, hana::at_c<K>(w.inner));
    } else {
      slant::apply_adjoint(factor<K>(), x, w.between[K], hana::at_c<K>(w.inner));
      from_the_left<K + 1>(w.between[K], w, finish);
    }
  }

  [[no_unique_address]] C c_;
  hana::tuple<F...> factors_;
};

// --- A B -----------------------------------------------------------------------------------------

/// The number in front of an expression.
template <class A>
[[nodiscard]] auto coefficient_of(A const& a) {
  if constexpr (is_product<A>) {
    return a.coefficient();
  } else {
    return one{};
  }
}
/// Its factors.
template <class A>
[[nodiscard]] auto factors_of(A const& a) {
  if constexpr (is_product<A>) {
    return a.factors();
  } else {
    return hana::tuple<A>(a);
  }
}

template <class A>
inline constexpr bool is_identity = false;
template <auto Name, unsigned Flags>
inline constexpr bool is_identity<letter<Name, identity_operator, Flags>> = true;

template <class A>
inline constexpr bool is_plain_diagonal = false;
template <class D, law_set L>
inline constexpr bool is_plain_diagonal<letter<nameless{}, diagonal_operator<D, L>, 0>> = true;

/// The product of two diagonals. Its laws are checked again: a product of entries may underflow.
template <auto Name, class D, law_set L, class E, law_set M>
[[nodiscard]] auto merge_diagonals(letter<Name, diagonal_operator<D, L>, 0> const& a,
                                   letter<Name, diagonal_operator<E, M>, 0> const& b) {
  using entries = plain_t<std::remove_cvref_t<decltype(a.get().entries())>>;
  entries d = a.get().entries().cwiseProduct(b.get().entries());
  slant::detail::require_diagonal_laws<(L & M)>(d);
  return expr::make_letter<Name>(diagonal_operator<entries, (L & M)>(held<entries>(std::move(d))));
}

/// The factors F followed by G: identities vanish, neighbouring diagonals become one.
template <class... F, class... G>
[[nodiscard]] auto join_factors(hana::tuple<F...> f, hana::tuple<G...> g) {
  using left = nth<sizeof...(F) - 1, F...>;
  using right = nth<0, G...>;
  if constexpr (is_identity<left>) {
    return hana::concat(hana::drop_back(std::move(f)), std::move(g));
  } else if constexpr (is_identity<right>) {
    return hana::concat(std::move(f), hana::drop_front(std::move(g)));
  } else if constexpr (is_plain_diagonal<left> && is_plain_diagonal<right>) {
    return hana::concat(hana::concat(hana::drop_back(f), hana::make_tuple(expr::merge_diagonals(
                                                             hana::back(f), hana::front(g)))),
                        hana::drop_front(g));
  } else {
    return hana::concat(std::move(f), std::move(g));
  }
}

/// An operand as a refusal shows it.
struct shown_operand {
  std::string text;
  index rows;
  index cols;
};
[[noreturn, gnu::cold]] inline void refuse_sizes(shown_operand const& a, shown_operand const& b,
                                                 bool term) {
  using slant::detail::size_text;
  throw bad_input(b.text, size_text(b.rows, b.cols),
                  term ? size_text(a.rows, a.cols) + " (the size of " + a.text + ")"
                       : std::to_string(a.cols) + " rows (the columns of " + a.text + ")");
}
/// Of two expressions whose sizes do not fit.
template <class A, class B>
[[noreturn, gnu::cold]] void refuse_sizes(A const& a, B const& b, bool term) {
  shown_operand left{{}, a.rows(), a.cols()};
  shown_operand right{{}, b.rows(), b.cols()};
  a.print(left.text);
  b.print(right.text);
  expr::refuse_sizes(left, right, term);
}

/// A B C ….
template <class A, class B, class... C>
[[nodiscard]] auto product_of(A const& a, B const& b, C const&... c) {
  if (b.rows() != a.cols()) expr::refuse_sizes(a, b, false);
  auto p =
      expr::make_product(expr::multiply_numbers(expr::coefficient_of(a), expr::coefficient_of(b)),
                         expr::join_factors(expr::factors_of(a), expr::factors_of(b)));
  if constexpr (sizeof...(C) > 0) {
    return expr::product_of(p, c...);
  } else {
    return p;
  }
}
/// c A.
template <class C, class A>
[[nodiscard]] auto multiple_of(C const& c, A const& a) {
  return expr::make_product(expr::multiply_numbers(c, expr::coefficient_of(a)),
                            expr::factors_of(a));
}
/// −A.
template <class A>
[[nodiscard]] auto negative_of(A const& a) {
  return expr::make_product(expr::negative_number(expr::coefficient_of(a)), expr::factors_of(a));
}

// --- B A Bᵀ --------------------------------------------------------------------------------------

template <class A>
inline constexpr bool is_twin = false;
template <class A, unsigned Flags>
inline constexpr bool is_twin<letter<twin{}, A, Flags>> = true;

/// A product that is taken apart by nobody: what its letters are to each other was settled when it
/// was made.
template <class P>
class sealed : public P {
 public:
  explicit sealed(P p) : P(std::move(p)) {}

  [[nodiscard]] auto adjoint() const {
    if constexpr (P::laws.contains(law::self_adjoint)) {
      return *this;
    } else {
      return sealed<decltype(P::adjoint())>(P::adjoint());
    }
  }
  [[nodiscard]] auto inverse() const
    requires slant::detail::knows_its_inverse<P>
  {
    return sealed<decltype(P::inverse())>(P::inverse());
  }
};

/// B as what stands at both ends of a congruence: itself if its letters have names.
template <adjoint_operand B>
[[nodiscard]] decltype(auto) as_twin(B&& b) {
  if constexpr (expression<B>) {
    using U = std::remove_cvref_t<B>;
    if constexpr (mirrors<U, decltype(b.adjoint())>) {
      return std::forward<B>(b);
    } else {
      return expr::make_letter<twin{}>(U(std::forward<B>(b)));
    }
  } else {
    return expr::make_letter<twin{}>(std::forward<B>(b));
  }
}

/// B A Bᵀ.
template <class A, class B>
[[nodiscard]] auto multiply_around(A const& a, B const& b) {
  auto p = expr::product_of(b, a, b.adjoint());
  if constexpr (is_twin<B> && !is_identity<B>) {
    return sealed<decltype(p)>(std::move(p));
  } else {
    return p;
  }
}

}  // namespace slant::expr

namespace slant {

namespace detail {

/// One complaint per part that is no operator; a fold over the parts would only say that one is not.
template <class A>
void check_part_of_formula() {
  static_assert(operand<A>, "a term or factor must be an operator or an Eigen matrix");
}

}  // namespace detail

/// A B C …. @throws bad_input unless each has as many rows as the one before it has columns.
template <class A, class... B>
  requires(sizeof...(B) >= 1)
[[nodiscard]] auto product(A&& a, B&&... b) {
  if constexpr (!(operand<A> && ... && operand<B>)) {
    (detail::check_part_of_formula<A>(), ..., detail::check_part_of_formula<B>());
    return detail::stand_in{};
  } else {
    char name = 'A';
    index cols = a.cols();
    auto const check = [&](auto const& factor) {
      if (index(factor.rows()) != cols) {
        detail::require_rows(std::string(1, static_cast<char>(name + 1)), factor, cols,
                             std::string("the columns of ") + name);
      }
      ++name;
      cols = factor.cols();
    };
    (check(b), ...);
    return expr::product_of(expr::as_expression(std::forward<A>(a)),
                            expr::as_expression(std::forward<B>(b))...);
  }
}

/// B A Bᵀ: self-adjoint and semidefinite if A is; definite if A is and B declares full_row_rank.
/// @throws bad_input unless A is square with as many rows as B has columns.
template <operand B, operand A>
[[nodiscard]] auto congruence(B&& b, A&& a) {
  if constexpr (!adjoint_operand<B>) {
    static_assert(adjoint_operand<B>, "congruence: B must have apply_adjoint(x, y)");
    return detail::stand_in{};
  } else {
    detail::require_square("A", a);
    detail::require_cols("B", b, a.rows(), "the size of A");
    return expr::multiply_around(expr::as_expression(std::forward<A>(a)),
                                 expr::as_twin(std::forward<B>(b)));
  }
}

/// c A, as c * A. @throws bad_input if c is NaN or infinite, or has not the sign that the laws of A
/// need.
template <class C, operand A>
  requires expr::number_in_front<C>
[[nodiscard]] auto scaled(C const& c, A&& a) {
  return expr::multiple_of(expr::as_number(c), expr::as_expression(std::forward<A>(a)));
}

}  // namespace slant
