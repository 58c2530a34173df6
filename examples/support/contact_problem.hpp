// SPDX-License-Identifier: MIT
//
// A contact scene ready to be solved by any method of the tables, from zero or by nested iteration.
#pragma once

#include <fem/contact_prolongation.hpp>
#include <fem/contact_scene.hpp>
#include <ranges>
#include <slant/contact/dual.hpp>
#include <slant/contact/preconditioners.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/iteration/nested.hpp>
#include <slant/krylov/spectrum.hpp>
#include <support/measured.hpp>
#include <support/named_method.hpp>
#include <type_traits>
#include <utility>
#include <vector>

namespace examples {

/// Tresca's law for bodies in D dimensions.
template <int D>
using tresca_friction =
    std::conditional_t<D == 2, slant::contact::friction_line, slant::contact::friction_disc>;

/// A scene, the factors of its stiffness, its dual problem and a bound σ of σ_max(A): all that does
/// not depend on the method.
template <int D>
class contact_problem {
 public:
  explicit contact_problem(fem::contact_scene<D> scene)
      : scene_(std::move(scene)),
        factor_(slant::factorize(scene_.K)),
        dual_(tresca_friction<D>{}, factor_,
              slant::contact::data<double>{scene_.N, scene_.T, scene_.f, scene_.d, scene_.g}),
        σ_(slant::largest_eigenvalue_bound(dual_.a(), dual_.zero()).upper) {}

  [[nodiscard]] fem::contact_scene<D> const& scene() const { return scene_; }
  [[nodiscard]] auto qp() const { return dual_.qp(); }
  [[nodiscard]] auto const& dual() const { return dual_; }
  [[nodiscard]] Eigen::VectorXd zero() const { return dual_.zero(); }
  [[nodiscard]] Eigen::VectorXd displacement(Eigen::VectorXd const& λ) const {
    return dual_.displacement(λ);
  }
  /// M ≈ A⁻¹.
  [[nodiscard]] auto preconditioner() const {
    return slant::contact::lumped_preconditioner(scene_.K, dual_.constraints());
  }
  /// A better M ≈ A⁻¹, which costs a factorisation.
  [[nodiscard]] auto dirichlet() const {
    return slant::contact::dirichlet_preconditioner(scene_.K, dual_.constraints());
  }
  /// An upper bound of σ_max(A).
  [[nodiscard]] double sigma() const { return σ_; }

 private:
  using factor_type =
      decltype(slant::factorize(std::declval<Eigen::SparseMatrix<double> const&>()));

  fem::contact_scene<D> scene_;
  factor_type factor_;
  slant::contact::dual<tresca_friction<D>, factor_type const&, double> dual_;
  double σ_;
};

/// A problem as a level of nested iteration, for one of the methods.
template <class Method, int D>
class contact_level {
 public:
  /// `coarse` is the problem of the level before, or null.
  contact_level(Method const& method, contact_problem<D> const& problem,
                contact_problem<D> const* coarse, run_limits const& limits)
      : method_(&method), problem_(&problem), limits_(limits) {
    if (coarse != nullptr) P_ = fem::contact_prolongation(coarse->scene(), problem.scene());
  }

  [[nodiscard]] auto method() const { return method_->make(*problem_); }
  [[nodiscard]] auto stop() const { return method_->stop(limits_); }
  [[nodiscard]] auto prolongation() const { return slant::matrix(P_); }

 private:
  Method const* method_;
  contact_problem<D> const* problem_;
  run_limits limits_;
  Eigen::SparseMatrix<double> P_{};
};

/// Solves a problem from zero.
template <class Method, int D, class... Observers>
[[nodiscard]] auto run_from_zero(Method const& method, contact_problem<D> const& problem,
                                 run_limits const& limits, Observers&&... observers) {
  return slant::solve(method.make(problem), problem.zero(), method.stop(limits), observers...);
}

/// Solves problem after problem, each from the prolonged solution of the one before.
template <class Method, int D>
[[nodiscard]] auto run_nested(Method const& method,
                              std::vector<contact_problem<D> const*> const& ladder,
                              run_limits const& limits) {
  auto const levels =
      std::views::iota(std::size_t(0), ladder.size()) | std::views::transform([&](std::size_t l) {
        return contact_level<Method, D>(method, *ladder[l], l == 0 ? nullptr : ladder[l - 1],
                                        limits);
      });
  return slant::solve_nested(levels, ladder.front()->zero());
}

}  // namespace examples
