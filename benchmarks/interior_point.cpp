// SPDX-License-Identifier: MIT
//
// The work of the interior-point method on the model problems, in products with A:
//
//     interior_point brick [K...]      products and steps until the energy error is 1e-6, three
//                                      loads, without preconditioner, with the lumped and with the
//                                      Dirichlet one, beside [K] Table 3 for the same mesh
//     interior_point condition [K...]  condition numbers of J_SC and J_AM with and without
//                                      preconditioner at every iterate, brick and wire
//                                      (l = 0, g = 1.4, n = 1024), beside κ(A) κ(D)
//     interior_point crossover [K...]  lift to the last digits: interior point, symmetric Newton,
//                                      and the one after the other
//
// prints comma-separated values. Exit status 1 if a run does not converge or misses a limit: 30
// steps and 300 products; preconditioned condition numbers below κ(A) κ(D) at every iterate; with
// the Dirichlet preconditioner a crossover with fewer products than either method alone.

#include <slant/iteration/solve.hpp>
#include <slant/methods/interior_point.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/operators/matrix.hpp>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fem/steel_brick.hpp>
#include <fem/string_1d.hpp>
#include <optional>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>
#include <string>
#include <support/contact_problem.hpp>
#include <vector>

namespace {

using vector = Eigen::VectorXd;
using matrix = Eigen::MatrixXd;
using brick_problem = examples::contact_problem<3>;

/// [K] Table 3, by the number of displacements: Newton steps / products of PF(r_tol, c_fact).
struct printed_row {
  int k;
  char const *loose, *usual, *tight, *kprgp;
};
constexpr printed_row printed[] = {
    {4, "15/87", "14/92", "14/119", "187"},    {6, "13/85", "13/96", "12/105", "181"},
    {8, "15/91", "14/104", "15/130", "187"},   {10, "17/120", "15/116", "17/166", "203"},
    {12, "16/106", "15/116", "15/147", "230"}, {14, "17/121", "16/125", "16/151", "254"},
    {16, "18/130", "17/130", "17/175", "259"}};

brick_problem make_problem(int k, fem::brick_load load) {
  return brick_problem(fem::make_steel_brick({.k = k, .load = load}));
}

/// ‖λ − λ*‖_A / ‖λ*‖_A; its products are nobody's.
template <class QP>
class energy_error {
 public:
  energy_error(QP qp, vector exact) : qp_(qp), exact_(std::move(exact)), size_(energy(exact_)) {}

  [[nodiscard]] double operator()(vector const& λ) const { return energy(λ - exact_) / size_; }

 private:
  [[nodiscard]] double energy(vector const& d) const {
    vector image(d.size());
    auto w = slant::workspace(qp_.a(), d);
    slant::apply(qp_.a(), d, image, w);
    return std::sqrt(d.dot(image));
  }
  QP qp_;
  vector exact_;
  double size_;
};

/// Steps and products to an energy error of 1e-6, as cells of a line; whether within the limits.
/// The refresh that confirms success, and what was spent before, count as well.
template <class Method, class Error>
bool print_run(Method const& method, Error const& error, vector const& zero) {
  double now = 1;
  auto const accurate = slant::stop_when(
      [&](auto const& s) {
        now = error(s.x);
        return now <= 1e-6;
      },
      "energy error at most 1e-6", slant::status::converged);
  auto const r = slant::solve(method, zero, accurate || slant::at_most(100));
  auto const& work = r.state.work;
  auto const products = work.operator_applications + work.setup_applications;
  std::printf(",%td,%td,%.1e", r.iterations(), products, now);
  std::fflush(stdout);
  return r.converged() && r.iterations() <= 30 && products <= 300;
}

bool bricks(std::vector<int> const& sizes) {
  std::printf("load,k");
  for (auto const* name : {"plain", "lumped", "Dirichlet"}) {
    std::printf(",%s steps,%s products,%s error", name, name, name);
  }
  std::printf(",PF(.3;.99),PF(.1;.9),PF(.01;.99),KPRGP\n");
  bool good = true;
  for (auto const load : fem::brick_loads) {
    for (int const k : sizes) {
      auto const p = make_problem(k, load);
      auto const dirichlet = p.dirichlet();
      auto const exact = slant::solve(slant::symmetric_newton{p.qp(), dirichlet}, p.zero(),
                                      slant::reduced_gradient_below(1e-13) || slant::at_most(200));
      energy_error const error(p.qp(), exact.x());
      std::printf("%s,%d", fem::name_of(load).data(), k);
      good = exact.converged() && good;
      good = print_run(slant::interior_point{p.qp()}, error, p.zero()) && good;
      good = print_run(slant::interior_point{p.qp(), p.preconditioner()}, error, p.zero()) && good;
      good = print_run(slant::interior_point{p.qp(), dirichlet}, error, p.zero()) && good;
      auto const row = std::find_if(std::begin(printed), std::end(printed),
                                    [k](printed_row const& each) { return each.k == k; });
      if (row != std::end(printed)) {
        std::printf(",%s,%s,%s,%s\n", row->loose, row->usual, row->tight, row->kprgp);
      } else {
        std::printf(",,,,\n");
      }
    }
  }
  return good;
}

/// All of A, symmetric to the last bit.
template <class A>
matrix dense(A const& a) {
  matrix m(a.rows(), a.cols());
  vector y(a.rows());
  vector e = vector::Zero(a.cols());
  auto w = slant::workspace(a, e);
  for (Eigen::Index j = 0; j < m.cols(); ++j) {
    e[j] = 1;
    slant::apply(a, e, y, w);
    m.col(j) = y;
    e[j] = 0;
  }
  return (m + m.transpose()) / 2;
}

/// Largest over smallest modulus of an eigenvalue of a symmetric matrix.
double condition(matrix const& m) {
  vector const e =
      Eigen::SelfAdjointEigenSolver<matrix>(m, Eigen::EigenvaluesOnly).eigenvalues().cwiseAbs();
  return e.maxCoeff() / e.minCoeff();
}

/// κ of P_SC⁻¹J_SC, and of P_AM⁻¹J_AM, whose spectrum has 1 besides.
struct condition_pair {
  double sc, am;
};
condition_pair preconditioned(matrix const& J_SC, matrix const& P_SC) {
  matrix const L = P_SC.llt().matrixL();
  matrix half = L.triangularView<Eigen::Lower>().solve(J_SC);
  half = L.triangularView<Eigen::Lower>().solve(half.transpose().eval()).eval();
  vector const e =
      Eigen::SelfAdjointEigenSolver<matrix>((half + half.transpose()) / 2, Eigen::EigenvaluesOnly)
          .eigenvalues();
  double const least = e.minCoeff(), most = e.maxCoeff();
  return {most / least, std::max(most, 1.0) / std::min(least, 1.0)};
}

/// One line per iterate of a run with the dense matrix M. Rows and columns of J_AM are scaled such
/// that D₂₂ becomes I, which leaves the preconditioned spectrum as it is.
template <class Set>
bool conditions(char const* name, int size, matrix const& M, vector const& b, Set const& set) {
  auto const A = slant::matrix<slant::self_adjoint, slant::positive_definite>(M);
  slant::separable_qp const qp{A, b, set};
  double const κ_A = condition(M), κ_D = M.diagonal().maxCoeff() / M.diagonal().minCoeff();
  slant::interior_point const method{qp};
  auto s = method.start(vector(vector::Zero(b.size())));
  bool good = true;
  while (s.status == slant::status::running && s.iteration <= 60 &&
         s.reduced_gradient_norm > 1e-8 * s.gradient_scale) {
    auto barrier = s.barrier;
    barrier.assemble(set, s.x, s.multipliers, s.slacks, s.unit, s.diagonal);
    matrix const W = dense(barrier.stiffness()), J_SC = M + W;
    matrix P_SC = W;
    P_SC.diagonal() += M.diagonal();
    auto const n = M.rows(), m = barrier.rows();
    matrix J_AM = matrix::Zero(n + m, n + m);
    J_AM.topLeftCorner(n, n) = M + dense(barrier.curvature());
    vector y(m), e = vector::Zero(n);
    for (Eigen::Index j = 0; j < n; ++j) {
      e[j] = 1;
      barrier.jacobian().apply(e, y);
      J_AM.col(j).tail(m) = y;
      J_AM.row(j).tail(m) = y.transpose();
      e[j] = 0;
    }
    J_AM.diagonal().tail(m) = -(s.slacks.array() / (s.unit * s.multipliers.array())).matrix();
    auto const κ = preconditioned(J_SC, P_SC);
    std::printf("%s,%d,%td,%.3g,%.3g,%.3g,%.3g,%.3g\n", name, size, s.iteration, condition(J_SC),
                κ.sc, condition(J_AM), κ.am, κ_A * κ_D);
    std::fflush(stdout);
    good = good && κ.sc <= κ_A * κ_D && κ.am <= κ_A * κ_D;
    method.step(s);
  }
  return good && s.status == slant::status::running && s.iteration <= 60;
}

bool all_conditions(std::vector<int> const& sizes) {
  std::printf("problem,size,iterate,J_SC,P_SC^-1 J_SC,J_AM,P_AM^-1 J_AM,bound\n");
  bool good = true;
  for (int const k : sizes) {
    auto const p = make_problem(k, fem::brick_load::lift);
    auto const qp = p.qp();
    good = conditions("lift", k, dense(qp.a()), qp.b(), qp.set()) && good;
  }
  auto const wire = fem::make_wire(256);
  auto const set = slant::cartesian(slant::half_lines(vector::Zero(256).eval()),
                                    slant::discs(vector::Constant(256, 1.4).eval()),
                                    slant::free_components(256));
  return conditions("wire", 1024, matrix(wire.A), wire.b, set) && good;
}

/// One after the other for several tolerances of the handover, beside each alone; whether the best
/// of them takes fewer products than either.
/// newton(step_length) makes the second one; none: it has to find its own.
template <class Interior, class Newton>
bool crossover(char const* preconditioner, int k, Interior const& interior, Newton const& newton,
               vector const& zero) {
  auto const stop = slant::reduced_gradient_below(1e-14) || slant::at_most(200);
  auto const products = [](slant::work const& w) {
    return w.operator_applications + w.setup_applications;
  };
  auto const print = [&](char const* name, auto const& r, slant::index count) {
    std::printf("%s,%s,%d,%td,%td,%.1e\n", name, preconditioner, k, r.iterations(), count,
                r.state.reduced_gradient_norm / r.state.gradient_scale);
  };
  auto const a = slant::solve(interior, zero, stop);
  auto const b = slant::solve(newton(std::nullopt), zero, stop);
  auto const of_a = products(a.state.work), of_b = products(b.state.work);
  print("interior point", a, of_a);
  print("symmetric Newton", b, of_b);
  auto least = of_a + of_b;
  for (double const handover : {0.3, 0.2, 0.1, 0.05, 0.02, 1e-2, 1e-3, 1e-4, 1e-6}) {
    auto const r = slant::solve_then(
        interior, slant::reduced_gradient_below(handover) || slant::at_most(60),
        [&](auto const& s) { return newton(s.step_length); }, zero, stop);
    if (!r.second) continue;
    std::printf("crossover at %g,%s,%d,%td+%td,%td+%td,%.1e\n", handover, preconditioner, k,
                r.first.iterations(), r.second->iterations(), products(r.first.state.work),
                products(r.second->state.work),
                r.second->state.reduced_gradient_norm / r.second->state.gradient_scale);
    if (r.converged()) least = std::min(least, products(r.work()));
  }
  std::fflush(stdout);
  // Alone, the interior-point method may lose the last digits.
  return b.converged() && least < (a.converged() ? std::min(of_a, of_b) : of_b);
}

bool crossovers(std::vector<int> const& sizes) {
  std::printf("method,preconditioner,k,steps,products,reduced_gradient\n");
  bool good = true;
  for (int const k : sizes) {
    auto const p = make_problem(k, fem::brick_load::lift);
    auto const qp = p.qp();
    auto const S = p.dirichlet();
    auto const options = [](std::optional<double> step_length) {
      slant::symmetric_newton_options<double> o{.step_length = step_length};
      o.forcing.goal = 1e-14;
      return o;
    };
    auto const plain = [&](std::optional<double> step_length) {
      return slant::symmetric_newton{qp, options(step_length)};
    };
    auto const preconditioned = [&](std::optional<double> step_length) {
      return slant::symmetric_newton{qp, S, options(step_length)};
    };
    static_cast<void>(crossover("none", k, slant::interior_point{qp}, plain, p.zero()));
    good =
        crossover("Dirichlet", k, slant::interior_point{qp, S}, preconditioned, p.zero()) && good;
  }
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  std::string const what = argc > 1 ? argv[1] : "";
  std::vector<int> numbers;
  for (int i = 2; i < argc; ++i) numbers.push_back(std::atoi(argv[i]));
  auto const or_else = [&](std::vector<int> usual) { return numbers.empty() ? usual : numbers; };
  bool good = false;
  if (what == "brick") {
    good = bricks(or_else({4, 6, 8, 10, 12, 14, 16}));
  } else if (what == "condition") {
    good = all_conditions(or_else({4, 6, 8}));
  } else if (what == "crossover") {
    good = crossovers(or_else({4, 8, 12}));
  } else {
    std::fprintf(stderr,
                 "usage: interior_point brick [K...] | condition [K...] | crossover [K...]\n");
    return 2;
  }
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
