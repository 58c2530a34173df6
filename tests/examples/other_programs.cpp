// SPDX-License-Identifier: MIT
//
// brick, tridiagonal and wire: do they run, end with the right status, and say the right thing?
#include "run_program.hpp"

namespace other_programs {
using namespace examples_test;

TEST_CASE("tridiagonal: active set and products near the printed ones") {
  auto const ran = output_of("tridiagonal", "");
  CHECK(contains(ran, "active set: {2, 3, 5}\n"));

  std::istringstream lines(ran.substr(ran.find("products")));
  std::string line;
  std::getline(lines, line);
  int rows = 0;
  for (double Γ, ours, printed; lines >> Γ >> ours >> printed; ++rows) {
    CAPTURE(Γ);
    CHECK(std::fabs(ours - printed) <= printed / 3);
    std::getline(lines, line);
    CHECK(contains(line, "converged"));
  }
  CHECK(rows == 11);
}

TEST_CASE("wire: all printed counts of a small mesh") {
  auto const ran = output_of("wire", "--unknowns 64");
  CHECK(contains(ran, "all counts that were printed are reproduced\n"));

  auto const one = run("wire", "--unknowns 128 --lower 0 --radius 0.3");
  CHECK(one.status == 0);
  CHECK(contains(one.out, "29:3      29:3      16:16     16:16"));

  check_failed("wire", "--unknowns 64 --radius 1 --max-iterations 3", "iteration_limit");
}

TEST_CASE("brick: problem, result, proof and files") {
  io_test::temporary_folder const folder;
  auto const output = folder / "new/demo";
  auto const ran = output_of("brick", "--cells 2 --load lift --output " + word(output.string()));
  for (auto const* expected :
       {"load \"lift\"", "(0.3, 0.2, 1.2) MPa on the right end", "slip bound     0.6 MPa",
        "144 tetrahedra, 162 unknowns", "18 nodes", "factorisation", "status         converged",
        "products", "open", "stick", "slip", "equilibrium", "penetration"})
    CHECK(contains(ran, expected));
  CHECK(contains(io_test::get(output / "brick.vtu"), "contact_pressure"));
  bool const drawn = has_gnuplot();
  CHECK(contains(ran, "no picture: ") == !drawn);
  CHECK(io_test::get(output / "contact.png").starts_with("\x89PNG") == drawn);
}

TEST_CASE("brick: a fine mesh without factors") {
  auto const ran = run("brick", "--refine 4 --load lift --tolerance 1e-8");
  CHECK(ran.status == 0);
  CHECK(contains(ran.out, "converged: relative energy error"));
  CHECK(contains(ran.out, "chosen                 iterated, as asked for"));
  CHECK(contains(ran.out, "levels                 smoothed aggregation"));
  CHECK(contains(ran.out, "contact nodes"));
  CHECK(run("brick", "--refine 2 --max-iterations 1").status == 1);
}

TEST_CASE("the programs refuse bad options in one line") {
  auto const check = [](auto const&... with) { check_refused(with...); };
  check("brick", "--load push", "--load: got push, expected press, pull or lift");
  check("brick", "--cells 1 --output /dev/null", "--output: got /dev/null");
  check("wire", "--unknowns 30", "--unknowns: got 30, expected a multiple of 4");
  check("tridiagonal", "extra", "argument: got extra, expected one of those that --help lists");
}

}  // namespace other_programs
