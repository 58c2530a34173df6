// SPDX-License-Identifier: MIT
//
// Problems of the comparisons that are separable quadratic programs from the start, without a
// scene in contact: the wire, obstacle problems on n × n nodes, Stokes flow with a wall that slips.
//
// Each has a name, a size, what a linear solve takes as matrix and right-hand side, and a setup:
// all that a run makes for itself before its first iteration.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <fem/channel_flow.hpp>
#include <fem/incomplete_five_point.hpp>
#include <fem/stokes_dual.hpp>
#include <fem/string_1d.hpp>
#include <fem/wall_preconditioner.hpp>
#include <membranes/runs.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/operators/inverse.hpp>
#include <string>
#include <utility>

#include "peer_folder.hpp"

namespace benchmarks {

/// The wire over a plane and in a tube, 4m unknowns [T §4.1]; M is A⁻¹ by factorisation.
struct wire_case {
  static constexpr double l = 0, g = 1.4;
  std::string name = "wire";
  int size;  ///< m
  fem::wire<> wire = fem::make_wire(size);

  [[nodiscard]] Eigen::SparseMatrix<double> const& linear_matrix() const { return wire.A; }
  [[nodiscard]] Eigen::VectorXd const& linear_load() const { return wire.b; }

  class setup {
   public:
    explicit setup(wire_case const& c)
        : c_(&c),
          set_(slant::half_lines(Eigen::VectorXd::Constant(c.size, l).eval()),
               slant::discs(Eigen::VectorXd::Constant(c.size, g).eval()),
               slant::free_components(c.size)) {}
    [[nodiscard]] auto qp() const {
      return slant::separable_qp{
          slant::matrix<slant::self_adjoint, slant::positive_definite>(c_->wire.A), c_->wire.b,
          set_};
    }
    [[nodiscard]] auto preconditioner() const {
      return slant::inverse(slant::factorize(c_->wire.A));
    }
    /// Inner systems solved well, as suits a preconditioner that is A⁻¹ where nothing is active.
    static void adapt(slant::symmetric_newton_options<double>& o) {
      o.step_factor = 1;
      o.forcing = {.γ = 0.9, .exponent = 2, .η_max = 1e-4, .η_first = 1e-4, .goal = o.forcing.goal};
    }

   private:
    wire_case const* c_;
    decltype(slant::cartesian(slant::half_lines(Eigen::VectorXd()), slant::discs(Eigen::VectorXd()),
                              slant::free_components(1))) set_;
  };

  [[nodiscard]] separable_set bounds() const {
    separable_set s(4 * size);
    s.lower.head(size).setConstant(l);
    s.add_discs(size, Eigen::VectorXd::Constant(size, g));
    return s;
  }
};

/// torsion, bearing, lower_obstacle or double_obstacle; A is never stored, M an incomplete factor.
struct membrane_case {
  std::string name;
  int size;  ///< n
  fem::membrane<> membrane = membranes::make(name, {}, size, size);
  Eigen::SparseMatrix<double> A = membrane.A.matrix();

  [[nodiscard]] Eigen::SparseMatrix<double> const& linear_matrix() const { return A; }
  [[nodiscard]] Eigen::VectorXd const& linear_load() const { return membrane.b; }

  class setup {
   public:
    explicit setup(membrane_case const& c) : problem_(c.membrane) {}
    [[nodiscard]] auto qp() const { return problem_.qp(); }
    [[nodiscard]] auto preconditioner() const { return problem_.preconditioner(); }
    void adapt(slant::symmetric_newton_options<double>& o) const {
      o.step_length = 2 / problem_.sigma();
    }

   private:
    membranes::membrane_problem problem_;
  };

  [[nodiscard]] separable_set bounds() const {
    separable_set s(A.rows());
    s.lower = membrane.lower;
    s.upper = membrane.upper;
    return s;
  }
};

/// The flow past an obstacle on mesh 1 … 4, g = 10. The linear solve is one with A_κ, which is less
/// than a Stokes problem without friction takes.
struct stokes_case {
  std::string name = "stokes";
  int size;  ///< number of the mesh
  fem::stokes_flow flow;
  fem::stokes_scene scene = fem::make_stokes_scene(flow);

  [[nodiscard]] Eigen::SparseMatrix<double> const& linear_matrix() const { return scene.A; }
  [[nodiscard]] Eigen::VectorXd const& linear_load() const { return scene.l; }

  class setup {
   public:
    explicit setup(stokes_case const& c)
        : c_(&c), factor_(slant::factorize(c.scene.A)), dual_(factor_, c.scene) {}
    [[nodiscard]] auto qp() const { return dual_.qp(); }
    [[nodiscard]] auto preconditioner() const {
      return fem::wall_preconditioner(c_->flow.domain, c_->scene);
    }
    static void adapt(slant::symmetric_newton_options<double>&) {}
    [[nodiscard]] auto const& dual() const { return dual_; }
    [[nodiscard]] auto const& factor() const { return factor_; }

   private:
    using factor_type =
        decltype(slant::factorize(std::declval<Eigen::SparseMatrix<double> const&>()));
    stokes_case const* c_;
    factor_type factor_;
    fem::stokes_dual<factor_type> dual_;
  };

  /// In the balanced units of the dual problem.
  [[nodiscard]] separable_set bounds() const {
    auto const m = scene.wall_count();
    separable_set s(2 * m + scene.pressure_count());
    s.upper.head(m) = scene.g / std::sqrt(scene.viscosity);
    s.lower.head(m) = -s.upper.head(m);
    return s;
  }
};

}  // namespace benchmarks
