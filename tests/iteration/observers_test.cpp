// SPDX-License-Identifier: MIT
#include "toy_method.hpp"

#include <slant/iteration/observers.hpp>
#include <slant/iteration/solve.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>

namespace observers_test {

std::string drawn(slant::progress_bar::options o, double start) {
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::tmpfile(), &std::fclose);
  REQUIRE(file);
  {
    o.stream = file.get();
    slant::progress_bar bar("toy", 1e-2, o);
    auto const r = slant::solve(toy::halving{}, start, slant::residual_below(1e-2), bar);
    CHECK(r.converged());
  }
  std::string text(static_cast<std::size_t>(std::ftell(file.get())), '\0');
  std::rewind(file.get());
  REQUIRE(std::fread(text.data(), 1, text.size(), file.get()) == text.size());
  return text;
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

}  // namespace observers_test
