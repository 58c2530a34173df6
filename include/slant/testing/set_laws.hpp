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
  auto const text = listed(set_breaches(set, rest...));
  CHECK_MESSAGE(text.empty(), "broken laws:\n", text);
}

/// The same for a function with a proximal map; see function_breaches.hpp.
template <class F>
void check_function_laws(F const& φ, set_options const& options = {}) {
  auto const text = listed(function_breaches(φ, options));
  CHECK_MESSAGE(text.empty(), "broken laws:\n", text);
}

/// The same for a face that cuts down vectors like `prototype`.
template <class F, class V>
void check_face_laws(F const& face, V const& prototype) {
  auto const text = listed(face_breaches(face, prototype));
  CHECK_MESSAGE(text.empty(), "broken laws:\n", text);
}

}  // namespace slant::testing
