// SPDX-License-Identifier: MIT
//
// The one place in which the program stokes calls a solver.
#pragma once

#include <chrono>
#include <fem/channel_flow.hpp>
#include <fem/stokes_dual.hpp>
#include <fem/wall_preconditioner.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/methods/interior_point.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <string>
#include <string_view>
#include <support/measured.hpp>
#include <support/named_method.hpp>
#include <tuple>
#include <utility>
#include <vector>

namespace stokes {

/// A flow, factors of A_κ, the dual problem and the preconditioner: what all methods share.
class flow_problem {
 public:
  explicit flow_problem(fem::stokes_flow const& flow)
      : scene_(fem::make_stokes_scene(flow)),
        factor_(slant::factorize(scene_.A)),
        dual_(factor_, scene_),
        preconditioner_(fem::wall_preconditioner(flow.domain, scene_)) {}
  flow_problem(flow_problem const&) = delete;
  flow_problem& operator=(flow_problem const&) = delete;

  [[nodiscard]] fem::stokes_scene const& scene() const { return scene_; }
  [[nodiscard]] auto const& factor() const { return factor_; }
  [[nodiscard]] auto const& dual() const { return dual_; }
  [[nodiscard]] auto qp() const { return dual_.qp(); }
  /// M ≈ A⁻¹.
  [[nodiscard]] auto const& preconditioner() const { return preconditioner_; }

 private:
  using factor_type =
      decltype(slant::factorize(std::declval<Eigen::SparseMatrix<double> const&>()));
  using preconditioner_type = decltype(fem::wall_preconditioner(
      std::declval<fem::planar_domain const&>(), std::declval<fem::stokes_scene const&>()));

  fem::stokes_scene scene_;
  factor_type factor_;
  fem::stokes_dual<factor_type> dual_;
  preconditioner_type preconditioner_;
};

/// The methods by name; a line here is all that a further one takes. With `goal`, the accuracy
/// asked for, Newton's last step is not solved too well.
[[nodiscard]] inline auto methods(double goal = 0) {
  slant::symmetric_newton_options<double> options;
  options.forcing.goal = goal;
  auto const newton = [options](flow_problem const& problem) {
    return slant::symmetric_newton{problem.qp(), problem.preconditioner(), options};
  };
  auto const plain_newton = [options](flow_problem const& problem) {
    return slant::symmetric_newton{problem.qp(), options};
  };
  auto const interior = [](flow_problem const& problem) {
    return slant::interior_point{problem.qp(), problem.preconditioner()};
  };
  auto const plain_interior = [](flow_problem const& problem) {
    return slant::interior_point{problem.qp()};
  };
  auto const active_set = [](flow_problem const& problem) { return slant::kprgp{problem.qp()}; };
  return std::tuple{examples::named_method{"newton", newton},
                    examples::named_method{"plain_newton", plain_newton},
                    examples::named_method{"interior_point", interior},
                    examples::named_method{"plain_interior_point", plain_interior},
                    examples::named_method{"active_set", active_set}};
}

/// "newton, … or active_set".
[[nodiscard]] inline std::string method_names() {
  std::vector<std::string> names;
  examples::for_each_method(methods(), [&](auto const& method) { names.push_back(method.name); });
  std::string list = names.front();
  for (std::size_t i = 1; i < names.size(); ++i)
    list += (i + 1 == names.size() ? " or " : ", ") + names[i];
  return list;
}

[[nodiscard]] inline bool is_method(std::string_view name) {
  bool found = false;
  examples::for_each_method(methods(),
                            [&](auto const& method) { found = found || method.name == name; });
  return found;
}

/// What a run leaves behind, whatever the method.
struct flow_run {
  examples::measured work{};
  std::string reason{};  ///< why it ended
  double accuracy = 0;   ///< relative norm of the reduced gradient
  double seconds = 0;
  Eigen::VectorXd dual{};  ///< the unknowns of the dual problem
};

/// Solves from zero by the method of that name.
[[nodiscard]] inline flow_run run(std::string_view name, flow_problem const& problem,
                                  examples::run_limits const& limits) {
  flow_run result;
  examples::for_each_method(methods(limits.tolerance), [&](auto const& method) {
    if (method.name != name) return;
    auto const start = std::chrono::steady_clock::now();
    auto const report =
        slant::solve(method.make(problem), problem.dual().zero(), method.stop(limits));
    result.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    result.work = examples::measure(report);
    result.reason = report.reason;
    result.accuracy = report.state.reduced_gradient_norm / report.state.gradient_scale;
    result.dual = report.x();
  });
  return result;
}

}  // namespace stokes
