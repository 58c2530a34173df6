// SPDX-License-Identifier: MIT
//
// The program stokes: does it run, say the right thing, write its files, and name what is missing?
#include "run_program.hpp"

namespace stokes {
using namespace examples_test;

TEST_CASE("stokes: problem, result, proof and files") {
  io_test::temporary_folder const folder;
  auto const output = folder / "new/flow";
  auto const ran = output_of("stokes", "--refinement 1 --g 10 --output " + word(output.string()));
  for (auto const* expected :
       {"862 velocities, 526 pressures, 30 wall nodes", "586 unknowns, 30 of them bounded",
        "status         converged", "6 stick, 24 slip", "in 0.07875, out 0.07875"})
    CHECK(contains(ran, expected));
  CHECK(contains(io_test::get(output / "flow.vtu"), "wall_state"));
  CHECK(contains(ran, "wrote " + (output / "flow.png").string()) == has_gnuplot());
}

TEST_CASE("stokes: the table, by all methods") {
  auto const ran = run("stokes", "--table --refinement 1 --tolerance 1e-6");
  CHECK(ran.status == 0);
  CHECK(contains(ran.out, "862/526/30       10     6867      208"));
  CHECK(contains(ran.out, "862/526/30       30      682      181"));
  CHECK(contains(ran.out, "all runs converged\n"));
}

TEST_CASE("stokes: path following takes no more products than the lecture's") {
  struct printed {
    char const* options;
    int products;
  };
  for (auto const& [options, products] :
       {printed{"--refinement 1 --g 10", 208}, printed{"--refinement 1 --g 30", 181},
        printed{"--refinement 2 --g 10", 283}, printed{"--refinement 2 --g 30", 268}}) {
    CAPTURE(options);
    auto const ran =
        run("stokes", std::string(options) + " --method interior_point --tolerance 1e-6");
    CHECK(ran.status == 0);
    auto const at = ran.out.find("products ");
    REQUIRE(at != std::string::npos);
    std::istringstream line(ran.out.substr(at));
    std::string word, more;
    int spent = 0, before = 0;
    line >> word >> spent >> more >> more >> before;
    CHECK(before > 0);
    CHECK(spent + before <= products);
  }
}

TEST_CASE("stokes: what cannot be used is named in one line") {
  auto const refused = [](auto const&... with) { check_refused("stokes", with...); };
  io_test::temporary_folder const folder;
  auto const empty = word(folder.path().string());
  refused("--meshes " + empty + " --refinement 3", "examples/stokes/make_mesh 3 makes it");
  io_test::put(folder / "channel_1.msh", "solid\n");
  refused("--meshes " + empty + " --refinement 1", "channel_1.msh:1: got 'solid'");
  refused("--refinement 5", "--refinement: got 5, expected a whole number from 1 to 4");
  refused("--g -1", "--g: got -1, expected a finite number >= 0");
  refused("--kappa nan", "--kappa: got nan");
  refused("--method simplex", "--method: got simplex, expected newton");
}

}  // namespace stokes
