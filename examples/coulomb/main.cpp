// SPDX-License-Identifier: MIT
//
// Contact with Coulomb friction through a sequence of load steps: a body is pressed down, dragged
// along and released from the drag.
#include <algorithm>
#include <cmath>
#include <slant/concepts/bad_input.hpp>
#include <string>
#include <support/command_line.hpp>
#include <vector>

#include "settings.hpp"

namespace {

using coulomb::settings;

int follow(settings const& s) {
  if (s.orthotropic() && s.model == "plates") {
    throw slant::bad_input("--friction-across", slant::detail::show(s.across),
                           "nothing with --model plates, which slip along a line");
  }
  if (s.orthotropic() && s.method == "newton") {
    throw slant::bad_input("--method", s.method, "coulomb or radii, as --friction-across is given");
  }
  return s.model == "plates" ? coulomb::follow_in_plane(s) : coulomb::follow_in_space(s);
}

/// One of these words.
CLI::Validator expects_one_of(std::vector<std::string> const& words,
                              std::string const& expectation) {
  return examples::expects<std::string>(expectation, [words](std::string const& word) {
    return std::find(words.begin(), words.end(), word) != words.end();
  });
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("A body pressed, dragged and released, with Coulomb friction.", "coulomb");
  app.footer(std::string(examples::exit_status_help));
  settings s;
  auto const coefficient = examples::expects<double>(
      "a finite number >= 0", [](double F) { return F >= 0 && std::isfinite(F); });
  app.add_option("--model", s.model,
                 "brick (on a foundation), bricks (two), or plates (two, in the plane)")
      ->capture_default_str()
      ->check(expects_one_of({"brick", "bricks", "plates"}, "brick, bricks or plates"));
  app.add_option("--cells", s.k,
                 "k of the 3k x k x k cells, of the k x (k-1) x (k-1) of each brick, or of the\n"
                 "3k x k of each plate")
      ->capture_default_str()
      ->check(examples::expects_at_least(2));
  app.add_option("--friction", s.friction, "friction coefficient; its mean if it varies")
      ->capture_default_str()
      ->check(coefficient);
  app.add_option("--friction-across", s.across,
                 "that along y, if it is another one (orthotropic, in space)")
      ->check(coefficient);
  app.add_option("--friction-variation", s.variation,
                 "part of the mean by which coefficients grow along x: from 1 - v to 1 + v times "
                 "the mean")
      ->capture_default_str()
      ->check(examples::expects<double>("a number in [0, 1]",
                                        [](double v) { return v >= 0 && v <= 1; }));
  app.add_option("--method", s.method,
                 "newton (isotropic friction only), radii (successive approximations), or coulomb: "
                 "newton,\nand radii where that fails or cannot be")
      ->capture_default_str()
      ->check(expects_one_of({"coulomb", "newton", "radii"}, "coulomb, newton or radii"));
  app.add_option("--steps", s.steps, "load steps of each phase")
      ->capture_default_str()
      ->check(examples::expects_at_least(1));
  app.add_option("--tolerance", s.tolerance,
                 "relative norm of the residual, or of the reduced gradient (radii)")
      ->capture_default_str()
      ->check(examples::expects_tolerance());
  app.add_option("--output", s.output,
                 "folder for coulomb.pvd with a VTU file per step (ParaView) and slip.png")
      ->check(examples::expects_name());
  return examples::run_program(app, argc, argv, [&] { return follow(s); });
}
