// SPDX-License-Identifier: MIT
//
// All of the three-dimensional elastic contact problem: mesh, stiffness, loads and scenes.
#pragma once

#include <fem/box_mesh.hpp>
#include <fem/brick_mesh.hpp>
#include <fem/contact_scene.hpp>
#include <fem/elasticity.hpp>
#include <fem/simplex_mesh.hpp>
#include <fem/steel_brick.hpp>
#include <fem/surface.hpp>
#include <fem/unknowns.hpp>
