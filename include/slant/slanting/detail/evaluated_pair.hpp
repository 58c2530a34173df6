// SPDX-License-Identifier: MIT
//
// Two slanting functions whose values F(y) and G(y) a function of both is computed from: what
// functions by components and by blocks share.
#pragma once

#include <slant/slanting/detail/function_pair.hpp>

#include <type_traits>

namespace slant::detail {

/// `f` and `g` hold F(y) and G(y).
template <class First, class Second, class Vector>
struct evaluated_pair_workspace {
  First first;
  Second second;
  Vector f;
  Vector g;
};

/// F and G with their values. Of the parts of an assembled operator the third and the fourth are
/// F°(y) and G°(y).
template <class F, class G>
class evaluated_pair : public function_pair<F, G> {
  using pair = function_pair<F, G>;

 public:
  using pair::left;
  using pair::pair;
  using pair::right;
  using pair::rows;

  template <class Y>
  [[nodiscard]] auto workspace(Y const& y) const {
    using first = decltype(slant::workspace(left(), y));
    using second = decltype(slant::workspace(right(), y));
    return evaluated_pair_workspace<first, second, plain_t<Y>>{
        slant::workspace(left(), y), slant::workspace(right(), y), slant::like(y, rows()),
        slant::like(y, rows())};
  }

 protected:
  template <class Y, class W>
  void evaluate_parts(Y const& y, W& w) const {
    slant::evaluate(left(), y, w.f, w.first);
    slant::evaluate(right(), y, w.g, w.second);
  }
  template <class Y, class S, class W>
  void update_parts(Y const& y, S& s, W& w) const {
    slant::update_slant_after_value(left(), y, s.template part<2>(), w.first);
    slant::update_slant_after_value(right(), y, s.template part<3>(), w.second);
  }
};

}  // namespace slant::detail
