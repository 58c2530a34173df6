// SPDX-License-Identifier: MIT
//
// Elastic bodies in frictionless contact with each other and with rigid obstacles, prepared for the
// Schur complement algorithm [D]:
//
//     minimise   ½ uᵀK u − fᵀu   over   B u ≤ c,      K = diag(K₁, …, K_p) positive semidefinite
//
// Bodies are the connected components of the graph of K; they may float, which nobody has to know.
//
//     idle bodies    no row of B touches them, and K_i is definite: solved once, here; no iteration
//                    sees them
//     inside         of the others, U: the unknowns that no row of B touches, one factor per body
//     fixing rows    where K_i is singular even on those (a body that nothing holds along a contact
//                    plane, or with too few contact nodes), as many unknowns as the kernel has
//                    dimensions are left out of U, those of factorizations/kernel_basis.hpp, so
//                    that UᵀKU is definite; conjugate gradients find out about the rest. Where
//                    rounding errors hide the kernel (chains of hinges), the body has no U
//
// Rows with an infinite bound never act and touch nothing.
#pragma once

#include <slant/base/matrix_entries.hpp>
#include <slant/contact/node_layout.hpp>
#include <slant/contact/parts/prepared_body.hpp>
#include <slant/factorizations/conjugate_projector.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/problems/polyhedral_qp.hpp>

#include <Eigen/SparseCore>

#include <cstddef>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace slant::contact {

/// The problem of the top of this file. Not movable: what qp() refers to is here.
///
///     slant::contact::bodies problem(K, f, B, c);
///     auto r = slant::solve(slant::schur_contact{problem.qp()}, problem.zero(), …);
///     auto u = problem.displacement(r.x());
///     auto λ = r.state.multipliers();                       // K u + Bᵀλ = f
template <class S, class Factor = factor_by_ldlt>
class bodies {
 public:
  using vector_type = Eigen::VectorX<S>;
  using sparse_type = Eigen::SparseMatrix<S>;
  using factors = std::remove_cvref_t<decltype(std::declval<Factor const&>()(
      std::declval<sparse_type const&>()))>;

  /// Throws bad_input if sizes do not match, K is not symmetric, its diagonal shows that it is not
  /// semidefinite, or a number is not finite (c may be +infinity).
  template <class M, class N>
  bodies(Eigen::SparseMatrixBase<M> const& k, vector_type const& f,
         Eigen::SparseMatrixBase<N> const& b, vector_type const& c, Factor const& factor = {})
      : size_(f.size()) {
    using slant::detail::check_size;
    check_size("rows of K", k.rows(), size_, "the size of f,");
    check_size("columns of K", k.cols(), size_, "the size of f,");
    check_size("columns of B", b.cols(), size_, "the size of f,");
    slant::detail::check_finite("f", f);
    sparse_type stiffness = k.derived();
    stiffness.makeCompressed();
    slant::detail::require_finite_entries("K", stiffness);
    slant::detail::require_symmetric_entries("K", stiffness);
    slant::detail::require_semidefinite_diagonal("K", stiffness);
    split(stiffness, f, constraint_rows<S>(b, c), factor);
    sparse_type const live = slant::detail::columns_of_identity<S>(size_, live_);
    f_ = live.transpose() * f;
    k_ = sparse_type(live.transpose() * stiffness * live);
    rows_.emplace(sparse_type(b.derived() * live), c);
    q_.emplace(live_size(), std::move(parts_));
  }
  bodies(bodies const&) = delete;
  bodies& operator=(bodies const&) = delete;

  /// The problem of the bodies that are not idle; refers to this object.
  [[nodiscard]] auto qp() const& {
    return polyhedral_qp{matrix<self_adjoint, positive_semidefinite>(k_), f_, *rows_, *q_};
  }
  auto qp() const&& = delete;
  /// u = 0, the start that costs nothing.
  [[nodiscard]] vector_type zero() const { return vector_type::Zero(live_size()); }
  /// The displacements of all bodies from those of qp().
  [[nodiscard]] vector_type displacement(vector_type const& u) const {
    slant::detail::check_size("u", u.size(), live_size());
    vector_type all = idle_displacement_;
    all(live_) = u;
    return all;
  }
  /// The same for a direction, in which idle bodies do not move.
  [[nodiscard]] vector_type direction(vector_type const& d) const {
    return displacement(d) - idle_displacement_;
  }

  /// All bodies, those that were solved here, and those that needed fixing rows or have no U.
  [[nodiscard]] index count() const noexcept { return count_; }
  [[nodiscard]] index idle() const noexcept { return idle_; }
  [[nodiscard]] index fixed() const noexcept { return fixed_; }
  /// Matrices factored: one for each body with unknowns inside, and two more where that turned out
  /// singular: to find the kernel, and without the fixing rows.
  [[nodiscard]] index factorizations() const noexcept { return factorizations_; }
  /// Unknowns of qp(), and those of them in U.
  [[nodiscard]] index live_size() const noexcept { return index(live_.size()); }
  [[nodiscard]] index inside_size() const noexcept { return inside_size_; }

 private:
  using part = slant::detail::conjugate_part<S, factors>;
  using list = std::vector<index>;
  using outcome = detail::prepared_body<S, factors>;

  void split(sparse_type const& k, vector_type const& f, constraint_rows<S> const& rows,
             Factor const& factor) {
    std::vector<unsigned char> touched(std::size_t(size_), 0);
    for (auto const& cluster : rows.clusters()) {
      for (index const i : cluster.unknowns) touched[std::size_t(i)] = 1;
    }
    auto const found = detail::bodies_of(k);
    list const number = detail::numbers_within(found, size_);
    std::vector<outcome> outcomes(found.size());
    slant::detail::parallel_for(
        index(found.size()), std::numeric_limits<index>::max(), [&](index i) {
          auto const at = std::size_t(i);
          outcomes[at] = detail::prepare_body<factors>(k, f, found[at], number, touched, factor);
        });
    count_ = index(found.size());
    idle_displacement_ = vector_type::Zero(size_);
    list begins;  // of the parts, among the unknowns of qp()
    for (std::size_t i = 0; i < found.size(); ++i) note(found[i], outcomes[i], begins);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      move_down(parts_[i].u, begins[i]);
      move_down(parts_[i].ku, begins[i]);
    }
  }

  void note(list const& body, outcome& result, list& begins) {
    factorizations_ += result.attempts;
    if (result.idle) {
      ++idle_;
      idle_displacement_(body) = result.displacement;
      return;
    }
    fixed_ += result.fixed ? 1 : 0;
    if (result.inside) {
      inside_size_ += result.inside->u.cols();
      begins.push_back(live_size());
      parts_.push_back(std::move(*result.inside));
    }
    live_.insert(live_.end(), body.begin(), body.end());
  }

  /// Rows of a body become rows of qp(), where they begin with this one.
  void move_down(sparse_type& m, index begin) const {
    m.conservativeResize(live_size(), m.cols());
    Eigen::Map<Eigen::VectorXi>(m.innerIndexPtr(), m.nonZeros()).array() += int(begin);
  }

  index size_;
  index count_ = 0;
  index idle_ = 0;
  index fixed_ = 0;
  index factorizations_ = 0;
  index inside_size_ = 0;
  list live_;                      // unknowns of bodies that are not idle
  std::vector<part> parts_;        // until they move into q_
  vector_type idle_displacement_;  // 0 at the others
  vector_type f_;
  Eigen::SparseMatrix<S, Eigen::RowMajor> k_;  // symmetric; by rows it is applied in parallel
  std::optional<constraint_rows<S>> rows_;
  std::optional<conjugate_projector_operator<S, factors>> q_;
};

template <class M, class F, class N, class C>
bodies(Eigen::SparseMatrixBase<M> const&, F const&, Eigen::SparseMatrixBase<N> const&, C const&)
    -> bodies<typename M::Scalar>;
template <class M, class F, class N, class C, class Factor>
bodies(Eigen::SparseMatrixBase<M> const&, F const&, Eigen::SparseMatrixBase<N> const&, C const&,
       Factor const&) -> bodies<typename M::Scalar, Factor>;

}  // namespace slant::contact
