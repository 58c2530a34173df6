// SPDX-License-Identifier: MIT
//
// Contact with Coulomb friction through a sequence of load steps: a body is pressed down, dragged
// along and released from the drag. Quasi-static: in each step friction resists the increment of
// the slip, so the solution depends on the path, and what was dragged is held back.
#include <cmath>
#include <cstdio>
#include <fem/contact_field.hpp>
#include <fem/contact_vtu.hpp>
#include <fem/plots/slip_history_plot.hpp>
#include <limits>
#include <optional>
#include <slant/contact/contact_unknowns.hpp>
#include <slant/contact/coulomb.hpp>
#include <slant/contact/coulomb_newton.hpp>
#include <slant/contact/load_stepper.hpp>
#include <slant/contact/preconditioner.hpp>
#include <slant/factorizations/static_condensation.hpp>
#include <slant/io/vtu_series.hpp>
#include <support/command_line.hpp>

#include "scene.hpp"

namespace {

namespace contact = slant::contact;
using vector = Eigen::VectorXd;

struct settings {
  std::string model = "brick";
  int k = 6;
  double friction = 0.3;
  double across = std::numeric_limits<double>::quiet_NaN();  // second coefficient
  std::string method = "radii";
  int steps = 8;  // of each of the three phases
  double tolerance = 1e-8;
  std::filesystem::path output{};
};

void print_problem(settings const& s, coulomb::loaded_scene const& loaded) {
  auto const& scene = loaded.scene;
  std::printf("%s: pressed, dragged and released in %d load steps\n", loaded.title.c_str(),
              3 * s.steps);
  std::printf("  friction       %g", s.friction);
  if (!std::isnan(s.across)) std::printf(" along x, %g along y (orthotropic)", s.across);
  std::printf(" (Coulomb)\n  mesh           %td tetrahedra, %td unknowns\n",
              scene.mesh.cell_count(), scene.unknowns.count);
  std::printf("  contact        %td nodes\n\n", scene.contact_count());
  std::printf("  step   press   drag   open  stick   slip   products   status\n");
  std::fflush(stdout);
}

/// The coefficient in the direction of t: that of the ellipse with the semi-axes F¹, F².
double coefficient_along(Eigen::Vector2d const& t, double first, double second) {
  if (first == second || t.norm() == 0) return first;
  return first * second * t.norm() / std::hypot(second * t[0], first * t[1]);
}

/// Goes along the path. with_stepper(problem, K, go) calls go(stepper, to_lambda): a load_stepper
/// of the problem, and what makes (λ_ν, λ_t) of its solutions.
template <class WithStepper>
int follow(settings const& s, double across, WithStepper const& with_stepper) {
  if (!s.output.empty()) examples::make_folder("--output", s.output);
  auto const loaded = coulomb::make_scene(s.model, s.k);
  auto const& scene = loaded.scene;
  Eigen::Index const m = scene.contact_count();
  print_problem(s, loaded);

  vector const rest = vector::Zero(scene.f.size());
  contact::data<double> const data{scene.N, scene.T, rest, scene.d, scene.g};
  slant::static_condensation const factor(scene.K, contact::contact_unknowns(data));
  contact::dual problem(contact::friction_disc{}, factor, data);
  std::optional<slant::vtu_series> series;
  if (!s.output.empty()) {
    series.emplace(s.output / "coulomb.pvd");
  }
  std::vector<fem::slip_record> records;
  fem::contact_field<3> field;
  vector position = vector::Zero(2 * m);  // T u of the step before
  vector pressed = position;              // T u before the drag
  slant::index products = 0;
  bool good = true;
  with_stepper(problem, scene.K, [&](auto& stepper, auto const& to_lambda) {
    for (int i = 1; i <= 3 * s.steps && good; ++i) {
      double const time = static_cast<double>(i) / s.steps;
      auto const share = coulomb::share_at(time);
      auto const& step = stepper.advance(
          {.f = share.press * loaded.press + share.drag * loaded.drag, .w = position});
      good = step.converged();
      vector const λ = to_lambda(step.x());
      vector const u = problem.displacement(λ);
      vector bound(m);
      for (Eigen::Index j = 0; j < m; ++j) {
        bound[j] =
            std::fmax(λ[j], 0) * coefficient_along(λ.segment<2>(m + 2 * j), s.friction, across);
      }
      field = fem::make_contact_field(scene, {bound, position}, u, vector(λ.head(m)),
                                      vector(λ.tail(2 * m)));
      records.push_back({time, field.state});
      if (series) fem::write_contact_vtu(series->next(time), scene, field, u);
      position = scene.T * u;
      if (i == s.steps) pressed = position;
      products += step.work.operator_applications + step.work.setup_applications;
      std::printf("  %4d  %6.3f %6.3f  %5td  %5td  %5td  %9td   %s\n", i, share.press, share.drag,
                  field.count(fem::contact_state::open), field.count(fem::contact_state::stick),
                  field.count(fem::contact_state::slip), step.work.operator_applications,
                  slant::to_string(step.status).data());
      std::fflush(stdout);
    }
  });
  std::printf("\n  products       %td in all; K was factored once\n", products);
  // The loads of the last step are those before the drag: without friction nothing would be left.
  std::printf("  left behind    by the drag: slip of %.3g at most; friction of %.3g MPa at most\n",
              (position - pressed).cwiseAbs().maxCoeff(),
              field.friction.colwise().norm().maxCoeff());
  if (series) {
    series->write();
    std::printf("\nwrote %s\n", (s.output / "coulomb.pvd").c_str());
    auto const plot =
        fem::slip_history_plot(s.output / "slip.png", field, records,
                               loaded.title + ": pressed (1), dragged (2), released (3)");
    std::printf("%s\n", plot.message.c_str());
  }
  return good ? examples::succeeded : examples::not_converged;
}

constexpr slant::index most_steps = 200;

/// Newton's method for the whole law.
int follow_by_newton(settings const& s) {
  return follow(s, s.friction, [&](auto& problem, auto const&, auto const& go) {
    contact::coulomb_cones family(problem,
                                  vector::Constant(problem.zero().size() / 3, s.friction).eval());
    auto const F = contact::coulomb_residual(family, contact::residual_step(family).length);
    contact::load_stepper stepper(family, contact::coulomb_newton(F, s.tolerance),
                                  slant::residual_below(s.tolerance) || slant::at_most(most_steps));
    go(stepper, [&](vector const& x) { return family.by_directions(x); });
  });
}

/// Successive approximations over Tresca's problems; make_friction(m) makes m coefficients.
template <class MakeFriction>
int follow_by_radii(settings const& s, double across, MakeFriction const& make_friction) {
  return follow(s, across, [&](auto& problem, auto const& K, auto const& go) {
    contact::coulomb_radii family(problem, make_friction(problem.zero().size() / 3));
    auto const M = contact::lumped_preconditioner(K, problem.constraints());
    contact::load_stepper stepper(
        family, contact::coulomb(family, M, {.goal = s.tolerance}),
        slant::reduced_gradient_below(s.tolerance) || slant::at_most(most_steps));
    go(stepper, [](vector const& λ) { return λ; });
  });
}

int solve(settings const& s) {
  auto const all = [](Eigen::Index m, double F) { return vector::Constant(m, F).eval(); };
  if (!std::isnan(s.across)) {
    if (s.method == "newton") {
      throw slant::bad_input("--method", "newton", "radii, as --friction-across is given");
    }
    return follow_by_radii(s, s.across, [&](Eigen::Index m) {
      return contact::orthotropic_coefficients(all(m, s.friction), all(m, s.across));
    });
  }
  if (s.method == "newton") return follow_by_newton(s);
  return follow_by_radii(s, s.friction,
                         [&](Eigen::Index m) { return contact::coefficients(all(m, s.friction)); });
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("A body pressed, dragged and released, with Coulomb friction.", "coulomb");
  app.footer(std::string(examples::exit_status_help));
  settings s;
  auto const coefficient = [](double F) { return F >= 0 && std::isfinite(F); };
  app.add_option("--model", s.model, "brick (on a foundation) or bricks (two)")
      ->capture_default_str()
      ->check(examples::expects<std::string>("brick or bricks", [](std::string const& name) {
        return name == "brick" || name == "bricks";
      }));
  app.add_option("--cells", s.k, "k of the 3k x k x k cells, or of the k x (k-1) x (k-1) of each")
      ->capture_default_str()
      ->check(examples::expects_at_least(2));
  app.add_option("--friction", s.friction, "friction coefficient")
      ->capture_default_str()
      ->check(examples::expects<double>("a finite number >= 0", coefficient));
  app.add_option("--friction-across", s.across, "that along y, if it is another one (orthotropic)")
      ->check(examples::expects<double>("a finite number >= 0", coefficient));
  app.add_option("--method", s.method,
                 "radii (successive approximations) or newton (isotropic friction only)")
      ->capture_default_str()
      ->check(examples::expects<std::string>("radii or newton", [](std::string const& name) {
        return name == "radii" || name == "newton";
      }));
  app.add_option("--steps", s.steps, "load steps of each phase")
      ->capture_default_str()
      ->check(examples::expects_at_least(1));
  app.add_option("--tolerance", s.tolerance, "relative norm of the reduced gradient")
      ->capture_default_str()
      ->check(examples::expects_tolerance());
  app.add_option("--output", s.output,
                 "folder for coulomb.pvd with a VTU file per step (ParaView) and slip.png")
      ->check(examples::expects_name());
  return examples::run_program(app, argc, argv, [&] { return solve(s); });
}
