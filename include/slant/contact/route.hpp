// SPDX-License-Identifier: MIT
//
// Two routes to a contact problem: factor K and solve the dual problem, an application of K⁻¹ a
// product; or never factor K and iterate on u with a multigrid preconditioner. In space the
// operations of a factorisation grow like n², its entries like n^(4/3), the work of a cycle like n:
// there is a size from which on iterating is faster. Which side of it a problem is on is judged by
//
//     factor:   α nnz(K) + β operations(L) + products · γ entries(L)
//     iterate:  (δ + cycles · ε) nnz(K)
//
// with L estimated by estimate_fill and constants measured on the steel brick with and without
// friction (k = 8 … 32, all loads, relative accuracy 1e-8).
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/iterative_method.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/factorizations/fill_estimate.hpp>

#include <Eigen/SparseCore>

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

namespace slant::contact {

/// How to solve a contact problem.
enum class solution_route : unsigned char {
  automatic,  ///< what the cost model takes to be faster
  factor,     ///< factors of K, dual problem
  iterate     ///< multigrid, K never factored
};

/// Processor seconds per unit of work on an AMD EPYC; machines differ, but less in what decides,
/// the ratios.
struct route_costs {
  double ordering = 1.2e-7;    ///< α, per entry of K
  double operation = 2.3e-11;  ///< β, per operation of the factorisation as estimated
  double sweep = 1.3e-9;       ///< γ, per entry of L and application of K⁻¹
  double products = 60;        ///< applications of K⁻¹ of the dual method
  double hierarchy = 2e-8;     ///< δ, per entry of K
  double cycle = 3.3e-9;       ///< ε, per entry of K and cycle, a product by K included
  double cycles = 50;          ///< of the primal method

  /// For factors by Eigen, without supernodes.
  [[nodiscard]] static constexpr route_costs without_cholmod() {
    return {.operation = 1.2e-9, .sweep = 2e-9};
  }
};

/// The outcome of the cost model.
struct route_choice {
  solution_route route = solution_route::factor;  ///< factor or iterate
  double factor_seconds = 0;                      ///< estimated; at least, if counting was stopped
  double iterate_seconds = 0;                     ///< estimated
  std::string reason;                             ///< a sentence
};

/// The costs of the factorisation that slant::factorize has for scalars S.
template <class S>
[[nodiscard]] constexpr route_costs default_route_costs() {
  using factor_type = decltype(slant::factorize(std::declval<Eigen::SparseMatrix<S> const&>()));
  return std::is_same_v<factor_type, ldlt<S>> ? route_costs::without_cholmod() : route_costs{};
}

/// Which route to take for K (n × n, both triangles). Counts the fill no further than is needed to
/// decide. A refusal, why iterating is impossible, leaves only `factor`: throws bad_input if
/// `iterate` is asked for then.
template <class S>
[[nodiscard]] route_choice choose_route(Eigen::SparseMatrix<S> const& K,
                                        std::optional<std::string> const& refusal,
                                        solution_route wanted = solution_route::automatic,
                                        route_costs const& cost = default_route_costs<S>()) {
  route_choice c;
  if (refusal) {
    if (wanted == solution_route::iterate) {
      throw bad_input("route", "iterate", "factor or automatic, because " + *refusal);
    }
    c.reason = "factored: " + *refusal;
    return c;
  }
  if (wanted != solution_route::automatic) {
    c.route = wanted;
    c.reason =
        wanted == solution_route::factor ? "factored, as asked for" : "iterated, as asked for";
    return c;
  }
  auto const entries = static_cast<double>(K.nonZeros());
  c.iterate_seconds = (cost.hierarchy + cost.cycles * cost.cycle) * entries;
  auto const fill = estimate_fill(K, c.iterate_seconds / cost.operation);
  c.factor_seconds = cost.ordering * entries + cost.operation * fill.operations +
                     cost.products * cost.sweep * fill.entries;
  bool const iterate = !fill.complete || c.factor_seconds > c.iterate_seconds;
  c.route = iterate ? solution_route::iterate : solution_route::factor;
  c.reason = std::string(iterate ? "iterated" : "factored") + ": factors are estimated at " +
             (fill.complete ? "" : "more than ") + slant::detail::brief(c.factor_seconds) +
             " s, multigrid at " + slant::detail::brief(c.iterate_seconds) + " s";
  return c;
}

namespace detail {

/// What run() finds without factors, if that is the route and leads to the solution or was asked
/// for; none: factors are to be taken, and the choice says why.
template <class Run>
[[nodiscard]] auto iterated_first(route_choice& choice, solution_route asked, Run&& run)
    -> std::optional<decltype(run())> {
  if (choice.route != solution_route::iterate) return std::nullopt;
  try {
    auto found = run();
    found.choice = choice;
    if (found.converged() || asked == solution_route::iterate) return found;
    choice.reason += "; factored after all: " + found.reason;
  } catch (bad_input const& refusal) {
    if (asked == solution_route::iterate) throw;
    choice.reason += "; factored after all: " + std::string(refusal.what());
  }
  choice.route = solution_route::factor;
  return std::nullopt;
}
/// The result of factors, or that of run() where they have got nowhere and it has.
template <class Found, class Run>
[[nodiscard]] Found iterated_after_all(route_choice& choice, Found found, Run&& run) {
  using std::sqrt;
  auto const error = found.error.relative();
  bool const is_near = error <= sqrt(std::numeric_limits<decltype(error + 0)>::epsilon());
  if (found.converged() || found.status == status::unbounded || is_near) return found;
  try {
    auto other = run();
    other.work += found.work;
    if (other.converged()) {
      choice.route = solution_route::iterate;
      choice.reason += "; iterated after all: " + found.reason;
      other.solves += found.solves;
      other.condition = found.condition;
      return other;
    }
    found.work = other.work;
    choice.reason += "; iterated in vain: " + other.reason;
  } catch (bad_input const& refusal) {
    choice.reason += "; iterated in vain: " + std::string(refusal.what());
  }
  return found;
}

}  // namespace detail

}  // namespace slant::contact
