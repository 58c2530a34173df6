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

}  // namespace

int main(int argc, char** argv) {
  examples::command_line app("A body pressed, dragged and released, with Coulomb friction.",
                             "coulomb");
  settings s;
  auto const coefficient = examples::expects<double>(
      "a finite number >= 0", [](double F) { return F >= 0 && std::isfinite(F); });
  app.option("--model", s.model,
             "brick (on a foundation), bricks (two), or plates (two, in the plane)",
             examples::expects_one_of({"brick", "bricks", "plates"}));
  app.option("--cells", s.k,
             "k of the 3k x k x k cells, of the k x (k-1) x (k-1) of each brick, or of the\n"
             "3k x k of each plate",
             examples::expects_at_least(2));
  app.option("--friction", s.friction, "friction coefficient; its mean if it varies", coefficient);
  app.option("--friction-across", s.across,
             "that along y, if it is another one (orthotropic, in space)", coefficient);
  app.option(
      "--friction-variation", s.variation,
      "part of the mean by which coefficients grow along x: from 1 - v to 1 + v times "
      "the mean",
      examples::expects<double>("a number in [0, 1]", [](double v) { return v >= 0 && v <= 1; }));
  app.option("--method", s.method,
             "newton (isotropic friction only), radii (successive approximations), or coulomb: "
             "newton,\nand radii where that fails or cannot be",
             examples::expects_one_of({"coulomb", "newton", "radii"}));
  app.option("--steps", s.steps, "load steps of each phase", examples::expects_at_least(1));
  app.option("--tolerance", s.tolerance,
             "relative norm of the residual, or of the reduced gradient (radii)",
             examples::expects_tolerance());
  app.option("--output", s.output,
             "folder for coulomb.pvd with a VTU file per step (ParaView) and slip.png",
             examples::expects_name());
  return app.run(argc, argv, [&] { return follow(s); });
}
