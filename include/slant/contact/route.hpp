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
// friction (k = 8 … 32, all loads, relative accuracy 1e-8). How many cycles there will be is known
// to nobody: multigrid that was chosen so ends where it has cost a few times what factors would, and
// these follow, as one rents skis [Karlin, Manasse, Rudolph, Sleator 1988].
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/iterative_method.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/factorizations/fill_estimate.hpp>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <new>
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

namespace detail {

/// What factors of a K of so many entries, whose fill was counted, cost.
[[nodiscard]] inline double seconds_of_factors(route_costs const& cost, double entries,
                                               fill_estimate const& fill) {
  return cost.ordering * entries + cost.operation * fill.operations +
         cost.products * cost.sweep * fill.entries;
}

}  // namespace detail

/// Which route to take for K (n × n, both triangles). Counts the fill no further than is needed to
/// decide. A refusal, why not to iterate, leaves only `factor`: throws bad_input if `iterate` is
/// asked for then.
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
  c.factor_seconds = detail::seconds_of_factors(cost, entries, fill);
  bool const iterate = !fill.complete || c.factor_seconds > c.iterate_seconds;
  c.route = iterate ? solution_route::iterate : solution_route::factor;
  c.reason = std::string(iterate ? "iterated" : "factored") + ": factors are estimated at " +
             (fill.complete ? "" : "more than ") + slant::detail::brief(c.factor_seconds) +
             " s, multigrid at " + slant::detail::brief(c.iterate_seconds) + " s";
  return c;
}

namespace detail {

/// What multigrid may cost where the cost model has preferred it: so many times what factors would.
template <class S>
class route_budget {
 public:
  /// Without a limit.
  route_budget() = default;
  /// Of the choice for K, to which it refers; without a limit unless costs led to `iterate`.
  route_budget(Eigen::SparseMatrix<S> const& K, route_choice const& c, route_costs const& cost)
      : K_(c.route == solution_route::iterate && c.factor_seconds > 0 ? &K : nullptr),
        cost_(cost),
        factor_seconds_(c.factor_seconds) {}

  /// Whether so many products and cycles are too many. Counts the fill to its end where that was
  /// stopped too early to tell.
  [[nodiscard]] bool is_spent(index cycles) {
    if (!K_ || is_spent_) return is_spent_;
    auto const entries = static_cast<double>(K_->nonZeros());
    double const seconds = (cost_.hierarchy + static_cast<double>(cycles) * cost_.cycle) * entries;
    if (seconds <= times * factor_seconds_) return false;
    auto const fill = estimate_fill(*K_, times * seconds / cost_.operation);
    factor_seconds_ = seconds_of_factors(cost_, entries, fill);
    is_spent_ = seconds > times * factor_seconds_;
    return is_spent_;
  }
  [[nodiscard]] bool is_spent() const { return is_spent_; }
  /// The sentence that says so.
  [[nodiscard]] std::string reason() const {
    return "multigrid has cost twice what factors are estimated at, " +
           slant::detail::brief(factor_seconds_) + " s";
  }

 private:
  // Where factors cost what they are estimated at, a wrong choice costs three times the right one at
  // most; once would make it twice, but estimates are off by as much.
  static constexpr double times = 2;

  Eigen::SparseMatrix<S> const* K_ = nullptr;
  route_costs cost_{};
  double factor_seconds_ = 0;
  bool is_spent_ = false;
};

/// Whether a result ends the search.
template <class Result>
[[nodiscard]] bool is_verdict(Result const& of) {
  return of.converged() || of.status == status::unbounded;
}
/// Of two results the nearer, with the work of both, is `first` then; whether that was the second.
template <class Result>
bool take_nearer(Result& first, Result& second) {
  bool const is_second =
      detail::is_verdict(second) || second.error.relative() < first.error.relative();
  if (is_second) std::swap(first, second);
  first.work += second.work;
  if constexpr (requires { first.solves; }) first.solves += second.solves;
  first.condition = std::max(first.condition, second.condition);
  return is_second;
}

/// What first() finds on the route of the choice, or, if that gets nowhere and then `may_change`, what
/// second() → std::optional finds on the other one, nothing if it is refused there: of two results
/// the nearer, with the work of both. Nowhere is also a lack of memory, and without factors what
/// first() throws.
template <class First, class Second>
[[nodiscard]] auto by_routes(route_choice& choice, bool const& may_change, First&& first,
                             Second&& second) -> decltype(first()) {
  using std::sqrt;
  bool const iterates = choice.route == solution_route::iterate;
  std::optional<decltype(first())> found;
  std::exception_ptr thrown;
  std::string why;
  auto const passes = [&](char const* refusal) {
    thrown = std::current_exception();
    why = refusal;
    return may_change;
  };
  try {
    found = first();
    auto const error = found->error.relative();
    // Factors that come near end for reasons that multigrid has as well.
    bool const is_near =
        !iterates && error <= sqrt(std::numeric_limits<decltype(error + 0)>::epsilon());
    if (!may_change || detail::is_verdict(*found) || is_near) return *std::move(found);
    why = found->reason;
  } catch (bad_input const& refusal) {
    if (!iterates || !passes(refusal.what())) throw;
  } catch (std::bad_alloc const&) {
    if (!passes("no memory")) throw;
  }
  std::string const way = iterates ? "; factored " : "; iterated ";
  std::string const before = choice.reason;
  choice.reason += way + "after all: " + why;
  choice.route = iterates ? solution_route::factor : solution_route::iterate;
  auto other = second();
  if (!found && !other) std::rethrow_exception(thrown);
  if (!found) return *std::move(other);
  if (!other || !detail::take_nearer(*found, *other)) {
    choice.route = iterates ? solution_route::iterate : solution_route::factor;
    choice.reason = before + way + "in vain" + (other ? ": " + other->reason : std::string());
  }
  return *std::move(found);
}
/// run(), nothing where that has no memory.
template <class Run>
[[nodiscard]] auto unless_no_memory(Run&& run) -> std::optional<decltype(run())> {
  try {
    return run();
  } catch (std::bad_alloc const&) {
    return std::nullopt;
  }
}
/// The same, and nothing where it refuses its data.
template <class Run>
[[nodiscard]] auto unless_refused(Run&& run) -> std::optional<decltype(run())> {
  try {
    return detail::unless_no_memory(run);
  } catch (bad_input const&) {
    return std::nullopt;
  }
}

/// factor() where multigrid got nowhere; where that has no memory or gets nowhere either, and only
/// the budget of multigrid was spent, iterate() to the end.
template <class S, class Factor, class Iterate>
[[nodiscard]] auto factored_after(route_choice& choice, route_budget<S>& budget, Factor&& factor,
                                  Iterate&& iterate) {
  auto found = detail::unless_no_memory(factor);
  if ((found && detail::is_verdict(*found)) || !budget.is_spent()) return found;
  budget = {};
  choice.reason +=
      (found ? "; in vain: " + found->reason : "; no memory") + "; iterated to the end";
  auto again = iterate();
  if (found && !detail::take_nearer(*found, again)) return found;
  choice.route = solution_route::iterate;
  return found ? std::move(found) : decltype(found)(std::move(again));
}

}  // namespace detail

}  // namespace slant::contact
