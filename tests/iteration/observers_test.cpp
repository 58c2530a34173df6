// SPDX-License-Identifier: MIT
#include "toy_method.hpp"

#include <slant/iteration/observers.hpp>
#include <slant/iteration/solve.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>

namespace observers_test {

/// What a bar for the accuracy 1e-2 has drawn at the end of use(bar).
template <class Use>
std::string drawn_by(slant::progress_bar::options o, Use use) {
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::tmpfile(), &std::fclose);
  REQUIRE(file);
  {
    o.stream = file.get();
    slant::progress_bar bar("toy", 1e-2, o);
    use(bar);
  }
  std::string text(static_cast<std::size_t>(std::ftell(file.get())), '\0');
  std::rewind(file.get());
  REQUIRE(std::fread(text.data(), 1, text.size(), file.get()) == text.size());
  return text;
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
  double const nan = std::numeric_limits<double>::quiet_NaN();
  for (auto const& text : {drawn_at(nan, 1), drawn_at(1, nan), drawn_at(0, nan), drawn_at(1, 0)}) {
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
