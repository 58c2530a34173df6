// SPDX-License-Identifier: MIT
//
// Any three texts as the files of a friction problem, separated by zero bytes: they are refused by
// bad_input, or give a problem that is valid and whose law can be evaluated.
#include "bytes.hpp"

#include <slant/contact/friction/verify.hpp>
#include <slant/io/friction_folder.hpp>

namespace {

bool is_number(double x) {
  return x == x;
}

void evaluate(slant::contact::friction_problem<double> const& p) {
  Eigen::VectorXd const none = Eigen::VectorXd::Zero(p.q.size());
  auto const found = slant::contact::verify(p, none);
  fuzz::demand(found.open + found.stick + found.slip == p.contacts(), "each contact has a state");
  // r = 0 is in every cone, W r = 0 exactly.
  fuzz::demand(
      found.outside_cone.value == 0 && found.complementarity.value == 0 && found.dissipation == 0,
      "no force does nothing");
  fuzz::demand(is_number(found.natural_map) && is_number(found.penetration.value) &&
                   is_number(found.relative_natural_map) && is_number(found.outside_dual.value),
               "the law at r = 0 is a number");
  bool const separates = [&] {
    for (slant::index i = 0; i < p.contacts(); ++i)
      if (p.q[i * p.dimension()] < 0) return false;
    return true;
  }();
  if (separates) fuzz::demand(found.natural_map == 0, "bodies that separate need no force");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  std::string_view rest(reinterpret_cast<char const*>(data), size);
  auto const next = [&] {
    std::string_view const text = rest.substr(0, rest.find('\0'));
    rest.remove_prefix(std::min(rest.size(), text.size() + 1));
    return text;
  };
  slant::friction_texts texts{};
  texts.W = next();
  texts.q = next();
  texts.mu = next();
  bool const strict = !rest.empty();
  slant::contact::friction_problem<double> p;
  try {
    p = slant::parse_friction_problem(
        texts, "folder",
        {.asymmetry = strict ? slant::contact::asymmetric_data::refused
                             : slant::contact::asymmetric_data::used_as_given,
         .W = {.unbacked_dimension = 4096}});
  } catch (slant::bad_input const& refusal) {
    fuzz::demand_message(refusal.what());
    return 0;
  }
  double const skew = slant::contact::asymmetry(p.W);
  fuzz::demand(0 <= skew && skew <= 2, "the asymmetry is a number of [0, 2]");
  evaluate(p);
  return 0;
}
