// SPDX-License-Identifier: MIT
//
// Slanting functions of the form v_i = κ(F(y)_i, G(y)_i) with a function κ of two numbers. With the
// slopes p_i, q_i of κ in its two arguments
//
//     F̃°(y) = diag(p) F°(y) + diag(q) G°(y).
//
// The maximum, the minimum and the Fischer–Burmeister function are three choices of κ.
#pragma once

#include <slant/slanting/detail/assembled_operator.hpp>
#include <slant/slanting/detail/evaluated_pair.hpp>
#include <slant/slanting/detail/weighted_sum_operator.hpp>

#include <type_traits>
#include <utility>

namespace slant::detail {

/// diag(p) A + diag(q) B; Chooses: each row is that of A or that of B.
template <bool Chooses>
struct weighted_sum_rule {
  template <class P, class Q, class A, class B>
  [[nodiscard]] auto operator()(P const& p, Q const& q, A const& a, B const& b) const {
    return weighted_sum_operator<Chooses, P, Q, A, B>(p, q, a, b);
  }
};

/// κ is Kernel::value(a, b) → number and Kernel::slopes(a, b) → {p, q}; Kernel::chooses says that
/// the slopes are always (1, 0) or (0, 1), or NaN.
template <class Kernel, class F, class G>
class pointwise_pair : public evaluated_pair<F, G> {
  using pair = evaluated_pair<F, G>;

 public:
  using pair::left;
  using pair::pair;
  using pair::right;
  using pair::rows;

  template <class Y, class V, class W>
    requires pair::template
  usable<plain_t<Y>> void value(Y const& y, V& v, W& w) const {
    this->evaluate_parts(y, w);
    slant::local(v) = slant::local(w.f).binaryExpr(
        slant::local(w.g), [](auto const& a, auto const& b) { return Kernel::value(a, b); });
  }
  template <class Y>
    requires pair::template
  usable<plain_t<Y>> [[nodiscard]] auto slant(Y const& y) const {
    auto w = this->workspace(y);
    this->evaluate_parts(y, w);
    assembled_operator s(weighted_sum_rule<Kernel::chooses>{}, slant::like(y, rows()),
                         slant::like(y, rows()), left().slant(y), right().slant(y));
    set_slopes(s, w);
    return s;
  }
  template <class Y, class S, class W>
  void slant(Y const& y, S& s, W& w) const {
    this->evaluate_parts(y, w);
    slant_after_value(y, s, w);
  }
  template <class Y, class S, class W>
  void slant_after_value(Y const& y, S& s, W& w) const {
    set_slopes(s, w);
    this->update_parts(y, s, w);
  }

 private:
  template <class S, class W>
  void set_slopes(S& s, W const& w) const {
    auto& p = slant::local(s.template part<0>());
    auto& q = slant::local(s.template part<1>());
    for (index i = 0; i < rows(); ++i) {
      auto const [at_f, at_g] = Kernel::slopes(slant::local(w.f)[i], slant::local(w.g)[i]);
      p[i] = at_f;
      q[i] = at_g;
    }
  }
};

}  // namespace slant::detail
