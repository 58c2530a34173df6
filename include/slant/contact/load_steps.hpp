// SPDX-License-Identifier: MIT
//
// Load steps as a range of reports:
//
//     auto const path = std::views::iota(1, 21) | std::views::transform([&](int i) {
//                         return contact::load_step<>{.f = i / 20.0 * f};
//                       });
//     for (auto const& step : contact::load_steps(problem, method, stop, path)) …
//
// As `iterates`, it is single-pass and ends behind the first report that is not what one hopes for:
// a step that does not converge is the last one, and shown.
//
// Rejected: a vector of reports, each with its state. A state is a dozen vectors, of which the next
// step reuses every one.
#pragma once

#include <slant/contact/load_stepper.hpp>

#include <range/v3/view/facade.hpp>

#include <memory>
#include <ranges>
#include <utility>

namespace slant::contact {

/// View of the reports of load steps; made by load_steps. A step is solved when the range gets to
/// it.
template <class Stepper, class Steps>
class load_steps_view
    : public ranges::view_facade<load_steps_view<Stepper, Steps>, ranges::cardinality::unknown> {
 public:
  load_steps_view() = default;
  template <class... Arguments>
  explicit load_steps_view(Steps steps, Arguments&&... arguments)
      : run_(std::make_shared<run>(std::move(steps), std::forward<Arguments>(arguments)...)) {}

 private:
  friend ranges::range_access;

  // Copies of a single-pass view share the run, as copies of an input stream do.
  struct run {
    template <class... Arguments>
    explicit run(Steps s, Arguments&&... arguments)
        : steps(std::move(s)), stepper(std::forward<Arguments>(arguments)...) {}
    Steps steps;
    Stepper stepper;
    std::ranges::iterator_t<Steps> next{};
    typename Stepper::report_type const* report = nullptr;  // null: over
    bool begun = false;

    void begin() {
      if (begun) return;
      next = std::ranges::begin(steps);
      solve();
      begun = true;  // not if that has thrown
    }
    void advance() {
      if (report->converged()) {
        ++next;
        solve();
      } else {
        report = nullptr;
      }
    }
    void solve() {
      report = nullptr;  // over, if this throws
      if (next != std::ranges::end(steps)) report = &stepper.advance(*next);
    }
  };
  struct cursor {
    run* r = nullptr;
    auto const& read() const { return *r->report; }
    void next() { r->advance(); }
    bool equal(ranges::default_sentinel_t) const { return r->report == nullptr; }
  };
  cursor begin_cursor() const {
    run_->begin();
    return {run_.get()};
  }

  std::shared_ptr<run> run_;
};

/// The reports (load_step_report) of solving these steps of a problem one after the other, with a
/// method for problem.qp() and a fresh copy of the rule in each; see load_stepper. The range ends
/// with the last step, or with the first that does not converge. Throws bad_input, when it gets
/// there, for a step that does not fit the problem.
template <class Dual, class Method, class Rule, std::ranges::viewable_range Steps>
  requires std::ranges::input_range<Steps>
[[nodiscard]] auto load_steps(Dual& problem, Method&& method, Rule stop, Steps&& steps) {
  using stepper = load_stepper<Dual, kept_t<Method>, Rule>;
  using view = std::views::all_t<Steps>;
  return load_steps_view<stepper, view>(std::views::all(std::forward<Steps>(steps)), problem,
                                        held<kept_t<Method>>(std::forward<Method>(method)),
                                        std::move(stop));
}

}  // namespace slant::contact
