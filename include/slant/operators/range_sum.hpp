// SPDX-License-Identifier: MIT
//
// A₁ + … + A_p with as many terms as there are when the program runs, all of one type: the bodies or
// subdomains of a problem. Terms of different types, known when it is compiled, are sum(A, B, …).
//
// Closure: self-adjoint, semidefinite, definite if the type is.
#pragma once

#include <slant/base/vector_algebra.hpp>
#include <slant/operators/composition.hpp>
#include <slant/operators/matrix.hpp>

#include <ranges>
#include <string>
#include <utility>
#include <vector>

namespace slant {

/// y = A₁x + … + A_p x, p ≥ 1. A is `Operator const&` (referenced) or an operator type (owned).
template <class A>
class range_sum_operator {
  using part = std::remove_cvref_t<A>;

 public:
  static constexpr law_set laws = detail::sum_laws({laws_of<A>});

  /// All terms have the same size and there is one; slant::sum checks it.
  explicit range_sum_operator(std::vector<held<A>> terms) : terms_(std::move(terms)) {}

  [[nodiscard]] index rows() const { return terms_.front().get().rows(); }
  [[nodiscard]] index cols() const { return terms_.front().get().cols(); }
  [[nodiscard]] part const& term(index i) const {
    return terms_[static_cast<std::size_t>(i)].get();
  }

  [[nodiscard]] auto workspace(detail::accepted_by<part> auto const& x) const {
    return workspaces<false>(x);
  }
  template <class X, class Y, class W>
    requires detail::adds<part, X, Y>
  void apply(X const& x, Y& y, W& w) const {
    vectors::set_zero(y);
    add<false>(scalar_t<X>(1), x, y, w);
  }
  template <class X, class Y, class W>
    requires detail::adds<part, X, Y>
  void apply_add(scalar_t<X> α, X const& x, Y& y, W& w) const {
    add<false>(α, x, y, w);
  }

  [[nodiscard]] auto adjoint_workspace(detail::accepted_by_adjoint_of<part> auto const& x) const {
    return workspaces<true>(x);
  }
  template <class X, class Y, class W>
    requires detail::adds_adjoint<part, X, Y>
  void apply_adjoint(X const& x, Y& y, W& w) const {
    vectors::set_zero(y);
    add<true>(scalar_t<X>(1), x, y, w);
  }

  template <class D>
    requires has_diagonal<part, plain_t<D>>
  void diagonal(D& d) const {
    add_up(d, [](part const& a, auto& own) { a.diagonal(own); });
  }
  template <class Y>
    requires has_columns<part, plain_t<Y>>
  void columns(index first, Y& y) const {
    add_up(y, [&](part const& a, auto& own) { a.columns(first, own); });
  }

 private:
  template <bool Adjoint, class X>
  [[nodiscard]] auto workspaces(X const& x) const {
    std::vector<decltype(detail::accumulate_workspace<Adjoint>(term(0), x))> w;
    w.reserve(terms_.size());
    for (auto const& kept : terms_) {
      w.push_back(detail::accumulate_workspace<Adjoint>(kept.get(), x));
    }
    return w;
  }
  /// y ← y + α A x, or y + α Aᵀx.
  template <bool Adjoint, class S, class X, class Y, class W>
  void add(S const& α, X const& x, Y& y, W& w) const {
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      detail::accumulate<Adjoint>(terms_[i].get(), α, x, y, w[i]);
    }
  }
  /// y = Σ own(Aᵢ).
  void add_up(auto& y, auto const& write) const {
    auto own = slant::like(y, rows());
    vectors::set_zero(y);
    for (auto const& kept : terms_) {
      write_part(write, kept.get(), own);
      slant::local(y) += slant::local(own);
    }
  }

  /// Not inlined: g++ 12 would see Eigen free `own` twice, were it resized in add_up.
  [[gnu::noinline]] static void write_part(auto const& write, part const& a, auto& own) {
    write(a, own);
  }

  std::vector<held<A>> terms_;
};

/// A₁ + … + A_p over a range of operators or Eigen matrices: elements of an lvalue range are
/// referenced, those of a container that dies here are moved, of a view that does copied.
/// @throws bad_input if there is none, or sizes differ.
template <std::ranges::input_range R>
  requires(!operand<R>) && operand<std::ranges::range_reference_t<R>>
[[nodiscard]] auto sum(R&& range) {
  using element = std::ranges::range_reference_t<R>;
  constexpr bool lives_on = std::is_lvalue_reference_v<R>;
  // What a view shows is another's.
  constexpr bool dies = !lives_on && !std::ranges::view<std::remove_cvref_t<R>>;
  using part = part_t<std::conditional_t<lives_on, element, std::remove_cvref_t<element>>>;
  std::vector<held<part>> terms;
  for (auto&& a : range) {
    if constexpr (lives_on) {
      terms.push_back(held<part>(slant::as_operator(std::forward<decltype(a)>(a))));
    } else if constexpr (dies) {
      terms.push_back(held<part>(slant::as_operator(std::move(a))));
    } else {
      terms.push_back(held<part>(slant::as_operator(std::remove_cvref_t<element>(a))));
    }
  }
  if (terms.empty()) throw bad_input("range", "no operator", "at least one");
  auto const& first = terms.front().get();
  for (std::size_t i = 1; i < terms.size(); ++i) {
    auto const& a = terms[i].get();
    if (a.rows() != first.rows() || a.cols() != first.cols()) {
      detail::require_size("A" + std::to_string(i + 1), a, first.rows(), first.cols(),
                           "the size of A1");
    }
  }
  return range_sum_operator<part>(std::move(terms));
}

}  // namespace slant
