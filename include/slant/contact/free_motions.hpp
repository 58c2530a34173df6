// SPDX-License-Identifier: MIT
//
// The motions of bodies that a stiffness matrix K does not resist, and their names.
//
//     given     of nodes that nothing holds: translations, and the linearised rotations ω × (x − x̄)
//               about their centre (rigid_body_modes)
//     found     bodies are the connected components of the graph of K, numbered from 0 in the order
//               of their first unknowns; the free motions R of a body are the kernel of its block,
//               orthonormal, by inverse iteration (computed_kernel): rigid ones, if it is elastic
//     names     where the places of the unknowns are known: R = Φ C with the rigid motions Φ about
//               the centre of the body. Combinations without rotation are translations, the others
//               turn about the axes that are left.
//
// Finding them costs a factorisation for each body, and a few solves.
#pragma once

#include <slant/base/entries.hpp>
#include <slant/base/scaling.hpp>
#include <slant/compiled.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/contact/node_layout.hpp>
#include <slant/contact/parts/prepared_body.hpp>
#include <slant/factorizations/factorize.hpp>
#include <slant/factorizations/kernel_basis.hpp>
#include <slant/multilevel/aggregation.hpp>

#include <Eigen/Core>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace slant::contact::detail {

// --- rigid-body modes ----------------------------------------------------------------------------

/// Coordinates about the mean of all nodes, in multiples of the largest one. Directions in which
/// they differ by no more than its rounding errors are left out: a line must not become a rotation,
/// wherever it lies.
template <class S, class M>
[[nodiscard]] Eigen::MatrixX<S> about_centre(M const& nodes) {
  using std::sqrt;
  using matrix_type = Eigen::MatrixX<S>;
  auto const n = static_cast<S>(static_cast<double>(nodes.cols()));
  matrix_type x = nodes;
  S const factor = S(1) / unit_near(slant::detail::largest_of(x));
  for (index i = 0; i < x.rows(); ++i) {
    x.row(i) *= factor;
    x.row(i).array() -= x.row(i).sum() / n;
  }
  Eigen::JacobiSVD<matrix_type> const svd(x, Eigen::ComputeThinU);
  S const rounding = S(16) * sqrt(n) * std::numeric_limits<S>::epsilon();
  index rank = 0;
  for (S const& σ : svd.singularValues()) rank += σ > rounding ? 1 : 0;
  matrix_type const axes = svd.matrixU().leftCols(rank);
  return axes * matrix_type(axes.transpose() * x);
}

}  // namespace slant::contact::detail

namespace slant::contact {

/// Orthonormal basis of the motions of n nodes, D n × 3 in the plane (D = 2) and D n × 6 in space;
/// fewer where nodes on a line, or a single one, leave rotations without effect. `nodes` has D rows
/// and a column for each node; node i has the unknowns D i … D i + D − 1. Throws bad_input for
/// another number of rows, coordinates that are not finite, or no nodes.
template <class M>
[[nodiscard]] auto rigid_body_modes(Eigen::MatrixBase<M> const& nodes)
    -> Eigen::MatrixX<typename M::Scalar> {
  using S = typename M::Scalar;
  index const D = nodes.rows(), n = nodes.cols();
  if (D != 2 && D != 3) {
    throw bad_input("rows of nodes", slant::detail::show(D), "2 or 3 coordinates");
  }
  if (n < 1) throw bad_input("columns of nodes", slant::detail::show(n), "at least one node");
  slant::detail::require_finite_entries("nodes", nodes.derived());

  return slant::detail::orthonormal_basis<S>(slant::detail::rigid_motions<S>(
      detail::about_centre<S>(nodes), D * n, [D](index j) { return j / D; },
      [D](index j) { return j % D; }));
}

}  // namespace slant::contact

namespace slant::contact::detail {

// --- rigid names ---------------------------------------------------------------------------------

/// "body 2 (unknowns 300 … 899)".
[[nodiscard, gnu::cold]] inline std::string body_text(index number,
                                                      std::vector<index> const& unknowns) {
  using slant::detail::show;
  auto const count = index(unknowns.size());
  std::string text = "body " + show(number);
  if (count == 0) return text;
  if (count == 1) return text + " (unknown " + show(unknowns.front()) + ")";
  bool const contiguous = unknowns.back() - unknowns.front() + 1 == count;
  return text + " (" + (contiguous ? "" : show(count) + " of the ") + "unknowns " +
         show(unknowns.front()) + " to " + show(unknowns.back()) + ")";
}

/// "a, b and c".
[[nodiscard, gnu::cold]] inline std::string enumeration(std::vector<std::string> const& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    text.append(i == 0 ? "" : i + 1 == words.size() ? " and " : ", ").append(words[i]);
  }
  return text;
}

/// "(0.6, 0, 0.8)"; components that are rounding errors of the largest, or of `size`, are 0.
template <class V>
[[nodiscard, gnu::cold]] std::string rounded_vector(V const& v, typename V::Scalar const& size) {
  using std::abs;
  std::string text = "(";
  for (index i = 0; i < v.size(); ++i) {
    typename V::Scalar const x = v[i];
    bool const is_zero = abs(x) <= typename V::Scalar(1e-6) * size;
    text.append(i == 0 ? "" : ", ").append(is_zero ? "0" : slant::detail::brief(x));
  }
  return text + ")";
}

/// The rigid motions about the middle of a body in multiples of its size, restricted to its
/// unknowns: D translations, then one rotation in the plane, three about x, y and z in space.
template <class S>
struct rigid_frame {
  using matrix_type = Eigen::MatrixX<S>;
  using vector_type = Eigen::VectorX<S>;

  index D = 0;
  vector_type centre{};
  S size = S(0);
  matrix_type Φ{};

  rigid_frame(node_layout<S> const& layout, std::vector<index> const& unknowns)
      : D(layout.dimension()) {
    auto const n = index(unknowns.size());
    auto const [low, high] = layout.box(unknowns);
    centre = (low + high) / S(2);
    size = (high - low).maxCoeff();
    S const length = size > S(0) ? size : S(1);
    index const rotations = D == 2 ? 1 : 3;
    Φ = matrix_type::Zero(n, D + rotations);
    for (index j = 0; j < n; ++j) {
      index const unknown = unknowns[std::size_t(j)];
      index const a = layout.axis[std::size_t(unknown)];
      vector_type const r = (layout.place(unknown) - centre) / length;
      Φ(j, a) = S(1);
      for (index about = D == 2 ? 2 : 0; about < 3; ++about) {  // ω × r, ω the unit vector
        index const b = (about + 1) % 3, c = (about + 2) % 3, column = D == 2 ? D : D + about;
        if (a == c && b < D) Φ(j, column) = r[b];
        if (a == b && c < D) Φ(j, column) = -r[c];
      }
    }
  }
};

/// What a few motions R of a body are made of. Not rigid: neither translations nor rotations.
template <class S>
struct rigid_parts {
  using matrix_type = Eigen::MatrixX<S>;
  bool rigid = false;
  matrix_type translations{};  ///< orthonormal columns
  matrix_type rotations{};     ///< orthonormal columns: directions of the axes
  matrix_type moved{};  ///< the velocity of the centre for each rotation, no translation in it
};

/// An orthonormal basis of the directions in which the columns of m extend by more than rounding
/// errors of `size`, and the combinations of columns: m V = U diag(σ), first those, then the rest.
template <class S>
struct column_space {
  using matrix_type = Eigen::MatrixX<S>;
  matrix_type U{}, V{};
  Eigen::VectorX<S> σ{};
  index rank = 0;

  column_space(matrix_type const& m, S const& size) {
    if (m.cols() == 0 || m.rows() == 0) {
      V = matrix_type::Identity(m.cols(), m.cols());
      U.resize(m.rows(), 0);
      return;
    }
    // Columns of zeros make V square with a thin decomposition.
    matrix_type padded = matrix_type::Zero(std::max<index>(m.rows(), m.cols()), m.cols());
    padded.topRows(m.rows()) = m;
    Eigen::JacobiSVD<matrix_type> const svd(padded, Eigen::ComputeThinU | Eigen::ComputeThinV);
    for (S const& s : svd.singularValues()) rank += s > S(1e-6) * size ? 1 : 0;
    U = svd.matrixU().topLeftCorner(m.rows(), rank);
    V = svd.matrixV();
    σ = svd.singularValues();
  }
};

template <class S>
[[nodiscard]] rigid_parts<S> parts_of(rigid_frame<S> const& frame, Eigen::MatrixX<S> const& R) {
  using matrix_type = Eigen::MatrixX<S>;
  rigid_parts<S> parts;
  matrix_type const C = frame.Φ.colPivHouseholderQr().solve(R);
  // Rigid up to the rounding errors of K and of coordinates that were written with seven digits.
  parts.rigid = (frame.Φ * C - R).norm() <= S(1e-5) * R.norm();
  if (!parts.rigid) return parts;
  index const D = frame.D;
  column_space<S> const turning(matrix_type(C.bottomRows(C.rows() - D)), S(C.norm()));
  index const r = turning.rank, rest = R.cols() - r;
  matrix_type const shifts = C.topRows(D) * turning.V.rightCols(rest);
  parts.translations = column_space<S>(shifts, S(C.norm())).U;
  parts.rotations = turning.U;
  parts.moved = C.topRows(D) * turning.V.leftCols(r);
  for (index k = 0; k < r; ++k) parts.moved.col(k) /= turning.σ[k];
  parts.moved -= parts.translations * matrix_type(parts.translations.transpose() * parts.moved);
  return parts;
}

/// The names of the axes that span the columns of W, orthonormal; else the columns as vectors.
template <class M>
[[nodiscard]] std::vector<std::string> axis_names(M const& W) {
  using S = typename M::Scalar;
  std::vector<std::string> names;
  for (index a = 0; a < W.rows(); ++a) {
    if (W.row(a).norm() >= S(1) - S(1e-5)) names.emplace_back(1, "xyz"[a]);
  }
  if (index(names.size()) == W.cols()) return names;
  names.clear();
  for (index k = 0; k < W.cols(); ++k) {
    index largest = 0;
    W.col(k).cwiseAbs().maxCoeff(&largest);
    S const sign = W(largest, k) < S(0) ? S(-1) : S(1);
    names.push_back(rounded_vector((sign * W.col(k)).eval(), S(1)));
  }
  return names;
}

/// The axes of the rotations: "z", or "an axis along z through (0, 1, 0)" where it is not free.
template <class S>
[[nodiscard]] std::vector<std::string> rotation_names(rigid_frame<S> const& frame,
                                                      rigid_parts<S> const& parts) {
  using vector_type = Eigen::VectorX<S>;
  using matrix_type = Eigen::MatrixX<S>;
  index const D = frame.D, count = parts.rotations.cols();
  if (D == 2) {
    if (parts.translations.cols() > 0) return {"z"};
    vector_type const v = parts.moved.col(0) * parts.rotations(0, 0);
    vector_type p(2);
    p << -v[1], v[0];
    p = frame.centre + frame.size * p;
    return {"the point " + rounded_vector(p, S(frame.size + frame.centre.cwiseAbs().maxCoeff()))};
  }
  auto const names = axis_names(parts.rotations);
  bool const axes = !names.empty() && names.front().size() == 1;
  std::vector<std::string> texts;
  for (index k = 0; k < count; ++k) {
    vector_type ω = parts.rotations.col(k), v = parts.moved.col(k);
    if (axes) {  // the combination that turns about this axis
      ω = vector_type::Unit(3, names[std::size_t(k)][0] - 'x');
      v = parts.moved * vector_type(parts.rotations.transpose() * ω);
    }
    std::string const& name = names[std::size_t(k)];
    // A translation across the axis that is free as well leaves the axis anywhere.
    matrix_type across = parts.translations;
    for (index j = 0; j < across.cols(); ++j) across.col(j) -= ω * ω.dot(across.col(j));
    if (column_space<S>(across, S(1)).rank > 0 || count > 1) {
      texts.push_back(name);
      continue;
    }
    vector_type p(3);
    p << ω[1] * v[2] - ω[2] * v[1], ω[2] * v[0] - ω[0] * v[2], ω[0] * v[1] - ω[1] * v[0];
    p = frame.centre + frame.size * p;
    using std::abs;
    bool const screw = abs(ω.dot(v)) > S(1e-5);
    texts.push_back("the axis along " + name + " through " +
                    rounded_vector(p, S(frame.size + frame.centre.cwiseAbs().maxCoeff())) +
                    (screw ? " while it moves along it" : ""));
  }
  return texts;
}

/// " can move along x and turn about z"; " has 3 free motions" where places are not known.
template <class S>
[[nodiscard, gnu::cold]] std::string motions_text(node_layout<S> const& layout,
                                                  std::vector<index> const& unknowns,
                                                  Eigen::MatrixX<S> const& R) {
  using slant::detail::show;
  std::string const number =
      " has " + show(index(R.cols())) + (R.cols() == 1 ? " free motion" : " free motions");
  if (!layout.is_known()) return number;
  rigid_frame<S> const frame(layout, unknowns);
  auto const parts = parts_of<S>(frame, R);
  if (!parts.rigid) return number + ", not all of them rigid";
  std::string text = " can";
  if (parts.translations.cols() > 0)
    text += " move along " + enumeration(axis_names(parts.translations));
  if (parts.rotations.cols() > 0) {
    text += parts.translations.cols() > 0 ? " and turn about " : " turn about ";
    text += enumeration(rotation_names(frame, parts));
  }
  return text;
}

/// " moves along x", " turns about z", or only " moves".
template <class S>
[[nodiscard, gnu::cold]] std::string motion_text(node_layout<S> const& layout,
                                                 std::vector<index> const& unknowns,
                                                 Eigen::MatrixX<S> const& direction) {
  if (!layout.is_known()) return " moves";
  rigid_frame<S> const frame(layout, unknowns);
  auto const parts = parts_of<S>(frame, direction);
  if (!parts.rigid) return " moves";
  if (parts.rotations.cols() > 0) return " turns about " + rotation_names(frame, parts).front();
  if (parts.translations.cols() == 0) return " moves";
  // With the sign that it has.
  Eigen::VectorX<S> way = (frame.Φ.colPivHouseholderQr().solve(direction)).col(0).head(frame.D);
  way /= way.norm();
  for (index a = 0; a < frame.D; ++a) {
    using std::abs;
    if (abs(way[a]) >= S(1) - S(1e-5))
      return std::string(" moves along ") + (way[a] < S(0) ? "-" : "") + "xyz"[a];
  }
  return " moves along " + rounded_vector(way, S(1));
}

}  // namespace slant::contact::detail

namespace slant::contact {

// --- free motions --------------------------------------------------------------------------------

/// A body that K does not hold.
template <class S = double>
struct free_body {
  index number = 0;             ///< among all bodies, from 0
  std::vector<index> unknowns;  ///< in increasing order
  Eigen::MatrixX<S> motions;    ///< R, unknowns × dimension
  std::string text;             ///< "body 2 can move along x"
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
          .append(slant::detail::show(index(free.size()) - 4))
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
  result.bodies = index(bodies.size());
  auto const number = detail::numbers_within(bodies, K.rows());
  for (index i = 0; i < result.bodies; ++i) {
    auto& body = bodies[std::size_t(i)];
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
  Eigen::MatrixX<S> const own = d(body);
  return detail::body_text(index(largest), body) + detail::motion_text(layout, body, own);
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
