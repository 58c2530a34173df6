// SPDX-License-Identifier: MIT
//
// Semismooth Newton for u = W r + q with Coulomb friction, on the equations of friction_map
// with one ρ for each contact, 1/ρ = Λ, the mean diagonal of W of the contact:
//
//     (A + B (W + δ Λ)) dr = −F,    r ← r + β dr,   β = 1, ½, … until ‖F‖ falls enough.
//
// δ, a damping of the matrix alone, makes a singular system solvable; the step is then one of a
// proximal point method with the centre r, and its fixed points are those of δ = 0.
//
// Open contacts have dr = −F and leave the system: what is factored has the size of the contacts
// that are closed, full or sparse (block_lu).
#pragma once

#include <slant/base/entries.hpp>
#include <slant/base/lu.hpp>
#include <slant/contact/friction/friction_blocks.hpp>
#include <slant/sets/second_order_cone.hpp>
#include <slant/slanting/coulomb_law.hpp>

#include <Eigen/Core>
#include <Eigen/LU>
#include <Eigen/SparseCore>

#include <cstddef>
#include <vector>

namespace slant::contact {

// --- friction map --------------------------------------------------------------------------------
//
// The equations of one contact for Newton's method, F = 0, and their generalised derivative
// dF = A dr + B du by the chain rule, composed of parts of the library:
//
//     F = r − P_K(r − ρ û),  û de Saxcé's map of u,     A = I − G,   B = ρ G û°
//
// An open contact has G = 0: F = r, A = I, B = 0.

namespace detail {

/// F of one contact, and A and B where they were asked for.
template <int N, class S>
struct friction_map {
  using part_type = Eigen::Matrix<S, N, 1>;
  using block_type = Eigen::Matrix<S, N, N>;

  part_type F;
  block_type A, B;
  bool open = false;  ///< A = I, B = 0

  /// F at (r, u), with A, B and open if `derivative`.
  void look(S const& μ, S const& ρ, part_type const& r, part_type const& u, bool derivative) {
    using slant::detail::combination;
    de_saxce_block<N, S> const velocity(μ);
    second_order_cone<N, S> const cone(μ);
    part_type const z = combination(S(1), r, S(-ρ), velocity.value(u));
    F = combination(S(1), r, S(-1), cone.project(z));
    if (!derivative) return;
    B = cone.slant(z);
    open = slant::detail::all_zero(B);
    A = slant::detail::from_entries<block_type>(
        [&](int i, int j) -> S { return S(i == j ? 1 : 0) - B(i, j); });
    B = slant::detail::product_of(slant::detail::multiple_of(ρ, B), velocity.slant(u));
  }
};

// --- block lu ------------------------------------------------------------------------------------

/// What block_lu has factored.
struct block_lu_work {
  index factorizations = 0;  ///< matrices
  index rows = 0;            ///< of all of them together
  index sparse = 0;          ///< how many of them were sparse
};

/// LU factors of a matrix of N × N blocks that is assembled anew at every Newton step: a sparse LU,
/// which allocates, as does the assembly; of a small or full matrix a dense LU, which does not for
/// a size that it has seen.
template <int N, class S>
class block_lu {
 public:
  using vector_type = Eigen::VectorX<S>;
  using block_type = Eigen::Matrix<S, N, N>;

  /// assemble(put) calls put(i, j, block) for each of `count` blocks of a matrix of `rows` rows of
  /// blocks, once each. False if the matrix is singular, or has an entry that is not a number.
  template <class Assemble>
  [[nodiscard]] bool factor(index rows, index count, Assemble const& assemble) {
    index const n = N * rows;
    sparse_ = n > 48 && 8 * N * N * count <= n * n;
    ++work_.factorizations;
    work_.rows += n;
    work_.sparse += sparse_ ? 1 : 0;
    return sparse_ ? factor_sparse(n, count, assemble) : factor_dense(n, assemble);
  }
  /// x = M⁻¹ b; false if that is not finite.
  [[nodiscard]] bool solve(vector_type const& b, vector_type& x) const {
    x.resize(b.size());
    if (sparse_) {
      sparse_lu_.solve(b, x);
    } else {
      x = dense_lu_.solve(b);
    }
    return slant::detail::is_finite(S(x.norm()));
  }
  [[nodiscard]] block_lu_work const& work() const { return work_; }

 private:
  template <class Assemble>
  bool factor_dense(index n, Assemble const& assemble) {
    dense_.setZero(n, n);
    assemble([&](index i, index j, block_type const& b) {
      for (int c = 0; c < N; ++c) {
        for (int r = 0; r < N; ++r) dense_.coeffRef(N * i + r, N * j + c) = b.coeff(r, c);
      }
    });
    dense_lu_.compute(dense_);
    for (index i = 0; i < n; ++i) {
      S const pivot = dense_lu_.matrixLU()(i, i);
      if (pivot == S(0) || !slant::detail::is_finite(pivot)) return false;
    }
    return true;
  }
  template <class Assemble>
  bool factor_sparse(index n, index count, Assemble const& assemble) {
    triplets_.clear();
    triplets_.reserve(std::size_t(N * N * count));
    assemble([&](index i, index j, block_type const& b) {
      for (int c = 0; c < N; ++c) {
        for (int r = 0; r < N; ++r) {
          if (b(r, c) != S(0)) triplets_.emplace_back(int(N * i + r), int(N * j + c), b(r, c));
        }
      }
    });
    matrix_.resize(n, n);
    matrix_.setFromTriplets(triplets_.begin(), triplets_.end());
    return sparse_lu_.factor(matrix_);
  }

  bool sparse_ = false;
  block_lu_work work_;
  Eigen::MatrixX<S> dense_;
  Eigen::PartialPivLU<Eigen::MatrixX<S>> dense_lu_;
  std::vector<Eigen::Triplet<S>> triplets_;
  Eigen::SparseMatrix<S> matrix_;
  slant::detail::sparse_lu<S> sparse_lu_;
};

}  // namespace detail

// --- friction newton -----------------------------------------------------------------------------

/// Newton steps on a problem in blocks, to which it refers.
template <int N, scalar S = double>
class friction_newton {
 public:
  using blocks_type = friction_blocks<N, S>;
  using vector_type = typename blocks_type::vector_type;
  using part_type = typename blocks_type::part_type;
  using block_type = typename blocks_type::block_type;

  explicit friction_newton(blocks_type const& blocks)
      : blocks_(&blocks),
        weight_(blocks.contacts()),
        place_(std::size_t(blocks.contacts())),
        maps_(std::size_t(blocks.contacts())),
        F_(blocks.size()),
        u_(blocks.size()),
        direction_(blocks.size()),
        image_(blocks.size()),
        trial_(blocks.size()),
        trial_u_(blocks.size()) {
    for (index i = 0; i < blocks.contacts(); ++i) {
      auto const& d = blocks.diagonal(i);
      S const mean = slant::detail::sum_of<N>([&](int k) { return d(k, k); }) / S(N);
      weight_[i] = mean > S(0) ? mean : S(1);
    }
  }

  /// Directions so far; evaluations of F, a product by W each; and what was factored.
  [[nodiscard]] index steps() const { return steps_; }
  [[nodiscard]] index evaluations() const { return evaluations_; }
  [[nodiscard]] detail::block_lu_work const& factored() const { return lu_.work(); }

  /// F at r; also what `advance` starts from. Returns ‖F‖.
  S begin(vector_type const& r) {
    velocity(r, u_);
    F_norm_ = residual(r, u_);
    return F_norm_;
  }
  /// One step from r, for which `begin` or the last `advance` was called; false, and r unchanged,
  /// if there is no direction or no length that makes ‖F‖ fall.
  bool advance(vector_type& r, S const& δ) {
    constexpr index halvings = 8;
    ++steps_;
    differentiate(r);
    if (!find_direction(δ)) return false;
    blocks_->multiply(direction_, image_);
    ++evaluations_;
    S β = S(1);
    for (index k = 0; k <= halvings; ++k, β /= S(2)) {
      trial_ = r + β * direction_;
      trial_u_ = u_ + β * image_;
      S const now = residual(trial_, trial_u_);
      if (now <= (S(1) - S(1e-4) * β) * F_norm_) {
        r.swap(trial_);
        // u afresh: sums of images drift
        velocity(r, u_);
        F_norm_ = residual(r, u_);
        length_ = β;
        if (slant::detail::is_finite(F_norm_)) return true;
        r.swap(trial_);
        static_cast<void>(begin(r));
        return false;
      }
    }
    return false;
  }
  /// ‖F‖ at the point of the last begin or advance, and the length of the last step.
  [[nodiscard]] S residual_norm() const { return F_norm_; }
  [[nodiscard]] S length() const { return length_; }

 private:
  void velocity(vector_type const& r, vector_type& u) {
    blocks_->velocity(r, u);
    ++evaluations_;
  }
  [[nodiscard]] S rho(index i) const { return S(1) / weight_[i]; }

  S residual(vector_type const& r, vector_type const& u) {
    detail::friction_map<N, S> f;
    for (index i = 0; i < blocks_->contacts(); ++i) {
      f.look(blocks_->mu(i), rho(i), blocks_->part_of(r, i), blocks_->part_of(u, i), false);
      blocks_->put(f.F, i, F_);
    }
    return F_.norm();
  }
  void differentiate(vector_type const& r) {
    closed_.clear();
    for (index i = 0; i < blocks_->contacts(); ++i) {
      auto& f = maps_[std::size_t(i)];
      f.look(blocks_->mu(i), rho(i), blocks_->part_of(r, i), blocks_->part_of(u_, i), true);
      place_[std::size_t(i)] = f.open ? -1 : index(closed_.size());
      if (!f.open) closed_.push_back(i);
      for (int a = 0; a < N; ++a) direction_[N * i + a] = -f.F[a];
    }
  }

  /// The system of the closed contacts; direction_ holds −F of all.
  bool find_direction(S const& δ) {
    index const n = N * index(closed_.size());
    if (n == 0) return true;
    right_.resize(n);
    index entries = index(closed_.size());  // blocks; the diagonal first
    for (index k = 0; k < index(closed_.size()); ++k) {
      index const i = closed_[std::size_t(k)];
      part_type known = slant::detail::from_entries<part_type>([](int) { return S(0); });
      blocks_->for_row(i, [&](index j, block_type const& b) {
        if (place_[std::size_t(j)] < 0) {
          slant::detail::add_product(b, direction_.data() + N * j, known);
        } else {
          ++entries;
        }
      });
      part_type const moved = slant::detail::product_of(maps_[std::size_t(i)].B, known);
      for (int a = 0; a < N; ++a) right_[N * k + a] = direction_[N * i + a] - moved[a];
    }
    bool const good =
        lu_.factor(index(closed_.size()), entries, [&](auto put) { assemble(δ, put); });
    if (!good || !lu_.solve(right_, solution_)) return false;
    for (index k = 0; k < index(closed_.size()); ++k) {
      blocks_->put(blocks_->part_of(solution_, k), closed_[std::size_t(k)], direction_);
    }
    return true;
  }
  /// put(k, l, block) for every block of the system.
  template <class Put>
  void assemble(S const& δ, Put put) const {
    for (index k = 0; k < index(closed_.size()); ++k) {
      index const i = closed_[std::size_t(k)];
      auto const& f = maps_[std::size_t(i)];
      block_type d = blocks_->diagonal(i);
      for (int a = 0; a < N; ++a) d(a, a) += δ * weight_[i];
      d = slant::detail::product_of(f.B, d);
      put(k, k, slant::detail::combination(S(1), f.A, S(1), d));
      blocks_->for_row(i, [&](index j, block_type const& b) {
        index const l = place_[std::size_t(j)];
        if (l >= 0) put(k, l, slant::detail::product_of(f.B, b));
      });
    }
  }

  blocks_type const* blocks_;
  vector_type weight_;  // Λ: the mean diagonal of W of each contact (1 where that is 0)
  std::vector<index> place_, closed_;
  std::vector<detail::friction_map<N, S>> maps_;
  vector_type F_, u_, direction_, image_, trial_, trial_u_, right_, solution_;
  S F_norm_{}, length_{1};
  detail::block_lu<N, S> lu_;
  index steps_ = 0, evaluations_ = 0;
};

}  // namespace slant::contact
