// SPDX-License-Identifier: MIT
//
// Contact with Tresca friction as a problem for the displacements:
//
//     minimise  ½ uᵀKu − fᵀu + Σ gᵢ‖(T u)ᵢ‖   over   N u ≤ d         becomes
//     minimise  ½ vᵀ(G⁻ᵀK G⁻¹)v − (G⁻ᵀf)ᵀv + φ(v),      v = G u,
//
// φ of blocks of a component each for the gaps and of one or two for friction: the normal
// displacement of a contact between two bounds, g‖·‖ of its tangential one. Where the rows of N and
// T have one entry each (an obstacle parallel to a coordinate plane) G is the identity. K is never
// factored: the problem is for envelope_newton{problem.qp(), M} with the multigrid M of the same
// matrix.
#pragma once

#include <slant/base/matrix_entries.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/contact/contact_data.hpp>
#include <slant/multilevel/multigrid.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/problems/separable_qp.hpp>
#include <slant/sets/ball.hpp>
#include <slant/sets/blocks.hpp>
#include <slant/sets/interval.hpp>
#include <slant/sets/proximal_step.hpp>
#include <slant/sets/support.hpp>

#include <Eigen/Core>
#include <Eigen/QR>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace slant::contact {

// --- surface -------------------------------------------------------------------------------------

/// What contacts add to the energy of a vector of displacements: bounds of single components, and
/// g‖·‖ of one or two others. Components of no contact are free, and nothing is done for them.
template <class S = double>
class surface_function {
 public:
  using scalar = S;

  /// A contact in local coordinates: l ≤ v_p ≤ h, and g‖(v_q, v_{q+stride})‖.
  struct contact {
    interval<S> gap;
    index p;
    S g{0};
    index q = 0;
    index stride = 1;
    index number = 0;  ///< of the contact in the data
  };

  /// Contacts of vectors of n components with 0, 1 or 2 tangents each; no component of two of them.
  surface_function(index n, index tangents, std::vector<contact> contacts)
      : n_(n), tangents_(tangents), contacts_(std::move(contacts)) {}

  [[nodiscard]] index size() const { return n_; }
  [[nodiscard]] index block_count() const {
    return static_cast<index>(contacts_.size()) * (tangents_ > 0 ? 2 : 1);
  }
  [[nodiscard]] std::vector<contact> const& contacts() const { return contacts_; }
  [[nodiscard]] index tangents() const { return tangents_; }
  /// change(contact) for all of them, of their bounds alone.
  template <class F>
  void change_bounds(F change) {
    for (contact& c : contacts_) change(c);
  }

  /// x = prox_{ρφ}(z); x may be z.
  template <class Z, class X>
  void prox(S const& ρ, Z const& z, X& x) const {
    if (!slant::detail::same_memory(slant::local(z), slant::local(x))) {
      slant::local(x) = slant::local(z);
    }
    visit([&](auto const& block, auto const& p) {
      auto const from = p.value(x);
      p.put(x, slant::prox(block, ρ, from));
    });
  }
  /// φ(x), ∞ where a bound is violated.
  template <class X>
  [[nodiscard]] S value(X const& x) const {
    S sum(0);
    visit(
        [&](auto const& block, auto const& p) { sum += slant::function_value(block, p.value(x)); });
    return sum;
  }

  /// f(block, place): bounds are sets, friction is a support function.
  template <class F>
  void visit(F&& f) const {
    index number = 0;
    for (contact const& c : contacts_) {
      f(c.gap, place<1>(number++, c.p, 1));
      if (tangents_ == 1) {
        f(slant::support(symmetric_interval<S>(c.g)), place<1>(number++, c.q, 1));
      } else if (tangents_ == 2) {
        f(slant::support(ball<2, S>(c.g)), place<2, planar>(number++, c.q, 2, c.stride));
      }
    }
  }

 private:
  index n_;
  index tangents_;
  std::vector<contact> contacts_;
};

}  // namespace slant::contact

namespace slant::contact::detail {

// --- local coordinates ---------------------------------------------------------------------------
//
// v = G u in which the rows of N and T of a contact are multiples of unit vectors. Rows of one
// entry are that already. Otherwise, with O the unknowns that belong to this contact alone and S
// those that it shares with others, as the nodes of a face opposite of which several nodes lie,
//
//     v_O = H u_O + L u_S,     v_S = u_S,     u_O = Hᵀ(v_O − L v_S):
//
// H is the product of the Householder reflections that bring one row of (N, T)_O after the other
// onto an axis [Golub, Van Loan, 5.2.1], L the rest of the rows over their lengths. Contacts that
// share nothing have G = H, orthogonal. Where bodies are of different materials, components of
// contacts whose stiffness is far from the mean are scaled besides, by powers of two: methods have
// one step length for all blocks. What is needed: the parts of the rows on O are orthogonal,
// those of tangents of one length, and none is short beside its row.

/// The rows of one contact: entries (column, value) of N_i, then of T_i.
template <class S>
using local_rows = std::vector<std::vector<std::pair<index, S>>>;

/// Where a row acts: as `size` times component `component`, with the sign of `size`.
template <class S>
struct local_row {
  index component = -1;  ///< −1 for an empty row
  S size{0};
};

template <class S>
struct local_coordinates {
  using sparse_type = Eigen::SparseMatrix<S>;
  using rows_type = Eigen::SparseMatrix<S, Eigen::RowMajor>;
  using vector_type = Eigen::VectorX<S>;
  using matrix_type = Eigen::MatrixX<S>;

  std::vector<local_row<S>> normal;    ///< of each contact
  std::vector<local_row<S>> tangents;  ///< as the rows of T
  rows_type G;                         ///< n × n, empty if it is the identity
  sparse_type inverse;                 ///< G⁻¹, empty likewise
  std::string refusal;                 ///< why there are none, or empty

  explicit local_coordinates(data<S> const& c) {
    rows_type const N = c.N, T = c.T;
    index const n = c.f.size(), per = c.tangents();
    std::vector<index> owner(static_cast<std::size_t>(n), nobody);
    auto const for_each_row = [&](index i, auto f) {
      f(N, i);
      for (index k = 0; k < per; ++k) f(T, i * per + k);
    };
    for (index i = 0; i < c.nodes(); ++i) {
      for_each_row(i, [&](rows_type const& m, index r) {
        for (typename rows_type::InnerIterator e(m, r); e; ++e) {
          index& other = owner[static_cast<std::size_t>(e.col())];
          if (e.value() != S(0)) other = other == nobody || other == i ? i : several;
        }
      });
    }
    std::vector<Eigen::Triplet<S>> reflections, rest;
    for (index i = 0; i < c.nodes() && refusal.empty(); ++i) {
      local_rows<S> own, shared;
      for_each_row(i, [&](rows_type const& m, index r) {
        own.emplace_back();
        shared.emplace_back();
        for (typename rows_type::InnerIterator e(m, r); e; ++e) {
          if (e.value() == S(0)) continue;
          bool const mine = owner[static_cast<std::size_t>(e.col())] == i;
          (mine ? own : shared).back().emplace_back(e.col(), e.value());
        }
      });
      place_rows(own, shared, i, reflections, rest);
    }
    if (!refusal.empty() || reflections.empty()) return;
    std::vector<bool> turned(static_cast<std::size_t>(n), false);
    for (auto const& e : reflections) turned[static_cast<std::size_t>(e.row())] = true;
    for (index j = 0; j < n; ++j) {
      if (!turned[static_cast<std::size_t>(j)]) reflections.emplace_back(int(j), int(j), S(1));
    }
    rows_type H(n, n), L(n, n);
    H.setFromTriplets(reflections.begin(), reflections.end());
    inverse = H.transpose();
    if (rest.empty()) {
      G = std::move(H);
    } else {
      L.setFromTriplets(rest.begin(), rest.end());
      G = H + L;
      inverse -= sparse_type(inverse * sparse_type(L));
    }
  }

  /// Factors of the components of contacts for diagonal entries of K = G⁻ᵀK G⁻¹ near their mean, put
  /// into G; empty if all are 1.
  [[nodiscard]] vector_type scale(vector_type const& diagonal) {
    using std::sqrt;
    constexpr S far = S(64);
    S const mean = diagonal.mean();
    vector_type scales = vector_type::Ones(diagonal.size());
    auto const fit = [&](local_row<S>* row, std::size_t count) {
      if (count == 0 || row->component < 0) return;
      S const k = diagonal[row->component];
      if (!(k > S(0)) || (k <= far * mean && mean <= far * k)) return;
      S const factor = unit_near(S(sqrt(mean) / sqrt(k)));
      for (std::size_t r = 0; r < count; ++r) {
        if (row[r].component < 0) continue;
        scales[row[r].component] = factor;
        row[r].size *= factor;
      }
    };
    std::size_t const per = normal.empty() ? 0 : tangents.size() / normal.size();
    for (std::size_t i = 0; i < normal.size(); ++i) {
      fit(&normal[i], 1);
      fit(tangents.data() + i * per, per);
    }
    if ((scales.array() == S(1)).all()) return {};
    if (G.rows() == 0) {
      G.resize(scales.size(), scales.size());
      G.setIdentity();
      inverse = G;
    }
    G = scales.cwiseInverse().asDiagonal() * G;
    inverse = inverse * scales.asDiagonal();
    return scales;
  }

 private:
  static constexpr index nobody = -1, several = -2;

  /// Rows of a contact on its own unknowns, and on others.
  void place_rows(local_rows<S> const& own, local_rows<S> const& shared, index i,
                  std::vector<Eigen::Triplet<S>>& reflections,
                  std::vector<Eigen::Triplet<S>>& rest) {
    // The rows as dense vectors of their common support.
    std::vector<index> support;
    for (auto const& row : own) {
      for (auto const& [j, value] : row) support.push_back(j);
    }
    std::sort(support.begin(), support.end());
    support.erase(std::unique(support.begin(), support.end()), support.end());
    matrix_type a = matrix_type::Zero(index(own.size()), index(support.size()));
    bool single = true;
    for (std::size_t r = 0; r < own.size(); ++r) {
      for (auto const& [j, value] : own[r]) {
        a(index(r), std::lower_bound(support.begin(), support.end(), j) - support.begin()) = value;
      }
      single = single && own[r].size() <= 1 && shared[r].empty();
    }
    if (!complete(own, shared, i) || !orthogonal(a, i) || !weighty(own, shared, i)) return;
    std::vector<local_row<S>> where(own.size());
    if (single) {
      for (std::size_t r = 0; r < own.size(); ++r) {
        if (!own[r].empty()) where[r] = {own[r][0].first, own[r][0].second};
      }
    } else {
      reflect(a, support, where, reflections);
      for (std::size_t r = 0; r < own.size(); ++r) {
        for (auto const& [j, value] : shared[r]) {
          rest.emplace_back(int(where[r].component), int(j), value / where[r].size);
        }
      }
    }
    normal.push_back(where[0]);
    tangents.insert(tangents.end(), where.begin() + 1, where.end());
  }

  /// Whether N and T act both or neither of them, on unknowns of which a few are its own.
  bool complete(local_rows<S> const& own, local_rows<S> const& shared, index i) {
    auto const acts = [&](std::size_t r) { return !own[r].empty() || !shared[r].empty(); };
    for (std::size_t r = 1; r < own.size() && refusal.empty(); ++r) {
      if (acts(r) == acts(0)) continue;
      refusal = "contact " + slant::detail::show(i) + " has " + (acts(0) ? "an empty" : "a") +
                " row of T and " + (acts(0) ? "one" : "none") + " of N";
    }
    std::size_t entries = 0;
    for (auto const& row : own) entries = std::max(entries, row.size());
    if (entries > 64 && refusal.empty()) {
      refusal = "contact " + slant::detail::show(i) + " has a row of more than 64 unknowns";
    }
    return refusal.empty();
  }
  /// Whether no row has its greater part on unknowns of several contacts.
  bool weighty(local_rows<S> const& own, local_rows<S> const& shared, index i) {
    auto const size = [](auto const& row) {
      using std::abs;
      S sum(0);
      for (auto const& [j, value] : row) sum += abs(value);
      return sum;
    };
    for (std::size_t r = 0; r < own.size(); ++r) {
      if (S(4) * size(own[r]) >= size(shared[r])) continue;
      index const j = shared[r].front().first;
      refusal = "contact " + slant::detail::show(i) + " shares unknown " + slant::detail::show(j) +
                " with others, and has hardly any of its own";
      return false;
    }
    return true;
  }

  /// Whether rows are orthogonal and those of T of one length, up to rounding of what they are given
  /// with.
  bool orthogonal(matrix_type const& a, index i) {
    using std::abs;
    S const tolerance = S(1e5) * std::numeric_limits<S>::epsilon();
    matrix_type const products = a * a.transpose();
    vector_type const length = products.diagonal().cwiseSqrt();
    for (index r = 0; r < a.rows(); ++r) {
      for (index s = 0; s < r; ++s) {
        bool const differ = s > 0 && abs(S(length[r] - length[s])) > tolerance * length[s];
        if (abs(products(r, s)) > tolerance * length[r] * length[s] || differ) {
          refusal = "the rows of N and T of contact " + slant::detail::show(i) +
                    (differ ? " have tangents of different lengths" : " are not orthogonal");
          return false;
        }
      }
    }
    return true;
  }

  /// H on the support, rows that are not empty at its first components.
  static void reflect(matrix_type const& a, std::vector<index> const& support,
                      std::vector<local_row<S>>& where, std::vector<Eigen::Triplet<S>>& entries) {
    std::vector<index> full;
    for (index r = 0; r < a.rows(); ++r) {
      if (a.row(r).squaredNorm() > S(0)) full.push_back(r);
    }
    index const k = a.cols();
    Eigen::HouseholderQR<matrix_type> const qr(a(full, Eigen::all).transpose());
    for (std::size_t r = 0; r < full.size(); ++r) {
      auto const at = static_cast<index>(r);
      where[static_cast<std::size_t>(full[r])] = {support[r], qr.matrixQR()(at, at)};
    }
    matrix_type const Q = qr.householderQ() * matrix_type::Identity(k, k);
    for (index i = 0; i < k; ++i) {
      for (index j = 0; j < k; ++j) {
        if (Q(j, i) == S(0)) continue;
        entries.emplace_back(int(support[std::size_t(i)]), int(support[std::size_t(j)]), Q(j, i));
      }
    }
  }
};

/// A column of a sparse matrix while terms are added to it.
template <class S>
struct column_sum {
  Eigen::VectorX<S> entries;
  std::vector<bool> held;
  std::vector<index> rows{};

  explicit column_sum(index n)
      : entries(Eigen::VectorX<S>::Zero(n)), held(static_cast<std::size_t>(n)) {}

  void add(index i, S const& term) {
    entries[i] += term;
    if (held[static_cast<std::size_t>(i)]) return;
    held[static_cast<std::size_t>(i)] = true;
    rows.push_back(i);
  }
  /// f(row, entry) for all; none is left.
  template <class F>
  void take(F f) {
    for (index const i : rows) {
      held[static_cast<std::size_t>(i)] = false;
      f(i, std::exchange(entries[i], S(0)));
    }
    rows.clear();
  }
};

/// EᵀK E for an E of which most columns and rows are those of I: columns of K that meet no other ones
/// are copied. Nothing is subtracted, and what is not symmetric stays so.
template <class S>
[[nodiscard]] Eigen::SparseMatrix<S> congruent(Eigen::SparseMatrix<S> const& K,
                                               Eigen::SparseMatrix<S> const& E) {
  using sparse_type = Eigen::SparseMatrix<S>;
  using entry = typename sparse_type::InnerIterator;
  auto const is_own = [](sparse_type const& a, index j) {
    entry e(a, j);
    return e && e.row() == j && e.value() == S(1) && !++e;
  };
  sparse_type const rows = E.transpose();
  std::vector<bool> own(static_cast<std::size_t>(rows.cols()));
  for (index r = 0; r < rows.cols(); ++r) own[static_cast<std::size_t>(r)] = is_own(rows, r);

  sparse_type A(E.cols(), E.cols());
  A.reserve(K.nonZeros() + K.nonZeros() / 8);
  column_sum<S> of_KE(K.rows()), of_A(E.cols());
  for (index j = 0; j < E.cols(); ++j) {
    A.startVec(j);
    bool copied = is_own(E, j);
    for (entry k(K, j); copied && k; ++k) copied = own[static_cast<std::size_t>(k.row())];
    if (copied) {
      for (entry k(K, j); k; ++k) A.insertBack(k.row(), j) = k.value();
      continue;
    }
    for (entry e(E, j); e; ++e) {
      for (entry k(K, e.row()); k; ++k) of_KE.add(k.row(), e.value() * k.value());
    }
    of_KE.take([&](index r, S const& sum) {
      for (entry e(rows, r); e; ++e) of_A.add(e.row(), e.value() * sum);
    });
    std::ranges::sort(of_A.rows);
    of_A.take([&](index i, S const& sum) { A.insertBack(i, j) = sum; });
  }
  A.finalize();
  return A;
}

}  // namespace slant::contact::detail

namespace slant::contact {

// --- primal --------------------------------------------------------------------------------------

/// Why the displacements of a scene cannot be solved for directly, or nothing: contacts without
/// unknowns of their own, rows of N and T that are not orthogonal there.
template <class S>
[[nodiscard]] std::optional<std::string> primal_refusal(data<S> const& c) {
  detail::local_coordinates<S> const local(c);
  if (local.refusal.empty()) return std::nullopt;
  return local.refusal;
}

/// The problem at the top of this file. Refers to K; not movable, and qp() not
/// to be had from a temporary.
template <class S = double>
class primal {
 public:
  using vector_type = Eigen::VectorX<S>;
  using matrix_type = Eigen::MatrixX<S>;
  using sparse_type = Eigen::SparseMatrix<S>;

  /// K: n × n, both triangles, definite (which is asserted, not checked). Throws bad_input naming
  /// what does not fit: sizes, numbers that are not finite, and what primal_refusal says.
  primal(sparse_type const& K, data<S> const& c)
      : local_(checked(K, c)),
        K_(&K),
        own_(scaled(turned(K))),
        f_(turned(c.f)),
        d_(c.d),
        φ_(c.f.size(), c.tangents(), contacts(c)) {}
  primal(primal const&) = delete;
  primal& operator=(primal const&) = delete;

  /// G⁻ᵀK G⁻¹.
  [[nodiscard]] sparse_type const& matrix() const& { return own_.rows() > 0 ? own_ : *K_; }
  sparse_type const& matrix() const&& = delete;
  /// The problem; refers to this object.
  [[nodiscard]] auto qp() const& {
    return separable_qp{slant::matrix<self_adjoint, positive_definite>(matrix()), f_, φ_};
  }
  auto qp() const&& = delete;
  /// φ.
  [[nodiscard]] surface_function<S> const& surface() const& { return φ_; }
  surface_function<S> const& surface() const&& = delete;
  [[nodiscard]] vector_type zero() const { return vector_type::Zero(f_.size()); }
  /// The load becomes f: b of qp() changes with it.
  void set_load(vector_type const& f) {
    slant::detail::check_size("f", f.size(), f_.size(), "the number of unknowns,");
    f_ = turned(f);
    if (offset_.size() > 0) f_ -= K_offset_;
  }
  /// Friction begins to act where T u = w, in place of 0: unknowns are v = G u − s with T G⁻¹s = w
  /// from now on, s of tangential components. b of qp() changes. One product.
  void set_positions(vector_type const& w) {
    slant::detail::check_size("w", w.size(), index(local_.tangents.size()), "one per row of T,");
    if (offset_.size() > 0) f_ += K_offset_;
    offset_ = zero();
    for (index i = 0; i < w.size(); ++i) {
      auto const& row = local_.tangents[static_cast<std::size_t>(i)];
      if (row.component >= 0) offset_[row.component] = w[i] / row.size;
    }
    K_offset_ = matrix().transpose() * offset_;  // by columns, which are rows
    f_ -= K_offset_;
  }
  /// s, or nothing if that is 0; and the image of it.
  [[nodiscard]] vector_type const& offset() const& { return offset_; }
  [[nodiscard]] vector_type const& image_of_offset() const& { return K_offset_; }
  /// The slip bounds become g, one for each contact: φ changes, and qp() with it.
  void set_slip_bounds(vector_type const& g) {
    slant::detail::check_size("g", g.size(), d_.size(), "one for each contact,");
    φ_.change_bounds([&](auto& c) { c.g = slip_bound(c.number, g[c.number]); });
  }
  /// The gaps become d likewise.
  void set_gaps(vector_type const& d) {
    slant::detail::check_size("d", d.size(), d_.size(), "one for each contact,");
    d_ = d;
    φ_.change_bounds([&](auto& c) { c.gap = gap(c.number, d[c.number]); });
  }
  /// λ_ν of all contacts at v with the gradient of the problem, for a step length ρ: what the
  /// projection of v − ρ r onto the gaps takes away, over ρ.
  void pressures(vector_type const& v, vector_type const& r, S const& ρ, vector_type& λ) const {
    λ.setZero();
    for (auto const& c : φ_.contacts()) {
      auto const& row = local_.normal[static_cast<std::size_t>(c.number)];
      S const z = v[c.p] - ρ * r[c.p];
      S const force = (z - std::clamp<S>(z, c.gap.lower(), c.gap.upper())) / (ρ * row.size);
      if (force > S(0)) λ[c.number] = force;
    }
  }
  /// G, without rows where it is the identity.
  [[nodiscard]] typename detail::local_coordinates<S>::rows_type const& turning() const& {
    return local_.G;
  }
  /// Whether G is not the identity.
  [[nodiscard]] bool turns() const { return local_.G.rows() > 0; }
  /// Multigrid for matrix(), from candidates of the near kernel of K (n × r, or without columns).
  [[nodiscard]] slant::multigrid<S> levels(matrix_type const& candidates,
                                           multigrid_options const& o) const {
    auto own = o;
    // What slides in two directions has its unknowns in one node, also where K does not tell nodes.
    bool const is_open = o.block_size == 0 && o.coordinates.size() == 0 && o.prolongations.empty();
    bool const slides = local_.tangents.size() > local_.normal.size();
    if (is_open && slides && candidates.cols() == 0 && matrix().rows() % 3 == 0 &&
        detected_block_size(*K_) == 1) {
      own.block_size = 3;
    }
    if (!turns()) return slant::multigrid<S>(matrix(), candidates, own);
    return slant::multigrid<S>(own_, mixed_unknowns<S>{*K_, local_.G}, candidates, own);
  }

  /// u = G⁻¹(v + s).
  [[nodiscard]] vector_type displacement(vector_type const& v) const {
    slant::detail::check_size("v", v.size(), f_.size(), "the size of f,");
    if (offset_.size() == 0) return turns() ? vector_type(local_.inverse * v) : v;
    vector_type const moved = v + offset_;
    return turns() ? vector_type(local_.inverse * moved) : moved;
  }
  /// The forces (λ_ν, λ_t) of the contacts, f − K u = Nᵀλ_ν + Tᵀλ_t at a solution v. One product.
  [[nodiscard]] vector_type multipliers(vector_type const& v) const {
    slant::detail::check_size("v", v.size(), f_.size(), "the size of f,");
    vector_type const r = f_ - matrix().transpose() * v;
    auto const m = static_cast<index>(local_.normal.size());
    vector_type λ = vector_type::Zero(m + static_cast<index>(local_.tangents.size()));
    auto const force = [&](detail::local_row<S> const& row) {
      return row.component < 0 ? S(0) : S(r[row.component] / row.size);
    };
    for (index i = 0; i < m; ++i) {
      auto const& row = local_.normal[static_cast<std::size_t>(i)];
      bool const closes = row.component >= 0 && slant::detail::is_finite(d_[i]);
      S const λ_i = closes ? force(row) : S(0);
      if (λ_i > S(0)) λ[i] = λ_i;
    }
    for (index i = m; i < λ.size(); ++i) {
      λ[i] = force(local_.tangents[static_cast<std::size_t>(i - m)]);
    }
    return λ;
  }

 private:
  static detail::local_coordinates<S> checked(sparse_type const& K, data<S> const& c) {
    detail::check_scene(K, c);
    detail::local_coordinates<S> local(c);
    if (!local.refusal.empty()) {
      throw bad_input("N and T", local.refusal,
                      "contacts with unknowns of their own and orthogonal rows");
    }
    return local;
  }

  [[nodiscard]] sparse_type turned(sparse_type const& K) const {
    if (turns()) return detail::congruent(K, local_.inverse);
    if (K.isCompressed()) return {};
    sparse_type copy = K;
    copy.makeCompressed();
    return copy;
  }
  /// Of K in local coordinates, or nothing if that is K.
  [[nodiscard]] sparse_type scaled(sparse_type own) {
    sparse_type const& K = own.rows() == 0 ? *K_ : own;
    vector_type diagonal(K.rows());
    slant::detail::copy_diagonal(K, diagonal);
    vector_type const scales = local_.scale(diagonal);
    if (scales.size() == 0) return own;
    return scales.asDiagonal() * K * scales.asDiagonal();
  }
  [[nodiscard]] vector_type turned(vector_type const& f) const {
    if (!turns()) return f;
    return vector_type(local_.inverse.transpose() * f);
  }

  /// Bounds of the normal component of a contact with this gap.
  [[nodiscard]] interval<S> gap(index contact, S const& d) const {
    constexpr S infinity = std::numeric_limits<S>::infinity();
    auto const& row = local_.normal[static_cast<std::size_t>(contact)];
    if (row.component < 0 || !(d < infinity)) return {-infinity, infinity};
    return row.size > S(0) ? interval<S>(-infinity, d / row.size)
                           : interval<S>(d / row.size, infinity);
  }
  /// g‖·‖ of the tangential components of a contact with this slip bound; 0 without any.
  [[nodiscard]] S slip_bound(index contact, S const& g) const {
    using std::abs;
    auto const per = local_.tangents.size() / local_.normal.size();
    if (per == 0 || !slant::detail::is_finite(g)) return g;
    return S(g * abs(local_.tangents[static_cast<std::size_t>(contact) * per].size));
  }

  [[nodiscard]] std::vector<typename surface_function<S>::contact> contacts(
      data<S> const& c) const {
    index const per = c.tangents();
    std::vector<typename surface_function<S>::contact> list;
    list.reserve(local_.normal.size());
    for (index i = 0; i < c.nodes(); ++i) {
      auto const& normal = local_.normal[static_cast<std::size_t>(i)];
      auto const* const t = local_.tangents.data() + static_cast<std::size_t>(i * per);
      bool acts = normal.component >= 0;
      for (index k = 0; k < per; ++k) acts = acts && t[k].component >= 0;
      if (!acts) continue;
      typename surface_function<S>::contact here{gap(i, c.d[i]), normal.component};
      here.number = i;
      if (per > 0) {
        here.g = slip_bound(i, c.g[i]);
        here.q = t[0].component;
      }
      if (per == 2) here.stride = t[1].component - t[0].component;
      list.push_back(here);
    }
    return list;
  }

  detail::local_coordinates<S> local_;
  sparse_type const* K_;
  sparse_type own_;  // G⁻ᵀK G⁻¹, or a compressed copy, or nothing
  vector_type f_, d_;
  vector_type offset_{}, K_offset_{};  // s and its image, empty: 0
  surface_function<S> φ_;
};

template <class S>
primal(Eigen::SparseMatrix<S> const&, data<S> const&) -> primal<S>;

}  // namespace slant::contact
