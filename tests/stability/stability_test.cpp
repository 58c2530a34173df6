// SPDX-License-Identifier: MIT
//
// The quick form of bench_stability: every method on the middle and the end of adversities. No
// method that is marked as certified may be wrong anywhere; of the others the mild programs are
// demanded, and the verdicts that were wrong once are kept.
#include <stability/regressions.hpp>
#include <stability/scenes.hpp>
#include <stability/verdict.hpp>
#include <support/effort.hpp>
#include <support/testing.hpp>

namespace stability_test {

using namespace stability;

/// A program, its reference, and what the methods see of it.
struct judged {
  program p;
  reference exact;
  prepared ready;
  explicit judged(program q) : p(std::move(q)), exact(solve_in_quad(p)), ready(p) {}
};

judgement judge_run(judged const& j, method const& m, request const& asked, tally& t) {
  outcome const o = run(m, j.ready, asked);
  judgement const result = judge(j.ready, j.exact, m, asked, o);
  t.add(o, result);
  CAPTURE(m.name);
  CAPTURE(j.p.name());
  CAPTURE(asked.tolerance);
  CAPTURE(o.reason);
  CAPTURE(result.ratio);
  // Of a run that has not converged the error is known less well: conjugate gradients that estimate
  // it end at their limit too. The summary counts these.
  if (o.status == slant::status::converged) CHECK_FALSE(result.claim_broken);
  CHECK(result.said != verdict::unbounded);
  if (m.certified) CHECK(result.said != verdict::wrong);
  return result;
}

program identity() {
  program p;
  p.A = MatrixXd::Identity(4, 4);
  p.b = VectorXd{{-1, 2, 3, 4}};
  p.lower = VectorXd{{0}};
  p.low = VectorXd{{-1}};
  p.high = VectorXd{{0.5}};
  p.radius = VectorXd{{1}};
  return p;
}

TEST_CASE("the reference of a program that is solved by hand") {
  program const p = identity();
  reference const r = solve_in_quad(p);
  CHECK(r.bound < 1e-25);
  CHECK(r.condition == doctest::Approx(1));
  CHECK(r.floor < 1e-14);
  CHECK(relative_error(p, r, VectorXd{{0, 0.5, 0.6, 0.8}}) < 1e-15);
  CHECK(relative_error(p, r, VectorXd{{0, 0.5, 0.6, 0.8 + 1e-9}}) ==
        doctest::Approx(1e-9 / std::sqrt(1.25)).epsilon(1e-6));
}

TEST_CASE("roots over the whole range") {
  quad const huge = static_cast<quad>(1e300) * static_cast<quad>(1e300);
  CHECK(static_cast<double>(root(huge) / static_cast<quad>(1e300)) == doctest::Approx(1));
  quad const infinite = static_cast<quad>(std::numeric_limits<double>::infinity());
  CHECK((root(infinite) == infinite));
  CHECK((root(quad(0)) == quad(0)));
}

TEST_CASE("references prove themselves") {
  for (auto const& f : families()) {
    if (make_program(f.name, f.parameters.front(), f.variants.front()).contact()) continue;
    for (double const parameter : f.parameters) {
      program const p = make_program(f.name, parameter, f.variants.back());
      CAPTURE(p.name());
      reference const r = solve_in_quad(p);
      CHECK(r.exact());
      CHECK(r.bound < 1e-20);
    }
  }
}

TEST_CASE("what is wrong is called wrong") {
  judged const j(identity());
  method const& m = newton_methods().front();
  request const asked{.tolerance = 1e-8};
  auto const said = [&](slant::status s, double error, double claimed) {
    outcome o;
    o.status = s;
    o.x = VectorXd{{0, 0.5, 0.6, 0.8 + error}};
    o.claimed = claimed;
    return judge(j.ready, j.exact, m, asked, o);
  };
  CHECK(said(slant::status::converged, 1e-8, quiet_nan).said == verdict::right);
  CHECK(said(slant::status::converged, 1e-6, quiet_nan).said == verdict::wrong);
  CHECK(said(slant::status::converged, 1e-5, quiet_nan).contradicted);
  CHECK(said(slant::status::converged, quiet_nan, quiet_nan).said == verdict::crashed);
  CHECK(said(slant::status::stalled, 1e-8, quiet_nan).said == verdict::unclaimed);
  CHECK(said(slant::status::stalled, 1e-6, quiet_nan).said == verdict::stalled);
  CHECK(said(slant::status::iteration_limit, 1e-6, quiet_nan).said == verdict::limit);
  CHECK(said(slant::status::unbounded, 1e-8, quiet_nan).said == verdict::unbounded);
  CHECK(said(slant::status::converged, 1e-8, 1e-9).claim_broken);
  CHECK_FALSE(said(slant::status::converged, 1e-8, 6e-9).claim_broken);
  CHECK_FALSE(said(slant::status::converged, 1e-8, 1e-8).claim_broken);
}

TEST_CASE("well-conditioned programs are solved by every method") {
  tally t;
  for (char const* seed : {"1", "2", "3"}) {
    judged const j(make_program("condition", 1, seed));
    for_each_method([&](method const& m) {
      if (!takes(m, j.p) || m.programs == scope::rounded) return;
      judgement const result = judge_run(j, m, {.tolerance = 1e-8}, t);
      CAPTURE(m.name);
      CAPTURE(seed);
      CHECK(result.said == verdict::right);
    });
  }
}

/// Contact costs most of the time: the adversities that told most methods wrong.
bool is_quick(family const& f, bool contact) {
  return !contact || f.name == "slenderness" || f.name == "thickness" || f.name == "spring";
}

TEST_CASE("the middle and the end of every adversity") {
  tally t;
  for (auto const& f : families()) {
    bool const contact = make_program(f.name, f.parameters.front(), f.variants.front()).contact();
    if (!is_quick(f, contact)) continue;
    for (std::size_t const at : {f.parameters.size() / 2, f.parameters.size() - 1}) {
      bool const last = at + 1 == f.parameters.size();
      if (last && (contact || !test::is_optimised)) continue;
      judged const j(make_program(f.name, f.parameters[at], f.variants.front()));
      CAPTURE(j.p.name());
      REQUIRE(j.exact.exact());
      slant::index const applications = contact ? 300 : 1000;
      for_each_method([&](method const& m) {
        if (!takes(m, j.p) || m.programs == scope::rounded) return;
        judge_run(j, m, {.tolerance = 1e-8, .steps = 200, .applications = applications}, t);
      });
    }
  }
  MESSAGE(summary_line(t));
  CHECK(t.claims > 0);
}

TEST_CASE("verdicts that were wrong once" * doctest::skip(!test::is_optimised)) {
  tally t;
  std::optional<judged> j;  // kept for all regressions of the same program, which stand together
  bool was_rounded = false;
  for (auto const& r : regressions) {
    for_each_method([&](method const& m) {
      if (m.name != r.method) return;
      program p = make_program(r.adversity, r.parameter, r.variant);
      bool const rounded = m.programs == scope::rounded;
      if (!j || j->p.name() != p.name() || rounded != was_rounded)
        j.emplace(rounded ? p.rounded() : std::move(p));
      was_rounded = rounded;
      judgement const result = judge_run(*j, m, {.tolerance = r.tolerance, .start = r.start}, t);
      CAPTURE(m.name);
      CAPTURE(j->p.name());
      CHECK(result.said != verdict::crashed);
      CHECK_FALSE(result.claim_broken);
    });
  }
  CHECK(t.runs == static_cast<long>(regressions.size()));
}

}  // namespace stability_test
