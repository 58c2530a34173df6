// SPDX-License-Identifier: MIT
//
// The laws of slanting functions as a check for doctest suites:
//
//     TEST_CASE("my function is slantly differentiable") {
//       slant::testing::check_slanting_laws(my_function{…}, at_a_kink, somewhere_else);
//     }
//
// What is sampled, and what no sample can see, is described in slanting_breaches.hpp.
#pragma once

#include <slant/testing/slanting_breaches.hpp>

#include <doctest/doctest.h>

namespace slant::testing {

/// One doctest CHECK per point, with each broken law and the numbers that show it.
template <class F, vector... V>
  requires(slanting_function<F, V> && ...)
void check_slanting_laws(slanting_options const& options, F const& f, V const&... points) {
  auto const check = [&](auto const& y) {
    auto const text = listed(slanting_breaches(f, y, options));
    CHECK_MESSAGE(text.empty(), "broken at ", slant::local(y).transpose(), ":\n", text);
  };
  (check(points), ...);
}

template <class F, vector... V>
  requires(slanting_function<F, V> && ...)
void check_slanting_laws(F const& f, V const&... points) {
  slant::testing::check_slanting_laws(slanting_options{}, f, points...);
}

}  // namespace slant::testing
