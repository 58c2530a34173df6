// SPDX-License-Identifier: MIT
#define SLANT_EIGEN_INSTANCE template
#include "eigen_instances.hpp"
