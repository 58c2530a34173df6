// SPDX-License-Identifier: MIT
//
// stacked_bricks: a stack that stands, and what it says of one that does not.
#include <doctest/doctest.h>

#include <string>

#include "run_program.hpp"

namespace stacked_bricks {
namespace {

using examples_test::contains;
using examples_test::run;
using examples_test::word;

}  // namespace

TEST_CASE("stacked_bricks: a stack that stands, and loads without equilibrium") {
  io_test::temporary_folder const folder;
  auto const held =
      run("stacked_bricks", "--bricks 2 --cells 2 --output " + word(folder.path().string()));
  CHECK(held.status == 0);
  CHECK(held.err == "");
  for (auto const* expected : {"load \"hold\"", "factors        2,", "status         converged",
                               "equilibrium", "of the projector"})
    CHECK(contains(held.out, expected));
  CHECK(contains(io_test::get(folder / "stack.vtu"), "contact_force"));
  for (auto const* load : {"lift", "tip"}) {
    CAPTURE(load);
    auto const ran = run("stacked_bricks", "--bricks 2 --cells 2 --load " + std::string(load));
    CHECK(ran.status == 1);
    CHECK(contains(ran.out, "unbounded: no solution: the energy falls for ever"));
    CHECK(contains(ran.out, "direction      K d = "));
  }
}

TEST_CASE("stacked_bricks refuses bad options in one line") {
  examples_test::check_refused(run("stacked_bricks", "--load push"),
                               "--load: got push, expected hold, lift or tip");
}

}  // namespace stacked_bricks
