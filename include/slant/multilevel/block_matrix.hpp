// SPDX-License-Identifier: MIT
//
// A sparse symmetric matrix of N × N blocks, A = L + D + Lᵀ with L strictly below the diagonal, as
// block Gauss–Seidel reads it:
//
//     forwards from 0     x = (D + L)⁻¹b,   r = b − A x = −Lᵀx      one product, residual included
//     backwards           x ← (D + Lᵀ)⁻¹(b − L x)
//
// L, D and Lᵀ are stored apart, because the sweep from 0 passes through one after the other: with
// rows in one piece each half of it would drag the whole matrix through the cache (measured on
// bricks of 10⁵ unknowns: twice the time). A block is one index for N² numbers, and its columns fill
// vector registers (parts/lanes.hpp), so that a product takes half of the time of one by scalar
// rows. Blocks may be of scalars shorter than those of the matrix they are made from: sweeps wait
// for memory.
//
// Block vectors, what the sweeps work on: N numbers for each of the nodes, `stride` apart; what lies
// between them is overwritten and means nothing.
#pragma once

#include <slant/base/long_arrays.hpp>
#include <slant/base/matrix_entries.hpp>
#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/laws.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/multilevel/parts/lanes.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

namespace slant {

/// The rows of one triangle in compressed form.
template <int N, class T>
struct block_triangle {
  std::vector<int> first{0};       ///< of each row: where its blocks begin; and the end of the last
  detail::long_array<int> column;  ///< of each block, ascending in a row
  /// N² of each block, by columns, and what loads read beyond the last.
  detail::long_array<T> entries;

  [[nodiscard]] int begin(int i) const { return first[static_cast<std::size_t>(i)]; }
  [[nodiscard]] int end(int i) const { return first[static_cast<std::size_t>(i) + 1]; }
  [[nodiscard]] int at(int e) const { return column[static_cast<std::size_t>(e)]; }
  [[nodiscard]] T const* block(int e) const {
    return entries.data() + static_cast<std::size_t>(e) * (N * N);
  }
  [[nodiscard]] T* block(int e) { return entries.data() + static_cast<std::size_t>(e) * (N * N); }
  /// Where block (i, j), which is there, stands.
  [[nodiscard]] int find(int i, int j) const {
    return static_cast<int>(
        std::lower_bound(column.begin() + begin(i), column.begin() + end(i), j) - column.begin());
  }
};

namespace detail {

/// A vector of numbers T side by side, as a row of a matrix is not.
template <class X, class T>
concept contiguous_column =
    std::same_as<scalar_t<X>, T> && int(local_t<X>::ColsAtCompileTime) == 1 &&
    requires { requires int(local_t<X>::InnerStrideAtCompileTime) == 1; };

}  // namespace detail

/// A symmetric matrix of N × N blocks of scalars T. An operator on vectors of scalars T.
template <int N, class T = double>
class block_matrix {
  using columns = detail::lanes<T, N>;

 public:
  using scalar = T;
  using triangle = block_triangle<N, T>;
  static constexpr law_set laws = slant::laws<slant::self_adjoint>;
  static constexpr int stride = columns::size;  ///< of block vectors
  /// Numbers of a block that stands alone, what loads read beyond it included.
  static constexpr std::size_t padded_block = static_cast<std::size_t>(N * N + stride - N);

  /// No rows.
  block_matrix() = default;
  /// factor · K for a symmetric K (both triangles, rows sorted) whose size is a multiple of N.
  /// Blocks without an entry of K are left out. Throws bad_input if K is not square, its size no
  /// multiple of N, or K is not finite and symmetric up to rounding; the message calls it `name`.
  template <class M>
  explicit block_matrix(Eigen::SparseCompressedBase<M> const& K,
                        typename M::Scalar const& factor = typename M::Scalar(1),
                        std::string_view name = "K") {
    detail::require_square(name, K.derived());
    if (K.rows() % N != 0) {
      throw bad_input(name, detail::show(K.rows()) + " rows",
                      "a multiple of " + detail::show(index(N)));
    }
    if (!finite_and_symmetric(K.derived())) {
      detail::require_symmetric_matrix(name, typename M::PlainObject(K.derived()));
    }
    gather(K.derived(), factor);
  }

  [[nodiscard]] index rows() const { return N * index(nodes()); }
  [[nodiscard]] index cols() const { return rows(); }
  /// Rows of blocks.
  [[nodiscard]] int nodes() const { return static_cast<int>(lower_.first.size()) - 1; }
  /// Blocks that are stored, those of both triangles.
  [[nodiscard]] index blocks() const {
    return static_cast<index>(lower_.column.size() + upper_.column.size()) + nodes();
  }
  [[nodiscard]] triangle const& lower() const { return lower_; }  ///< L
  [[nodiscard]] triangle const& upper() const { return upper_; }  ///< Lᵀ
  /// D_i, by columns.
  [[nodiscard]] T const* diagonal(int i) const {
    return diagonal_.data() + static_cast<std::size_t>(i) * (N * N);
  }

  /// y = A x, for vectors of rows() scalars.
  template <class X, class Y>
    requires(detail::contiguous_column<X, T> && detail::contiguous_column<Y, T>)
  void apply(X const& x, Y& y) const {
    multiply<N>(slant::local(x).data(), slant::local(y).data());
  }

  // --- on block vectors --------------------------------------------------------------------------

  /// Numbers of a block vector, what loads read beyond the last block included.
  [[nodiscard]] std::size_t padded_size() const {
    return static_cast<std::size_t>(nodes()) * stride;
  }

  /// y = A x. Stride: of both vectors, N or `stride`.
  template <int Stride = stride>
  void multiply(T const* x, T* y) const {
    for (int i = 0; i < nodes(); ++i) {
      columns s = sum<Stride>(lower_, i, x);
      add_block(s, diagonal(i), x + at<Stride>(i));
      s += sum<Stride>(upper_, i, x);
      put<Stride>(s, y + at<Stride>(i));
    }
  }
  /// Sweeps with diagonal blocks of which `inverses` holds the inverses, N columns of `stride`
  /// numbers each, 0 beyond the N that count. They need not be those of D: with D + C they are the
  /// sweeps of A + C, with inverses on a subspace those on that subspace.
  void forwards_from_zero(T const* inverses, T const* b, T* x, T* r) const {
    for (int i = 0; i < nodes(); ++i) {
      columns s = columns::load(b + at<stride>(i));
      s -= sum<stride>(lower_, i, x);
      relax(inverses, i, s, x);
    }
    for (int i = 0; i < nodes(); ++i) {
      columns s = columns::zero();
      s -= sum<stride>(upper_, i, x);
      s.store_padded(r + at<stride>(i));
    }
  }
  /// r ← Lᵀx, of the new x.
  void backwards(T const* inverses, T const* b, T* x, T* r) const {
    for (int i = nodes() - 1; i >= 0; --i) {
      columns s = columns::load(b + at<stride>(i));
      columns const above = sum_from_the_end(upper_, i, x);
      s -= sum<stride, -ahead>(lower_, i, x);
      s -= above;
      relax(inverses, i, s, x);
      above.store_padded(r + at<stride>(i));
    }
  }
  /// z ← α z + β D⁻¹r and x ← x + z, with inverses as for the sweeps.
  void step(T const* inverses, T const* r, T const& α, T const& β, T* z, T* x) const {
    for (int i = 0; i < nodes(); ++i) {
      std::size_t const k = at<stride>(i);
      columns const own = inverse_times(inverses, i, columns::load(r + k));
      columns next = columns::zero(), sum = columns::load(x + k);
      next.add(own, β);
      next.add(z + k, α);
      sum += next;
      next.store_padded(z + k);
      sum.store_padded(x + k);
    }
  }
  /// r = A x from r = Lᵀx, by half of the matrix.
  void complete_product(T const* x, T* r) const {
    for (int i = 0; i < nodes(); ++i) {
      columns s = sum<stride>(lower_, i, x);
      add_block(s, diagonal(i), x + at<stride>(i));
      s += columns::load(r + at<stride>(i));
      s.store_padded(r + at<stride>(i));
    }
  }

  // --- assembly ----------------------------------------------------------------------------------

  /// The pattern of L, columns ascending in each row, and of Lᵀ; entries without values.
  block_matrix(std::vector<int> first, detail::long_array<int> column) {
    lower_.first = std::move(first);
    lower_.column = std::move(column);
    auto const n = static_cast<std::size_t>(nodes());
    upper_.first.assign(n + 1, 0);
    for (int const j : lower_.column) ++upper_.first[static_cast<std::size_t>(j) + 1];
    for (std::size_t i = 0; i < n; ++i) upper_.first[i + 1] += upper_.first[i];
    upper_.column.resize(lower_.column.size());
    std::vector<int> next(upper_.first.begin(), upper_.first.end() - 1);
    for (int i = 0; i < nodes(); ++i) {
      for (int e = lower_.begin(i); e < lower_.end(i); ++e) {
        int& to = next[static_cast<std::size_t>(lower_.at(e))];
        upper_.column[static_cast<std::size_t>(to++)] = i;
      }
    }
    allocate();
  }
  /// One with the same pattern; entries without values.
  [[nodiscard]] block_matrix of_same_pattern() const {
    block_matrix other;
    for (auto const part : {&block_matrix::lower_, &block_matrix::upper_}) {
      (other.*part).first = (this->*part).first;
      (other.*part).column = (this->*part).column;
    }
    other.allocate();
    return other;
  }
  [[nodiscard]] bool has_pattern_of(block_matrix const& other) const {
    return lower_.first == other.lower_.first && lower_.column == other.lower_.column;
  }
  [[nodiscard]] triangle& lower() { return lower_; }
  [[nodiscard]] triangle& upper() { return upper_; }
  [[nodiscard]] T* diagonal(int i) {
    return diagonal_.data() + static_cast<std::size_t>(i) * (N * N);
  }
  /// f(j, block) for the blocks of row i from left to right.
  template <class F>
  void for_each_in_row(int i, F f) const {
    visit_row(*this, i, f);
  }
  template <class F>
  void for_each_in_row(int i, F f) {
    visit_row(*this, i, f);
  }

 private:
  static constexpr std::size_t beyond = static_cast<std::size_t>(stride - N);

  void allocate() {
    for (triangle* t : {&lower_, &upper_}) {
      t->entries.resize(t->column.size() * N * N + beyond);
      std::fill(t->entries.end() - std::ptrdiff_t(beyond), t->entries.end(), T(0));
    }
    diagonal_.resize(static_cast<std::size_t>(nodes()) * N * N + beyond);
  }

  template <class Self, class F>
  static void visit_row(Self& a, int i, F& f) {
    for (int e = a.lower_.begin(i); e < a.lower_.end(i); ++e) f(a.lower_.at(e), a.lower_.block(e));
    f(i, a.diagonal(i));
    for (int e = a.upper_.begin(i); e < a.upper_.end(i); ++e) f(a.upper_.at(e), a.upper_.block(e));
  }

  template <int Stride>
  [[nodiscard]] static std::size_t at(int i) {
    return static_cast<std::size_t>(i) * static_cast<std::size_t>(Stride);
  }
  template <int Stride>
  [[gnu::always_inline]] static void put(columns const& s, T* y) {
    if constexpr (Stride == N) {
      s.store(y);
    } else {
      s.store_padded(y);
    }
  }
  /// s += B x.
  [[gnu::always_inline]] static void add_block(columns& s, T const* block, T const* x) {
    detail::unrolled<N>([&](auto c) __attribute__((always_inline)) { s.add(block + N * c, x[c]); });
  }
  /// How far ahead sums read, in bytes; negative where rows are visited from the last one on.
  static constexpr std::intptr_t ahead = 4096;
  static constexpr std::size_t two_blocks = 2 * N * N * sizeof(T);

  /// Σ of the blocks of row i times those of x; two sums that do not wait for each other.
  template <int Stride, std::intptr_t Ahead = ahead>
  [[nodiscard, gnu::always_inline]] static columns sum(triangle const& t, int i, T const* x) {
    columns a = columns::zero(), b = columns::zero();
    int const end = t.end(i);
    int e = t.begin(i);
    int const* const column = t.column.data();
    for (; e + 1 < end; e += 2) {
      detail::read_ahead<two_blocks>(t.block(e), Ahead);
      add_block(a, t.block(e), x + at<Stride>(column[e]));
      add_block(b, t.block(e + 1), x + at<Stride>(column[e + 1]));
    }
    if (e < end) add_block(a, t.block(e), x + at<Stride>(column[e]));
    a += b;
    return a;
  }
  /// The same from right to left: what a backward sweep has found last is needed last.
  [[nodiscard, gnu::always_inline]] static columns sum_from_the_end(triangle const& t, int i,
                                                                    T const* x) {
    columns a = columns::zero(), b = columns::zero();
    int const begin = t.begin(i);
    int e = t.end(i);
    int const* const column = t.column.data();
    for (; e - 1 > begin; e -= 2) {
      detail::read_ahead<two_blocks>(t.block(e - 2), -ahead);
      add_block(a, t.block(e - 1), x + at<stride>(column[e - 1]));
      add_block(b, t.block(e - 2), x + at<stride>(column[e - 2]));
    }
    if (e > begin) add_block(a, t.block(e - 1), x + at<stride>(column[e - 1]));
    a += b;
    return a;
  }
  /// D_i⁻¹ s.
  [[nodiscard, gnu::always_inline]] static columns inverse_times(T const* inverses, int i,
                                                                 columns const& s) {
    columns y = columns::zero();
    T const* const inverse = inverses + at<stride>(i) * N;
    detail::unrolled<N>([&](auto c)
                            __attribute__((always_inline)) { y.add(inverse + stride * c, s[c]); });
    return y;
  }
  /// x_i = D_i⁻¹ s.
  [[gnu::always_inline]] static void relax(T const* inverses, int i, columns const& s, T* x) {
    inverse_times(inverses, i, s).store_padded(x + at<stride>(i));
  }

  /// The measure of require_symmetric_entries, in one pass. False also for patterns that are not
  /// symmetric, whatever the entries.
  template <class M>
  [[nodiscard]] static bool finite_and_symmetric(M const& K) {
    using std::abs;
    using std::sqrt;
    using S = typename M::Scalar;
    auto const n = static_cast<std::size_t>(K.outerSize());
    auto const* const first = K.outerIndexPtr();
    auto const* const inner = K.innerIndexPtr();
    S const* const value = K.valuePtr();
    auto const end_of = [&](std::size_t i) {
      return K.isCompressed() ? first[i + 1] : first[i] + K.innerNonZeroPtr()[i];
    };
    // Entries left of the diagonal of a row are visited while the rows above it are: as their
    // mirror images, in the same order.
    std::vector<typename M::StorageIndex> next(first, first + n);
    std::vector<S> root(n);
    for (std::size_t i = 0; i < n; ++i) {
      auto e = first[i];
      while (e < end_of(i) && inner[e] < static_cast<index>(i)) ++e;
      bool const there = e < end_of(i) && inner[e] == static_cast<index>(i);
      root[i] = there ? S(sqrt(S(abs(value[e])))) : S(0);
      if (!(root[i] <= std::numeric_limits<S>::max())) return false;
      S const tolerance = S(1024) * std::numeric_limits<S>::epsilon() * root[i];
      if (next[i] != e) return false;
      for (e += there ? 1 : 0; e < end_of(i); ++e) {
        auto const j = static_cast<std::size_t>(inner[e]);
        auto& mirrored = next[j];
        if (mirrored >= end_of(j) || inner[mirrored] != static_cast<index>(i)) return false;
        // Row j comes later: its root is taken from there.
        S const difference = abs(S(value[e] - value[mirrored]));
        ++mirrored;
        if (difference == S(0)) continue;
        S const allowed = tolerance * S(sqrt(S(abs(K.coeff(inner[e], inner[e])))));
        if (!(difference <= allowed)) return false;
      }
    }
    return true;
  }

  /// All three parts from the rows of K; columns are the same.
  template <class M>
  void gather(M const& K, typename M::Scalar const& factor) {
    auto const n = static_cast<int>(K.rows() / N);
    auto const* const first = K.outerIndexPtr();
    auto const* const inner = K.innerIndexPtr();
    auto const* const value = K.valuePtr();
    using position = std::remove_cvref_t<decltype(*first)>;
    auto const most = static_cast<std::size_t>(K.nonZeros()) / (2 * N * N) + 1;
    for (triangle* t : {&lower_, &upper_}) {
      t->first.assign(1, 0);
      t->first.reserve(static_cast<std::size_t>(n) + 1);
      t->column.reserve(most);
      t->entries.reserve(most * N * N + beyond);
    }
    diagonal_.assign(static_cast<std::size_t>(n) * N * N + beyond, T(0));
    for (int i = 0; i < n; ++i) {
      position here[N], end[N];
      for (int a = 0; a < N; ++a) {
        auto const row =
            static_cast<std::size_t>(N) * static_cast<std::size_t>(i) + static_cast<std::size_t>(a);
        here[a] = first[row];
        end[a] = K.isCompressed() ? first[row + 1] : first[row] + K.innerNonZeroPtr()[row];
      }
      while (true) {
        int j = n;  // the leftmost block that is not read yet
        for (int a = 0; a < N; ++a) {
          if (here[a] < end[a]) j = std::min(j, static_cast<int>(inner[here[a]]) / N);
        }
        if (j == n) break;
        T* const block = place(i, j);
        for (int a = 0; a < N; ++a) {
          for (; here[a] < end[a]; ++here[a]) {
            int const c = static_cast<int>(inner[here[a]]) - N * j;
            if (c >= N) break;
            block[N * c + a] = T(value[here[a]] * factor);
          }
        }
      }
      for (triangle* t : {&lower_, &upper_}) {
        t->first.push_back(static_cast<int>(t->column.size()));
      }
    }
    for (triangle* t : {&lower_, &upper_}) t->entries.resize(t->entries.size() + beyond, T(0));
  }
  /// A block of zeros for (i, j).
  T* place(int i, int j) {
    if (j == i) return diagonal(i);
    triangle& t = j < i ? lower_ : upper_;
    t.column.push_back(j);
    std::size_t const at = t.entries.size();
    t.entries.resize(at + N * N, T(0));
    return t.entries.data() + at;
  }

  triangle lower_, upper_;
  std::vector<T> diagonal_;
};

}  // namespace slant
