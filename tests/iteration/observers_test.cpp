// SPDX-License-Identifier: MIT
#include <slant/iteration/iteration.hpp>

#include <cstdio>
#include <support/testing.hpp>
#include "toy_method.hpp"

namespace observers_test {

/// What use(file) has printed at the end.
template <class Use>
std::string printed_by(Use use) {
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::tmpfile(), &std::fclose);
  REQUIRE(file);
  use(file.get());
  std::string text(static_cast<std::size_t>(std::ftell(file.get())), '\0');
  std::rewind(file.get());
  REQUIRE(std::fread(text.data(), 1, text.size(), file.get()) == text.size());
  return text;
}

/// What a bar for the accuracy 1e-2 has drawn at the end of use(bar).
template <class Use>
std::string drawn_by(slant::progress_bar::options o, Use use) {
  return printed_by([&](std::FILE* file) {
    o.stream = file;
    slant::progress_bar bar("toy", 1e-2, o);
    use(bar);
  });
}

std::string drawn(slant::progress_bar::options o, double start) {
  return drawn_by(o, [&](slant::progress_bar& bar) {
    auto const r = slant::solve(toy::halving{}, start, slant::residual_below(1e-2), bar);
    CHECK(r.converged());
  });
}

/// The bar shown for one state.
std::string drawn_at(double residual, double scale) {
  return drawn_by({}, [&](slant::progress_bar& bar) {
    bar(toy::state{.residual_norm = residual, .residual_scale = scale});
  });
}

TEST_CASE("history records one number per state") {
  slant::history h{[](auto const& s) { return s.x; }};
  auto const r = slant::solve(toy::halving{}, 4.0, slant::at_most(3), h);
  CHECK(r.iterations() == 3);
  CHECK(h.values() == std::vector<double>{4, 2, 1, 0.5});
}

/// What a step_table prints of a run of the toy method.
std::string table_of_toy(slant::step_table::options o) {
  return printed_by([&](std::FILE* file) {
    o.stream = file;
    CHECK(slant::solve(toy::halving{}, 1.0, slant::at_most(2), slant::step_table{o}).x() == 0.25);
  });
}

/// A state with all that there is a column for.
struct full_state {
  enum class kind : unsigned char { none, full, damped };
  double reduced_gradient_norm = 1, gradient_scale = 4;
  double residual_norm = 1, residual_scale = 8;
  double feasibility_norm = 0, feasibility_scale = 0;
  double step_norm = 1, x_norm = 3, step_fraction = 0.5;
  kind last_step = kind::damped;
  slant::work work{.operator_applications = 17};
  double x = 0;
  slant::index iteration = 2;
  slant::status status = slant::status::running;
};

TEST_CASE("a step_table has a line of names and one for each state") {
  CHECK(table_of_toy({}) ==
        "     step   residual\n"
        "        0   1.00e+00\n"
        "        1   5.00e-01\n"
        "        2   2.50e-01\n");
  CHECK(table_of_toy({.csv = true}) == "step,residual\n0,1\n1,0.5\n2,0.25\n");
  CHECK(table_of_toy({.csv = true, .every = 2}) == "step,residual\n0,1\n2,0.25\n");
}

TEST_CASE("a step_table shows what the state has, with the name of the step") {
  auto const print = [](bool csv) {
    return printed_by([&](std::FILE* file) {
      slant::step_table table({.stream = file, .csv = csv});
      table(full_state{});
    });
  };
  CHECK(print(true) ==
        "step,reduced_gradient,residual,infeasibility,step_norm,fraction,kind,products\n"
        "2,0.25,0.125,0,0.33333333333333331,0.5,damped,17\n");
  CHECK(print(false) ==
        "     step  reduced_gradient   residual  infeasibility  step_norm   fraction"
        "                kind   products\n"
        "        2          2.50e-01   1.25e-01       0.00e+00   3.33e-01   5.00e-01"
        "              damped         17\n");
}

TEST_CASE("an enumerator has its name, another value none") {
  using kind = full_state::kind;
  CHECK(slant::detail::name_of(kind::none) == "none");
  CHECK(slant::detail::name_of(kind::full) == "full");
  CHECK(slant::detail::name_of(static_cast<kind>(7)).empty());
}

TEST_CASE("a step_table cannot print every 0 states") {
  CHECK_THROWS_WITH_AS(slant::step_table({.every = 0}),
                       "every: got 0, expected a number of states >= 1", slant::bad_input);
}

TEST_CASE("the progress bar fills, shows the residual and ends its line") {
  auto const text = drawn({}, 1.0);
  CHECK(text.find("toy [") != std::string::npos);
  CHECK(text.find("step      0  relative residual 1.0e+00") != std::string::npos);
  CHECK(text.find(std::string(30, '#')) != std::string::npos);
  CHECK(text.back() == '\n');
}

TEST_CASE("a disabled bar prints nothing, a rare one prints rarely") {
  CHECK(drawn({.enabled = false}, 1.0).empty());
  auto const often = drawn({}, 1.0), rarely = drawn({.every = 3}, 1.0);
  auto const lines = [](std::string const& s) { return std::count(s.begin(), s.end(), '\r'); };
  CHECK(lines(often) == 8);
  CHECK(lines(rarely) == 3);
}

TEST_CASE("an error that is no number, or meets no scale, does not look like success") {
  for (auto const& text :
       {drawn_at(quiet_nan, 1), drawn_at(1, quiet_nan), drawn_at(0, quiet_nan), drawn_at(1, 0)}) {
    CAPTURE(text);
    CHECK(text.find('#') == std::string::npos);
    CHECK(text.find("[..............................]") != std::string::npos);
  }
  CHECK(drawn_at(0, 0).find(std::string(30, '#')) != std::string::npos);
  CHECK(drawn_at(1e-2, 1).find(std::string(30, '#')) != std::string::npos);
}

TEST_CASE("a bar cannot be drawn every 0 states") {
  using slant::progress_bar;
  for (slant::index const every : {0, -3}) {
    std::string const complaint =
        "every: got " + std::to_string(every) + ", expected a number of states >= 1";
    CHECK_THROWS_WITH_AS(progress_bar("toy", 1e-2, {.every = every}), complaint.c_str(),
                         slant::bad_input);
  }
}

}  // namespace observers_test
