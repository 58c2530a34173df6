// SPDX-License-Identifier: MIT
//
// The prolongation P from a coarse level, nodes of M unknowns, to a fine one, nodes of N, and its
// transpose, the restriction. Entries are N × M blocks, stored by rows, or, with M = N, weights:
// multiples of the identity, as those of interpolation on a mesh.
#pragma once

#include <slant/base/long_arrays.hpp>
#include <slant/base/matrix_entries.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/multilevel/parts/lanes.hpp>

#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace slant::detail {

template <int N, int M, class T>
struct prolongation {
  static constexpr int fine_stride = lanes<T, N>::size;
  static constexpr int coarse_stride = lanes<T, M>::size;
  static constexpr std::size_t beyond = static_cast<std::size_t>(coarse_stride - M);
  static constexpr std::size_t block_bytes = N * M * sizeof(T);
  static constexpr std::intptr_t ahead = 1024;  // in bytes, how far loops over the entries read

  std::vector<int> first{0};  // of each fine node
  long_array<int> column;     // coarse nodes, ascending in a row
  long_array<T> entries;      // and what loads read beyond the last block
  int coarse_nodes = 0;
  bool weights = false;

  [[nodiscard]] int nodes() const { return static_cast<int>(first.size()) - 1; }
  [[nodiscard]] int begin(int i) const { return first[static_cast<std::size_t>(i)]; }
  [[nodiscard]] int end(int i) const { return first[static_cast<std::size_t>(i) + 1]; }
  [[nodiscard]] int at(int e) const { return column[static_cast<std::size_t>(e)]; }
  [[nodiscard]] T const* block(int e) const {
    return entries.data() + static_cast<std::size_t>(e) * (N * M);
  }
  [[nodiscard]] T weight(int e) const { return entries[static_cast<std::size_t>(e)]; }

  /// b = Pᵀr, block vectors.
  void restrict_to(T const* r, T* b) const {
    using coarse = lanes<T, M>;
    std::fill(b, b + static_cast<std::size_t>(coarse_nodes) * coarse_stride, T(0));
    for (int i = 0; i < nodes(); ++i) {
      T const* const from = r + static_cast<std::size_t>(i) * fine_stride;
      for (int e = begin(i); e < end(i); ++e) {
        T* const to = b + static_cast<std::size_t>(at(e)) * coarse_stride;
        coarse s = coarse::load(to);
        if (N == M && weights) {
          s.add(from, weight(e));
        } else {
          T const* const p = block(e);
          read_ahead<block_bytes>(p, ahead);
          unrolled<N>([&](auto q) __attribute__((always_inline)) { s.add(p + M * q, from[q]); });
        }
        s.store_padded(to);
      }
    }
  }
  /// x += P z.
  void add_to(T const* z, T* x) const {
    using coarse = lanes<T, M>;
    for (int i = 0; i < nodes(); ++i) {
      T* const to = x + static_cast<std::size_t>(i) * fine_stride;
      if (N == M && weights) {
        coarse s = coarse::zero();
        for (int e = begin(i); e < end(i); ++e) {
          s.add(z + static_cast<std::size_t>(at(e)) * coarse_stride, weight(e));
        }
        for (int q = 0; q < N; ++q) to[q] += s[q];
      } else {
        std::array<coarse, N> s;
        s.fill(coarse::zero());
        for (int e = begin(i); e < end(i); ++e) {
          coarse const from = coarse::load(z + static_cast<std::size_t>(at(e)) * coarse_stride);
          T const* const p = block(e);
          read_ahead<block_bytes>(p, ahead);
          unrolled<N>([&](auto q) __attribute__((always_inline)) {
            s[q].add_product(coarse::load(p + M * q), from);
          });
        }
        for (int q = 0; q < N; ++q) to[q] += sum_of_lanes(s[static_cast<std::size_t>(q)]);
      }
    }
  }
};

/// G P for a matrix G of unknowns.
template <int N, int M, class T, class S>
[[nodiscard]] prolongation<N, M, T> mixed_prolongation(
    prolongation<N, M, T> const& P, Eigen::SparseMatrix<S, Eigen::RowMajor> const& G) {
  constexpr std::size_t block = static_cast<std::size_t>(N * M);
  using row = typename Eigen::SparseMatrix<S, Eigen::RowMajor>::InnerIterator;
  prolongation<N, M, T> mixed;
  mixed.coarse_nodes = P.coarse_nodes;
  mixed.column.reserve(P.column.size());
  long_array<T> entries;
  entries.reserve(P.entries.size());
  std::vector<int> columns;
  for (int i = 0; i < P.nodes(); ++i) {
    columns.clear();
    for (int a = 0; a < N; ++a) {
      for (row e(G, N * i + a); e; ++e) {
        int const j = static_cast<int>(e.col()) / N;
        columns.insert(columns.end(), P.column.begin() + P.begin(j), P.column.begin() + P.end(j));
      }
    }
    std::sort(columns.begin(), columns.end());
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    auto const start = entries.size();
    entries.resize(start + columns.size() * block, T(0));
    for (int a = 0; a < N; ++a) {
      for (row e(G, N * i + a); e; ++e) {
        int const j = static_cast<int>(e.col()) / N, b = static_cast<int>(e.col()) % N;
        for (int k = P.begin(j); k < P.end(j); ++k) {
          auto const at = std::lower_bound(columns.begin(), columns.end(), P.at(k));
          T* const to = entries.data() + start +
                        static_cast<std::size_t>(at - columns.begin()) * block + M * a;
          if (N == M && P.weights) {
            to[b] += T(e.value()) * P.weight(k);
          } else {
            for (int c = 0; c < M; ++c) to[c] += T(e.value()) * P.block(k)[M * b + c];
          }
        }
      }
    }
    mixed.column.insert(mixed.column.end(), columns.begin(), columns.end());
    mixed.first.push_back(static_cast<int>(mixed.column.size()));
  }
  entries.resize(entries.size() + mixed.beyond, T(0));
  mixed.entries = std::move(entries);
  return mixed;
}

/// P for fine nodes of N unknowns each in place of F, a multiple.
template <int N, int F, int M, class T>
[[nodiscard]] prolongation<N, M, T> rows_apart(prolongation<F, M, T> const& P) {
  if constexpr (N == F) {
    return P;
  } else {
    constexpr int parts = F / N;
    constexpr std::ptrdiff_t block = N * M;
    prolongation<N, M, T> apart;
    apart.coarse_nodes = P.coarse_nodes;
    apart.first.reserve(static_cast<std::size_t>(P.nodes()) * parts + 1);
    apart.column.reserve(P.column.size() * parts);
    apart.entries.reserve(P.entries.size());
    for (int i = 0; i < P.nodes(); ++i) {
      for (int part = 0; part < parts; ++part) {
        for (int e = P.begin(i); e < P.end(i); ++e) {
          T const* const from = P.block(e) + part * block;
          apart.column.push_back(P.at(e));
          apart.entries.insert(apart.entries.end(), from, from + block);
        }
        apart.first.push_back(static_cast<int>(apart.column.size()));
      }
    }
    apart.entries.resize(apart.entries.size() + apart.beyond, T(0));
    return apart;
  }
}

/// P for coarse nodes of M unknowns each in place of W, a multiple.
template <int M, int N, int W, class T>
[[nodiscard]] prolongation<N, M, T> columns_apart(prolongation<N, W, T> P) {
  if constexpr (M == W) {
    return P;
  } else {
    constexpr int parts = W / M;
    prolongation<N, M, T> apart;
    apart.coarse_nodes = P.coarse_nodes * parts;
    apart.column.reserve(P.column.size() * parts);
    apart.entries.reserve(P.entries.size() + apart.beyond);
    for (int i = 0; i < P.nodes(); ++i) {
      for (int e = P.begin(i); e < P.end(i); ++e) {
        for (int part = 0; part < parts; ++part) {
          apart.column.push_back(P.at(e) * parts + part);
          for (int q = 0; q < N; ++q) {
            T const* const from = P.block(e) + W * q + M * part;
            apart.entries.insert(apart.entries.end(), from, from + M);
          }
        }
      }
      apart.first.push_back(static_cast<int>(apart.column.size()));
    }
    apart.entries.resize(apart.entries.size() + apart.beyond, T(0));
    return apart;
  }
}

/// P of the user as blocks of N unknowns: rows are the nodes of the fine level and columns those of
/// the coarse one, entries the weights; or rows and columns are unknowns. `nodes` fine nodes.
/// Throws bad_input naming what does not fit.
template <int N, class T, class S, int Order>
[[nodiscard]] prolongation<N, N, T> prolongation_from(Eigen::SparseMatrix<S, Order> const& given,
                                                      int nodes, std::string const& name) {
  for_each_entry(given, [&](index i, index j, S const& value) {
    using std::abs;
    if (!(abs(value) <= S(0x1p20))) {
      throw bad_input(entry_text(name, i, j), show(value), "a weight of at most 2^20");
    }
  });
  bool const of_nodes = given.rows() == nodes;
  if (!of_nodes && given.rows() != N * index(nodes)) {
    throw bad_input("rows of " + name, show(given.rows()),
                    show(index(nodes)) + " nodes or " + show(N * index(nodes)) + " unknowns");
  }
  int const size = of_nodes ? 1 : N;
  if (given.cols() < size || given.cols() % size != 0) {
    throw bad_input("columns of " + name, show(given.cols()),
                    "a positive multiple of " + show(index(size)));
  }
  Eigen::SparseMatrix<S, Eigen::RowMajor> const P = given;
  using row = typename Eigen::SparseMatrix<S, Eigen::RowMajor>::InnerIterator;
  prolongation<N, N, T> p;
  p.coarse_nodes = static_cast<int>(P.cols()) / size;
  p.weights = of_nodes;
  p.first.reserve(static_cast<std::size_t>(nodes) + 1);
  if (of_nodes) {
    p.column.reserve(static_cast<std::size_t>(P.nonZeros()));
    p.entries.reserve(static_cast<std::size_t>(P.nonZeros()) + p.beyond);
    for (int i = 0; i < nodes; ++i) {
      for (row e(P, i); e; ++e) {
        p.column.push_back(static_cast<int>(e.col()));
        p.entries.push_back(T(e.value()));
      }
      p.first.push_back(static_cast<int>(p.column.size()));
    }
    p.entries.resize(p.entries.size() + p.beyond, T(0));
    return p;
  }
  std::vector<int> place(static_cast<std::size_t>(p.coarse_nodes), -1);
  long_array<T> blocks;  // N × N by rows
  for (int i = 0; i < nodes; ++i) {
    auto const start = p.column.size();
    for (int a = 0; a < N; ++a) {
      for (row e(P, N * i + a); e; ++e) {
        int& at = place[static_cast<std::size_t>(e.col()) / N];
        if (at >= static_cast<int>(start)) continue;
        at = static_cast<int>(p.column.size());
        p.column.push_back(static_cast<int>(e.col()) / N);
      }
    }
    std::sort(p.column.begin() + static_cast<std::ptrdiff_t>(start), p.column.end());
    for (auto e = start; e < p.column.size(); ++e) {
      place[static_cast<std::size_t>(p.column[e])] = static_cast<int>(e);
    }
    blocks.resize(p.column.size() * N * N, T(0));
    for (int a = 0; a < N; ++a) {
      for (row e(P, N * i + a); e; ++e) {
        auto const at = static_cast<std::size_t>(place[static_cast<std::size_t>(e.col()) / N]);
        blocks[at * (N * N) + static_cast<std::size_t>(a * N) +
               static_cast<std::size_t>(e.col()) % N] = T(e.value());
      }
    }
    p.first.push_back(static_cast<int>(p.column.size()));
  }
  // Interpolation of all unknowns by the same weights is one of nodes.
  p.weights = true;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    auto const in = k % (N * N);
    p.weights = p.weights && blocks[k] == (in % (N + 1) == 0 ? blocks[k - in] : T(0));
  }
  if (p.weights) {
    for (std::size_t e = 0; e < p.column.size(); ++e) blocks[e] = blocks[e * N * N];
    blocks.resize(p.column.size());
  }
  p.entries = std::move(blocks);
  p.entries.resize(p.entries.size() + p.beyond, T(0));
  p.entries.shrink_to_fit();
  return p;
}

}  // namespace slant::detail
