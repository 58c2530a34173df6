// SPDX-License-Identifier: MIT
//
// Total variation on the line: a signal of five levels from one with noise, for five weights μ.
#include <cmath>
#include <cstdio>
#include <slant/methods/solve_program.hpp>
#include <support/command_line.hpp>

#include "steps_signal.hpp"

namespace {

namespace tv = total_variation;

int denoise(Eigen::Index n, double tolerance) {
  auto const signal = tv::steps_signal(n), y = tv::with_noise(signal, 0.5);
  auto const distance = [&](tv::vector const& x) {
    return (x - signal).norm() / std::sqrt(double(n));
  };
  std::printf("%td values, 4 jumps; root mean square of the noise %.4f\n\n", n, distance(y));
  std::printf("      μ  jumps  left of the noise  steps  products  energy error  status\n");
  bool good = true;
  for (double const share : {0.01, 0.03, 0.1, 0.3, 1.0}) {
    double const μ = share * std::sqrt(double(n));
    auto const run = slant::solve(tv::program(y, μ), tv::chains_inverse{n}, tolerance);
    good = good && run.converged();
    std::printf("%7.3f  %5td  %17.4f  %5td  %8td  %12.1e  %s\n", μ,
                (run.x().array().abs() == μ).count(), distance(tv::denoised(y, run.x())),
                run.iterations(), run.work.operator_applications + run.work.setup_applications,
                run.error.relative(), to_string(run.status).data());
  }
  return good ? examples::succeeded : examples::not_converged;
}

}  // namespace

int main(int argc, char** argv) {
  examples::command_line app("Removes noise by total variation, for five weights.",
                             "total_variation");
  Eigen::Index n = 2000;
  double tolerance = 1e-8;
  app.option("--values", n, "length of the signal",
             examples::expects<Eigen::Index>("an integer >= 3", [](auto k) { return k >= 3; }));
  app.option("--tolerance", tolerance, "relative error in the energy norm",
             examples::expects_tolerance());
  return app.run(argc, argv, [&] { return denoise(n, tolerance); });
}
