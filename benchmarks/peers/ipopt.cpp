// SPDX-License-Identifier: MIT
//
// IPOPT on a problem that bench_*_precision has exported, with exact second derivatives:
//
//     peer_ipopt FOLDER [--tolerances LIST] [--repeats N] [--limit S]
//
//     min ½ xᵀA x − bᵀx,   lower ≤ x ≤ upper,   ½ (x_j² + x_{j+1}²) ≤ ½ r² for each disc
//
// The tolerance is IPOPT's `tol`, and all tolerances of its own scaling follow it. The problem is
// brought to units in which diag(A) is about 1 and b is about 1, which IPOPT's absolute tolerances
// expect. Linear solver: the one it comes with (MUMPS in Debian).

#include <coin/IpoptConfig.h>
#include <coin/IpIpoptApplication.hpp>
#include <coin/IpTNLP.hpp>

#include <cmath>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "../support/arguments.hpp"
#include "peer_case.hpp"

namespace {

using namespace benchmarks;
using Ipopt::Index, Ipopt::Number;
using vector = Eigen::VectorXd;

/// Scaled by x = σ y and q/θ: θ = b·b-like energy, so that gradients are of order 1.
class quadratic_program : public Ipopt::TNLP {
 public:
  quadratic_program(peer_case const& c, double deadline) : c_(&c), deadline_(deadline) {
    double const diagonal =
        c.is_dense ? c.dense.diagonal().mean() : vector(c.sparse.diagonal()).mean();
    σ_ = c.problem.b.lpNorm<Eigen::Infinity>() / diagonal;
    θ_ = 1 / (diagonal * σ_ * σ_);
    for (Eigen::Index j = 0; j < c.size(); ++j) {
      if (c.is_dense) {
        for (Eigen::Index i = j; i < c.size(); ++i) add(i, j, c.dense(i, j));
      } else {
        for (Eigen::SparseMatrix<double>::InnerIterator e(c.sparse, j); e; ++e)
          if (e.row() >= j) add(e.row(), j, e.value());
      }
    }
    entries_of_A_ = values_.size();
    for (Eigen::Index i = 0; i < discs(); ++i)
      for (int part = 0; part < 2; ++part) add(first(i) + part, first(i) + part, 1);
  }
  [[nodiscard]] vector const& solution() const { return x_; }
  [[nodiscard]] bool late() const { return late_; }
  [[nodiscard]] Eigen::Index steps() const { return steps_; }

  bool get_nlp_info(Index& n, Index& m, Index& jacobian, Index& hessian,
                    IndexStyleEnum& style) override {
    n = static_cast<Index>(c_->size());
    m = static_cast<Index>(discs());
    jacobian = 2 * m;
    hessian = static_cast<Index>(values_.size());
    style = C_STYLE;
    return true;
  }
  bool get_bounds_info(Index n, Number* lower, Number* upper, Index m, Number* from,
                       Number* to) override {
    for (Index i = 0; i < n; ++i) {
      lower[i] = std::max(-2e19, c_->problem.set.lower[i] / σ_);
      upper[i] = std::min(2e19, c_->problem.set.upper[i] / σ_);
    }
    for (Index i = 0; i < m; ++i) {
      from[i] = -2e19;
      to[i] = std::pow(c_->problem.set.disc_radius[i] / σ_, 2) / 2;
    }
    return true;
  }
  bool get_starting_point(Index n, bool, Number* x, bool, Number*, Number*, Index, bool,
                          Number*) override {
    std::fill_n(x, n, 0.0);
    return true;
  }
  bool eval_f(Index n, Number const* x, bool, Number& q) override {
    vector const y = at(n, x);
    q = θ_ * (y.dot(c_->times(y)) / 2 - c_->problem.b.dot(y));
    return true;
  }
  bool eval_grad_f(Index n, Number const* x, bool, Number* gradient) override {
    Eigen::Map<vector>(gradient, n) = θ_ * σ_ * (c_->times(at(n, x)) - c_->problem.b);
    return true;
  }
  bool eval_g(Index, Number const* x, bool, Index m, Number* g) override {
    for (Index i = 0; i < m; ++i)
      g[i] = (std::pow(x[first(i)], 2) + std::pow(x[first(i) + 1], 2)) / 2;
    return true;
  }
  bool eval_jac_g(Index, Number const* x, bool, Index m, Index, Index* row, Index* column,
                  Number* values) override {
    for (Index i = 0; i < m; ++i)
      for (Index part = 0; part < 2; ++part) {
        auto const j = static_cast<Index>(first(i)) + part;
        if (values == nullptr) {
          row[2 * i + part] = i;
          column[2 * i + part] = j;
        } else {
          values[2 * i + part] = x[j];
        }
      }
    return true;
  }
  bool eval_h(Index, Number const*, bool, Number factor, Index m, Number const* multiplier, bool,
              Index, Index* row, Index* column, Number* values) override {
    if (values == nullptr) {
      std::copy(rows_.begin(), rows_.end(), row);
      std::copy(columns_.begin(), columns_.end(), column);
      return true;
    }
    for (std::size_t e = 0; e < entries_of_A_; ++e) values[e] = factor * θ_ * σ_ * σ_ * values_[e];
    for (Index i = 0; i < 2 * m; ++i)
      values[static_cast<Index>(entries_of_A_) + i] = multiplier[i / 2];
    return true;
  }
  void finalize_solution(Ipopt::SolverReturn, Index n, Number const* x, Number const*,
                         Number const*, Index, Number const*, Number const*, Number,
                         Ipopt::IpoptData const*, Ipopt::IpoptCalculatedQuantities*) override {
    x_ = at(n, x);
  }
  bool intermediate_callback(Ipopt::AlgorithmMode, Index step, Number, Number, Number, Number,
                             Number, Number, Number, Number, Index, Ipopt::IpoptData const*,
                             Ipopt::IpoptCalculatedQuantities*) override {
    steps_ = step;
    late_ = cpu_seconds() > deadline_;
    return !late_;
  }

 private:
  [[nodiscard]] Eigen::Index discs() const { return c_->problem.set.disc_first.size(); }
  [[nodiscard]] Eigen::Index first(Eigen::Index i) const {
    return static_cast<Eigen::Index>(c_->problem.set.disc_first[i]);
  }
  [[nodiscard]] vector at(Index n, Number const* x) const {
    return σ_ * Eigen::Map<vector const>(x, n);
  }
  void add(Eigen::Index i, Eigen::Index j, double value) {
    rows_.push_back(static_cast<Index>(i));
    columns_.push_back(static_cast<Index>(j));
    values_.push_back(value);
  }

  peer_case const* c_;
  double deadline_;
  double σ_ = 1;
  double θ_ = 1;
  std::vector<Index> rows_{}, columns_{};
  std::vector<double> values_{};  ///< of A, then of the discs
  std::size_t entries_of_A_ = 0;
  vector x_{};
  bool late_ = false;
  Eigen::Index steps_ = 0;
};

outcome solve(peer_case const& c, request const& asked) {
  Ipopt::SmartPtr<quadratic_program> const problem = new quadratic_program(c, asked.deadline);
  Ipopt::SmartPtr<Ipopt::IpoptApplication> const app = new Ipopt::IpoptApplication();
  auto const& options = app->Options();
  options->SetIntegerValue("print_level", 0);
  options->SetStringValue("sb", "yes");
  options->SetNumericValue("tol", asked.tolerance);
  for (char const* name : {"dual_inf_tol", "constr_viol_tol", "compl_inf_tol"})
    options->SetNumericValue(name, asked.tolerance);
  options->SetNumericValue("acceptable_tol", asked.tolerance);
  options->SetNumericValue("bound_relax_factor", std::min(1e-8, asked.tolerance));
  options->SetStringValue("nlp_scaling_method", "none");
  options->SetStringValue("mu_strategy", "adaptive");
  options->SetIntegerValue("max_iter", 1000);
  options->SetStringValue("hessian_constant", c.has_discs() ? "no" : "yes");
  if (app->Initialize() != Ipopt::Solve_Succeeded) return {c.problem.b, 0, "failed"};
  auto const status = app->OptimizeTNLP(problem);
  outcome result{problem->solution(), problem->steps(), "stalled"};
  if (status == Ipopt::Solve_Succeeded) result.status = "converged";
  if (problem->late()) result.status = "time_limit";
  if (result.x.size() != c.size()) result.x = vector::Zero(c.size());
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    arguments const given(argc, argv, {"tolerances", "repeats", "limit"});
    if (given.words().empty()) throw std::invalid_argument("usage: peer_ipopt FOLDER");
    peer_case const c(given.words()[0]);
    std::fprintf(stderr, "IPOPT %s, linear solver MUMPS, adaptive barrier\n", IPOPT_VERSION);
    auto how = given.how();
    how.before = c.seconds_elsewhere();
    measure_method(
        {.library = "IPOPT", .method = "ipopt", .formulation = c.formulation()}, c.problem.labels,
        how, [&](request const& asked) { return solve(c, asked); },
        [&](vector const& x) { return c.error(x); });
  } catch (std::exception const& failure) {
    std::fprintf(stderr, "peer_ipopt: %s\n", failure.what());
    return 2;
  }
}
