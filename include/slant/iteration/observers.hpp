// SPDX-License-Identifier: MIT
//
// Observers: they are shown every state and change nothing.
#pragma once

#include <slant/iteration/stopping.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace slant {

/// Records one number per state: history h{[](auto const& s) { return s.reduced_gradient_norm; }};
/// Memory is reserved ahead so that recording does not allocate within the first `capacity` states.
template <class Projection, class Value = double>
class history {
 public:
  explicit history(Projection p, std::size_t capacity = 4096) : projection_(std::move(p)) {
    values_.reserve(capacity);
  }
  template <class State>
  void operator()(State const& s) {
    values_.push_back(static_cast<Value>(projection_(s)));
  }
  [[nodiscard]] std::vector<Value> const& values() const { return values_; }

 private:
  Projection projection_;
  std::vector<Value> values_;
};

namespace detail {

/// 0/0 is 0: nothing to solve, nothing left to do.
template <class S>
[[nodiscard]] double relative_size(S const& value, S const& scale) {
  return value == S(0) && scale == S(0) ? 0.0 : static_cast<double>(value / scale);
}

/// "expansion" of slant::kprgp_step::expansion, which is how the compiler prints it; empty for a
/// number in parentheses, which is no enumerator.
template <auto Enumerator>
[[nodiscard]] constexpr std::string_view enumerator_name() {
  std::string_view s = __PRETTY_FUNCTION__;
  s.remove_prefix(s.find("Enumerator = ") + 13);
  s = s.substr(0, s.find_first_of(";]"));
  return s.front() == '(' ? std::string_view() : s.substr(s.rfind(':') + 1);
}
/// The name of one of the first eight values.
template <class E>
[[nodiscard]] std::string_view name_of(E value) {
  std::string_view name;
  [&]<int... I>(std::integer_sequence<int, I...>) {
    ((value == E(I) ? void(name = enumerator_name<E(I)>()) : void()), ...);
  }(std::make_integer_sequence<int, 8>{});
  return name;
}

/// f(name, value) for what a state has of the columns of a step_table.
template <class State, class F>
void for_each_column(State const& s, F const& f) {
  f("step", s.iteration);
  if constexpr (has_reduced_gradient_norm<State>) {
    f("reduced_gradient", relative_size(s.reduced_gradient_norm, s.gradient_scale));
  }
  if constexpr (has_residual_norm<State>) {
    f("residual", relative_size(s.residual_norm, s.residual_scale));
  }
  if constexpr (has_feasibility_norm<State>) {
    f("infeasibility", relative_size(s.feasibility_norm, s.feasibility_scale));
  }
  if constexpr (has_step_norm<State>) f("step_norm", relative_size(s.step_norm, s.x_norm));
  if constexpr (requires { s.step_fraction; }) {
    f("fraction", static_cast<double>(s.step_fraction));
  }
  if constexpr (requires { s.last_step; }) f("kind", name_of(s.last_step));
  if constexpr (has_work<State>) f("products", s.work.operator_applications);
}

}  // namespace detail

/// A line for each state under a line of names, as a table or, with all digits, as CSV:
///
///     step  reduced_gradient   fraction                kind   products
///        0          1.00e+00   1.00e+00                none          0
///        1          1.39e-03   1.00e+00                full          2
///
/// Columns are what the state has of these: reduced gradient, residual, distance from the equality
/// constraints and step, relative to their scales; fraction of the step that was taken, its kind;
/// applications of A so far. Throws bad_input if `every` < 1.
class step_table {
 public:
  struct options {
    std::FILE* stream = stdout;  ///< where to print
    bool csv = false;            ///< comma-separated values
    index every = 1;             ///< print every n-th state, n >= 1

    /// Throws bad_input naming the option, its value and what was expected.
    [[gnu::cold]] void validate() const {
      if (every < 1) throw bad_input("every", detail::show(every), "a number of states >= 1");
    }
  };
  step_table() : step_table(options{}) {}
  explicit step_table(options o) : options_(o) { options_.validate(); }

  template <iteration_state State>
  void operator()(State const& s) {
    if (s.iteration % options_.every != 0) return;
    if (!std::exchange(has_head_, true)) print_line(s, true);
    print_line(s, false);
  }

 private:
  using cell_text = std::array<char, 32>;

  /// The values of the state, or their names.
  template <class State>
  void print_line(State const& s, bool names) const {
    char const* separator = "";
    detail::for_each_column(s, [&](std::string_view name, auto const& value) {
      constexpr bool is_word = std::is_same_v<decltype(value), std::string_view const&>;
      std::size_t const width = std::max<std::size_t>(name.size(), is_word ? 18 : 9);
      cell_text text{};
      std::string_view const cell = names ? name : shown(value, text);
      std::fprintf(options_.stream, "%s%*.*s", separator,
                   options_.csv ? 0 : static_cast<int>(width), static_cast<int>(cell.size()),
                   cell.data());
      separator = options_.csv ? "," : "  ";
    });
    std::fputc('\n', options_.stream);
  }

  [[nodiscard]] std::string_view shown(std::string_view word, cell_text&) const { return word; }
  [[nodiscard]] std::string_view shown(index count, cell_text& text) const {
    return {text.data(), written(std::snprintf(text.data(), text.size(), "%td", count))};
  }
  [[nodiscard]] std::string_view shown(double x, cell_text& text) const {
    char const* const format = options_.csv ? "%.17g" : "%.2e";
    return {text.data(), written(std::snprintf(text.data(), text.size(), format, x))};
  }
  static std::size_t written(int length) { return std::size_t(length); }

  options options_;
  bool has_head_ = false;
};

/// A progress line on a terminal: "kprgp  step 120  products 133  residual 3.1e-05 → 1.0e-08".
/// The bar is logarithmic in the relative accuracy. Prints at most every `every` states, and
/// nothing at all if the stream is not `enabled` (decide with isatty in the program).
/// Throws bad_input if the tolerance is not in [0, 1) or `every` < 1.
class progress_bar {
 public:
  struct options {
    std::FILE* stream = stderr;  ///< where to draw
    bool enabled = true;         ///< false: stay silent
    index every = 1;             ///< draw every n-th state, n >= 1

    /// Throws bad_input naming the option, its value and what was expected.
    [[gnu::cold]] void validate() const {
      if (every < 1) throw bad_input("every", detail::show(every), "a number of states >= 1");
    }
  };
  progress_bar(std::string title, double tolerance)
      : progress_bar(std::move(title), tolerance, {}) {}
  progress_bar(std::string title, double tolerance, options o)
      : title_(std::move(title)), tolerance_(detail::checked_tolerance(tolerance)), options_(o) {
    options_.validate();
  }
  ~progress_bar() {
    if (drawn_) std::fputc('\n', options_.stream);
  }
  progress_bar(progress_bar const&) = delete;
  progress_bar& operator=(progress_bar const&) = delete;

  template <class State>
    requires has_reduced_gradient_norm<State> || has_residual_norm<State>
  void operator()(State const& s) {
    if (!options_.enabled || s.iteration % options_.every != 0) return;
    double error = 0;
    if constexpr (has_reduced_gradient_norm<State>) {
      error = detail::relative_size(s.reduced_gradient_norm, s.gradient_scale);
    } else {
      error = detail::relative_size(s.residual_norm, s.residual_scale);
    }
    draw(s.iteration, error);
  }

 private:
  void draw(index step, double error) {
    constexpr int width = 30;
    // Full when log(error) has come all the way from 1 to the tolerance.
    double done = 1;
    if (!(error <= tolerance_)) {  // also if it is NaN
      done = error < 1 && tolerance_ > 0 ? std::log(error) / std::log(tolerance_) : 0;
    }
    best_ = done > best_ ? done : best_;
    auto const filled = static_cast<int>(best_ * width);
    std::string bar(std::size_t(filled), '#');
    bar.resize(width, '.');
    std::fprintf(options_.stream, "\r%s [%s] step %6td  relative residual %.1e ", title_.c_str(),
                 bar.c_str(), step, error);
    std::fflush(options_.stream);
    drawn_ = true;
  }

  std::string title_;
  double tolerance_;
  options options_;
  double best_ = 0;
  bool drawn_ = false;
};

}  // namespace slant
