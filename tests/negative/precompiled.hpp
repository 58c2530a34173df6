// SPDX-License-Identifier: MIT
//
// What a case may include, compiled once for all of them.
#pragma once

#include <slant/slant.hpp>

#include <boost/hana.hpp>
#include <random>
