// SPDX-License-Identifier: MIT
//
// Bounds and estimates of the error.
#pragma once

// IWYU pragma: begin_exports
#include <slant/certificates/constrained_certificate.hpp>
#include <slant/certificates/dual_norm.hpp>
#include <slant/certificates/energy_certificate.hpp>
#include <slant/certificates/energy_error.hpp>
#include <slant/certificates/newton_estimate.hpp>
// IWYU pragma: end_exports
