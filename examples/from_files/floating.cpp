// SPDX-License-Identifier: MIT
#include "floating.hpp"

#include <algorithm>
#include <limits>
#include <slant/contact/solve_floating.hpp>
#include <string_view>
#include <utility>

namespace from_files {

slant::contact::free_motions<double> motions_behind(
    slant::bad_input const& refusal, problem const& p,
    slant::contact::node_layout<double> const& layout) {
  if (!std::string_view(refusal.what()).starts_with("K: got pivot")) return {};
  auto motions = slant::contact::find_free_motions(p.K, layout);
  // A matrix that is indefinite as well is no matter of supports.
  if (!motions.undetermined.empty()) return {};
  return motions;
}

floating_result solve_floating(problem const& p, settings const& s,
                               slant::contact::node_layout<double> const& layout) {
  auto const begin = clock::now();
  slant::contact::floating_options<double> options;
  options.tolerance = std::max(s.tolerance, std::numeric_limits<double>::min());
  options.max_iterations = s.max_iterations;
  options.layout = layout;
  auto found = slant::contact::solve_floating(p.K, p.contact, options);
  floating_result result;
  auto& body = result.body;
  body.run = {.status = found.status,
              .reason = std::move(found.reason),
              .iterations = found.iterations,
              .work = found.work,
              .started = begin,
              .λ = std::move(found.lambda)};
  body.u = std::move(found.u);
  body.solved_by = found.method;
  body.factorization = "body by body";
  body.take_times(begin);
  body.kkt_residual = found.status == slant::status::unbounded
                          ? std::numeric_limits<double>::quiet_NaN()
                          : found.residual;
  result.motions = std::move(found.motions);
  return result;
}

nlohmann::ordered_json report_motions(slant::contact::free_motions<double> const& motions) {
  auto list = nlohmann::ordered_json::array();
  for (auto const& body : motions.free) {
    list.push_back({{"body", body.number},
                    {"unknowns", body.unknowns.size()},
                    {"first_unknown", body.unknowns.front()},
                    {"motions", body.motions.cols()},
                    {"text", body.text}});
  }
  return list;
}

}  // namespace from_files
