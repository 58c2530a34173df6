// SPDX-License-Identifier: MIT
//
// Peak memory of this process: VmHWM of Linux, the largest amount that was resident at a time. It
// falls only where it is forgotten, so that what is to be measured runs in a process of its own
// (child_process.hpp) or begins there; a child begins with what its parent holds, such as the matrices
// of the scene.
#pragma once

#include <cstdio>
#include <limits>

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

namespace benchmarks {

/// In MiB; NaN where the system does not tell.
[[nodiscard]] inline double peak_memory_mib() {
  double kib = std::numeric_limits<double>::quiet_NaN();
  if (std::FILE* const file = std::fopen("/proc/self/status", "r")) {
    char line[256];
    while (std::fgets(line, sizeof line, file) != nullptr) {
      long value = 0;
      if (std::sscanf(line, "VmHWM: %ld kB", &value) == 1) kib = double(value);
    }
    std::fclose(file);
  }
  return kib / 1024;
}

/// From here on the peak is that of what follows, what is held now included, but not what has been
/// given back to the heap. Without effect where the system does not know it.
inline void forget_peak_memory() {
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
  if (std::FILE* const file = std::fopen("/proc/self/clear_refs", "w")) {
    std::fputs("5", file);
    std::fclose(file);
  }
}

}  // namespace benchmarks
