// SPDX-License-Identifier: MIT
//
// Contact of bodies that supports do not hold, with a singular K: contact or friction holds them,
// or nothing does.
//
//     minimise   ½ uᵀK u − fᵀu + Σ gᵢ‖(T u)ᵢ‖   over   N u ≤ d,      K semidefinite with kernel R
//
//     frictionless   the Schur complement algorithm on u (contact/bodies.hpp), also for g = 0
//     Tresca         Newton's method on the multipliers with K⁺ and the equilibrium of each body,
//                    Rᵀ(f − Bᵀλ) = 0 (contact/total_feti.hpp)
//
// Gaps. Both see u − w, w the place to which the load moves rigid bodies (detail/rigid_position).
//
// No solution. The energy falls for ever exactly along motions w = R α with N w ≤ 0 and fᵀw > Σ gᵢ
// ‖(T w)ᵢ‖. The status `unbounded` is said of a w that has been checked so, and its name is part of
// the reason. K w = 0 as R is the computed kernel of K.
//
// A solution is checked by contact/optimality.hpp, from the data alone: `converged` is not said
// where its residual is more than 1000 times the tolerance, or what rounding errors of K u make.
#pragma once

#include <slant/compiled.hpp>
#include <slant/contact/bodies.hpp>
#include <slant/contact/free_motions.hpp>
#include <slant/contact/optimality.hpp>
#include <slant/contact/parts/rigid_position.hpp>
#include <slant/contact/total_feti.hpp>
#include <slant/iteration/solve.hpp>
#include <slant/iteration/stopping.hpp>
#include <slant/methods/constrained_newton.hpp>
#include <slant/methods/schur_contact.hpp>
#include <slant/problems/separable_qp.hpp>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace slant::contact {

/// Options of solve_floating.
template <class S = double>
struct floating_options {
  S tolerance = S(1e-10);       ///< relative, of the residual that the method measures
  index max_iterations = 5000;  ///< steps at most
  node_layout<S> layout{};      ///< gives the motions their names

  /// Throws bad_input naming the option, its value and what was expected.
  [[gnu::cold]] void validate() const {
    if (!(tolerance > S(0) && tolerance < S(1))) {
      throw bad_input("tolerance", slant::detail::show(tolerance), "a number in (0, 1)");
    }
    if (max_iterations < 0) {
      throw bad_input("max_iterations", slant::detail::show(max_iterations), "a number >= 0");
    }
  }
};

/// What came of bodies that float.
template <class S = double>
struct floating_solution {
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;

  vector_type u{};        ///< displacements; where rigid motions are left free, one of many
  vector_type lambda{};   ///< forces of [N; T]
  vector_type descent{};  ///< where unbounded: w, along which the energy falls for ever; else empty
  slant::status status = slant::status::running;
  std::string reason{};
  std::string method{};  ///< "schur_contact" or "constrained_newton"
  index iterations = 0;
  slant::work work{};
  free_motions<S> motions{};  ///< of K alone
  S residual = S(0);          ///< of the optimality conditions, see optimality.hpp

  [[nodiscard]] bool converged() const { return status == slant::status::converged; }
};

namespace detail {

/// `converged` stands only beside an independent check.
template <class S>
void check_claim(Eigen::SparseMatrix<S> const& K, data<S> const& c, S const& tolerance,
                 floating_solution<S>& r) {
  r.residual = check_optimality(K, c, r.u, r.lambda).residual();
  if (r.status != slant::status::converged) return;
  S const allowed = allowed_residual(K, c, tolerance, r.u, r.lambda);
  if (r.residual <= allowed) return;
  r.status = slant::status::stalled;
  r.reason = "the method has converged (" + r.reason +
             "), but the optimality conditions have the "
             "residual " +
             slant::detail::show(r.residual) + ", more than " + slant::detail::show(allowed);
}

/// w, where the load puts the bodies before they deform, for u = w + v: the methods then see gaps
/// of the size of the strains, however wide they are, and friction acts on T w + T v.
template <class S>
[[nodiscard]] Eigen::Matrix<S, Eigen::Dynamic, 1> loaded_position(Eigen::SparseMatrix<S> const& K,
                                                                  data<S> const& c,
                                                                  free_motions<S> const& motions) {
  auto const R = kernel_of(motions, K.rows());
  return R * rigid_position<S>(K, c, R)();
}

template <class S>
void solve_without_friction(Eigen::SparseMatrix<S> const& K, data<S> const& c,
                            floating_options<S> const& o, floating_solution<S>& r) {
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  r.method = "schur_contact";
  vector_type const w = loaded_position(K, c, r.motions);
  bodies<S> const problem(K, c.f, c.N, vector_type(c.d - c.N * w));
  auto const qp = problem.qp();
  auto run = slant::solve(slant::schur_contact{qp}, problem.zero(),
                          residual_below(o.tolerance) || at_most(o.max_iterations));
  r.status = run.status;
  r.reason = std::move(run.reason);
  r.iterations = run.iterations();
  r.work = run.state.work;
  r.u = w + problem.displacement(run.x());
  r.lambda.setZero(c.N.rows() + c.T.rows());
  r.lambda.head(c.N.rows()) = run.state.multipliers();
  if (r.status == slant::status::unbounded) conclude_unbounded(K, c, o.layout, r);
}

/// The unknowns body after body: entry j is an unknown of K.
[[nodiscard]] inline std::vector<index> body_order(std::vector<std::vector<index>> const& bodies) {
  std::vector<index> order;
  for (auto const& body : bodies) order.insert(order.end(), body.begin(), body.end());
  return order;
}

/// The columns of B in this order.
template <class S>
[[nodiscard]] Eigen::SparseMatrix<S> columns_in_order(Eigen::SparseMatrix<S> const& B,
                                                      std::vector<index> const& order) {
  Eigen::SparseMatrix<S> sorted(B.rows(), B.cols());
  sorted.reserve(B.nonZeros());
  for (index j = 0; j < B.cols(); ++j) {
    sorted.startVec(j);
    for (typename Eigen::SparseMatrix<S>::InnerIterator e(B, order[static_cast<std::size_t>(j)]); e;
         ++e)
      sorted.insertBack(e.row(), j) = e.value();
  }
  sorted.finalize();
  return sorted;
}

template <class Friction, class S>
void solve_with_friction(Friction friction, Eigen::SparseMatrix<S> const& K, data<S> const& c,
                         floating_options<S> const& o, floating_solution<S>& r) {
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using dense_type = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
  r.method = "constrained_newton";
  auto const parts = bodies_of(K);
  auto const order = body_order(parts);
  std::vector<index> number(order.size());
  for (auto const& body : parts) {
    for (std::size_t j = 0; j < body.size(); ++j)
      number[static_cast<std::size_t>(body[j])] = static_cast<index>(j);
  }
  floating_bodies<S> floating;
  auto next = r.motions.free.begin();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    auto const& body = parts[i];
    floating.K.push_back(columns_of_body(K, number, body, body, true));
    bool const is_free = next != r.motions.free.end() && next->number == static_cast<index>(i);
    floating.R.push_back(is_free ? next->motions : dense_type(static_cast<index>(body.size()), 0));
    if (is_free) ++next;
  }
  floating.B.resize(0, K.rows());
  vector_type const w = loaded_position(K, c, r.motions);
  data<S> sorted{columns_in_order(c.N, order), columns_in_order(c.T, order), c.f,
                 vector_type(c.d - c.N * w), c.g};
  for (index j = 0; j < c.f.size(); ++j) sorted.f[j] = c.f[order[static_cast<std::size_t>(j)]];
  auto const unsorted = [&](vector_type const& v) {
    vector_type all(v.size());
    for (index j = 0; j < v.size(); ++j) all[order[static_cast<std::size_t>(j)]] = v[j];
    return all;
  };
  r.u.setZero(K.rows());
  r.lambda.setZero(c.N.rows() + c.T.rows());
  try {
    total_feti const problem(friction, floating, sorted);
    auto const closed = problem.qp();
    vector_type b = closed.b();
    b.tail(c.T.rows()) += c.T * w;
    separable_qp const qp{closed.a(), b, closed.set()};
    slant::constrained_newton const method{qp, problem.constraints()};
    auto run =
        slant::solve(method, problem.zero(),
                     (reduced_gradient_below(o.tolerance) && feasibility_below(o.tolerance)) ||
                         at_most(o.max_iterations));
    r.status = run.status;
    r.reason = std::move(run.reason);
    r.iterations = run.iterations();
    r.work = run.state.work;
    r.lambda = run.x();
    r.u = w + unsorted(problem.displacement(run.x(), method.multipliers(run.state)));
    if (run.state.infeasible) conclude_unbounded(K, c, o.layout, r);
  } catch (bad_input const& refusal) {
    if (!std::string_view(refusal.what()).starts_with("f: got a load that moves")) throw;
    conclude_unbounded(K, c, o.layout, r);
  }
}

}  // namespace detail

/// Solves the problem at the top of this file; for a definite K as well, though other methods are
/// faster. Throws bad_input if the data are not valid (see contact::data::validate), K is not
/// symmetric, or not semidefinite, or options are out of range; loads that nothing balances are a
/// status.
///
///     auto r = slant::contact::solve_floating(K, data);
///     if (!r.converged()) std::puts(r.reason.c_str());    // "… body 0 moves along x"
template <class S>
[[nodiscard]] floating_solution<S> solve_floating(Eigen::SparseMatrix<S> const& K, data<S> const& c,
                                                  floating_options<S> const& options = {}) {
  options.validate();
  c.validate();
  slant::detail::check_size("rows of K", K.rows(), c.f.size(), "the size of f,");
  floating_solution<S> r;
  r.motions = find_free_motions(K, options.layout);
  if (!r.motions.undetermined.empty()) {
    throw bad_input("K",
                    "a body, number " + slant::detail::show(r.motions.undetermined.front()) +
                        ", whose block is not positive semidefinite up to rounding",
                    "a symmetric positive semidefinite matrix");
  }
  bool const slides = c.tangents() == 0 || c.g.maxCoeff() == S(0);
  if (slides)
    detail::solve_without_friction(K, c, options, r);
  else if (c.tangents() == 1)
    detail::solve_with_friction(friction_line{}, K, c, options, r);
  else
    detail::solve_with_friction(friction_disc{}, K, c, options, r);
  if (r.status != slant::status::unbounded) detail::check_claim(K, c, options.tolerance, r);
  return r;
}

#if SLANT_USES_COMPILED
extern template floating_solution<double> solve_floating<double>(Eigen::SparseMatrix<double> const&,
                                                                 data<double> const&,
                                                                 floating_options<double> const&);
#endif

}  // namespace slant::contact
