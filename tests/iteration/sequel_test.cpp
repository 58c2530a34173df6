// SPDX-License-Identifier: MIT
#include <slant/iteration/solve.hpp>

#include <support/testing.hpp>

namespace sequel_test {

struct halving_state {
  VectorXd x;
  slant::index iteration = 0;
  slant::status status = slant::status::running;
  slant::work work{};
};

/// x ← factor · x; ends by itself in step `last` with the status `end`.
struct halving {
  double factor = 0.5;
  slant::index last = 1000;
  slant::status end = slant::status::breakdown;

  [[nodiscard]] halving_state start(VectorXd const& x0) const { return {x0}; }
  void step(halving_state& s) const {
    s.x *= factor;
    ++s.work.operator_applications;
    if (++s.iteration == last) s.status = end;
  }
};

auto size_below(double size) {
  return slant::stop_when([size](auto const& s) { return s.x.norm() <= size; }, "small enough",
                          slant::status::converged);
}

TEST_CASE("the second method goes on where the first one ends; counts and words of both") {
  VectorXd const x0 = VectorXd::Unit(3, 1);
  slant::index seen = 0;
  auto const r =
      slant::solve_then(halving{}, size_below(0.1), halving{.factor = 0.1}, x0,
                        size_below(1e-4) || slant::at_most(50), [&](auto const&) { ++seen; });
  CHECK(r.converged());
  CHECK(r.status() == slant::status::converged);
  CHECK(r.first.iterations() == 4);
  REQUIRE(r.second.has_value());
  CHECK(r.second->iterations() == 3);
  CHECK(r.x()(1) == doctest::Approx(1.0 / 16 * 1e-3));
  CHECK(r.iterations() == 7);
  CHECK(r.work().operator_applications == 7);
  CHECK(seen == 5 + 4);
  CHECK(r.reason() == "first phase: small enough; second phase: small enough");
}

TEST_CASE("the second method may be made from the last state of the first") {
  VectorXd const x0 = VectorXd::Unit(3, 1);
  auto const r = slant::solve_then(
      halving{}, size_below(0.1),
      [](halving_state const& last) { return halving{.factor = last.x.norm()}; }, x0,
      size_below(1e-4) || slant::at_most(50));
  CHECK(r.converged());
  CHECK(r.second->iterations() == 3);
  CHECK(r.x()(1) == doctest::Approx(std::pow(2.0, -4 * 4)));
}

TEST_CASE("a limit or a stall hands over; a failure is reported and ends it") {
  VectorXd const x0 = VectorXd::Ones(2);
  auto const run = [&](slant::status end) {
    return slant::solve_then(halving{.last = 2, .end = end}, slant::at_most(5), halving{}, x0,
                             size_below(1e-3) || slant::at_most(50));
  };
  CHECK(run(slant::status::stalled).converged());
  CHECK(run(slant::status::iteration_limit).first.status == slant::status::iteration_limit);
  CHECK(run(slant::status::iteration_limit).converged());
  for (auto const end :
       {slant::status::breakdown, slant::status::unbounded, slant::status::interrupted}) {
    auto const r = run(end);
    CHECK_FALSE(r.converged());
    CHECK_FALSE(r.second.has_value());
    CHECK(r.status() == end);
    CHECK(r.iterations() == 2);
    CHECK(r.work().operator_applications == 2);
    CHECK(r.x()(0) == 0.25);
    CHECK(r.reason() == "first phase: the method reports: " + std::string(slant::to_string(end)) +
                            "; no second phase");
  }
  // An iterate that is not finite starts nothing.
  auto const r = slant::solve_then(halving{.factor = 1e200}, slant::at_most(2), halving{}, x0,
                                   slant::at_most(1));
  CHECK_FALSE(r.second.has_value());
  CHECK(r.status() == slant::status::iteration_limit);
}

}  // namespace sequel_test
