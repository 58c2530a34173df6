// SPDX-License-Identifier: MIT
#include <stability/verdict.hpp>

#include <algorithm>
#include <cstdio>

namespace stability {

std::string_view name_of(verdict v) {
  static constexpr std::string_view names[verdict_count]{"right",     "wrong",   "unclaimed",
                                                         "stalled",   "limit",   "unbounded",
                                                         "breakdown", "refused", "crashed"};
  return names[static_cast<int>(v)];
}

judgement judge(prepared const& p, reference const& exact, method const& m, request const& asked,
                outcome const& o) {
  double const inf = std::numeric_limits<double>::infinity();
  judgement j;
  j.floor = exact.floor * (m.epsilon / std::numeric_limits<double>::epsilon());
  j.allowed = std::max(asked.tolerance, j.floor);
  j.error = j.kkt = j.ratio = inf;
  if (o.refused || o.crashed) {
    j.said = o.refused ? verdict::refused : verdict::crashed;
    return j;
  }
  bool const finite = o.x.size() == p.source().size() && o.x.allFinite();
  if (finite) {
    j.error = o.fine_x.size() > 0 ? relative_error(p.source(), exact, o.fine_x)
              : o.u.size() > 0    ? relative_error(p.source(), exact, o.u)
                                  : relative_error(p.source(), exact, p.answer(o.x));
    j.kkt = p.kkt(o.x);
    j.ratio = j.error / j.allowed;
    if (!(j.ratio == j.ratio)) j.error = j.ratio = inf;
  }
  bool const good = j.ratio <= threshold;
  switch (o.status) {
    case slant::status::converged:
      j.said = good ? verdict::right : finite ? verdict::wrong : verdict::crashed;
      j.contradicted = !good && !(j.kkt <= threshold * j.allowed);
      break;
    case slant::status::unbounded:
      j.said = verdict::unbounded;
      break;
    case slant::status::stalled:
      j.said = good ? verdict::unclaimed : verdict::stalled;
      break;
    case slant::status::iteration_limit:
      j.said = good ? verdict::unclaimed : verdict::limit;
      break;
    default:
      j.said = good ? verdict::unclaimed : verdict::breakdown;
  }
  // Claims are estimates: at the floor they do not see the rounding of the gradient, and conjugate
  // gradients see the norm from below. More than that, or than a factor of two, is none of it.
  j.claim_broken = 2 * o.claimed + j.floor < j.error;
  return j;
}

void tally::add(outcome const& o, judgement const& j) {
  ++runs;
  ++counts[static_cast<int>(j.said)];
  if (j.said == verdict::right || j.said == verdict::wrong) largest = std::max(largest, j.ratio);
  if (j.contradicted) ++contradicted;
  if (o.claimed == o.claimed) ++claims;
  if (j.claim_broken) ++claims_broken;
}

std::string summary_line(tally const& t) {
  char text[400];
  std::snprintf(
      text, sizeof text,
      "stability: %ld of %ld above %g (right %ld, unclaimed %ld, missed %ld: stalled %ld, "
      "limit %ld, false unbounded %ld, breakdown %ld, exception or NaN %ld; refused %ld; "
      "wrong with a kkt residual that shows it %ld; claimed errors %ld, below half of the true one "
      "%ld)",
      t.count(verdict::wrong), t.runs, threshold, t.count(verdict::right),
      t.count(verdict::unclaimed), t.missed(), t.count(verdict::stalled), t.count(verdict::limit),
      t.count(verdict::unbounded), t.count(verdict::breakdown), t.count(verdict::crashed),
      t.count(verdict::refused), t.contradicted, t.claims, t.claims_broken);
  return text;
}

}  // namespace stability
