// SPDX-License-Identifier: MIT
//
// What every batch of tests includes, compiled beforehand: a seventh of the time of a batch.
#pragma once

#include <Eigen/Sparse>
#include <support/eigen_instances.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <vector>
