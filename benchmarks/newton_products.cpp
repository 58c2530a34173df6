// SPDX-License-Identifier: MIT
//
// The work of the symmetric Newton method on the model problems, in products with A:
//
//     newton_products brick [K...]   products until the energy error is 1e-8, three loads: without
//                                    and with a preconditioner, and nested (k/2 → k); for k ≤ 8 the
//                                    error that KPRGP, IMSSN and GIMSSN reach in 5000 products
//     newton_products wire [N]       Newton steps from zero and on each level of nested iteration
//
// prints comma-separated values. Exit status 1 if a run does not converge, or misses a limit: 250
// products, nested 120; 6 Newton steps on a level of the wire.

#include <slant/contact/optimality.hpp>
#include <slant/factorizations/ldlt.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/methods/mssn.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/operators/inverse.hpp>
#include <slant/operators/matrix.hpp>

#include <fem/active_counts.hpp>
#include <fem/steel_brick.hpp>
#include <fem/string_1d.hpp>
#include <fem/wire_counts.hpp>
#include <fem/wire_prolongation.hpp>
#include <support/contact_methods.hpp>
#include <support/problem_ladder.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

using vector = Eigen::VectorXd;
using brick_problem = examples::contact_problem<3>;

slant::symmetric_newton_options<double> with_goal(double goal) {
  slant::symmetric_newton_options<double> o;
  o.forcing.goal = goal;
  return o;
}

/// ‖λ − λ*‖_A / ‖λ*‖_A; its products are nobody's.
class energy_error {
 public:
  energy_error(brick_problem const& problem, vector exact)
      : problem_(&problem), exact_(std::move(exact)), size_(energy(exact_)) {}

  [[nodiscard]] double operator()(vector const& λ) const { return energy(λ - exact_) / size_; }

 private:
  [[nodiscard]] double energy(vector const& d) const {
    auto const qp = problem_->qp();
    vector image(d.size());
    auto w = slant::workspace(qp.a(), d);
    slant::apply(qp.a(), d, image, w);
    return std::sqrt(d.dot(image));
  }
  brick_problem const* problem_;
  vector exact_;
  double size_;
};

/// Runs a method from λ0 until the energy error is at most 1e-8 or the products are spent; prints
/// a row.
template <class Method>
bool run_brick(char const* load, int k, char const* name, Method const& method, vector const& λ0,
               energy_error const& error, slant::index most, bool must_converge) {
  double now = 1;
  auto const accurate = slant::stop_when(
      [&](auto const& s) {
        now = error(s.x);
        return now <= 1e-8;
      },
      "energy error at most 1e-8", slant::status::converged);
  auto const r = slant::solve(method, λ0, accurate || slant::at_most_applications(most));
  auto const& work = r.state.work;
  std::printf("%s,%d,%s,%td,%td,%td,%.1e\n", load, k, name, work.operator_applications,
              work.setup_applications, r.iterations(), now);
  std::fflush(stdout);
  return !must_converge || (r.converged() && work.operator_applications <= most);
}

bool bricks(std::vector<int> const& sizes) {
  std::printf("load,k,method,products,products_before,steps,energy_error\n");
  bool good = true;
  for (auto const load : fem::brick_loads) {
    auto problems = examples::make_ladder<3>(
        [load](int k) { return fem::make_steel_brick({.k = k, .load = load}); });
    char const* const name = fem::name_of(load).data();
    for (int const k : sizes) {
      auto const& p = problems.at(k);
      auto const exact = slant::solve(slant::symmetric_newton{p.qp(), p.preconditioner()}, p.zero(),
                                      slant::reduced_gradient_below(1e-14) || slant::at_most(200));
      good = exact.converged() && good;
      energy_error const error(p, exact.x());
      auto const o = with_goal(1e-11);
      good = run_brick(name, k, "Newton", slant::symmetric_newton{p.qp(), o}, p.zero(), error, 250,
                       true) &&
             good;
      slant::symmetric_newton const preconditioned{p.qp(), p.preconditioner(), o};
      good =
          run_brick(name, k, "Newton with M", preconditioned, p.zero(), error, 250, true) && good;
      auto const S = p.dirichlet();
      auto tight = o;
      tight.forcing.η_max = tight.forcing.η_first = 0.1;
      good = run_brick(name, k, "Newton with Dirichlet", slant::symmetric_newton{p.qp(), S, tight},
                       p.zero(), error, 250, true) &&
             good;
      if (k % 2 == 0) {
        auto const& coarse = problems.at(k / 2);
        auto const start =
            slant::solve(slant::symmetric_newton{coarse.qp(), coarse.preconditioner()},
                         coarse.zero(), slant::reduced_gradient_below(1e-8) || slant::at_most(200));
        auto const P = fem::contact_prolongation(coarse.scene(), p.scene());
        vector const λ0 = P * start.x();
        good = run_brick(name, k, "Newton with M nested", preconditioned, λ0, error, 120, true) &&
               good;
        good = run_brick(name, k, "Newton with Dirichlet nested",
                         slant::symmetric_newton{p.qp(), S, tight}, λ0, error, 120, true) &&
               good;
      }
      if (k > 8) continue;
      double const α = 1.9 / p.sigma();
      run_brick(name, k, "KPRGP", slant::kprgp{p.qp(), {.step_length = α}}, p.zero(), error, 5000,
                false);
      run_brick(name, k, "IMSSN", slant::imssn{p.qp(), {.step_length = α}}, p.zero(), error, 5000,
                false);
      run_brick(name, k, "GIMSSN", slant::gimssn{p.qp(), {.step_length = α}}, p.zero(), error, 5000,
                false);
    }
  }
  return good;
}

struct wire_run {
  slant::index steps;
  slant::index products;
  bool right;
  vector x;
};

/// Inner systems solved well, as suits a preconditioner that is A⁻¹ where nothing is active.
slant::symmetric_newton_options<double> wire_options() {
  slant::symmetric_newton_options<double> o;
  o.step_factor = 1;
  o.forcing = {.γ = 0.9, .exponent = 2, .η_max = 1e-4, .η_first = 1e-4};
  return o;
}

wire_run run_wire(fem::wire_counts const& row, std::size_t entry, vector const* start) {
  auto const m = static_cast<Eigen::Index>(row.m(entry));
  auto const wire = fem::make_wire(m);
  auto const set =
      slant::cartesian(slant::half_lines(vector::Constant(m, row.l).eval()),
                       slant::discs(vector::Constant(m, row.g).eval()), slant::free_components(m));
  slant::separable_qp const qp{slant::matrix<slant::self_adjoint, slant::positive_definite>(wire.A),
                               wire.b, set};
  vector x0 = vector::Zero(4 * m);
  if (start != nullptr)
    x0 = fem::wire_prolongation(fem::make_wire(static_cast<Eigen::Index>(row.m(entry - 1))), wire) *
         *start;
  auto r =
      slant::solve(slant::symmetric_newton{qp, slant::inverse(slant::ldlt(wire.A)), wire_options()},
                   x0, slant::reduced_gradient_below(1e-10) || slant::at_most(1000));
  bool const printed = row.bounds[entry] != fem::wire_counts::not_printed;
  bool const right =
      r.converged() && (!printed || fem::count_active(set, wire.A, wire.b, r.x()) ==
                                        fem::active_counts{row.bounds[entry], row.circles[entry]});
  return {r.iterations(), r.state.work.operator_applications, right, std::move(r.state.x)};
}

bool wires(int largest) {
  std::printf("l,g,n,steps_from_zero,products_from_zero,steps_nested,products_nested\n");
  bool good = true;
  for (auto const& row : fem::printed_wire_counts) {
    vector coarse;
    for (std::size_t e = 0; e < row.bounds.size() && row.unknowns(e) <= largest; ++e) {
      auto const from_zero = run_wire(row, e, nullptr);
      auto const nested = run_wire(row, e, e == 0 ? nullptr : &coarse);
      coarse = nested.x;
      std::printf("%g,%g,%d,%td,%td,%td,%td\n", row.l, row.g, row.unknowns(e), from_zero.steps,
                  from_zero.products, nested.steps, nested.products);
      good = good && from_zero.right && nested.right && nested.steps <= 6;
    }
  }
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  std::string const what = argc > 1 ? argv[1] : "";
  std::vector<int> numbers;
  for (int i = 2; i < argc; ++i) numbers.push_back(std::atoi(argv[i]));
  bool good = false;
  if (what == "brick") {
    good = bricks(numbers.empty() ? std::vector<int>{4, 6, 8, 12, 16} : numbers);
  } else if (what == "wire") {
    good = wires(numbers.empty() ? 2048 : numbers.front());
  } else {
    std::fprintf(stderr, "usage: newton_products brick [K...] | wire [N]\n");
    return 2;
  }
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
