// SPDX-License-Identifier: MIT
//
// Laws that the caller knows and the types cannot: `declare<self_adjoint>(product(A, B))` where A
// and B commute. The laws are asserted, not verified; slant::testing::check_operator_laws samples
// them.
#pragma once

#include <slant/base/held.hpp>
#include <slant/operators/composition.hpp>
#include <slant/operators/matrix.hpp>

#include <type_traits>
#include <utility>

namespace slant::detail {

enum class application_kind : unsigned char { forward, adjoint, columns };

/// An operator with something done around each application (counting, timing); forwards every
/// capability that the operator has, and no other. Probe has enter(kind, number of right-hand
/// sides), const and thread-safe, which returns an object that lives as long as the application.
template <class A, class Probe>
class decorator {
  using part = std::remove_cvref_t<A>;

 public:
  static constexpr law_set laws = laws_of<A>;
  static constexpr bool is_decorator = true;
  static constexpr bool full_row_rank = declares_full_row_rank<part>;

  explicit decorator(held<A> a) : a_(std::move(a)) {}
  /// With the probe of another one.
  decorator(held<A> a, Probe probe) : a_(std::move(a)), probe_(std::move(probe)) {}

  [[nodiscard]] index rows() const { return a_.get().rows(); }
  [[nodiscard]] index cols() const { return a_.get().cols(); }
  /// The operator inside.
  [[nodiscard]] part const& get() const noexcept { return a_.get(); }

  [[nodiscard]] auto workspace(accepted_by<part> auto const& x) const {
    return slant::workspace(a_.get(), x);
  }
  template <class X, class Y, class W>
    requires applies<part, X, Y>
  void apply(X const& x, Y& y, W& w) const {
    [[maybe_unused]] auto const scope =
        probe_.enter(application_kind::forward, slant::local(x).cols());
    slant::apply(a_.get(), x, y, w);
  }
  template <class X, class Y, class W>
    requires accumulates<part, X, Y>
  void apply_add(scalar_t<X> α, X const& x, Y& y, W& w) const {
    [[maybe_unused]] auto const scope =
        probe_.enter(application_kind::forward, slant::local(x).cols());
    slant::apply_add(a_.get(), α, x, y, w);
  }

  [[nodiscard]] auto adjoint_workspace(accepted_by_adjoint_of<part> auto const& x) const {
    return slant::adjoint_workspace(a_.get(), x);
  }
  template <class X, class Y, class W>
    requires applies_adjoint<part, X, Y>
  void apply_adjoint(X const& x, Y& y, W& w) const {
    [[maybe_unused]] auto const scope =
        probe_.enter(application_kind::adjoint, slant::local(x).cols());
    slant::apply_adjoint(a_.get(), x, y, w);
  }
  template <class X, class Y, class W>
    requires accumulates_adjoint<part, X, Y>
  void apply_adjoint_add(scalar_t<X> α, X const& x, Y& y, W& w) const {
    [[maybe_unused]] auto const scope =
        probe_.enter(application_kind::adjoint, slant::local(x).cols());
    slant::apply_adjoint_add(a_.get(), α, x, y, w);
  }

  template <class D>
    requires has_diagonal<part, D>
  void diagonal(D& d) const {
    a_.get().diagonal(d);
  }
  template <class D>
    requires(may_have_diagonal<part, D> && !has_diagonal<part, D>)
  [[nodiscard]] bool diagonal_if_known(D& d) const {
    return a_.get().diagonal_if_known(d);
  }
  template <class Y>
    requires has_columns<part, Y>
  void columns(index first, Y& y) const {
    [[maybe_unused]] auto const scope =
        probe_.enter(application_kind::columns, slant::local(y).cols());
    a_.get().columns(first, y);
  }
  /// The inverse of the operator inside. Its applications are its own: they are not probed.
  [[nodiscard]] auto inverse() const
    requires knows_its_inverse<part>
  {
    return a_.get().inverse();
  }
  /// The rounded twin, probed together with the operator.
  [[nodiscard]] auto rounded() const
    requires requires(part const& a) { a.rounded(); }
  {
    using twin = decltype(a_.get().rounded());
    return decorator<twin, Probe>(held<twin>(a_.get().rounded()), probe_);
  }

 protected:
  [[nodiscard]] Probe const& probe() const noexcept { return probe_; }

 private:
  held<A> a_;
  Probe probe_{};
};

}  // namespace slant::detail

namespace slant {

namespace detail {

/// Does nothing around an application.
struct no_probe {
  struct nothing {};
  nothing enter(application_kind, index) const noexcept { return {}; }
};

}  // namespace detail

/// The operator A with the laws L in addition to its own.
template <class A, law_set L>
class declared_operator : public detail::decorator<A, detail::no_probe> {
 public:
  static constexpr law_set laws = laws_of<A> | L;
  using detail::decorator<A, detail::no_probe>::decorator;

  /// The inverse of A, with what the laws of A imply for it.
  [[nodiscard]] auto inverse() const
    requires detail::knows_its_inverse<std::remove_cvref_t<A>>
  {
    using inverse_part = std::remove_cvref_t<decltype(this->get().inverse())>;
    return declared_operator<inverse_part, detail::inverse_laws(laws)>{
        held<inverse_part>(this->get().inverse())};
  }
};

/// The operator B with the assertion that its rows are linearly independent.
template <class B>
class full_row_rank_operator : public detail::decorator<B, detail::no_probe> {
 public:
  static constexpr bool full_row_rank = true;
  using detail::decorator<B, detail::no_probe>::decorator;
};

/// Asserts that the rows of B are linearly independent, which makes B A Bᵀ definite where A is.
/// Throws bad_input if there are more rows than columns.
template <adjoint_operand B>
[[nodiscard]] auto full_row_rank(B&& b) {
  detail::require_wide("B", b);
  if constexpr (requires { b.with_full_row_rank(); }) {
    return b.with_full_row_rank();
  } else {
    return full_row_rank_operator<part_t<B>>{
        held<part_t<B>>(slant::as_operator(std::forward<B>(b)))};
  }
}

/// Asserts laws of A. Throws bad_input if A is not square: only square operators have laws.
template <law... L, operand A>
  requires(sizeof...(L) > 0)
[[nodiscard]] auto declare(A&& a) {
  held<part_t<A>> part{slant::as_operator(std::forward<A>(a))};
  detail::require_square("A", part.get());
  return declared_operator<part_t<A>, slant::laws<L...>>{std::move(part)};
}

}  // namespace slant
