// SPDX-License-Identifier: MIT
//
// Options of solve_friction, and what it returns.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/concepts/iterative_method.hpp>
#include <slant/contact/friction/friction_blocks.hpp>
#include <slant/contact/friction/friction_gauss_seidel.hpp>
#include <slant/contact/friction/friction_interior_point.hpp>
#include <slant/contact/friction/friction_newton.hpp>
#include <slant/contact/friction/friction_problem.hpp>
#include <slant/contact/friction/verify.hpp>

#include <limits>
#include <string>
#include <string_view>

namespace slant::contact {

/// Which method solve_friction uses.
enum class friction_method : unsigned char {
  automatic,      ///< the others in turn, until one of them has solved the problem
  gauss_seidel,   ///< friction_gauss_seidel
  newton,         ///< friction_newton with damping, after a few sweeps
  interior_point  ///< friction_interior_point
};

/// The method in words.
[[nodiscard]] constexpr std::string_view to_string(friction_method m) {
  switch (m) {
    case friction_method::automatic:
      return "automatic";
    case friction_method::gauss_seidel:
      return "gauss_seidel";
    case friction_method::newton:
      return "newton";
    case friction_method::interior_point:
      return "interior_point";
  }
  return "unknown";
}

/// Options of solve_friction.
template <scalar S = double>
struct friction_options {
  friction_method method = friction_method::automatic;
  /// Of the unit-free natural map and penetration of verify.hpp. Where the natural map of the
  /// literature, with ρ = 1, is larger and not by rounding, the run goes on for a while to make
  /// that smaller too; its verdict does not depend on it.
  S tolerance = S(1e-8);
  friction_equations equations = friction_equations::natural_map;
  asymmetric_data asymmetry = asymmetric_data::used_as_given;
  index first_sweeps = 100;    ///< before the first Newton step
  index further_sweeps = 400;  ///< between Newton steps, four times as many each time
  index sweeps = 300000;       ///< of Gauss–Seidel at most, in all
  index newton_steps = 3000;   ///< at most, in all, those of the interior-point method included
  index interior_steps = 300;  ///< of that method at most
  index attempt = 40;          ///< Newton steps in one attempt of `newton`
  S damping = S(1e-6);         ///< first δ of friction_newton in `newton`
  index halvings = 8;          ///< of a Newton step at most
  index patience = 3;          ///< turns of `automatic` that hardly lessen the error, till stalled
  gauss_seidel_options<S> gauss_seidel{};
  friction_interior_options<S> interior_point{};  ///< `small` at most tolerance/100

  /// Throws bad_input naming the option, its value and what was expected.
  [[gnu::cold]] void validate() const {
    using slant::detail::show;
    slant::detail::check_fraction("tolerance", tolerance);
    if (!(damping > S(0)) || !slant::detail::is_finite(damping)) {
      throw bad_input("damping", show(damping), "a finite number > 0");
    }
    at_least_zero("first_sweeps", first_sweeps);
    at_least_zero("further_sweeps", further_sweeps);
    at_least_zero("sweeps", sweeps);
    at_least_zero("newton_steps", newton_steps);
    at_least_zero("interior_steps", interior_steps);
    at_least_zero("halvings", halvings);
    if (attempt < 1) throw bad_input("attempt", show(attempt), "at least 1");
    if (patience < 1) throw bad_input("patience", show(patience), "at least 1");
    gauss_seidel.validate();
    interior_point.validate();
  }

 private:
  static void at_least_zero(char const* name, index value) {
    if (value < 0) throw bad_input(name, slant::detail::show(value), "a number >= 0");
  }
};

/// Work of solve_friction.
struct friction_work {
  index sweeps = 0;          ///< passes of Gauss–Seidel over the contacts
  index block_products = 0;  ///< N × N blocks of W multiplied in them
  index products = 0;        ///< products by W besides
  index newton_steps = 0;    ///< directions of Newton's method, those of interior_steps included
  index interior_steps = 0;  ///< steps of the interior-point method
  index factorizations = 0;  ///< matrices factored
  index factored_rows = 0;   ///< rows of all of them together
  index sparse_factorizations = 0;  ///< how many of them were sparse

  friend bool operator==(friction_work const&, friction_work const&) = default;
};

/// Result of solve_friction.
template <class S>
struct friction_result {
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  vector_type r{};  ///< forces: the best that were found
  vector_type u{};  ///< W r + q
  slant::status status = slant::status::running;
  std::string reason{};       ///< the same as a sentence
  friction_error<S> error{};  ///< of r, as verify finds it
  violation<S> worst{};       ///< the contact with the largest unit-free natural map
  /// What had the last word; `automatic` if there was nothing to do.
  friction_method solved_by = friction_method::automatic;
  friction_work work{};

  [[nodiscard]] bool converged() const { return status == slant::status::converged; }
};

}  // namespace slant::contact
