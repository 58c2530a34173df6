// SPDX-License-Identifier: MIT
//
// A primal-dual interior-point method for Coulomb friction. In x = (μ r_n, r_t) = D⁻¹ r and
// s = (u_n/μ + ‖u_t‖, u_t), D = diag(1/μ, 1(, 1)), the problem of friction_problem.hpp is
//
//     p(x, s) = A x + b + ‖s_t‖ e − s = 0,    x, s ∈ L,    x ∘ s = 0,    A = D W D,  b = D q,
//
// with the Lorentz cone L and e = (1, 0) at each contact. For the convex problem, ‖s_t‖ given, see
// Acary, Armand, Nguyen and Shpakovych, "Second-order cone programming for frictional contact
// mechanics using interior point algorithm", 2024. Here ‖s_t‖ is linearised with the rest, so there
// is no outer iteration, and no symmetric system: E = I − e (s_t/‖s_t‖)ᵀ, T of lorentz_scaling.hpp,
//
//     A dx − E ds = −p,    λ ∘ (T dx + T⁻ᵀ ds) = c.
//
// c = −λ∘λ for the predictor dx, ds of length a, then −λ∘λ − a² (T dx)∘(T⁻ᵀ ds) + σγ e, γ the mean
// xᵀs of a contact (Mehrotra, 1992). What is solved: T = U Σ Vᵀ, and z is, direction by direction,
// dx where Σ is small (a free force) and −ds where it is large (a free velocity):
// dx = V D₁ z, ds = Tᵀ(λ\c) − V D₂ z with D₂ = Σ² D₁,
//
//     (A V D₁ + E V D₂) z = −p + E Tᵀ(λ\c),
//
// where no entry grows as γ → 0 and none is lost beside another. Two safeguards: α Λ dx, Λ the mean
// diagonal of A at a contact, is added after short steps, a proximal term that solves singular
// systems and leaves no bias; and until p is small the aim σγ is at least a part of the work of x
// on p, else x and s run into the boundary before, and stay there.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/iterative_method.hpp>
#include <slant/contact/friction_blocks.hpp>
#include <vector>

#include "lorentz_scaling.hpp"

namespace benchmarks {

/// No setting is of a problem: q and diag(W) are of the size of 1 in the units of friction_blocks.
struct interior_options {
  double tolerance = 1e-8;      ///< of friction_error, as in solve_friction
  Eigen::Index steps = 300;     ///< at most
  Eigen::Index patience = 100;  ///< steps without a smaller error until stalled
  double fraction = 0.99;       ///< of the way to the boundary
  double balance = 0.2;         ///< of the work of x on p, at least, is aimed at
  double largest_aim = 10;      ///< σ at most
  double proximal = 1e-3;       ///< first α; then × 3 after a short step, × ½ after a long one
};

struct interior_result {
  Eigen::VectorXd r{};  ///< the best forces, in the units of the blocks
  slant::status status = slant::status::running;
  Eigen::Index steps = 0;  ///< each is a factorisation, and two solutions
};

template <int N>
class friction_interior {
 public:
  using blocks_type = slant::contact::friction_blocks<N>;
  using vector = Eigen::VectorXd;

  /// Refers to the problem. Throws bad_input for μ = 0, a cone without inside.
  friction_interior(blocks_type const& problem, interior_options const& options)
      : problem_(&problem), options_(options), r_(problem.size()), u_(problem.size()) {
    full_ = size() <= 48 || 8 * N * N * problem.block_count() > size() * size();
    double b = 0, mean = 0;
    for (Eigen::Index i = 0; i < count(); ++i) {
      if (!(problem.mu(i) > 0)) throw slant::bad_input("mu", "0", "a number > 0");
      double const w = scaled(i, i, problem.diagonal(i)).trace() / N;
      weight_.push_back(w > 0 ? w : 1);
      mean += weight_.back() / double(count());
      part const q = scale(i).cwiseProduct(problem.q().template segment<N>(N * i));
      b = std::max(b, q.cwiseAbs().maxCoeff());
    }
    contacts_.assign(std::size_t(count()), contact(b / mean, b));
  }

  [[nodiscard]] interior_result run() {
    interior_result out{.r = vector::Zero(size())};
    if (problem_->q_norm() == 0) out.status = slant::status::converged;
    double best = std::numeric_limits<double>::infinity();
    for (Eigen::Index idle = 0; out.status == slant::status::running;) {
      evaluate();
      auto const e = problem_->error(r_, u_);
      double const error = e.worst();
      if (error < best) out.r = r_;
      idle = error <= 0.9 * best ? 0 : idle + 1;
      best = std::min(best, error);
      if (e.at_most(options_.tolerance)) {
        out.status = slant::status::converged;
      } else if (out.steps >= options_.steps) {
        out.status = slant::status::iteration_limit;
      } else if (idle > options_.patience) {
        out.status = slant::status::stalled;
      } else if (++out.steps; !step()) {
        out.status = slant::status::breakdown;
      }
    }
    return out;
  }

 private:
  using part = typename lorentz<N>::part;
  using block = typename lorentz<N>::block;

  struct contact {
    contact(double x0, double s0) : at(x0, s0) {}
    lorentz_scaling<N> at;
    part x, s, p;  ///< of the problem at the top of this file
    part aim;      ///< λ \ c
    part dx, ds;   ///< T dx and T⁻ᵀ ds
    part D1, D2;
    block E;
  };

  [[nodiscard]] Eigen::Index count() const { return problem_->contacts(); }
  [[nodiscard]] Eigen::Index size() const { return problem_->size(); }
  /// Diagonal of D.
  [[nodiscard]] part scale(Eigen::Index i) const {
    part D = part::Ones();
    D[0] = 1 / problem_->mu(i);
    return D;
  }
  [[nodiscard]] block scaled(Eigen::Index i, Eigen::Index j, block const& b) const {
    return scale(i).asDiagonal() * b * scale(j).asDiagonal();
  }
  /// f(contact, i) for all of them.
  template <class F>
  void each(F const& f) {
    for (Eigen::Index i = 0; i < count(); ++i) f(contacts_[std::size_t(i)], i);
  }

  /// r, u, p, γ, and the matrices of the linearised equations at x and s.
  void evaluate() {
    each([&](contact& c, Eigen::Index i) {
      c.x = c.at.x();
      c.s = c.at.s();
      r_.template segment<N>(N * i) = scale(i).cwiseProduct(c.x);
    });
    problem_->velocity(r_, u_);
    γ_ = 0;
    each([&](contact& c, Eigen::Index i) {
      auto const slip = c.s.template tail<N - 1>();
      double const speed = slip.norm(), w = weight_[std::size_t(i)];
      c.p = scale(i).cwiseProduct(u_.template segment<N>(N * i)) - c.s;
      c.p[0] += speed;
      c.E.setIdentity();
      if (speed > 0) c.E.row(0).template tail<N - 1>() -= slip.transpose() / speed;
      c.D1 = (w / c.at.Σ().array().square()).min(1.0);
      c.D2 = c.at.Σ().array().square().min(w);
      γ_ += c.at.λ().squaredNorm() / double(count());
    });
  }

  /// False if there is no direction.
  bool step() {
    if (!factor()) return (α_ = std::max(10 * α_, options_.proximal)) < 1;
    each([](contact& c, Eigen::Index) { c.aim = -c.at.λ(); });
    double const a = std::min(1.0, find_direction());
    if (!(a > 0)) return false;
    double after = 0, work = 0, p = 0;
    each([&](contact& c, Eigen::Index) {
      after += (c.at.λ() + a * c.dx).dot(c.at.λ() + a * c.ds) / double(count());
      work += c.p.norm() * c.x.norm() / double(count());
      p += c.p.squaredNorm();
    });
    double σ = std::pow(std::clamp(after / γ_, 0.0, 1.0), 2);
    if (std::sqrt(p) > 0.01 * options_.tolerance * problem_->q_norm()) {
      σ = std::max(σ, std::min(options_.largest_aim, options_.balance * work / γ_));
    }
    each([&](contact& c, Eigen::Index) {
      part second = a * a * lorentz<N>::product(c.dx, c.ds);
      second[0] -= σ * γ_;
      c.aim = -c.at.λ() - lorentz<N>::quotient(second, c.at.λ());
    });
    double const t = std::min(1.0, options_.fraction * find_direction());
    if (!(t > std::numeric_limits<double>::epsilon())) return false;
    each([&](contact& c, Eigen::Index) { c.at.move(t * c.dx, t * c.ds); });
    if (t < 0.1) α_ = std::max(3 * α_, options_.proximal);
    if (t > 0.5) α_ = α_ > 1e-14 ? α_ / 2 : 0;
    return true;
  }

  /// The factors of A V D₁ + E V D₂, with α.
  bool factor() {
    auto const assemble = [&](auto const& put) {
      each([&](contact& c, Eigen::Index i) {
        block d = scaled(i, i, problem_->diagonal(i));
        d.diagonal().array() += α_ * weight_[std::size_t(i)];
        put(i, i, block(d * c.at.V() * c.D1.asDiagonal() + c.E * c.at.V() * c.D2.asDiagonal()));
        problem_->for_row(i, [&](Eigen::Index j, block const& b) {
          auto const& other = contacts_[std::size_t(j)];
          put(i, j, block(scaled(i, j, b) * other.at.V() * other.D1.asDiagonal()));
        });
      });
    };
    if (full_) {
      Eigen::MatrixXd M = Eigen::MatrixXd::Zero(size(), size());
      assemble([&](auto i, auto j, block const& b) { M.template block<N, N>(N * i, N * j) = b; });
      dense_.compute(M);
      return true;
    }
    std::vector<Eigen::Triplet<double>> entries;
    assemble([&](auto i, auto j, block const& b) {
      for (int k = 0; k < N * N; ++k) {
        entries.emplace_back(int(N * i) + k % N, int(N * j) + k / N, b(k % N, k / N));
      }
    });
    Eigen::SparseMatrix<double> M(size(), size());
    M.setFromTriplets(entries.begin(), entries.end());
    sparse_.compute(M);
    return sparse_.info() == Eigen::Success;
  }

  /// dx and ds for the aim, and how far it is to the boundary; 0 if they are no numbers.
  double find_direction() {
    vector right(size());
    each([&](contact& c, Eigen::Index i) {
      right.template segment<N>(N * i) = -c.p + c.E * c.at.adjoint(c.aim);
    });
    vector const z = full_ ? vector(dense_.solve(right)) : vector(sparse_.solve(right));
    if (!z.allFinite()) return 0;
    double length = std::numeric_limits<double>::infinity();
    each([&](contact& c, Eigen::Index i) {
      part const y = c.D1.cwiseProduct(z.template segment<N>(N * i));
      c.dx = c.at.U() * c.at.Σ().cwiseProduct(y);
      c.ds = c.aim - c.dx;
      length = std::min(length, c.at.length(c.dx, c.ds));
    });
    return length;
  }

  blocks_type const* problem_;
  interior_options options_;
  std::vector<contact> contacts_{};
  std::vector<double> weight_{};
  vector r_, u_;
  double γ_ = 0, α_ = 0;
  bool full_ = true;
  Eigen::PartialPivLU<Eigen::MatrixXd> dense_{};
  Eigen::SparseLU<Eigen::SparseMatrix<double>> sparse_{};
};

}  // namespace benchmarks
