// SPDX-License-Identifier: MIT
//
// What nearly every test needs: doctest, Eigen and the names of its vectors, the standard library,
// messages of exceptions, counts of allocations. Compiled beforehand, by precompiled.hpp.
#pragma once

#include <Eigen/Dense>
#include <Eigen/Sparse>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <support/allocation_guard.hpp>
#include <support/dense_algebra.hpp>
#include <support/effort.hpp>
#include <support/message.hpp>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace slant::contact {}
namespace contact = slant::contact;

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using sparse = Eigen::SparseMatrix<double>;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double quiet_nan = std::numeric_limits<double>::quiet_NaN();

namespace test {

[[nodiscard]] inline VectorXd zeros(Eigen::Index n) {
  return VectorXd::Zero(n);
}

}  // namespace test
