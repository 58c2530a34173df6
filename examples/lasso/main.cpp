// SPDX-License-Identifier: MIT
//
// The lasso: a signal of a few spikes from measurements with noise, for weights μ of ‖x‖₁ that fall
// from where x = 0 is nearly the solution. With more measurements than entries MᵀM is definite. With
// fewer it is singular wherever many entries are free, as they are on Newton's way for small μ;
// forward–backward splitting does not mind, and takes over there.
#include <cstdio>
#include <slant/methods/solve_program.hpp>
#include <support/command_line.hpp>

#include "sparse_signal.hpp"

namespace {

bool print_table(lasso::sight const& s, double tolerance) {
  bool good = true;
  double const largest = (s.M.transpose() * s.y).lpNorm<Eigen::Infinity>();
  std::printf("%td measurements of %td entries, %td of them spikes\n", s.M.rows(), s.M.cols(),
              (s.signal.array() != 0).count());
  std::printf("  μ/max  not zero  of spikes  steps  products  energy error  status     method\n");
  Eigen::VectorXd x;
  for (double const share : {0.5, 0.2, 0.1, 0.05, 0.02, 0.001}) {
    auto const run = slant::solve(lasso::program(s, share * largest), tolerance);
    auto const found = run.x().array() != 0;
    std::printf("%7g  %8td  %9td  %5td  %8td  %12.1e  %s  %s\n", share, found.count(),
                (found && s.signal.array() != 0).count(), run.iterations(),
                run.work.operator_applications + run.work.setup_applications, run.error.relative(),
                slant::to_string(run.status).data(), run.method.data());
    good = good && run.converged();
    if (share == 0.02) x = run.x();
  }
  std::printf("\n  place  signal  recovered with μ/max = 0.02\n");
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    if (x[i] != 0) std::printf("%7td  %6.2f  %9.4f\n", i, s.signal[i], x[i]);
  }
  std::printf("\n");
  return good;
}

int recover(double tolerance) {
  bool const tall = print_table(lasso::sparse_signal(220, 200, 12, 0.02), tolerance);
  bool const wide = print_table(lasso::sparse_signal(80, 400, 12, 0.02), tolerance);
  return tall && wide ? examples::succeeded : examples::not_converged;
}

}  // namespace

int main(int argc, char** argv) {
  examples::command_line app("Recovers sparse signals by the lasso, for six weights of the norm.",
                             "lasso");
  double tolerance = 1e-8;
  app.option("--tolerance", tolerance, "relative error in the energy norm",
             examples::expects_tolerance());
  return app.run(argc, argv, [&] { return recover(tolerance); });
}
