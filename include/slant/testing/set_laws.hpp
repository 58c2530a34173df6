// SPDX-License-Identifier: MIT
//
// The laws of convex sets as a check for doctest suites:
//
//     TEST_CASE("my set keeps its word") { slant::testing::check_set_laws(my_set{…}); }
//
// What is sampled is described in set_breaches.hpp.
#pragma once

#include <slant/testing/function_breaches.hpp>
#include <slant/testing/set_breaches.hpp>

#include <doctest/doctest.h>

namespace slant::testing {

/// One doctest CHECK, with each broken law and the numbers that show it. Arguments as for
/// set_breaches: the set, a vector of the kind it takes if that is no Eigen vector, options.
template <class C, class... Rest>
void check_set_laws(C const& set, Rest const&... rest) {
  std::string text;
  for (auto const& broken : set_breaches(set, rest...)) {
    text += broken.law + " (" + broken.evidence + ")\n";
  }
  CHECK_MESSAGE(text.empty(), "broken laws:\n", text);
}

// --- function laws -------------------------------------------------------------------------------

/// The same for a function with a proximal map; see function_breaches.hpp.
template <class F>
void check_function_laws(F const& φ, set_options const& options = {}) {
  std::string text;
  for (auto const& broken : function_breaches(φ, options)) {
    text += broken.law + " (" + broken.evidence + ")\n";
  }
  CHECK_MESSAGE(text.empty(), "broken laws:\n", text);
}

// --- face laws -----------------------------------------------------------------------------------
//
// The laws of faces as a check for doctest suites:
//
//     TEST_CASE("my face keeps its word") { slant::testing::check_face_laws(face, x); }

/// One doctest CHECK, with each broken law and the numbers that show it.
template <class F, class V>
void check_face_laws(F const& face, V const& prototype) {
  std::string text;
  for (auto const& broken : face_breaches(face, prototype)) {
    text += broken.law + " (" + broken.evidence + ")\n";
  }
  CHECK_MESSAGE(text.empty(), "broken laws:\n", text);
}

}  // namespace slant::testing
