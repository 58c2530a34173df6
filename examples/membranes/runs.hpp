// SPDX-License-Identifier: MIT
//
// Obstacle problems by name, and how they are solved: a problem as a level of nested iteration.
#pragma once

#include <array>
#include <fem/double_obstacle.hpp>
#include <fem/elastic_torsion.hpp>
#include <fem/grid_prolongation.hpp>
#include <fem/incomplete_five_point.hpp>
#include <fem/journal_bearing.hpp>
#include <fem/lower_obstacle.hpp>
#include <fem/printed_membranes.hpp>
#include <optional>
#include <ranges>
#include <slant/iteration/nested.hpp>
#include <slant/methods/kprgp.hpp>
#include <slant/methods/symmetric_newton.hpp>
#include <slant/operators/matrix.hpp>
#include <slant/problems/separable_qp.hpp>
#include <slant/sets/contact_sets.hpp>
#include <string>
#include <string_view>
#include <support/named_method.hpp>
#include <utility>
#include <vector>

namespace membranes {

struct settings {
  std::string problem = "all";
  std::string method = "newton";
  std::vector<int> size{100};  ///< interior nodes in x and, if they differ, in y
  double twist = 5;            ///< c of the torsion
  double eccentricity = 0.1;   ///< ε of the bearing
  bool from_zero = false;
  examples::run_limits limits{.tolerance = 1e-8, .max_iterations = 100000};
  std::string output{};
};

inline constexpr std::array<std::string_view, 4> problems{"torsion", "bearing", "lower_obstacle",
                                                          "double_obstacle"};

[[nodiscard]] inline fem::membrane<> make(std::string_view problem, settings const& s,
                                          Eigen::Index nx, Eigen::Index ny) {
  if (problem == "torsion") return fem::make_elastic_torsion(nx, ny, s.twist);
  if (problem == "bearing")
    return fem::make_journal_bearing<>(nx, ny, {.eccentricity = s.eccentricity});
  if (problem == "lower_obstacle") return fem::make_lower_obstacle<>(nx, ny);
  return fem::make_double_obstacle<>(nx, ny);
}

/// What others have printed for this problem on this grid.
[[nodiscard]] inline std::optional<fem::printed_membrane> printed(std::string_view problem,
                                                                  settings const& s,
                                                                  fem::rectangle_grid<> const& g) {
  auto const find = [&](auto const& list, double parameter) {
    std::optional<fem::printed_membrane> found;
    for (auto const& entry : list)
      if (entry.nx == g.nx && entry.ny == g.ny && entry.parameter == parameter) found = entry;
    return found;
  };
  if (problem == "torsion") return find(fem::printed_torsions, s.twist);
  if (problem == "bearing") return find(fem::printed_bearings, s.eccentricity);
  return std::nullopt;
}

/// A problem on one grid, ready for any method. A is never stored.
class membrane_problem {
 public:
  explicit membrane_problem(fem::membrane<> membrane)
      : membrane_(std::move(membrane)), set_(slant::intervals(membrane_.lower, membrane_.upper)) {}

  [[nodiscard]] fem::membrane<> const& membrane() const { return membrane_; }
  [[nodiscard]] auto qp() const { return slant::separable_qp{membrane_.A, membrane_.b, set_}; }
  [[nodiscard]] auto preconditioner() const { return fem::incomplete_five_point<>(membrane_.A); }
  [[nodiscard]] double sigma() const { return membrane_.A.largest_eigenvalue_bound(); }
  [[nodiscard]] Eigen::VectorXd zero() const {
    return Eigen::VectorXd::Zero(membrane_.grid.size());
  }

 private:
  fem::membrane<> membrane_;
  decltype(slant::intervals(Eigen::VectorXd(), Eigen::VectorXd())) set_;
};

/// The grids of nested iteration, coarsest first: halved while there are more than 15 nodes.
[[nodiscard]] inline std::vector<membrane_problem> make_levels(std::string_view problem,
                                                               settings const& s) {
  std::vector<std::pair<Eigen::Index, Eigen::Index>> sizes{{s.size.front(), s.size.back()}};
  while (!s.from_zero && sizes.back().first > 15 && sizes.back().second > 15)
    sizes.emplace_back(sizes.back().first / 2, sizes.back().second / 2);
  std::vector<membrane_problem> levels;
  for (auto const& [nx, ny] : std::views::reverse(sizes))
    levels.emplace_back(make(problem, s, nx, ny));
  return levels;
}

template <class Method>
class membrane_level {
 public:
  membrane_level(Method const& method, examples::run_limits const& limits,
                 membrane_problem const& problem, membrane_problem const* coarse)
      : method_(&method), limits_(limits), problem_(&problem) {
    if (coarse != nullptr)
      P_ = fem::grid_prolongation(coarse->membrane().grid, problem.membrane().grid);
  }

  [[nodiscard]] auto method() const { return method_->make(*problem_); }
  [[nodiscard]] auto stop() const { return method_->stop(limits_); }
  [[nodiscard]] auto prolongation() const { return slant::matrix(P_); }

 private:
  Method const* method_;
  examples::run_limits limits_;
  membrane_problem const* problem_;
  Eigen::SparseMatrix<double> P_{};
};

/// ρ = 1/max A_ii; an accuracy asked for keeps the last step from being solved too well.
[[nodiscard]] inline auto newton(double goal) {
  return examples::named_method{
      "newton", [goal](membrane_problem const& problem) {
        slant::symmetric_newton_options<double> options;
        options.step_length = 2 / problem.sigma();
        options.forcing.goal = goal;
        return slant::symmetric_newton{problem.qp(), problem.preconditioner(), options};
      }};
}
[[nodiscard]] inline auto kprgp() {
  return examples::named_method{
      "kprgp", [](membrane_problem const& problem) {
        return slant::kprgp{problem.qp(), {.step_length = 1.9 / problem.sigma()}};
      }};
}

}  // namespace membranes
