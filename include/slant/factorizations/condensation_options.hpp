// SPDX-License-Identifier: MIT
//
// How far a static condensation should go, and what it costs: the cost model of
// static_condensation.
//
// Keeping the contact unknowns for the end makes the factorisation dearer and each application of
// B K⁻¹ Bᵀ cheaper (factorizations/parts/contact_ordering.hpp). For each ordering a symbolic
// analysis gives the operations of the factorisation and the bytes that an application reads; the
// one with the least
//
//     flops / flops_per_second + applications · 2 · bytes / bytes_per_second
//
// is taken. Where there will be many applications it pays to form the inverse S⁻¹ of the Schur
// complement on the contact unknowns (factorizations/parts/tail.hpp), of which each reads
// half once:
//
//     … + forming flops / forming_per_second + applications · bytes(S⁻¹)/2 / bytes_per_second
#pragma once

#include <slant/concepts/bad_input.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace slant {

/// Options of static_condensation. The constants were measured on one core of an AMD EPYC (factors
/// and sweeps of the steel brick); their ratio is what matters, and that differs little between
/// processors.
struct condensation_options {
  /// 0: all contact unknowns last; l: behind their own subdomain of those that the l topmost
  /// separators leave; none: what the cost model finds best.
  std::optional<index> levels{};
  /// Whether S⁻¹ is formed; none: where the cost model finds it better. Either way it is not kept
  /// where S is so ill-conditioned that S⁻¹ in floats might be indefinite; the report says so.
  std::optional<bool> inverse{};
  /// Expected; one in rounded precision counts as half. Methods for contact need 60 to 150.
  index applications = 150;
  double flops_per_second = 4.5e10;    ///< of a large factorisation
  double forming_per_second = 2.5e10;  ///< the same where S⁻¹ is formed
  double bytes_per_second = 2.4e10;    ///< read from memory by a sweep
  double cached_per_second = 5.0e10;   ///< the same if all fits the cache
  double cache = 1.6e7;                ///< bytes of the cache
  double most_memory = 1.5;  ///< ≥ 1; so many times the bytes of a factor alone, or the cache

  /// Throws bad_input naming the option, its value and what was expected.
  [[gnu::cold]] void validate() const {
    if (levels && *levels < 0) throw bad_input("levels", detail::show(*levels), "a number >= 0");
    detail::check_option("applications", applications, applications >= 0, "a number >= 0");
    detail::check_positive("flops_per_second", flops_per_second);
    detail::check_positive("forming_per_second", forming_per_second);
    detail::check_positive("bytes_per_second", bytes_per_second);
    detail::check_positive("cached_per_second", cached_per_second);
    detail::check_positive("cache", cache);
    detail::check_option("most_memory", most_memory, most_memory >= 1, "at least 1");
  }
};

/// One way to condense, by symbolic analysis.
struct condensation_plan {
  index levels = 0;         ///< of condensation_options
  bool inverse = false;     ///< S⁻¹ is formed
  double flops = 0;         ///< operations of the factorisation
  double entries = 0;       ///< of the whole factor
  double stored = 0;        ///< numbers kept for them: with upper halves of dense blocks
  double contact = 0;       ///< contact unknowns
  double forming = 0;       ///< operations that S⁻¹ takes: from each of them on, both sweeps
  double tail = 0;          ///< unknowns that an application touches, if not by S⁻¹
  double tail_entries = 0;  ///< entries of the factor that an application reads, twice
  double seconds = 0;       ///< predicted, for all there is to do

  /// Entries that applications read: of the tail, or half of S⁻¹.
  [[nodiscard]] double applied() const { return inverse ? contact * contact / 2 : tail_entries; }
  /// Bytes of the factor, of S⁻¹, and of the floats that applications read.
  [[nodiscard]] double bytes() const {
    return 8 * stored + 4 * applied() + (inverse ? 8 * applied() : 0);
  }
  void predict(condensation_options const& o) {
    double const held = 8 * applied();
    double const speed = held < o.cache ? o.cached_per_second : o.bytes_per_second;
    double const read = inverse ? held : 2 * held;
    seconds = flops / o.flops_per_second + (inverse ? forming / o.forming_per_second : 0) +
              static_cast<double>(o.applications) * read / speed;
  }
  /// The same with S⁻¹.
  [[nodiscard]] condensation_plan with_inverse(condensation_options const& o) const {
    condensation_plan result = *this;
    result.inverse = true;
    result.predict(o);
    return result;
  }
};

/// What a static condensation did and why.
struct condensation_report {
  std::string_view factorization;        ///< "cholmod", or "ldlt" without SuiteSparse
  index unknowns = 0;                    ///< rows of K
  index contact = 0;                     ///< contact unknowns
  condensation_plan alone;               ///< a factor with the contact unknowns anywhere
  std::vector<condensation_plan> plans;  ///< what was compared; empty without SuiteSparse
  condensation_plan chosen;              ///< what was done
  std::string reason;                    ///< why, in a sentence
};

namespace detail {

/// Whether a plan keeps to the memory that is allowed, compared with a factor alone.
[[nodiscard]] inline bool fits(condensation_plan const& plan, condensation_plan const& alone,
                               condensation_options const& o) {
  return plan.bytes() <= std::max(o.cache, o.most_memory * 8 * alone.stored);
}

/// The plan with the least predicted time among those that fit, else the smallest; plans are not
/// empty.
[[nodiscard]] inline condensation_plan const& cheapest(std::vector<condensation_plan> const& plans,
                                                       condensation_plan const& alone,
                                                       condensation_options const& o) {
  condensation_plan const* best = nullptr;
  condensation_plan const* smallest = &plans.front();
  for (auto const& plan : plans) {
    if (plan.bytes() < smallest->bytes()) smallest = &plan;
    if (!fits(plan, alone, o)) continue;
    if (best == nullptr || plan.seconds < best->seconds) best = &plan;
  }
  return best != nullptr ? *best : *smallest;
}

}  // namespace detail

}  // namespace slant
