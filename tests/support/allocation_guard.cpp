// SPDX-License-Identifier: MIT
//
// Two ways to see every allocation of the process:
//   under a sanitizer, whose run time owns malloc, its official hook;
//   otherwise our own malloc family, which the linker prefers to that of glibc, also for calls made
//   inside shared libraries, and which forwards to glibc's __libc_… entry points.
#include "allocation_guard.hpp"

#include <atomic>
#include <cerrno>
#include <cstdlib>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SLANT_SANITIZER_OWNS_MALLOC 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || \
    __has_feature(memory_sanitizer)
#define SLANT_SANITIZER_OWNS_MALLOC 1
#endif
#endif

namespace {

// Constant-initialised: malloc is called before any dynamic initialiser has run.
constinit std::atomic<std::size_t> allocations{0};

void count_one() noexcept {
  allocations.fetch_add(1, std::memory_order_relaxed);
}

}  // namespace

std::size_t slant::testing::allocations_so_far() noexcept {
  return allocations.load(std::memory_order_relaxed);
}

#if defined(SLANT_SANITIZER_OWNS_MALLOC)

// Declared by <sanitizer/allocator_interface.h>, which not every packaging of g++ contains.
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*malloc_hook)(void const volatile*,
                                                                             std::size_t),
                                                         void (*free_hook)(void const volatile*));

namespace {

void on_malloc(void const volatile*, std::size_t) {
  count_one();
}
void on_free(void const volatile*) {}

[[maybe_unused]] int const hook_installed = [] {
  // A guard that silently counts nothing would let every test pass.
  if (__sanitizer_install_malloc_and_free_hooks(on_malloc, on_free) == 0) std::abort();
  return 1;
}();

}  // namespace

#elif defined(__GLIBC__)

extern "C" {

void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);

void* malloc(std::size_t size) {
  count_one();
  return __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) {
  count_one();
  return __libc_calloc(count, size);
}

void* realloc(void* old, std::size_t size) {
  count_one();
  return __libc_realloc(old, size);
}

void* memalign(std::size_t alignment, std::size_t size) {
  count_one();
  return __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) {
  count_one();
  return __libc_memalign(alignment, size);
}

int posix_memalign(void** result, std::size_t alignment, std::size_t size) {
  count_one();
  auto const power_of_two = alignment != 0 && (alignment & (alignment - 1)) == 0;
  if (!power_of_two || alignment % sizeof(void*) != 0) return EINVAL;
  auto* const block = __libc_memalign(alignment, size);
  if (block == nullptr) return ENOMEM;
  *result = block;
  return 0;
}

void free(void* block) {
  __libc_free(block);
}

}  // extern "C"

#else
#error "the allocation guard needs glibc or a sanitizer run time"
#endif
