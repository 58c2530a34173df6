// SPDX-License-Identifier: MIT
//
// Peak memory of this process: VmHWM of Linux, the largest amount that was resident at a time. It
// never falls, so that what is to be measured runs in a process of its own (child_process.hpp); a
// child begins with what its parent holds, such as the matrices of the scene.
#pragma once

#include <cstdio>
#include <limits>

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

}  // namespace benchmarks
