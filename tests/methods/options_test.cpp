// SPDX-License-Identifier: MIT
//
// Options out of range are named with their value and what was expected.
#include <slant/slant.hpp>

#include <support/testing.hpp>

namespace options_test {

/// Options, and how the complaint about them begins.
template <class Options>
struct row {
  Options options;
  std::string complaint = "nothing thrown";
};

template <class Options>
void check(std::vector<row<Options>> const& table) {
  for (auto const& [options, expected] : table) {
    auto const said = SLANT_COMPLAINT(options.validate());
    CAPTURE(expected);
    CAPTURE(said);
    CHECK(said.starts_with(expected));
  }
}

TEST_CASE("KPRGP and QPC") {
  check<slant::kprgp_options<double>>(
      {{{}},
       {{.proportioning = 1e-9, .step_length = 1e-150, .step_factor = 1.99, .refresh = 0}},
       {{.proportioning = 0}, "proportioning: got 0, expected a finite number > 0"},
       {{.step_length = -1.0}, "step_length: got -1, expected a finite number > 0"},
       {{.step_factor = 2}, "step_factor: got 2, expected a number in (0, 2)"},
       {{.patience = -1}, "patience: got -1, expected a number >= 0"},
       {{.spectrum = {.steps = 1}}, "steps: got 1, expected at least 2 Lanczos steps"}});
}

TEST_CASE("MSSN and IMSSN") {
  check<slant::mssn_options<double>>(
      {{{.forcing = {.tolerance = 1}}, "tolerance: got 1, expected a number in [0, 1)"}});
  check<slant::imssn_options<double>>(
      {{{.forcing = {.r_tol = 1}}, "r_tol: got 1, expected a number in (0, 1)"},
       {{.step_length = -1}, "step_length: got -1, expected a finite number > 0"},
       {{.max_inner = 0}, "max_inner: got 0, expected a number >= 1"}});
}

TEST_CASE("successive approximations") {
  check<slant::successive_options<double>>(
      {{{}},
       {{.forcing = {.η_max = 2}}, "η_max: got 2"},
       {{.inner_steps = 0}, "inner_steps: got 0, expected at least 1"},
       {{.patience = 0}, "patience: got 0, expected at least 1"}});
}

TEST_CASE("the symmetric Newton method") {
  check<slant::symmetric_newton_options<double>>(
      {{{}},
       {{.step_length = -1.0}, "step_length: got -1, expected a finite number > 0"},
       {{.inner_steps = 0}, "inner_steps: got 0"},
       {{.sufficient = 1.0}, "sufficient: got 1"}});
}

TEST_CASE("interior points") {
  check<slant::interior_point_options<double>>({{{}}, {{.inner_share = 1}, "inner_share: got 1"}});
}

}  // namespace options_test
