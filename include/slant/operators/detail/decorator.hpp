// SPDX-License-Identifier: MIT
//
// An operator with something done around each application (counting, timing). Forwards
// every capability that the operator has, and no other.
#pragma once

#include <slant/operators/detail/applicable.hpp>
#include <slant/operators/held.hpp>

#include <type_traits>
#include <utility>

namespace slant::detail {

enum class application_kind : unsigned char { forward, adjoint, columns };

/// Probe has enter(kind, number of right-hand sides), const and thread-safe, which returns an
/// object that lives as long as the application.
template <class A, class Probe>
class decorator {
  using part = std::remove_cvref_t<A>;

 public:
  static constexpr law_set laws = laws_of<A>;

  explicit decorator(held<A> a) : a_(std::move(a)) {}
  /// With the probe of another one.
  decorator(held<A> a, Probe probe) : a_(std::move(a)), probe_(std::move(probe)) {}

  [[nodiscard]] index rows() const { return a_.get().rows(); }
  [[nodiscard]] index cols() const { return a_.get().cols(); }
  /// The operator inside.
  [[nodiscard]] part const& get() const noexcept { return a_.get(); }

  template <class X>
    requires linear_operator<part, plain_t<X>>
  [[nodiscard]] auto workspace(X const& x) const {
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

  template <class X>
    requires has_adjoint<part, plain_t<X>>
  [[nodiscard]] auto adjoint_workspace(X const& x) const {
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
