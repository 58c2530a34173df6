// SPDX-License-Identifier: MIT
#include <slant/contact/friction_law.hpp>
#include <support/testing.hpp>

namespace friction_law_test {

namespace contact = slant::contact;

TEST_CASE("coefficients by place, by slip, by direction") {
  auto const place = contact::coefficients(VectorXd{{0.1, 0.2}});
  CHECK(place.size() == 2);
  CHECK(place(1, 5.0) == 0.2);
  auto const slip =
      contact::slip_dependent(3, [](slant::index i, double s) { return 0.1 * double(i) + s; });
  CHECK(slip.size() == 3);
  CHECK(slip(2, 0.5) == doctest::Approx(0.7));
  auto const two = contact::orthotropic_coefficients(VectorXd{{0.1, 0.2}}, VectorXd{{0.3, 0.0}});
  CHECK(two.size() == 2);
  CHECK(two.first()(1) == 0.2);
  CHECK(two.second()(0) == 0.3);
}

TEST_CASE("coefficients that depend on the slip are looked at whenever they are asked for") {
  auto const F = contact::slip_dependent(3, [](slant::index i, double s) {
    return i == 0 ? std::numeric_limits<double>::infinity() : i == 1 ? 0.25 - s : NAN;
  });
  CHECK(F(0, 1.0) == std::numeric_limits<double>::infinity());  // sticks
  CHECK(F(1, 0.25) == 0);
  CHECK(SLANT_COMPLAINT(F(1, 0.75)) ==
        "f[1]: got -0.5, expected a friction coefficient >= 0 for the slip 0.75");
  CHECK(SLANT_COMPLAINT(F(2, 0.5)) ==
        "f[2]: got nan, expected a friction coefficient >= 0 for the slip 0.5");
}

TEST_CASE("coefficients out of range are refused") {
  CHECK(SLANT_COMPLAINT(contact::coefficients(VectorXd{{0.1, -0.2}})) ==
        "F[1]: got -0.2, expected a finite number >= 0");
  CHECK(
      SLANT_COMPLAINT(contact::coefficients(VectorXd{{std::numeric_limits<double>::infinity()}})) ==
      "F[0]: got inf, expected a finite number >= 0");
  CHECK(SLANT_COMPLAINT(
            contact::orthotropic_coefficients(VectorXd{{0.1, 0.2}}, VectorXd{{0.3, NAN}})) ==
        "F2[1]: got nan, expected a finite number >= 0");
  CHECK(SLANT_COMPLAINT(contact::orthotropic_coefficients(VectorXd{{0.1, 0.2}}, VectorXd{{0.3}}))
            .starts_with("F2: got 1"));
}

}  // namespace friction_law_test
