// SPDX-License-Identifier: MIT
//
// Each method of the list below solves every scene from zero to the accuracy that it is asked for:
// its energy error against the reference is a small multiple of the tolerance, down to where digits
// end. So any two of them agree to the sum of their errors, and find the same active constraints.
#include <slant/slant.hpp>

#include <oracle/certificate.hpp>
#include <scenes/scene.hpp>
#include <support/testing.hpp>

namespace agreement_test {

using scenes::scene;

/// What a run leaves behind.
struct outcome {
  VectorXd x;
  bool converged;
  slant::index products;  ///< with A, those of the setup included
  std::string reason;
};

/// When a run ends: the tolerance is relative to the first error that the method sees.
struct limits {
  double tolerance;
  slant::index products;
};

auto qp_of(scene const& s) {
  return slant::separable_qp{s.A, s.b, s.set};
}
VectorXd zero(scene const& s) {
  return VectorXd::Zero(s.b.size());
}
auto rule(limits const& l) {
  return slant::reduced_gradient_below(l.tolerance) || slant::at_most_applications(l.products);
}
slant::index total(slant::work const& w) {
  return w.operator_applications + w.setup_applications;
}

/// A method that watches the reduced gradient.
template <class Method>
outcome run(Method const& method, scene const& s, limits const& l) {
  auto const r = slant::solve(method, zero(s), rule(l));
  return {r.x(), r.converged(), total(r.state.work), r.reason};
}

/// Told the goal, Newton's method does not solve its last step for digits that do not exist.
slant::symmetric_newton_options<double> newton_options(limits const& l) {
  slant::symmetric_newton_options<double> options;
  options.forcing.goal = l.tolerance;
  return options;
}

outcome symmetric_newton(scene const& s, limits const& l) {
  return run(slant::symmetric_newton{qp_of(s), newton_options(l)}, s, l);
}
outcome preconditioned_newton(scene const& s, limits const& l) {
  return run(slant::symmetric_newton{qp_of(s), s.M, newton_options(l)}, s, l);
}
/// The composition x − P(x − ρ (A x − b)); its iterates need not be feasible, their projection is.
outcome semismooth_newton(scene const& s, limits const& l) {
  auto const step = slant::mean_step(s.A, s.b, 0.5);
  auto const F = slant::natural_residual(s.A, s.b, s.set, step.length);
  auto const r =
      slant::solve(slant::semismooth_newton{F, slant::symmetrized_cg{}}, zero(s),
                   slant::residual_below(l.tolerance) || slant::at_most_applications(l.products));
  return {slant::project(s.set, r.x()), r.converged(), total(r.state.work) + step.applications,
          r.reason};
}
outcome interior_point(scene const& s, limits const& l) {
  return run(slant::interior_point{qp_of(s)}, s, l);
}
/// Two digits by the first, the rest by the second.
outcome interior_then_newton(scene const& s, limits const& l) {
  auto const r = slant::solve_then(
      slant::interior_point{qp_of(s)}, slant::reduced_gradient_below(1e-2) || slant::at_most(30),
      slant::symmetric_newton{qp_of(s), newton_options(l)}, zero(s), rule(l));
  return {r.x(), r.converged(), total(r.work()), r.reason()};
}
outcome kprgp(scene const& s, limits const& l) {
  return run(slant::kprgp{qp_of(s)}, s, l);
}
outcome as_s(scene const& s, limits const& l) {
  return run(slant::as_s(qp_of(s)), s, l);
}
outcome gimssn(scene const& s, limits const& l) {
  return run(slant::gimssn{qp_of(s)}, s, l);
}
outcome imssn(scene const& s, limits const& l) {
  return run(slant::imssn{qp_of(s)}, s, l);
}

/// A method and what is demanded of it: an energy error of at most `factor` times the tolerance,
/// within so many products for 1e-12.
struct demand {
  char const* name;
  outcome (*run)(scene const&, limits const&);
  double factor;
  slant::index products;
  slant::index sliding;  ///< products on scenes with slow_sliding
};

// The factors are not 1 because the reduced gradient is not the energy error: what it leaves along
// an eigenvector of A counts the more, the smaller the eigenvalue is. Newton's methods end with a
// step that leaves little of anything, gradient steps leave the smallest eigenvalues. A disc on
// which the body slides moves in KPRGP, GIMSSN and IMSSN by gradient steps alone, so there they
// have the same accuracy to show, but many more products to do it.
constexpr std::array demands{
    demand{"symmetric_newton", symmetric_newton, 20, 350, 250},
    demand{"symmetric_newton with a preconditioner", preconditioned_newton, 20, 350, 250},
    demand{"semismooth_newton", semismooth_newton, 20, 400, 350},
    demand{"interior_point", interior_point, 20, 850, 400},
    demand{"interior_point then symmetric_newton", interior_then_newton, 20, 650, 300},
    demand{"kprgp", kprgp, 50, 1100, 9000},
    demand{"as_s", as_s, 50, 1100, 9000},
    demand{"gimssn", gimssn, 50, 1400, 8000},
    demand{"imssn", imssn, 50, 1400, 17000},
};

TEST_CASE("all methods agree with the reference on all scenes") {
  auto const tolerances = test::effort<std::vector<double>>({1e-4, 1e-12}, {1e-8});
  for (auto const& s : scenes::all_scenes()) {
    SUBCASE(s.name.c_str()) {
      auto const exact = oracle::count_active(s.plain, s.exact);
      for (auto const& d : demands) {
        SUBCASE(d.name) {
          for (double const tolerance : tolerances) {
            CAPTURE(tolerance);
            auto const products = s.slow_sliding ? d.sliding : d.products;
            auto const r = d.run(s, {tolerance, products});
            CAPTURE(r.reason);
            CHECK(r.converged);
            CHECK(r.products <= products);
            CHECK(s.energy_error(r.x) <= d.factor * tolerance);
            if (tolerance > 1e-8) continue;  // no constraint changes sides for so little
            auto const active = oracle::count_active(s.plain, r.x.cast<oracle::real>());
            CHECK(active.intervals == exact.intervals);
            CHECK(active.circles == exact.circles);
          }
        }
      }
    }
  }
}

TEST_CASE("every reference is proved to be the solution of the problem that the methods get") {
  for (auto const& s : scenes::all_scenes()) {
    CAPTURE(s.name);
    auto const proof = oracle::certify(s.plain, s.exact);
    CHECK(proof.infeasibility <= 1e-16);
    // A bound by a square root, so half of the digits of the long type; the solution has all.
    CHECK(proof.energy_error < 1e-9);
    // A by other factors, or from other integrals: the rounding of a solve with K apart.
    VectorXd const x = s.exact.cast<double>();
    VectorXd image(x.size());
    slant::apply(s.A, x, image);
    VectorXd const plain = s.plain.A * x;
    CHECK((image - plain).norm() <= 1e-12 * plain.norm());
    CHECK((s.b - s.plain.b.cast<double>()).norm() <= 1e-12 * s.b.norm());
    VectorXd const z = x - s.plain.steps().cwiseProduct(image - s.b);
    CHECK((slant::project(s.set, z) - x).norm() <= 1e-12 * x.norm());
    auto const found = oracle::count_active(s.plain, s.exact);
    CHECK(found.margin > 1e-5);
    if (s.active) {
      CHECK(std::pair(found.intervals, found.circles) == *s.active);
    } else {
      int const active = found.intervals + found.circles;
      CHECK(active > 0);
      CHECK(active < static_cast<int>(s.plain.intervals.size() + s.plain.circles.size()));
    }
  }
}

}  // namespace agreement_test
