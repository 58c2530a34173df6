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
//     fixing nodes   where K_i is singular even on those (a body that nothing holds along a contact
//                    plane, or with too few contact nodes), a few nodes far apart are left out of
//                    U, so that UᵀKU is definite; conjugate gradients find out about the rest
//
// Rows with an infinite bound never act and touch nothing.
#pragma once

#include <slant/contact/detail/body_graph.hpp>
#include <slant/methods/polyhedral_qp.hpp>
#include <slant/operators/conjugate_projector.hpp>
#include <slant/operators/matrix.hpp>

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
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using sparse_type = Eigen::SparseMatrix<S>;
  using factors = std::remove_cvref_t<decltype(std::declval<Factor const&>()(
      std::declval<sparse_type const&>()))>;

  /// Throws bad_input if sizes do not match, K is not symmetric, a number is not finite (c may be
  /// +infinity), or a body cannot be factored on any U.
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
    split(stiffness, f, constraint_rows<S>(b, c), factor);
    sparse_type const live = injection(live_);
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
    for (std::size_t i = 0; i < live_.size(); ++i) all[live_[i]] = u[static_cast<index>(i)];
    return all;
  }
  /// The same for a direction, in which idle bodies do not move.
  [[nodiscard]] vector_type direction(vector_type const& d) const {
    return displacement(d) - idle_displacement_;
  }

  /// All bodies, those that were solved here, and those that needed fixing nodes.
  [[nodiscard]] index count() const noexcept { return count_; }
  [[nodiscard]] index idle() const noexcept { return idle_; }
  [[nodiscard]] index fixed() const noexcept { return fixed_; }
  /// Matrices factored: one for each body, and one more for each choice of U that turned out
  /// singular.
  [[nodiscard]] index factorizations() const noexcept { return factorizations_; }
  /// Unknowns of qp(), and those of them in U.
  [[nodiscard]] index live_size() const noexcept { return static_cast<index>(live_.size()); }
  [[nodiscard]] index inside_size() const noexcept { return inside_size_; }

 private:
  using part = slant::detail::conjugate_part<S, factors>;
  using list = std::vector<index>;

  /// What becomes of a body.
  struct outcome {
    std::optional<part> inside;  // columns of U and K U, rows numbered as in K; none if idle
    vector_type displacement;    // if idle
    index attempts = 0;
    bool fixed = false;
  };

  void split(sparse_type const& k, vector_type const& f, constraint_rows<S> const& rows,
             Factor const& factor) {
    std::vector<unsigned char> touched(static_cast<std::size_t>(size_), 0);
    for (auto const& cluster : rows.clusters()) {
      for (index const i : cluster.unknowns) touched[static_cast<std::size_t>(i)] = 1;
    }
    auto const found = detail::bodies_of(k);
    std::vector<outcome> outcomes(found.size());
    slant::detail::parallel_for(static_cast<index>(found.size()), std::numeric_limits<index>::max(),
                                [&](index i) {
                                  auto const at = static_cast<std::size_t>(i);
                                  outcomes[at] = prepare(k, f, found[at], touched, factor);
                                });
    count_ = static_cast<index>(found.size());
    idle_displacement_ = vector_type::Zero(size_);
    for (std::size_t i = 0; i < found.size(); ++i) note(found[i], outcomes[i]);
    number_parts();
  }

  /// Tries U = what no row touches, then leaves out nodes far apart.
  [[nodiscard]] outcome prepare(sparse_type const& k, vector_type const& f, list const& body,
                                std::vector<unsigned char> touched, Factor const& factor) const {
    outcome result;
    list sources;
    for (index const i : body) {
      if (touched[static_cast<std::size_t>(i)] != 0) sources.push_back(i);
    }
    bool const free = sources.empty();
    constexpr index patience = 8;
    while (true) {
      list inside;
      for (index const i : body) {
        if (touched[static_cast<std::size_t>(i)] == 0) inside.push_back(i);
      }
      sparse_type u = injection(inside);
      sparse_type ku = k * u;
      sparse_type const block = u.transpose() * ku;
      ++result.attempts;
      try {
        result.inside.emplace(part{std::move(u), std::move(ku), factor(block)});
        break;
      } catch (bad_input const&) {
        if (result.attempts == patience || inside.empty()) throw;
      }
      // Three nodes that are not on a line hold a body in space.
      list fixing = result.fixed ? sources : list{};
      for (int node = result.fixed ? 2 : 0; node < 3; ++node) {
        auto const chosen = detail::node_of(
            k, detail::farthest_unknown(k, body, fixing.empty() ? sources : fixing));
        fixing.insert(fixing.end(), chosen.begin(), chosen.end());
      }
      for (index const i : fixing) touched[static_cast<std::size_t>(i)] = 1;
      sources = fixing;
      result.fixed = true;
    }
    if (free && !result.fixed) {
      vector_type load(static_cast<index>(body.size()));
      for (std::size_t i = 0; i < body.size(); ++i) load[static_cast<index>(i)] = f[body[i]];
      result.displacement.resize(load.size());
      auto w = slant::workspace(result.inside->factors, load);
      if constexpr (requires { result.inside->factors.solve(load, result.displacement, w); }) {
        result.inside->factors.solve(load, result.displacement, w);
      } else {
        result.inside->factors.solve(load, result.displacement);
      }
      result.inside.reset();
    }
    return result;
  }

  void note(list const& body, outcome& result) {
    factorizations_ += result.attempts;
    if (!result.inside) {
      ++idle_;
      for (std::size_t i = 0; i < body.size(); ++i) {
        idle_displacement_[body[i]] = result.displacement[static_cast<index>(i)];
      }
      return;
    }
    fixed_ += result.fixed ? 1 : 0;
    inside_size_ += result.inside->u.cols();
    live_.insert(live_.end(), body.begin(), body.end());
    parts_.push_back(std::move(*result.inside));
  }

  /// Rows of the parts from the numbers of K to those of qp().
  void number_parts() {
    sparse_type const to_live = sparse_type(injection(live_).transpose());
    for (part& p : parts_) {
      p.u = sparse_type(to_live * p.u);
      p.ku = sparse_type(to_live * p.ku);
    }
  }

  /// The columns of I with these numbers.
  [[nodiscard]] sparse_type injection(list const& unknowns) const {
    sparse_type u(size_, static_cast<index>(unknowns.size()));
    u.reserve(static_cast<index>(unknowns.size()));
    for (std::size_t j = 0; j < unknowns.size(); ++j) {
      u.startVec(static_cast<index>(j));
      u.insertBack(unknowns[j], static_cast<index>(j)) = S(1);
    }
    u.finalize();
    return u;
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
