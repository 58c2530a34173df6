// SPDX-License-Identifier: MIT
//
// The dual problem of a Stokes flow with stick–slip walls [K (27), (28)]:
//
//     min ½ λᵀA λ − bᵀλ   over   |λ_t,i| ≤ ω_i g(x_i),  λ_n and p free,      λ = (λ_t, λ_n, p)
//
//     C = [ T ]      A = C A_κ⁻¹ Cᵀ + [ 0     ]      b = C A_κ⁻¹ l − [ 0 ]
//         [ N ]                       [   0   ]                      [ 0 ]
//         [ B ]                       [     E ]                      [ c ]
//
//     u = A_κ⁻¹ (l − Cᵀλ),   r(λ) = −(C u − (0, 0, E p + c))
//
// (In [K (28)] E and c stand in front; there the order of λ is another one than in the text above.)
// A is definite, although C has more rows than independent ones: E p = 0 leaves p constant, and a
// constant pressure works on the outflow.
//
// In these units the problem is badly scaled, for any method: an entry of p is a pressure and an
// entry of B u a flow through the patch of a node, so that A has eigenvalues of the order ν⁻¹h²,
// while those of the wall are of the order ν⁻¹. With λ = S μ, S = diag(√ν I, √ν I, √(ν/∫φ_i)), all
// are of the order 1: B A_κ⁻¹ Bᵀ + E is the mass matrix of the pressures over ν, up to constants
// that do not depend on h [Verfürth 1984]. `dual_units::balanced`, the default, solves for μ.
#pragma once

#include <slant/concepts/factorization.hpp>
#include <slant/operators/block_diagonal.hpp>
#include <slant/operators/declare.hpp>
#include <slant/operators/identity.hpp>
#include <slant/operators/inverse.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/operators/product.hpp>
#include <slant/operators/sum.hpp>
#include <slant/problems/separable_qp.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>

#include <fem/stokes_scene.hpp>

namespace fem {

/// Whether the unknowns of the dual problem are λ itself or μ, λ = S μ.
enum class dual_units : unsigned char { physical, balanced };

/// The solution in the units of the scene.
struct stokes_solution {
  Eigen::VectorXd u;           ///< velocities, n_u
  Eigen::VectorXd tangential;  ///< λ_t, a force per wall node, m
  Eigen::VectorXd normal;      ///< λ_n, m
  Eigen::VectorXd p;           ///< pressures, n_p
};

/// The dual problem of a scene, given factors of A_κ. Refers to the factors, not to the scene.
///
///     auto const factor = slant::factorize(scene.A);
///     fem::stokes_dual const dual(factor, scene);
///     auto const r = slant::solve(slant::symmetric_newton{dual.qp()}, dual.zero(), …);
///     auto const solution = dual.solution(r.x());
template <class Factorization>
  requires slant::factorization<Factorization, Eigen::VectorXd>
class stokes_dual {
 public:
  /// One solve with A_κ, for b.
  stokes_dual(Factorization const& factor, stokes_scene const& scene,
              dual_units units = dual_units::balanced)
      : factor_(&factor), l_(scene.l), m_(scene.wall_count()), n_p_(scene.pressure_count()) {
    bool const balanced = units == dual_units::balanced;
    S_ = Eigen::VectorXd::Constant(2 * m_ + n_p_, balanced ? std::sqrt(scene.viscosity) : 1);
    if (balanced) S_.tail(n_p_).array() /= scene.pressure_mass.array().sqrt();
    auto const S_p = S_.tail(n_p_).asDiagonal();
    E_ = S_p * scene.E * S_p;
    radii_ = scene.g.cwiseQuotient(S_.head(m_));
    stack(scene);

    Eigen::VectorXd u(l_.size());
    slant::apply(slant::inverse(*factor_), l_, u);
    b_ = C_ * u;
    b_.tail(n_p_) -= S_p * scene.c;
  }

  stokes_dual(Factorization const&&, stokes_scene const&,
              dual_units = dual_units::balanced) = delete;  // the factors would be gone

  /// A, never formed.
  [[nodiscard]] auto a() const& {
    return slant::declare<slant::positive_definite>(
        slant::sum(slant::congruence(C_, slant::inverse(*factor_)),
                   slant::block_diagonal(
                       slant::zero(2 * m_),
                       slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(E_))));
  }
  auto a() const&& = delete;
  /// Λ, in the units of μ.
  [[nodiscard]] auto set() const {
    // λ_n and p apart: methods that treat parts of a set alike should tell the two.
    return slant::cartesian(slant::intervals(radii_), slant::free_components(m_),
                            slant::free_components(n_p_));
  }
  /// The dual problem; refers to this object.
  [[nodiscard]] auto qp() const& { return slant::separable_qp{a(), b_, set()}; }
  auto qp() const&& = delete;
  [[nodiscard]] Eigen::VectorXd const& b() const& { return b_; }
  Eigen::VectorXd const& b() const&& = delete;
  /// S C, (2m + n_p) × n_u.
  [[nodiscard]] Eigen::SparseMatrix<double> const& constraints() const& { return C_; }
  Eigen::SparseMatrix<double> const& constraints() const&& = delete;
  /// diag(S).
  [[nodiscard]] Eigen::VectorXd const& units() const { return S_; }
  [[nodiscard]] Eigen::VectorXd zero() const { return Eigen::VectorXd::Zero(b_.size()); }

  /// u = A_κ⁻¹ (l − Cᵀλ) and the parts of λ = S μ: one solve. Throws std::invalid_argument unless
  /// μ has the size of the problem.
  [[nodiscard]] stokes_solution solution(Eigen::VectorXd const& μ) const {
    require(μ.size() == b_.size(), "mu", μ.size(), "one entry per unknown of the dual problem");
    Eigen::VectorXd const load = l_ - C_.transpose() * μ;
    Eigen::VectorXd u(load.size());
    slant::apply(slant::inverse(*factor_), load, u);
    Eigen::VectorXd const λ = S_.cwiseProduct(μ);
    return {std::move(u), λ.head(m_), λ.segment(m_, m_), λ.tail(n_p_)};
  }

 private:
  void stack(stokes_scene const& scene) {
    detail::triplets entries;
    Eigen::Index first = 0;
    for (auto const* part : {&scene.T, &scene.N, &scene.B}) {
      for (Eigen::Index j = 0; j < part->outerSize(); ++j)
        for (Eigen::SparseMatrix<double>::InnerIterator e(*part, j); e; ++e)
          entries.emplace_back(first + e.row(), j, S_[first + e.row()] * e.value());
      first += part->rows();
    }
    C_ = detail::assembled(first, l_.size(), entries);
  }

  Factorization const* factor_;
  Eigen::VectorXd l_;
  Eigen::Index m_;
  Eigen::Index n_p_;
  Eigen::VectorXd S_{};
  Eigen::SparseMatrix<double> C_{};
  Eigen::SparseMatrix<double> E_{};
  Eigen::VectorXd radii_{};
  Eigen::VectorXd b_{};
};

}  // namespace fem
