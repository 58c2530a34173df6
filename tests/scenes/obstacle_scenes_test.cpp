// SPDX-License-Identifier: MIT
//
// The lecture's first example, all cells of the wire's tables, and membranes.
#include <slant/slant.hpp>

#include <fem/double_obstacle.hpp>
#include <fem/elastic_torsion.hpp>
#include <fem/incomplete_five_point.hpp>
#include <fem/journal_bearing.hpp>
#include <fem/lower_obstacle.hpp>
#include <fem/wire_counts.hpp>
#include <oracle/dense_newton.hpp>
#include <oracle/dense_wire.hpp>
#include <oracle/naive_membrane.hpp>
#include <scenes/scene.hpp>
#include <support/testing.hpp>
#include <tridiagonal/example_1.hpp>

namespace obstacle_scenes_test {

using scenes::make_set;
using scenes::scene;

/// A matrix that somebody else keeps, as an operator.
[[nodiscard]] auto spd(sparse const& A) {
  return slant::matrix<slant::self_adjoint, slant::positive_definite>(A);
}

/// The pairs (i, i + 6) of the lecture become consecutive.
[[nodiscard]] scene tridiagonal() {
  Eigen::PermutationMatrix<Eigen::Dynamic> P(12);
  for (int i = 0; i < 6; ++i) {
    P.indices()[i] = 2 * i;
    P.indices()[i + 6] = 2 * i + 1;
  }
  auto const A = std::make_shared<sparse const>(P * sparse(example_1::matrix() * P.transpose()));
  VectorXd const g = example_1::radii();
  VectorXd const b = P * example_1::right_hand_side();
  oracle::dense_qp plain{MatrixXd(*A), b.cast<long double>()};
  for (Eigen::Index i = 0; i < 6; ++i) plain.circles.push_back({2 * i, 2 * i + 1, g[i]});
  return {"tridiagonal",
          A,
          spd(*A),
          slant::inverse(slant::ldlt(*A)),
          b,
          make_set({.radii = g}),
          plain,
          scenes::solved(plain)};
}

[[nodiscard]] scene wire(Eigen::Index m, double l, double g) {
  auto const data = std::make_shared<fem::wire<> const>(fem::make_wire(m));
  auto const plain = oracle::dense_wire(fem::make_wire<oracle::real>(m), l, g);
  return {
      "wire, l = " + slant::detail::show(l) + ", g = " + slant::detail::show(g),
      data,
      spd(data->A),
      slant::inverse(slant::ldlt(data->A)),
      data->b,
      make_set(
          {.half_lines = VectorXd::Constant(m, l), .radii = VectorXd::Constant(m, g), .free = m}),
      plain,
      scenes::solved(plain)};
}

template <class Weight>
[[nodiscard]] scene membrane(std::string name, fem::membrane<> problem, Weight const& w) {
  auto const data = std::make_shared<fem::membrane<> const>(std::move(problem));
  auto const& grid = data->grid;
  oracle::dense_qp plain{
      oracle::naive_stiffness(static_cast<int>(grid.nx), static_cast<int>(grid.ny), grid.width,
                              grid.height, w)
          .template cast<double>(),
      data->b.cast<oracle::real>()};
  for (Eigen::Index i = 0; i < data->b.size(); ++i)
    plain.intervals.push_back({i, data->lower[i], data->upper[i]});
  scenes::constraints set;
  if (data->upper.allFinite()) {
    set.lower = data->lower;
    set.upper = data->upper;
  } else {
    set.half_lines = data->lower;
  }
  return {std::move(name), data,          data->A, fem::incomplete_five_point<>(data->A),
          data->b,         make_set(set), plain,   scenes::solved(plain)};
}

}  // namespace obstacle_scenes_test

namespace scenes {

oracle::real_vector solved(oracle::dense_qp const& plain) {
  return oracle::solve_dense(plain).x;
}

std::vector<scene> obstacle_scenes() {
  using obstacle_scenes_test::membrane;
  std::vector<scene> all;
  all.push_back(obstacle_scenes_test::tridiagonal());
  all.back().active = std::pair{0, 3};
  std::size_t const entry = test::effort(1, 0);
  for (auto const& cell : fem::printed_wire_counts) {
    all.push_back(obstacle_scenes_test::wire(cell.m(entry), cell.l, cell.g));
    all.back().active = std::pair{cell.bounds[entry], cell.circles[entry]};
  }
  int const n = test::effort(14, 6);
  auto const one = [](long double) { return 1.0L; };
  auto const film = [](long double x) {
    long double const gap = 1 + 0.5L * std::cos(x);
    return gap * gap * gap;
  };
  all.push_back(membrane("torsion", fem::make_elastic_torsion<>(n, n - 2), one));
  all.push_back(membrane(
      "bearing", fem::make_journal_bearing<>(n, n - 2, {.eccentricity = 0.5, .b = 2}), film));
  all.push_back(membrane("lower obstacle", fem::make_lower_obstacle<>(n, n - 2), one));
  all.push_back(membrane("double obstacle", fem::make_double_obstacle<>(n, n - 2), one));
  return all;
}

}  // namespace scenes
