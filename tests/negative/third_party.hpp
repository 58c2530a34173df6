// SPDX-License-Identifier: MIT
//
// What nearly every case includes and none is about, compiled once for all of them.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <boost/hana.hpp>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>
