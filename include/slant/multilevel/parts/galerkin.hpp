// SPDX-License-Identifier: MIT
//
// The matrix of a coarse level, A_c = PᵀA P, in two stages: with (AP)_i the row i of A P,
//
//     (AP)_iJ = Σ_j A_ij P_jJ,        (A_c)_IJ = Σ_i P_iIᵀ (AP)_iJ,
//
// row after row of the fine level, so that A P is never stored. Only blocks with J ≤ I are formed,
// the others are their mirror images.
//
// Changes. Where A becomes A + δ, and δ is 0 but for rows and columns H, A_c becomes A_c + Pᵀδ P.
// Only rows H of δ and the rows of their parents by P need to be visited:
//
//     (Pᵀδ P)_IJ = D_IJ + D_JIᵀ,     D_IJ = Σ_{i∈H} P_iIᵀ Σ_j w_j δ_ij P_jJ,
//
// w_j = ½ for j ∈ H, whose row has δ_ji, else 1.
#pragma once

#include <slant/base/long_arrays.hpp>
#include <slant/multilevel/block_matrix.hpp>
#include <slant/multilevel/parts/lanes.hpp>
#include <slant/multilevel/parts/prolongation.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace slant::detail {

/// A as it is: every block(i, j, entries) is those entries.
struct whole_blocks {
  template <class T>
  [[nodiscard]] T const* operator()(int, int, T const* entries) const {
    return entries;
  }
};

/// What forming coarse rows needs; big enough for two levels and all of their rows.
template <int N, int M, class T>
struct galerkin_scratch {
  std::vector<int> place;        // of a coarse node in the list of a row of A P, or −1
  std::vector<int> list;         // coarse nodes of that row
  std::vector<lanes<T, M>> row;  // their blocks, N lanes each
  std::vector<unsigned char> changed, parent;  // fine nodes in H; coarse ones that are parents

  galerkin_scratch() = default;
  galerkin_scratch(prolongation<N, M, T> const& P, std::size_t longest)
      : place(static_cast<std::size_t>(P.coarse_nodes), -1),
        row(longest * N, lanes<T, M>::zero()),
        changed(static_cast<std::size_t>(P.nodes()), 0),
        parent(place.size(), 0) {
    list.reserve(longest);
  }
};

/// The pattern of PᵀA P, and how many blocks its widest row of A P has.
template <int N, int M, class T>
[[nodiscard]] block_matrix<M, T> galerkin_pattern(block_matrix<N, T> const& A,
                                                  prolongation<N, M, T> const& P,
                                                  std::size_t& longest) {
  auto const coarse = static_cast<std::size_t>(P.coarse_nodes);
  std::vector<int> seen(coarse, -1);
  // Rows of A P.
  std::vector<int> begin{0}, nodes;
  begin.reserve(static_cast<std::size_t>(A.nodes()) + 1);
  nodes.reserve(2 * P.column.size());
  longest = 0;
  for (int i = 0; i < A.nodes(); ++i) {
    A.for_each_in_row(i, [&](int j, T const*) {
      for (int e = P.begin(j); e < P.end(j); ++e) {
        int& mark = seen[static_cast<std::size_t>(P.at(e))];
        if (mark == i) continue;
        mark = i;
        nodes.push_back(P.at(e));
      }
    });
    longest = std::max(longest, nodes.size() - static_cast<std::size_t>(begin.back()));
    begin.push_back(static_cast<int>(nodes.size()));
  }
  // Rows of Pᵀ.
  std::vector<int> child_begin(coarse + 1, 0), child(P.column.size());
  for (int const c : P.column) ++child_begin[static_cast<std::size_t>(c) + 1];
  for (std::size_t c = 0; c < coarse; ++c) child_begin[c + 1] += child_begin[c];
  std::vector<int> next(child_begin.begin(), child_begin.end() - 1);
  for (int i = 0; i < P.nodes(); ++i) {
    for (int e = P.begin(i); e < P.end(i); ++e) {
      int& to = next[static_cast<std::size_t>(P.at(e))];
      child[static_cast<std::size_t>(to++)] = i;
    }
  }
  std::fill(seen.begin(), seen.end(), -1);
  std::vector<int> first{0};
  long_array<int> column;
  for (int I = 0; I < P.coarse_nodes; ++I) {
    auto const start = static_cast<std::ptrdiff_t>(column.size());
    for (int c = child_begin[static_cast<std::size_t>(I)];
         c < child_begin[static_cast<std::size_t>(I) + 1]; ++c) {
      auto const i = static_cast<std::size_t>(child[static_cast<std::size_t>(c)]);
      for (int k = begin[i]; k < begin[i + 1]; ++k) {
        int const J = nodes[static_cast<std::size_t>(k)];
        if (J >= I || seen[static_cast<std::size_t>(J)] == I) continue;
        seen[static_cast<std::size_t>(J)] = I;
        column.push_back(J);
      }
    }
    std::sort(column.begin() + start, column.end());
    first.push_back(static_cast<int>(column.size()));
  }
  return block_matrix<M, T>(std::move(first), std::move(column));
}

/// Whether blocks are formed by columns, those of weights, or by rows.
template <int N, int M, class T>
[[nodiscard]] bool forms_columns(prolongation<N, M, T> const& P) {
  return N == M && P.weights;
}

/// Row i of A P in w, without the coarse nodes that it does not reach. block(i, j, entries) → what stands for the
/// block (i, j) of A.
template <int N, int M, class T, class Block>
void multiply_row(block_matrix<N, T> const& A, prolongation<N, M, T> const& P, int i,
                  galerkin_scratch<N, M, T>& w, Block const& block) {
  using wide = lanes<T, M>;
  w.list.clear();
  A.for_each_in_row(i, [&](int j, T const* entries) {
    if (P.begin(j) == P.end(j)) return;
    T const* const a = block(i, j, entries);
    for (int e = P.begin(j); e < P.end(j); ++e) {
      int& place = w.place[static_cast<std::size_t>(P.at(e))];
      if (place < 0) {
        place = static_cast<int>(w.list.size()) * N;
        w.list.push_back(P.at(e));
        for (int q = 0; q < N; ++q) w.row[static_cast<std::size_t>(place + q)] = wide::zero();
      }
      wide* const to = w.row.data() + place;
      if (forms_columns(P)) {
        unrolled<N>([&](auto c)
                        __attribute__((always_inline)) { to[c].add(a + N * c, P.weight(e)); });
      } else {
        T const* const p = P.block(e);
        unrolled<N>([&](auto k) __attribute__((always_inline)) {
          wide const row = wide::load(p + M * k);
          unrolled<N>([&](auto q) __attribute__((always_inline)) { to[q].add(row, a[N * k + q]); });
        });
      }
    }
  });
}

/// to += P_eᵀ times block J of the row in w, if it has one.
template <int N, int M, class T>
[[gnu::always_inline]] inline void add_to_block(prolongation<N, M, T> const& P, int e, int J, T* to,
                                                galerkin_scratch<N, M, T> const& w) {
  using wide = lanes<T, M>;
  int const place = w.place[static_cast<std::size_t>(J)];
  if (place < 0) return;
  wide const* const from = w.row.data() + place;
  if (forms_columns(P)) {
    unrolled<M>([&](auto c) __attribute__((always_inline)) {
      wide s = wide::load(to + M * c);
      s.add(from[c], P.weight(e));
      s.store(to + M * c);
    });
  } else {
    T const* const p = P.block(e);
    unrolled<M>([&](auto c) __attribute__((always_inline)) {
      wide s = wide::load(to + M * c);
      unrolled<N>([&](auto q) __attribute__((always_inline)) { s.add(from[q], p[M * q + c]); });
      s.store(to + M * c);
    });
  }
}

template <int N, int M, class T>
void forget_row(galerkin_scratch<N, M, T>& w) {
  for (int const J : w.list) w.place[static_cast<std::size_t>(J)] = -1;
}

/// PᵀA P.
template <int N, int M, class T>
void galerkin(block_matrix<N, T> const& A, prolongation<N, M, T> const& P, block_matrix<M, T>& C,
              galerkin_scratch<N, M, T>& w) {
  std::fill(C.lower().entries.begin(), C.lower().entries.end(), T(0));
  for (int I = 0; I < C.nodes(); ++I) std::fill(C.diagonal(I), C.diagonal(I) + M * M, T(0));
  for (int i = 0; i < A.nodes(); ++i) {
    if (P.begin(i) == P.end(i)) continue;
    multiply_row(A, P, i, w, whole_blocks{});
    for (int t = P.begin(i); t < P.end(i); ++t) {
      int const I = P.at(t);
      for (int e = C.lower().begin(I); e < C.lower().end(I); ++e) {
        add_to_block(P, t, C.lower().at(e), C.lower().block(e), w);
      }
      add_to_block(P, t, I, C.diagonal(I), w);
    }
    forget_row(w);
  }
  // Mirror images; what was formed by rows is one already.
  std::vector<int> next(C.upper().first.begin(), C.upper().first.end() - 1);
  for (int I = 0; I < C.nodes(); ++I) {
    T* const d = C.diagonal(I);
    for (int c = 0; c < M; ++c) {
      for (int q = 0; q < c; ++q) d[M * c + q] = d[M * q + c];
    }
    for (int e = C.lower().begin(I); e < C.lower().end(I); ++e) {
      int& to = next[static_cast<std::size_t>(C.lower().at(e))];
      T *here = C.lower().block(e), *there = C.upper().block(to++);
      if (!forms_columns(P)) {
        std::copy(here, here + M * M, there);
        std::swap(here, there);
      }
      for (int c = 0; c < M; ++c) {
        for (int q = 0; q < M; ++q) there[M * c + q] = here[M * q + c];
      }
    }
  }
}

/// C += Pᵀδ P, where A has the pattern of δ and block(i, j, entries) → δ_ij for i in `fine`. D, of
/// the pattern of C, has the rows of Pᵀδ P of their parents afterwards, and other rows mean nothing.
template <int N, int M, class T, class Block>
void galerkin_change(block_matrix<N, T> const& A, prolongation<N, M, T> const& P,
                     block_matrix<M, T>& C, block_matrix<M, T>& D, std::vector<int> const& fine,
                     std::vector<int>& parents, galerkin_scratch<N, M, T>& w, Block block) {
  parents.clear();
  for (int const i : fine) {
    w.changed[static_cast<std::size_t>(i)] = 1;
    for (int e = P.begin(i); e < P.end(i); ++e) {
      auto& parent = w.parent[static_cast<std::size_t>(P.at(e))];
      if (parent == 0) parents.push_back(P.at(e));
      parent = 1;
    }
  }
  for (int const I : parents) {
    D.for_each_in_row(I, [](int, T* to) { std::fill(to, to + M * M, T(0)); });
  }
  std::array<T, block_matrix<N, T>::padded_block> half{};
  for (int const i : fine) {
    if (P.begin(i) == P.end(i)) continue;
    multiply_row(A, P, i, w, [&](int, int j, T const* entries) {
      T const* const δ = block(i, j, entries);
      if (w.changed[static_cast<std::size_t>(j)] == 0) return δ;
      for (std::size_t k = 0; k < N * N; ++k) half[k] = δ[k] / 2;
      return static_cast<T const*>(half.data());
    });
    for (int t = P.begin(i); t < P.end(i); ++t) {
      D.for_each_in_row(P.at(t), [&](int J, T* to) { add_to_block(P, t, J, to, w); });
    }
    forget_row(w);
  }
  int const across = forms_columns(P) ? M : 1, along = forms_columns(P) ? 1 : M;
  for (int const I : parents) {
    auto const finish = [&](int J, T* here, T* there, T* of_c, T* mirrored) {
      bool const both = w.parent[static_cast<std::size_t>(J)] != 0;
      T v[M * M];
      for (int c = 0; c < M; ++c) {
        for (int q = 0; q < M; ++q) {
          v[M * c + q] = here[across * c + along * q];
          if (both) v[M * c + q] += there[across * q + along * c];
        }
      }
      for (int c = 0; c < M; ++c) {
        for (int q = 0; q < M; ++q) {
          here[M * c + q] = v[M * c + q];
          of_c[M * c + q] += v[M * c + q];
          if (here == there) continue;
          mirrored[M * q + c] += v[M * c + q];
          if (both) there[M * q + c] = v[M * c + q];
        }
      }
    };
    finish(I, D.diagonal(I), D.diagonal(I), C.diagonal(I), C.diagonal(I));
    for (int e = C.lower().begin(I); e < C.lower().end(I); ++e) {
      int const J = C.lower().at(e), f = C.upper().find(J, I);
      finish(J, D.lower().block(e), D.upper().block(f), C.lower().block(e), C.upper().block(f));
    }
    for (int e = C.upper().begin(I); e < C.upper().end(I); ++e) {
      int const J = C.upper().at(e);
      if (w.parent[static_cast<std::size_t>(J)] != 0) continue;  // from there
      int const f = C.lower().find(J, I);
      finish(J, D.upper().block(e), D.lower().block(f), C.upper().block(e), C.lower().block(f));
    }
  }
  for (int const I : parents) w.parent[static_cast<std::size_t>(I)] = 0;
  for (int const i : fine) w.changed[static_cast<std::size_t>(i)] = 0;
}

}  // namespace slant::detail
