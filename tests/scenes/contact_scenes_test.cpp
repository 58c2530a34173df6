// SPDX-License-Identifier: MIT
//
// Contact of bodies, against the dense reference.
#include <slant/contact/dual.hpp>
#include <slant/contact/preconditioners.hpp>
#include <slant/slant.hpp>

#include <fem/steel_brick.hpp>
#include <fem/two_bricks.hpp>
#include <fem/two_plates.hpp>
#include <oracle/dense_contact_reference.hpp>
#include <scenes/scene.hpp>
#include <support/testing.hpp>

namespace contact_scenes_test {

using scenes::scene;

/// A contact scene with factors of K and its dual problem.
template <int D>
struct contact_data {
  using friction =
      std::conditional_t<D == 2, slant::contact::friction_line, slant::contact::friction_disc>;

  explicit contact_data(fem::contact_scene<D> s)
      : scene(std::move(s)),
        factor(slant::ldlt(scene.K)),
        dual(friction{}, factor,
             slant::contact::data<double>{scene.N, scene.T, scene.f, scene.d, scene.g}) {}

  fem::contact_scene<D> scene;
  decltype(slant::ldlt(std::declval<Eigen::SparseMatrix<double> const&>())) factor;
  slant::contact::dual<friction, decltype(factor) const&, double> dual;
};

/// Each contact node has unknowns of its own, so the rows of B are independent and A is definite.
template <int D>
[[nodiscard]] scene contact(std::string name, fem::contact_scene<D> s) {
  auto const data = std::make_shared<contact_data<D> const>(std::move(s));
  auto const& c = data->scene;
  auto const reference = oracle::solve_contact({c.K, c.N, c.T, c.f, c.d, c.g});
  scenes::constraints set{.half_lines = VectorXd::Zero(c.d.size())};
  if constexpr (D == 2) {
    set.lower = -c.g;
    set.upper = c.g;
  } else {
    set.radii = c.g;
  }
  return {std::move(name),
          data,
          slant::declare<slant::positive_definite>(data->dual.a()),
          slant::contact::lumped_preconditioner(c.K, data->dual.constraints()),
          data->dual.b(),
          scenes::make_set(set),
          reference.dual,
          reference.report.x};
}

}  // namespace contact_scenes_test

namespace scenes {

std::vector<scene> contact_scenes() {
  using contact_scenes_test::contact;
  std::vector<scene> all;
  for (auto const load : fem::brick_loads) {
    auto const k = test::effort(3, 2);
    all.push_back(contact<3>("brick, " + std::string(fem::name_of(load)),
                             fem::make_steel_brick({.k = k, .load = load})));
    all.back().slow_sliding = true;
  }
  all.push_back(contact<2>("two plates", fem::make_two_plates(test::effort(4, 2))));
  all.push_back(contact<3>("two bricks", fem::make_two_bricks(test::effort(4, 3))));
  return all;
}

}  // namespace scenes
