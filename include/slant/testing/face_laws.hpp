// SPDX-License-Identifier: MIT
//
// The laws of faces as a check for doctest suites:
//
//     TEST_CASE("my face keeps its word") { slant::testing::check_face_laws(face, x); }
#pragma once

#include <slant/testing/face_breaches.hpp>

#include <doctest/doctest.h>

namespace slant::testing {

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
