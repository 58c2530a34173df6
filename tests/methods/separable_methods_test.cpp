// SPDX-License-Identifier: MIT
//
// What all methods for separable programs have in common: feasible iterates of falling energy, no
// allocation, states that can be copied, and how runs end that cannot end well.
#include <slant/iteration/iterates.hpp>
#include <slant/slant.hpp>

#include <support/minimise.hpp>
#include <support/testing.hpp>
#include "mixture.hpp"

namespace separable_methods_test {

using slant::status;
using test::mixture;

/// f(name, method) for all whose iterates may lie on the boundary.
template <class QP, class F>
void for_each_method(QP const& qp, F const& f) {
  f("kprgp", slant::kprgp{qp});
  f("as_s", slant::as_s(qp));
  f("qpq", slant::qpq{qp});
  f("qpc", slant::qpc{qp});
  f("mssn", slant::mssn{qp});
  f("imssn", slant::imssn{qp});
  f("gimssn", slant::gimssn{qp});
  f("symmetric_newton", slant::symmetric_newton{qp});
}

VectorXd const none;

TEST_CASE("iterates are feasible, and where a method promises it the energy falls in every step") {
  mixture const p(1000);
  auto const A = test::spd(p.A);
  auto const set = p.set();
  auto const qp = slant::separable_qp{A, p.b, set};
  for_each_method(qp, [&](std::string const& name, auto const& method) {
    CAPTURE(name);
    bool const falls = name != "mssn" && name != "imssn" && name != "symmetric_newton";
    int half_steps = 0;
    for (unsigned seed = 9; seed <= 20; ++seed) {
      CAPTURE(seed);
      double last = std::numeric_limits<double>::infinity();
      int seen = 0;
      for (auto const& s : slant::iterates(method, VectorXd(100 * test::random_vector(20, seed)))) {
        CHECK(set.contains(s.x));
        double const q = s.x.dot(0.5 * (p.A * s.x) - p.b);
        if (falls) CHECK(q <= last + 1e-13 * std::abs(last));
        CHECK(slant::energy(qp, s.x, VectorXd(s.unit * s.r)) == doctest::Approx(q).epsilon(1e-9));
        last = q;
        if constexpr (requires { s.last_inner; })
          half_steps += s.last_inner == slant::inner_end::boundary;
        if (++seen == 100) break;
      }
      CHECK(seen > 5);
    }
    if (name == "gimssn") CHECK(half_steps > 20);
  });
}

TEST_CASE("no allocation after the start, whatever the step") {
  mixture const p(1000);
  auto const A = test::spd(p.A);
  auto const set = p.set();
  auto const qp = slant::separable_qp{A, p.b, set};
  auto const allocations_of = [](auto const& method, auto& s) {
    bool seen[3] = {false, false, false};
    bool inner = false, outside = false, half_step = false;
    slant::testing::allocation_guard guard;
    for (int k = 0; k < 500 && s.status == status::running; ++k) {
      method.step(s);
      if constexpr (requires { s.last_step == slant::kprgp_step::proportioning; })
        seen[static_cast<int>(s.last_step)] = true;
      if constexpr (requires { s.last_inner; }) {
        inner = inner || s.inner_iterations > 1;
        half_step = half_step || s.last_inner == slant::inner_end::boundary;
      }
      if constexpr (requires { s.outside.in_use; }) outside = outside || s.outside.in_use;
    }
    auto const allocations = guard.count();
    // The guard has seen each kind of step.
    if constexpr (requires { s.last_step == slant::kprgp_step::proportioning; })
      CHECK((seen[0] && seen[1] && seen[2]));
    if constexpr (requires { s.last_inner; }) CHECK((inner && (outside || half_step)));
    CHECK(s.iteration >= 4);
    return allocations;
  };
  VectorXd const x0 = 100 * test::random_vector(20, 8);
  for_each_method(qp, [&](std::string const& name, auto const& method) {
    CAPTURE(name);
    auto s = method.start(x0);
    CHECK(allocations_of(method, s) == 0);
  });
  slant::symmetric_newton const newton{qp, A};
  auto t = newton.start(x0);
  CHECK(allocations_of(newton, t) == 0);
}

TEST_CASE("a state can be copied and continued: both go the same way") {
  mixture const p(300);
  auto const A = test::spd(p.A);
  auto const set = p.set();
  for_each_method(slant::separable_qp{A, p.b, set},
                  [&](std::string const& name, auto const& method) {
                    CAPTURE(name);
                    auto s = method.start(VectorXd::Zero(20));
                    for (int k = 0; k < 3; ++k) method.step(s);
                    auto copy = s;
                    for (int k = 0; k < 3; ++k) {
                      method.step(s);
                      method.step(copy);
                    }
                    CHECK(s.x == copy.x);
                    CHECK(s.work == copy.work);
                  });
}

TEST_CASE("a right-hand side of zero is solved by zero, and bad starts are named") {
  mixture const p(30);
  auto const A = test::spd(p.A);
  VectorXd const b = VectorXd::Zero(20);
  auto const set = test::mixed_set(none, VectorXd::Ones(20), none, 0);
  auto const stop = slant::reduced_gradient_below(1e-10) || slant::at_most(1000);
  for_each_method(slant::separable_qp{A, b, set}, [&](std::string const& name, auto const& method) {
    CAPTURE(name);
    auto const cold = slant::solve(method, b, stop);
    CHECK(cold.converged());
    CHECK(cold.iterations() == 0);
    auto const warm = slant::solve(method, VectorXd(VectorXd::Ones(20)), stop);
    CHECK(warm.converged());
    CHECK(warm.x().norm() <= 1e-8);
    CHECK_THROWS_AS(static_cast<void>(method.start(VectorXd::Zero(19))), slant::bad_input);
    VectorXd x0 = VectorXd::Zero(20);
    x0(7) = std::numeric_limits<double>::infinity();
    CHECK(SLANT_COMPLAINT(method.start(x0)) == "x0[7]: got inf, expected a finite number");
  });
  slant::interior_point const inside{slant::separable_qp{A, b, set}};
  CHECK_THROWS_AS(static_cast<void>(inside.start(VectorXd::Zero(19))), slant::bad_input);
  CHECK_THROWS_AS(static_cast<void>(inside.start(VectorXd::Constant(20, std::nan("")))),
                  slant::bad_input);
}

TEST_CASE("an accuracy beyond reach ends as stalled or converged, at the floor") {
  auto const check = [](double κ, double floor, auto make) {
    mixture const p(κ);
    auto const A = test::spd(p.A);
    auto const set = p.set();
    auto const r = slant::solve(make(slant::separable_qp{A, p.b, set}), test::zeros(20),
                                slant::stop_when([](auto const&) { return false; }, ""));
    CHECK((r.status == status::stalled || r.converged()));
    CHECK(r.state.reduced_gradient_norm <= floor * p.b.norm());
  };
  check(1e6, 1e-14, [](auto const& qp) { return slant::kprgp(qp); });
  check(1e4, 1e-13, [](auto const& qp) { return slant::gimssn(qp); });
}

/// diag(d), of which no more is promised than that it is semidefinite.
auto semidefinite(VectorXd const& d) {
  return slant::declare<slant::self_adjoint, slant::positive_semidefinite>(
      slant::diagonal(VectorXd(d)));
}

TEST_CASE("a singular A: consistent, held by the constraints, unbounded with the direction") {
  auto const A = semidefinite(VectorXd{{1.0, 2.0, 0.0}});
  VectorXd const zero = VectorXd::Zero(3), ones = VectorXd::Ones(3), b{{1.0, 1.0, 0.0}};
  auto const stop = slant::reduced_gradient_below(1e-12) || slant::at_most(1000);
  auto const free = test::mixed_set(none, none, none, 3);
  auto const box = test::mixed_set(none, VectorXd{{9.0, 9.0, 5.0}}, none, 0);
  auto const lines = test::mixed_set(zero, none, none, 0);
  auto const consistent = [&](std::string const& name, auto const& method) {
    CAPTURE(name);
    auto const r = slant::solve(method, zero, stop);
    CHECK(r.converged());
    CHECK(r.x()(0) == doctest::Approx(1));
  };
  auto const held = [&](std::string const& name, auto const& method) {
    CAPTURE(name);
    auto const r = slant::solve(method, zero, stop);
    CHECK(r.converged());
    CHECK(r.x()(2) == doctest::Approx(5));
  };
  auto const unbounded = [&](std::string const& name, auto const& method) {
    CAPTURE(name);
    auto const r = slant::solve(method, zero, stop);
    CHECK(r.status == status::unbounded);
    if constexpr (requires { r.state.directions.p; }) {
      VectorXd const down = -r.state.directions.p;
      CHECK(down(2) > 0);
      CHECK(std::abs(down(0)) + std::abs(down(1)) <= 1e-10 * down(2));
    }
  };
  auto const with = [&](auto const& f, auto const& qp) {
    f("kprgp", slant::kprgp{qp});
    f("gimssn", slant::gimssn{qp});
    f("symmetric_newton", slant::symmetric_newton{qp});
  };
  with(consistent, slant::separable_qp{A, b, free});
  with(held, slant::separable_qp{A, ones, box});
  with(unbounded, slant::separable_qp{A, ones, lines});

  auto const nothing = semidefinite(zero);
  VectorXd const way{{1.0, -1.0, 0.0}};
  auto const narrow = test::mixed_set(none, VectorXd{{2.0, 3.0, 4.0}}, none, 0);
  slant::separable_qp const flat{nothing, way, narrow};
  auto const corner = slant::solve(slant::kprgp{flat}, zero, stop);
  CHECK(corner.converged());
  CHECK(corner.x() == VectorXd{{2.0, -3.0, 0.0}});
}

TEST_CASE("numbers beyond the range of the scalar are a breakdown, not a solution") {
  VectorXd const b = VectorXd::Constant(10, 1.5e308);  // finite, but ‖b‖ is not
  MatrixXd const twice = 2 * MatrixXd::Identity(10, 10);
  auto const A = test::spd(twice);
  auto const set = test::mixed_set(none, none, none, 10);
  for_each_method(slant::separable_qp{A, b, set}, [&](std::string const& name, auto const& method) {
    CAPTURE(name);
    auto const r = test::minimise(method, test::zeros(10), 1e-8, 10);
    CHECK(r.status == status::breakdown);
  });
}

/// Well behaved `good` times.
struct fragile {
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
  int good;
  mutable int calls = 0;
  [[nodiscard]] slant::index rows() const { return 2; }
  [[nodiscard]] slant::index cols() const { return 2; }
  void apply(VectorXd const& x, VectorXd& y) const {
    y = x;
    y(1) *= 3;
    if (++calls > good) y(0) = std::nan("");
  }
};

TEST_CASE("a NaN that the operator makes later is a breakdown, not a result") {
  VectorXd const b{{1.0, 2.0}}, zero = VectorXd::Zero(2);
  auto const set = slant::intervals(VectorXd{{2.0, 0.5}});
  for (int good = 0; good < 3; ++good) {
    CAPTURE(good);
    auto const run = [&](auto make) {
      fragile const A{good};
      auto const r = test::minimise(make(slant::separable_qp{A, b, set}), zero, 1e-10, 10);
      CHECK(r.status == status::breakdown);
      CHECK(r.reason.find("left the range") != std::string::npos);
    };
    run([](auto const& qp) { return slant::mssn(qp, {.step_length = 0.3}); });
    run([](auto const& qp) { return slant::imssn(qp, {.step_length = 0.3}); });
    run([](auto const& qp) { return slant::gimssn(qp, {.step_length = 0.3}); });
    run([](auto const& qp) { return slant::kprgp(qp, {.step_length = 0.3}); });
  }
}

}  // namespace separable_methods_test
