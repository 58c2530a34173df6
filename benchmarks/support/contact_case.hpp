// SPDX-License-Identifier: MIT
//
// The contact scenes of the comparisons by name, and the error of a displacement.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cmath>
#include <fem/box_prolongations.hpp>
#include <fem/steel_brick.hpp>
#include <fem/two_bricks.hpp>
#include <fem/two_plates.hpp>
#include <slant/contact/contact_data.hpp>
#include <slant/contact/dual.hpp>
#include <slant/factorizations/factorize.hpp>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace benchmarks {

/// A scene in D dimensions.
template <int D>
struct contact_case {
  static constexpr int dimension = D;
  using friction =
      std::conditional_t<D == 2, slant::contact::friction_line, slant::contact::friction_disc>;

  std::string name;
  int size;
  fem::contact_scene<D> scene;
  std::vector<Eigen::SparseMatrix<double>> nested{};  ///< prolongations, where meshes are nested

  [[nodiscard]] slant::contact::data<double> data() const {
    return {scene.N, scene.T, scene.f, scene.d, scene.g};
  }
  /// √(uᵀK u).
  [[nodiscard]] double energy_norm(Eigen::VectorXd const& u) const {
    return std::sqrt(u.dot(scene.K * u));
  }
};

/// visit(case) for the scene: press, pull, lift (the steel brick of 3k × k × k cells), plates (two
/// bodies in 2D of 3k × k cells each), bricks (two bodies in 3D of k × (k−1) × (k−1) cells each).
/// Throws std::invalid_argument for a scene that is none.
template <class Visit>
void with_contact_case(std::string const& name, int size, Visit const& visit) {
  if (name == "plates") {
    visit(contact_case<2>{name, size, fem::make_two_plates(size)});
  } else if (name == "bricks") {
    visit(contact_case<3>{name, size, fem::make_two_bricks(size)});
  } else if (auto const load = fem::brick_load_named(name)) {
    contact_case<3> c{name, size, fem::make_steel_brick({.k = size, .load = *load})};
    c.nested = fem::box_prolongations(fem::make_brick_mesh(size, {3, 1, 1}), c.scene.unknowns);
    visit(c);
  } else {
    throw std::invalid_argument("scene: got " + name +
                                ", expected press, pull, lift, plates or bricks");
  }
}

/// A dual problem with all that it refers to; from the scene alone, as a user makes it.
template <int D>
class contact_setup {
 public:
  explicit contact_setup(contact_case<D> const& c)
      : factor_(slant::factorize(c.scene.K)),
        dual_(typename contact_case<D>::friction{}, factor_, c.data()) {}

  [[nodiscard]] auto const& dual() const { return dual_; }
  [[nodiscard]] auto const& factor() const { return factor_; }

 private:
  using factor_type =
      decltype(slant::factorize(std::declval<Eigen::SparseMatrix<double> const&>()));
  factor_type factor_;
  slant::contact::dual<typename contact_case<D>::friction, factor_type const&, double> dual_;
};

}  // namespace benchmarks
