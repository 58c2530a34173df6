// SPDX-License-Identifier: MIT
#include "methods.hpp"

#include <slant/methods/kprgp.hpp>

namespace random_programs {

namespace {

outcome with_kprgp(prepared const& p, request const& r) {
  return run_from_zero(slant::kprgp{p.qp}, p, r);
}
outcome with_as_s(prepared const& p, request const& r) {
  return run_from_zero(slant::as_s(p.qp), p, r);
}
outcome with_qpq(prepared const& p, request const& r) {
  return run_from_zero(slant::qpq{p.qp}, p, r);
}
outcome with_qpc(prepared const& p, request const& r) {
  return run_from_zero(slant::qpc{p.qp}, p, r);
}

}  // namespace

std::span<method const> active_set_methods() {
  static constexpr method list[]{
      {"kprgp", with_kprgp}, {"as_s", with_as_s}, {"qpq", with_qpq}, {"qpc", with_qpc}};
  return list;
}

}  // namespace random_programs
