// SPDX-License-Identifier: MIT
//
// decomposed_brick: does it run, end with the right status, and agree with the whole brick?
#include <doctest/doctest.h>

#include <sstream>
#include <string>

#include "run_program.hpp"

namespace decomposed_brick {
namespace {

using examples_test::contains;
using examples_test::run;

/// The number behind a caption.
double number_behind(std::string const& text, std::string const& caption) {
  auto const at = text.find(caption);
  REQUIRE(at != std::string::npos);
  double value = -1;
  std::istringstream(text.substr(at + caption.size())) >> value;
  return value;
}

}  // namespace

TEST_CASE("decomposed_brick: the displacements of the whole brick, by both methods") {
  for (std::string const options :
       {"", " --frictionless", " --method smalse", " --frictionless --method smalse"}) {
    CAPTURE(options);
    auto const ran = run("decomposed_brick", "--cubes 2 1 1 --cells 2 --tolerance 1e-10" + options);
    CHECK(ran.status == 0);
    CHECK(ran.err == "");
    CHECK(contains(ran.out, "status                 converged\n"));
    CHECK(number_behind(ran.out, "coarse problem") == 12);
    CHECK(number_behind(ran.out, "largest jump") <= 1e-8);
    double const difference = number_behind(ran.out, "beside the whole brick");
    CHECK(difference >= 0);
    CHECK(difference <= 1e-8);
  }
}

TEST_CASE("decomposed_brick: too few steps, and bad options") {
  auto const impatient = run("decomposed_brick", "--cubes 2 1 1 --cells 2 --max-iterations 1");
  CHECK(impatient.status == 1);
  CHECK(contains(impatient.out, "iteration_limit"));
  for (std::string const options :
       {"--cubes 2 1", "--cubes 2 1 0", "--load push", "--method ssn"}) {
    examples_test::check_refused(run("decomposed_brick", options),
                                 options.substr(0, options.find(' ')));
  }
}

}  // namespace decomposed_brick
