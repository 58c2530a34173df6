// SPDX-License-Identifier: MIT
//
// What every batch of tests includes, compiled beforehand: a seventh of the time of a batch.
#pragma once

#include <fem/instances.hpp>
#include <support/eigen_instances.hpp>
#include <support/testing.hpp>
