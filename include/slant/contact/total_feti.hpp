// SPDX-License-Identifier: MIT
//
// Total-FETI [K refs 11, 12]: contact with Tresca friction of a structure that is cut into bodies
// which all float, since Dirichlet conditions and gluing are multipliers as well.
//
//     primal   min ½ uᵀK u − fᵀu + Σ gᵢ‖(T u)ᵢ‖   s.t.  B_E u = c_E,  N u ≤ d,
//              K = diag(K₁ … K_p)
//
//     dual     min ½ λᵀFλ − bᵀλ   over   λ_ν ≥ 0,  ‖λ_t,i‖ ≤ gᵢ,  G λ = e,     λ = (λ_E, λ_ν, λ_t)
//              F = B K⁺ Bᵀ,   b = B K⁺ f − c,   G = RᵀBᵀ,   e = Rᵀf,           B = [B_E; N; T]
//
//     back     u = K⁺ (f − Bᵀλ) + R α,     α = −μ, the multipliers of G λ = e
//
// K⁺ is one generalised inverse for each body and R the kernels of all. G λ = e says that the
// forces on each body are in equilibrium, and its projector is the coarse problem. Methods:
// constrained_newton, whose coarse problem is that of the face, so that its iterations stay bounded
// when there are more bodies of the same number of elements, also where contact opens; smalse,
// whose iterations do so where the contact that is left holds the bodies well
// (benchmarks/total_feti.cpp).
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/contact/contact_data.hpp>
#include <slant/contact/friction_law.hpp>
#include <slant/factorizations/generalized_inverse.hpp>
#include <slant/operators/block_diagonal.hpp>
#include <slant/operators/product.hpp>
#include <slant/problems/equality_constraints.hpp>
#include <slant/problems/separable_qp.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>

#include <Eigen/QR>
#include <Eigen/SparseCore>

#include <cmath>
#include <limits>
#include <ranges>
#include <string_view>
#include <utility>
#include <vector>

namespace slant::contact {

namespace detail {

// --- feti constraints ----------------------------------------------------------------------------

/// Matrices as blocks on the diagonal of a sparse one.
template <class S, class Blocks>
[[nodiscard]] Eigen::SparseMatrix<S> diagonal_of(Blocks const& blocks) {
  std::vector<Eigen::Triplet<S>> entries;
  index rows = 0, cols = 0;
  for (auto const& m : blocks) {
    slant::detail::for_each_entry(m, [&](index i, index j, S const& value) {
      entries.emplace_back(int(rows + i), int(cols + j), value);
    });
    rows += m.rows();
    cols += m.cols();
  }
  Eigen::SparseMatrix<S> whole(rows, cols);
  whole.setFromTriplets(entries.begin(), entries.end());
  return whole;
}

}  // namespace detail

// --- total feti ----------------------------------------------------------------------------------

/// Bodies that float, and what holds them together.
template <class S = double>
struct floating_bodies {
  using vector_type = Eigen::VectorX<S>;
  using dense_type = Eigen::MatrixX<S>;
  using sparse_type = Eigen::SparseMatrix<S>;

  std::vector<sparse_type> K;  ///< n_i × n_i, positive semidefinite
  std::vector<dense_type> R;   ///< n_i × d_i, their kernels; empty: computed
  sparse_type B;               ///< B_E, m_E × Σ n_i: Dirichlet conditions and gluing
  vector_type c;               ///< c_E, m_E: prescribed displacements; 0 for gluing
};

/// diag(K₁ … K_p), for preconditioners.
template <class S>
[[nodiscard]] Eigen::SparseMatrix<S> block_stiffness(floating_bodies<S> const& bodies) {
  return detail::diagonal_of<S>(bodies.K);
}

/// The dual problem of decomposed contact. Holds all it needs. Not movable: its operators refer to
/// one another; what refers to it is not to be had from a temporary.
///
///     slant::contact::total_feti problem(slant::contact::friction_disc{}, bodies, data);
///     auto const qp = problem.qp();
///     slant::constrained_newton method{qp, problem.constraints()};
///     auto r = slant::solve(method, problem.zero(), …);
///     auto u = problem.displacement(r.x(), method.multipliers(r.state));
template <class Friction, class S>
class total_feti {
 public:
  using vector_type = Eigen::VectorX<S>;
  using sparse_type = Eigen::SparseMatrix<S>;

  /// One factorisation for each body (two, if its kernel is not given). The data are for the
  /// unknowns of all bodies, one after the other, with any number of contact nodes. Throws
  /// bad_input if sizes do not match, if the data or a kernel are not what they should be, or if
  /// the load moves a body in a way that no constraint opposes.
  total_feti(Friction friction, floating_bodies<S> const& bodies, data<S> const& c)
      : inverse_(generalized_inverses(bodies)),
        R_(detail::diagonal_of<S>(
            std::views::iota(index(0), inverse_.block_count()) |
            std::views::transform([&](index i) -> auto const& { return kernel_of(i); }))),
        f_(checked(friction, bodies, c, inverse_.rows()).f),
        B_(detail::stacked(bodies.B, detail::stacked_constraints(c))),
        set_(cartesian(free_components<S>(bodies.B.rows()), detail::feasible_set(friction, c))),
        constraints_(equilibrium()),
        b_(B_.rows()) {
    vector_type u(f_.size());
    slant::apply(inverse_, f_, u);
    b_.noalias() = B_ * u;
    b_.head(bodies.c.size()) -= bodies.c;
    detail::subtract_gaps(c.d, b_.tail(b_.size() - bodies.c.size()), b_);
  }
  total_feti(total_feti const&) = delete;
  total_feti& operator=(total_feti const&) = delete;

  /// F = B K⁺ Bᵀ, never formed.
  [[nodiscard]] auto a() const& { return congruence(B_, inverse_); }
  auto a() const&& = delete;
  /// The dual problem without G λ = e; refers to this object.
  [[nodiscard]] auto qp() const& { return separable_qp{a(), b_, set_}; }
  auto qp() const&& = delete;
  /// G λ = e.
  [[nodiscard]] equality_constraints<S> const& constraints() const& { return constraints_; }
  equality_constraints<S> const& constraints() const&& = delete;
  /// B = [B_E; N; T], for preconditioners.
  [[nodiscard]] sparse_type const& rows() const& { return B_; }
  sparse_type const& rows() const&& = delete;
  /// R, all kernels.
  [[nodiscard]] sparse_type const& kernel() const& { return R_; }
  sparse_type const& kernel() const&& = delete;
  /// λ = 0.
  [[nodiscard]] vector_type zero() const { return vector_type::Zero(b_.size()); }

  /// u = K⁺ (f − Bᵀλ) − R μ with the multipliers μ of G λ = e: one solve for each body.
  [[nodiscard]] vector_type displacement(vector_type const& λ, vector_type const& μ) const {
    slant::detail::check_size("lambda", λ.size(), b_.size());
    slant::detail::check_size("mu", μ.size(), R_.cols(), "the dimension of all kernels,");
    vector_type load = f_;
    load.noalias() -= B_.transpose() * λ;
    vector_type u(load.size());
    slant::apply(inverse_, load, u);
    u.noalias() -= R_ * μ;
    return u;
  }

 private:
  using inverse_type = diagonal_blocks_operator<generalized_inverse<S>>;
  using set_type = decltype(cartesian(
      free_components<S>(index{}),
      detail::feasible_set(std::declval<Friction>(), std::declval<data<S> const&>())));

  static inverse_type generalized_inverses(floating_bodies<S> const& bodies) {
    if (bodies.K.empty()) throw bad_input("K", "no bodies", "at least one");
    if (!bodies.R.empty()) {
      slant::detail::check_size("R", index(bodies.R.size()), index(bodies.K.size()),
                                "one kernel per body,");
    }
    std::vector<generalized_inverse<S>> inverses;
    inverses.reserve(bodies.K.size());
    for (std::size_t i = 0; i < bodies.K.size(); ++i) {
      if (bodies.R.empty()) {
        inverses.emplace_back(bodies.K[i]);
      } else {
        inverses.emplace_back(bodies.K[i], bodies.R[i]);
      }
    }
    return diagonal_blocks(std::move(inverses));
  }

  [[nodiscard]] auto const& kernel_of(index body) const { return inverse_.block(body).kernel(); }

  /// The data, valid as the constraints are. Without contact nodes the problem is one of gluing
  /// alone, and linear.
  static data<S> const& checked(Friction friction, floating_bodies<S> const& bodies,
                                data<S> const& c, index unknowns) {
    using slant::detail::check_size;
    if (c.nodes() > 0) {
      detail::validated(friction, c, unknowns);
    } else {
      check_size("rows of T", c.T.rows(), 0, "no contact nodes,");
      check_size("d", c.d.size(), 0, "no contact nodes,");
      check_size("g", c.g.size(), 0, "no contact nodes,");
      check_size("rows of K", unknowns, c.f.size(), "the size of f,");
      slant::detail::check_finite("f", c.f);
    }
    check_size("columns of B", bodies.B.cols(), c.f.size(), "the size of f,");
    check_size("c", bodies.c.size(), bodies.B.rows(), "the rows of B,");
    slant::detail::require_finite_entries("B", bodies.B);
    slant::detail::check_finite("c", bodies.c);
    return c;
  }

  /// G λ = e. Not movable, so made in place.
  [[nodiscard]] equality_constraints<S> equilibrium() const {
    vector_type const resultants = R_.transpose() * f_;
    sparse_type const sizes_of_R = R_.cwiseAbs();
    // 64: each of the sums has as many roundings as a body has unknowns, most of which cancel.
    S const rounding = S(64) * std::numeric_limits<S>::epsilon();
    vector_type const errors = rounding * (sizes_of_R.transpose() * f_.cwiseAbs());
    sparse_type G = R_.transpose() * sparse_type(B_.transpose());
    sparse_type const terms = sizes_of_R.transpose() * sparse_type(B_.cwiseAbs().transpose());
    // A motion that B does not see would become a row of its own, because rows count by their
    // directions.
    G.prune([&](index i, index j, S const& value) {
      using std::abs;
      return abs(value) > rounding * terms.coeff(i, j);
    });
    try {
      return equality_constraints<S>(G, resultants, errors);
    } catch (bad_input const& complaint) {
      if (!std::string_view(complaint.what()).starts_with("e[")) throw;
      throw bad_input("f",
                      "a load that moves body " + slant::detail::show(moving_body(G, resultants)),
                      "one that the constraints can bear");
    }
  }

  /// The body with the largest part of the resultants that is not in the range of G.
  [[nodiscard]] index moving_body(sparse_type const& G, vector_type const& resultants) const {
    Eigen::MatrixX<S> const gram = G * sparse_type(G.transpose());
    vector_type const rest = resultants - gram * gram.colPivHouseholderQr().solve(resultants);
    index row = 0, body = 0;
    rest.cwiseAbs().maxCoeff(&row);
    while (row >= kernel_of(body).cols()) row -= kernel_of(body++).cols();
    return body;
  }

  inverse_type inverse_;  // K⁺
  sparse_type R_;
  vector_type f_;
  sparse_type B_;
  set_type set_;
  equality_constraints<S> constraints_;
  vector_type b_;
};

template <class Friction, class S>
total_feti(Friction, floating_bodies<S> const&, data<S> const&) -> total_feti<Friction, S>;

}  // namespace slant::contact
