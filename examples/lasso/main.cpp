// SPDX-License-Identifier: MIT
//
// The lasso: a signal of a few spikes from measurements with noise, for weights μ of ‖x‖₁ that fall
// from where x = 0 is nearly the solution. With more measurements than entries MᵀM is definite, and
// Newton's method ends by a certificate of the error. With fewer it is singular wherever many
// entries are free, as they are on Newton's way; forward–backward splitting does not mind.
#include <cstdio>
#include <slant/methods/forward_backward.hpp>
#include <slant/methods/solve_program.hpp>
#include <support/command_line.hpp>

#include "sparse_signal.hpp"

namespace {

constexpr double shares[] = {0.5, 0.2, 0.1, 0.05, 0.02};

double largest_weight(lasso::sight const& s) {
  return (s.M.transpose() * s.y).lpNorm<Eigen::Infinity>();
}

void print_head(lasso::sight const& s, char const* method, char const* measure) {
  std::printf("%td measurements of %td entries, %td of them spikes: %s\n", s.M.rows(), s.M.cols(),
              (s.signal.array() != 0).count(), method);
  std::printf("  μ/max  not zero  of spikes  steps  products  %16s  status\n", measure);
}

void print_row(lasso::sight const& s, double share, Eigen::VectorXd const& x, slant::index steps,
               slant::work const& work, double accuracy, slant::status status) {
  auto const found = x.array() != 0;
  std::printf("%7g  %8td  %9td  %5td  %8td  %16.1e  %s\n", share, found.count(),
              (found && s.signal.array() != 0).count(), steps,
              work.operator_applications + work.setup_applications, accuracy,
              slant::to_string(status).data());
}

int recover(double tolerance) {
  bool good = true;
  auto const tall = lasso::sparse_signal(220, 200, 12, 0.02);
  print_head(tall, "symmetric_newton", "energy error");
  Eigen::VectorXd x;
  for (double const share : shares) {
    auto const run = slant::solve(lasso::program(tall, share * largest_weight(tall)), tolerance);
    print_row(tall, share, run.x(), run.iterations(), run.work, run.error.relative(), run.status);
    good = good && run.converged();
    x = run.x();
  }
  std::printf("\n  place  signal  recovered with the last μ\n");
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    if (x[i] != 0) std::printf("%7td  %6.2f  %9.4f\n", i, tall.signal[i], x[i]);
  }

  auto const wide = lasso::sparse_signal(80, 400, 12, 0.02);
  std::printf("\n");
  print_head(wide, "forward_backward", "reduced gradient");
  for (double const share : shares) {
    auto const program = lasso::program(wide, share * largest_weight(wide));
    auto const run =
        slant::solve(slant::forward_backward{program}, Eigen::VectorXd(Eigen::VectorXd::Zero(400)),
                     slant::reduced_gradient_below(tolerance) || slant::at_most(5000));
    print_row(wide, share, run.x(), run.iterations(), run.state.work,
              run.state.reduced_gradient_norm / run.state.gradient_scale, run.status);
    good = good && run.converged();
  }
  return good ? examples::succeeded : examples::not_converged;
}

}  // namespace

int main(int argc, char** argv) {
  examples::command_line app("Recovers sparse signals by the lasso, for five weights of the norm.",
                             "lasso");
  double tolerance = 1e-8;
  app.option("--tolerance", tolerance,
             "relative error in the energy norm; relative norm of the reduced gradient",
             examples::expects_tolerance());
  return app.run(argc, argv, [&] { return recover(tolerance); });
}
