// SPDX-License-Identifier: MIT
//
// Arrays that are longer than caches and read from one end to the other, as the matrices of
// iterations are: what such a loop waits for is memory.
//
// Pages. Where the system has pages of 2 MiB for those who ask (Linux), long arrays ask: a pass
// meets a thousandth of the page faults and misses of address translation.
//
// Ahead. The processor follows a stream up to the end of a page of 4 KiB. read_ahead asks for what
// is read some hundred nanoseconds later, also beyond.
//
// Measured on a brick of 313632 unknowns: a cycle of multigrid takes 0.75 of the time with both, a
// product by a sparse matrix 0.65.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace slant::detail {

/// Asks for `Bytes` bytes at `distance` bytes from p; there may be nothing.
template <std::size_t Bytes>
[[gnu::always_inline]] inline void read_ahead(void const* p, std::intptr_t distance) {
  constexpr std::size_t line = 64;
  auto const there = reinterpret_cast<std::uintptr_t>(p) + static_cast<std::uintptr_t>(distance);
  for (std::size_t k = 0; k < Bytes; k += line) {
    __builtin_prefetch(reinterpret_cast<void const*>(there + k));
  }
}

/// Large pages for what fills some; numbers begin with no value unless one is given.
template <class T>
struct long_array_allocator {
  using value_type = T;

  long_array_allocator() = default;
  template <class U>
  long_array_allocator(long_array_allocator<U> const&) {}

  [[nodiscard]] T* allocate(std::size_t n) {
    if (n > std::numeric_limits<std::size_t>::max() / sizeof(T)) throw std::bad_array_new_length();
    std::size_t const bytes = n * sizeof(T);
    if (bytes < page) return static_cast<T*>(::operator new(bytes));
    void* const p = ::operator new(bytes, std::align_val_t{page});
#if defined(__linux__)
    // The rest keeps small pages. Where the system refuses, so does all.
    static_cast<void>(::madvise(p, bytes / page * page, MADV_HUGEPAGE));
#endif
    return static_cast<T*>(p);
  }
  void deallocate(T* p, std::size_t n) {
    if (n * sizeof(T) < page) {
      ::operator delete(p);
    } else {
      ::operator delete(p, std::align_val_t{page});
    }
  }

  template <class U>
  void construct(U* p) {
    ::new (static_cast<void*>(p)) U;
  }
  template <class U, class... Args>
  void construct(U* p, Args&&... args) {
    ::new (static_cast<void*>(p)) U(std::forward<Args>(args)...);
  }

  friend bool operator==(long_array_allocator const&, long_array_allocator const&) { return true; }

 private:
  static constexpr std::size_t page = std::size_t{1} << 21;
};

/// A vector for numbers; resize(n) leaves new ones without a value.
template <class T>
using long_array = std::vector<T, long_array_allocator<T>>;

}  // namespace slant::detail
