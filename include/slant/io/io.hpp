// SPDX-License-Identifier: MIT
//
// Reading and writing files; <slant/io/vtu.hpp>, which needs pugixml, is not among them.
#pragma once

// IWYU pragma: begin_exports
#include <slant/io/atomic_file.hpp>
#include <slant/io/friction_folder.hpp>
#include <slant/io/matrix_market.hpp>
#include <slant/io/text_scanner.hpp>
#include <slant/io/text_vector.hpp>
// IWYU pragma: end_exports
