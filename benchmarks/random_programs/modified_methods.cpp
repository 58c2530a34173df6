// SPDX-License-Identifier: MIT
#include "methods.hpp"

#include <slant/methods/mssn.hpp>

namespace random_programs {

namespace {

outcome with_gimssn(prepared const& p, request const& r) {
  return run_from_zero(slant::gimssn{p.qp}, p, r);
}
outcome with_imssn(prepared const& p, request const& r) {
  return run_from_zero(slant::imssn{p.qp}, p, r);
}
outcome with_mssn(prepared const& p, request const& r) {
  return run_from_zero(slant::mssn{p.qp}, p, r);
}

}  // namespace

std::span<method const> modified_methods() {
  static constexpr method list[]{
      {"gimssn", with_gimssn}, {"imssn", with_imssn}, {"mssn", with_mssn}};
  return list;
}

}  // namespace random_programs
