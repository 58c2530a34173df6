// SPDX-License-Identifier: MIT
#include <slant/slant.hpp>

#include <support/testing.hpp>

namespace kkt_vector_test {

/// β for gradients r at x, with r̃ for the step length α.
template <class Set>
VectorXd kkt(Set const& set, VectorXd const& x, VectorXd const& r, double α = 0.1) {
  slant::face<double> const face(set, x);
  VectorXd const reduced = (x - slant::project(set, VectorXd(x - α * r))) / α;
  VectorXd β(x.size());
  face.keep_complement(reduced, β);
  slant::kkt_vector(set, face, x, r, reduced, β);
  return β;
}

TEST_CASE("on a circle: r + ‖r‖ x/‖x‖, zero exactly where r points inwards along the normal") {
  auto const set = slant::discs(VectorXd(VectorXd::Constant(1, 2.0)));
  VectorXd const x{{2.0, 0.0}};
  CHECK(kkt(set, x, VectorXd{{0.0, 3.0}}) == VectorXd{{3.0, 3.0}});
  CHECK(kkt(set, x, VectorXd{{-5.0, 0.0}}) == VectorXd{{0.0, 0.0}});
  CHECK(kkt(set, x, VectorXd{{5.0, 0.0}}) == VectorXd{{10.0, 0.0}});
  // −β halves the angle between −x, inwards, and −r.
  VectorXd const r{{1.0, -2.0}}, β = kkt(set, x, r);
  CHECK(β.dot(x) / x.norm() == doctest::Approx(β.dot(r) / r.norm()));
}

TEST_CASE("on bounds: twice the gradient where it releases, zero where it presses") {
  auto const set = slant::cartesian(slant::half_lines(2), slant::intervals(VectorXd{{1.0, 1.0}}));
  VectorXd const x{{0.0, 0.0, 1.0, -1.0}};
  CHECK(kkt(set, x, VectorXd{{-3.0, 3.0, 2.0, -2.0}}) == VectorXd{{-6.0, 0.0, 4.0, -4.0}});
  CHECK(kkt(set, x, VectorXd{{3.0, -3.0, -2.0, 2.0}}) == VectorXd{{0.0, -6.0, 0.0, 0.0}});
}

TEST_CASE("free blocks get nothing, points and apexes keep the reduced gradient") {
  auto const set = slant::cartesian(slant::discs(VectorXd{{0.0, 1.0}}), slant::free_components(1),
                                    slant::power(slant::second_order_cone<3>(1.0), 1));
  VectorXd x = VectorXd::Zero(8), r(8);
  r << 1, 2, 3, 4, 5, 0.5, 0.25, -6;
  VectorXd const β = kkt(set, x, r);
  CHECK(β.head(5) == VectorXd::Zero(5));
  VectorXd const reduced = (x - slant::project(set, VectorXd(x - 0.1 * r))) / 0.1;
  CHECK(β.tail(3) == reduced.tail(3));
  CHECK(β.tail(3).norm() > 0);
}

TEST_CASE("curved boundaries other than circles, at any scale") {
  for (double t : {1.0, std::ldexp(1.0, 500), std::ldexp(1.0, -500)}) {
    auto const set = slant::power(slant::ellipse<>(3.0 * t, 1.0 * t), 1);
    double const angle = 0.7;
    VectorXd const x{{3 * t * std::cos(angle), t * std::sin(angle)}};
    VectorXd normal{{std::cos(angle) / 3, std::sin(angle)}};
    normal.normalize();
    VectorXd const r{{0.3, -1.0}};
    CHECK((kkt(set, x, r, 0.1 * t) - (r + r.norm() * normal)).norm() <= 1e-14);
    CHECK(kkt(set, x, VectorXd(-2 * normal), 0.1 * t).norm() <= 1e-13);
  }
}

}  // namespace kkt_vector_test
