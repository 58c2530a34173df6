// SPDX-License-Identifier: MIT
#define FEM_INSTANCE template
#include <fem/instances.hpp>
