// SPDX-License-Identifier: MIT
//
// The matrix of a coarse level, A_c = PᵀA P, in two stages: with (AP)_i the row i of A P,
//
//     (AP)_iJ = Σ_j A_ij P_jJ,        (A_c)_IJ = Σ_i P_iIᵀ (AP)_iJ,
//
// row after row of the fine level, so that A P is never stored. Only blocks with J ≤ I are formed,
// the others are their mirror images.
//
// Rows anew. Where A has changed in rows and columns H, A_c changes in blocks (I, J) of which I or
// J is a parent of H by P. So the rows of the parents are formed anew from the rows of their
// children, nothing is subtracted, and the mirror images of their blocks follow in the other rows.
#pragma once

#include <slant/concepts/scalar.hpp>
#include <slant/multilevel/block_matrix.hpp>
#include <slant/multilevel/parts/lanes.hpp>
#include <slant/multilevel/parts/prolongation.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
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
  std::vector<unsigned char> wanted, needed;  // coarse rows to form; fine rows that takes

  galerkin_scratch() = default;
  galerkin_scratch(prolongation<N, M, T> const& P, std::size_t longest)
      : place(static_cast<std::size_t>(P.coarse_nodes), -1),
        row(longest * N, lanes<T, M>::zero()),
        wanted(place.size(), 0),
        needed(static_cast<std::size_t>(P.nodes()), 0) {
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
  std::vector<int> first{0}, column;
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

/// The entries of rows of C = PᵀA P: those with wanted[I], or all. block(i, j, entries) → what
/// stands for the block (i, j) of A.
template <int N, int M, class T, class Block>
void galerkin_rows(block_matrix<N, T> const& A, prolongation<N, M, T> const& P,
                   block_matrix<M, T>& C, bool all, galerkin_scratch<N, M, T>& w,
                   Block const& block) {
  using wide = lanes<T, M>;
  auto const want = [&](int I) { return all || w.wanted[static_cast<std::size_t>(I)] != 0; };
  // Row I has block (I, J) if it is left of the diagonal or if row J is not formed.
  auto const for_each_formed = [&](int I, auto f) {
    for (int e = C.lower().begin(I); e < C.lower().end(I); ++e) {
      f(C.lower().at(e), C.lower().block(e));
    }
    f(I, C.diagonal(I));
    if (all) return;
    for (int e = C.upper().begin(I); e < C.upper().end(I); ++e) {
      if (!want(C.upper().at(e))) f(C.upper().at(e), C.upper().block(e));
    }
  };
  for (int I = 0; I < C.nodes(); ++I) {
    if (!want(I)) continue;
    for_each_formed(I, [](int, T* to) { std::fill(to, to + M * M, T(0)); });
  }
  for (int i = 0; i < A.nodes(); ++i) {
    if (!all && w.needed[static_cast<std::size_t>(i)] == 0) continue;
    if (P.begin(i) == P.end(i)) continue;
    // Stage one. Of weights the blocks are kept by columns, of blocks by rows.
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
        if (N == M && P.weights) {
          unrolled<N>([&](auto c)
                          __attribute__((always_inline)) { to[c].add(a + N * c, P.weight(e)); });
        } else {
          T const* const p = P.block(e);
          unrolled<N>([&](auto k) __attribute__((always_inline)) {
            wide const row = wide::load(p + M * k);
            unrolled<N>([&](auto q)
                            __attribute__((always_inline)) { to[q].add(row, a[N * k + q]); });
          });
        }
      }
    });
    // Stage two.
    for (int t = P.begin(i); t < P.end(i); ++t) {
      int const I = P.at(t);
      if (!want(I)) continue;
      for_each_formed(
          I, [&](int J, T* to) __attribute__((always_inline)) {
            int const place = w.place[static_cast<std::size_t>(J)];
            if (place < 0) return;
            wide const* const from = w.row.data() + place;
            if (N == M && P.weights) {
              unrolled<M>([&](auto c) __attribute__((always_inline)) {
                wide s = wide::load(to + M * c);
                s.add(from[c], P.weight(t));
                s.store(to + M * c);
              });
            } else {
              T const* const p = P.block(t);
              unrolled<M>([&](auto c) __attribute__((always_inline)) {
                wide s = wide::load(to + M * c);
                unrolled<N>([&](auto q)
                                __attribute__((always_inline)) { s.add(from[q], p[M * q + c]); });
                s.store(to + M * c);
              });
            }
          });
    }
    for (int const J : w.list) w.place[static_cast<std::size_t>(J)] = -1;
  }
  // Mirror images; what was formed by rows is one already.
  bool const by_rows = !(N == M && P.weights);
  auto const transposed = [](T const* from, T* to) {
    for (int c = 0; c < M; ++c) {
      for (int q = 0; q < M; ++q) to[M * c + q] = from[M * q + c];
    }
  };
  auto const finish = [&](T* here, T* there) {
    if (by_rows) {
      std::copy(here, here + M * M, there);
      transposed(there, here);
    } else {
      transposed(here, there);
    }
  };
  for (int I = 0; I < C.nodes(); ++I) {
    if (!want(I)) continue;
    T* const d = C.diagonal(I);
    for (int c = 0; c < M; ++c) {
      for (int q = 0; q < c; ++q) d[M * c + q] = d[M * q + c];
    }
  }
  if (all) {
    std::vector<int> next(C.upper().first.begin(), C.upper().first.end() - 1);
    for (int I = 0; I < C.nodes(); ++I) {
      for (int e = C.lower().begin(I); e < C.lower().end(I); ++e) {
        int& to = next[static_cast<std::size_t>(C.lower().at(e))];
        finish(C.lower().block(e), C.upper().block(to++));
      }
    }
    return;
  }
  for (int I = 0; I < C.nodes(); ++I) {
    if (!want(I)) continue;
    for (int e = C.lower().begin(I); e < C.lower().end(I); ++e) {
      finish(C.lower().block(e), C.upper().block(C.upper().find(C.lower().at(e), I)));
    }
    for (int e = C.upper().begin(I); e < C.upper().end(I); ++e) {
      int const J = C.upper().at(e);
      if (!want(J)) finish(C.upper().block(e), C.lower().block(C.lower().find(J, I)));
    }
  }
}

/// PᵀA P.
template <int N, int M, class T>
void galerkin(block_matrix<N, T> const& A, prolongation<N, M, T> const& P, block_matrix<M, T>& C,
              galerkin_scratch<N, M, T>& w) {
  galerkin_rows(A, P, C, true, w, whole_blocks{});
}

/// `fine` nodes of which A has changed become the list of their parents, whose rows of PᵀA P are
/// formed anew.
template <int N, int M, class T, class Block>
void galerkin_anew(block_matrix<N, T> const& A, prolongation<N, M, T> const& P,
                   block_matrix<M, T>& C, std::vector<int> const& fine, std::vector<int>& parents,
                   galerkin_scratch<N, M, T>& w, Block const& block) {
  parents.clear();
  for (int const i : fine) {
    for (int e = P.begin(i); e < P.end(i); ++e) {
      auto& wanted = w.wanted[static_cast<std::size_t>(P.at(e))];
      if (wanted == 0) parents.push_back(P.at(e));
      wanted = 1;
    }
  }
  for (int i = 0; i < P.nodes(); ++i) {
    bool needed = false;
    for (int e = P.begin(i); e < P.end(i); ++e) {
      needed = needed || w.wanted[static_cast<std::size_t>(P.at(e))] != 0;
    }
    w.needed[static_cast<std::size_t>(i)] = needed ? 1 : 0;
  }
  galerkin_rows(A, P, C, false, w, block);
  for (int const I : parents) w.wanted[static_cast<std::size_t>(I)] = 0;
}

}  // namespace slant::detail
