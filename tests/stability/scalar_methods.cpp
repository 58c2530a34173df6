// SPDX-License-Identifier: MIT
//
// Some methods in other scalars than double, on programs without contact.
#include <slant/slant.hpp>

#include <algorithm>
#include <limits>
#include <stability/methods.hpp>

namespace stability {

namespace {

template <class S, class Make>
outcome in_scalar(prepared const& p, request const& r) {
  using vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  program const& q = p.source();
  Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> const A = q.A.cast<S>();
  vector const b = q.b.cast<S>(), lower = q.lower.cast<S>(), low = q.low.cast<S>(),
               high = q.high.cast<S>(), radius = q.radius.cast<S>();
  slant::separable_qp const qp{slant::matrix<slant::self_adjoint, slant::positive_semidefinite>(A),
                               b,
                               slant::cartesian(slant::half_lines(lower),
                                                slant::intervals(low, high), slant::discs(radius))};
  slant::energy_certificate certificate(qp);
  auto const error_of = [&](vector const& x) { return certificate(x); };
  // A float has no 1e300; the largest start that its norm can be taken of stands for it.
  constexpr double most = static_cast<double>(
      std::min<long double>(1e300L, static_cast<long double>(std::numeric_limits<S>::max()) / 16));
  vector const x0 = p.start(r.start).cwiseMin(most).template cast<S>();
  auto const report =
      slant::solve(Make{}(qp, x0), x0,
                   slant::energy_error_below(S(r.tolerance), error_of) || slant::at_most(r.steps) ||
                       slant::at_most_applications(r.applications));
  outcome o;
  o.status = report.status;
  o.reason = report.reason;
  o.iterations = report.iterations();
  o.applications = report.state.work.operator_applications;
  vector const x = slant::project(qp.set(), report.state.x);
  o.x = x.template cast<double>();
  o.fine_x = x.template cast<long double>();
  if (x.allFinite()) o.claimed = static_cast<double>(certificate(x).relative());
  return o;
}

using make_newton =
    decltype([](auto const& qp, auto const&) { return slant::symmetric_newton{qp}; });
using make_kprgp = decltype([](auto const& qp, auto const&) { return slant::kprgp{qp}; });
using make_interior =
    decltype([](auto const& qp, auto const&) { return slant::interior_point{qp}; });
using make_natural = decltype([](auto const& qp, auto const& x0) {
  using S = slant::scalar_t<std::remove_cvref_t<decltype(x0)>>;
  auto const step = slant::mean_step(qp.a(), x0, S(0.5));
  return slant::semismooth_newton{slant::natural_residual(qp.a(), qp.b(), qp.set(), step.length),
                                  slant::by_laws{}, slant::halving_line_search{},
                                  slant::eisenstat_walker{}};
});

constexpr double ε_float = std::numeric_limits<float>::epsilon();
constexpr auto ε_long = static_cast<double>(std::numeric_limits<long double>::epsilon());

}  // namespace

std::span<method const> scalar_methods() {
  static constexpr method list[]{
      {"symmetric_newton_float", in_scalar<float, make_newton>, scope::rounded, ε_float},
      {"kprgp_float", in_scalar<float, make_kprgp>, scope::rounded, ε_float},
      {"interior_point_float", in_scalar<float, make_interior>, scope::rounded, ε_float},
      {"semismooth_newton_float", in_scalar<float, make_natural>, scope::rounded, ε_float},
      {"symmetric_newton_long_double", in_scalar<long double, make_newton>, scope::dense, ε_long},
      {"kprgp_long_double", in_scalar<long double, make_kprgp>, scope::dense, ε_long},
      {"interior_point_long_double", in_scalar<long double, make_interior>, scope::dense, ε_long},
      {"semismooth_newton_long_double", in_scalar<long double, make_natural>, scope::dense, ε_long},
  };
  return list;
}

}  // namespace stability
