// SPDX-License-Identifier: MIT
//
// The parts of a decomposed scene as Total-FETI wants them.
#pragma once

#include <fem/decomposition.hpp>
#include <slant/contact/free_motions.hpp>
#include <slant/contact/total_feti.hpp>

namespace examples {

/// Bodies with the rigid motions of their nodes, glued and held at their place.
[[nodiscard]] inline slant::contact::floating_bodies<double> floating_parts(
    fem::decomposed_scene const& parts) {
  slant::contact::floating_bodies<double> bodies{
      parts.K, {}, parts.glue, Eigen::VectorXd::Zero(parts.glue.rows())};
  for (auto const& nodes : parts.nodes) bodies.R.push_back(slant::contact::rigid_body_modes(nodes));
  return bodies;
}

/// Contact data of a scene for the unknowns of all parts, with its slip bounds or frictionless.
template <int D>
[[nodiscard]] slant::contact::data<double> contact_data(fem::contact_scene<D> const& scene,
                                                        fem::decomposed_scene const& parts,
                                                        bool friction) {
  if (friction) return {parts.N, parts.T, parts.f, scene.d, scene.g};
  return {parts.N, Eigen::SparseMatrix<double>(0, parts.unknowns()), parts.f, scene.d,
          Eigen::VectorXd(0)};
}

/// The same for the unknowns of the scene itself.
template <int D>
[[nodiscard]] slant::contact::data<double> contact_data(fem::contact_scene<D> const& scene,
                                                        bool friction) {
  if (friction) return {scene.N, scene.T, scene.f, scene.d, scene.g};
  return {scene.N, Eigen::SparseMatrix<double>(0, scene.f.size()), scene.f, scene.d,
          Eigen::VectorXd(0)};
}

}  // namespace examples
