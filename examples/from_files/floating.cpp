// SPDX-License-Identifier: MIT
#include "floating.hpp"

#include <slant/contact/free_motions.hpp>

namespace from_files {

slant::contact::free_motions<double> motions_behind(
    slant::bad_input const& refusal, problem const& p,
    slant::contact::node_layout<double> const& layout) {
  return slant::contact::motions_behind(refusal, p.K, layout);
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
