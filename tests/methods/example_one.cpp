// SPDX-License-Identifier: MIT
#include "methods/example_one.hpp"

template struct test::example_one_solution<double>;
