// SPDX-License-Identifier: MIT
//
// The same run as a range of states, for range-v3 pipelines:
//
//     for (auto const& s : slant::iterates(method, x0) | ranges::views::take(10)) …
//
// The range is single-pass. It begins with the state of x0 and ends behind the first state that is
// no longer `running`. One state exists; it is moved on in place, so nothing is allocated by ++.
#pragma once

#include <slant/concepts/iterative_method.hpp>

#include <range/v3/view/facade.hpp>

#include <memory>
#include <type_traits>
#include <utility>

namespace slant {

/// View of the states of a method; see the top of this file. Created by `iterates`. `Method` is M&
/// if the method is referenced, M if it is owned.
template <class Method, class State>
class iterates_view
    : public ranges::view_facade<iterates_view<Method, State>, ranges::cardinality::unknown> {
 public:
  iterates_view() = default;
  template <class V>
  iterates_view(Method&& method, V const& x0)
      : run_(std::make_shared<run>(std::forward<Method>(method), x0)) {}

 private:
  friend ranges::range_access;

  // Copies of a single-pass view share the run, as copies of an input stream do. The method is in
  // its place before it makes a state, which may refer to it.
  struct run {
    template <class V>
    run(Method&& m, V const& x0) : method(std::forward<Method>(m)), state(method.start(x0)) {}
    Method method;
    State state;
    bool over = false;
  };
  struct cursor {
    run* r = nullptr;
    State const& read() const { return r->state; }
    void next() {
      if (r->state.status == status::running) {
        r->method.step(r->state);
      } else {
        r->over = true;
      }
    }
    bool equal(ranges::default_sentinel_t) const { return r->over; }
  };
  cursor begin_cursor() const { return {run_.get()}; }

  std::shared_ptr<run> run_;
};

/// The states of `method` from x0 on. A method passed as an lvalue is referenced and must outlive
/// the range; an rvalue is owned.
template <class Method, class V>
  requires iterative_method<std::remove_reference_t<Method>, V>
[[nodiscard]] auto iterates(Method&& method, V const& x0) {
  return iterates_view<Method, state_t<std::remove_reference_t<Method>, V>>(
      std::forward<Method>(method), x0);
}

}  // namespace slant
