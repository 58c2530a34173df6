// SPDX-License-Identifier: MIT
//
// The motions of bodies that a stiffness matrix K does not resist, and their names. Bodies are the
// connected components of the graph of K, numbered from 0 in the order of their first unknowns; the
// free motions of a body are the kernel of its block, rigid motions for an elastic one.
//
//     kernel    R, orthonormal, by inverse iteration (factorizations/computed_kernel.hpp)
//     names     where the places of the unknowns are known: R = Φ C with the rigid motions Φ about
//               the centre of the body. Combinations without rotation are translations, the others
//               turn about the axes that are left.
//
// Costs a factorisation for each body, and a few solves.
#pragma once

#include <slant/compiled.hpp>
#include <slant/contact/detail/body_graph.hpp>
#include <slant/contact/detail/prepared_body.hpp>
#include <slant/contact/detail/rigid_names.hpp>
#include <slant/contact/node_layout.hpp>
#include <slant/factorizations/computed_kernel.hpp>
#include <slant/factorizations/factorize.hpp>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace slant::contact {

/// A body that K does not hold.
template <class S = double>
struct free_body {
  index number = 0;                                          ///< among all bodies, from 0
  std::vector<index> unknowns;                               ///< in increasing order
  Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> motions;  ///< R, unknowns × dimension
  std::string text;                                          ///< "body 2 can move along x"
};

/// All bodies that K does not hold.
template <class S = double>
struct free_motions {
  index bodies = 0;                   ///< all, free or not
  std::vector<free_body<S>> free{};   ///< in increasing order of their numbers
  std::vector<index> undetermined{};  ///< bodies whose block is not semidefinite up to rounding

  /// Dimension of the kernel of K.
  [[nodiscard]] index dimension() const {
    index sum = 0;
    for (auto const& body : free) sum += body.motions.cols();
    return sum;
  }
  /// "body 0 can move along x; body 2 has 3 free motions"; the first few of many.
  [[nodiscard, gnu::cold]] std::string sentence() const {
    std::string text;
    for (std::size_t i = 0; i < free.size() && i < 4; ++i) {
      text.append(i == 0 ? "" : "; ").append(free[i].text);
    }
    if (free.size() > 4) {
      text.append("; and ")
          .append(slant::detail::show(static_cast<index>(free.size()) - 4))
          .append(" other bodies");
    }
    return text;
  }
};

/// Throws bad_input if K is not symmetric or the layout does not fit.
template <class S>
[[nodiscard]] free_motions<S> find_free_motions(Eigen::SparseMatrix<S> const& K,
                                                node_layout<S> const& layout = {}) {
  slant::detail::require_symmetric_matrix("K", K);
  layout.validate(K.rows());
  free_motions<S> result;
  auto bodies = detail::bodies_of(K);
  result.bodies = static_cast<index>(bodies.size());
  std::vector<index> number(static_cast<std::size_t>(K.rows()));
  for (index i = 0; i < result.bodies; ++i) {
    auto& body = bodies[static_cast<std::size_t>(i)];
    for (std::size_t j = 0; j < body.size(); ++j) {
      number[static_cast<std::size_t>(body[j])] = static_cast<index>(j);
    }
    try {
      auto R = computed_kernel(detail::columns_of_body(K, number, body, body, true));
      if (R.cols() == 0) continue;
      std::string text = detail::body_text(i, body) + detail::motions_text(layout, body, R);
      result.free.push_back({i, std::move(body), std::move(R), std::move(text)});
    } catch (bad_input const&) {
      result.undetermined.push_back(i);
    }
  }
  return result;
}

/// The largest part of a motion d of all unknowns, in words: "body 1 moves along x".
template <class S, class V>
[[nodiscard, gnu::cold]] std::string name_motion(Eigen::SparseMatrix<S> const& K, V const& d,
                                                 node_layout<S> const& layout = {}) {
  using std::abs;
  auto const bodies = detail::bodies_of(K);
  std::size_t largest = 0;
  S most(-1);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    S size(0);
    for (index const j : bodies[i]) size = std::max<S>(size, abs(S(d[j])));
    if (!(size > most)) continue;
    most = size;
    largest = i;
  }
  auto const& body = bodies[largest];
  Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> own(static_cast<index>(body.size()), 1);
  for (std::size_t j = 0; j < body.size(); ++j) own(static_cast<index>(j), 0) = d[body[j]];
  return detail::body_text(static_cast<index>(largest), body) +
         detail::motion_text(layout, body, own);
}

/// The free motions that made a factorisation refuse K; none if that has another reason.
template <class S>
[[nodiscard]] free_motions<S> motions_behind(bad_input const& refusal,
                                             Eigen::SparseMatrix<S> const& K,
                                             node_layout<S> const& layout) {
  if (!std::string_view(refusal.what()).starts_with("K: got pivot")) return {};
  auto motions = find_free_motions(K, layout);
  // A matrix that is indefinite as well is no matter of supports.
  if (!motions.undetermined.empty()) return {};
  return motions;
}

/// The refusal of a factorisation of K, with the free motions of K if these are its cause.
template <class S>
[[nodiscard]] bad_input with_free_motions(bad_input const& refusal,
                                          free_motions<S> const& motions) {
  std::string_view const text = refusal.what(), got = ": got ", expected = ", expected ";
  auto const value = text.find(got), end = text.find(expected);
  if (motions.free.empty() || value == text.npos || end == text.npos) return refusal;
  return {text.substr(0, value),
          std::string(text.substr(value + got.size(), end - value - got.size())) + ": " +
              motions.sentence(),
          std::string(text.substr(end + expected.size())) + ", with supports that hold every body"};
}

/// The factors of K, as slant::factorize; where it refuses a matrix that is singular by free
/// motions, the complaint names them.
template <class S>
[[nodiscard]] auto factorize_stiffness(Eigen::SparseMatrix<S> const& K,
                                       node_layout<S> const& layout = {}) {
  try {
    return slant::factorize(K);
  } catch (bad_input const& refusal) {
    slant::detail::require_symmetric_matrix("K", K);
    throw with_free_motions(refusal, find_free_motions(K, layout));
  }
}

#if SLANT_USES_COMPILED
extern template free_motions<double> find_free_motions<double>(Eigen::SparseMatrix<double> const&,
                                                               node_layout<double> const&);
extern template std::string name_motion<double, Eigen::VectorXd>(Eigen::SparseMatrix<double> const&,
                                                                 Eigen::VectorXd const&,
                                                                 node_layout<double> const&);
#endif

}  // namespace slant::contact
