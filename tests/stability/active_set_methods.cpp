// SPDX-License-Identifier: MIT
#include <slant/slant.hpp>

#include <stability/methods.hpp>
#include <stability/stopping.hpp>

namespace stability {

namespace {

template <class Make>
outcome on_dual(prepared const& p, request const& r) {
  return run_until(Make{}(p.qp()), p.start(r.start), p, r,
                   [](Eigen::VectorXd const& x) { return x; });
}

using make_kprgp = decltype([](auto qp) { return slant::kprgp{std::move(qp)}; });
using make_as_s = decltype([](auto qp) { return slant::as_s(std::move(qp)); });
using make_qpq = decltype([](auto qp) { return slant::qpq{std::move(qp)}; });
using make_qpc = decltype([](auto qp) { return slant::qpc{std::move(qp)}; });
using make_gimssn = decltype([](auto qp) { return slant::gimssn{std::move(qp)}; });
using make_imssn = decltype([](auto qp) { return slant::imssn{std::move(qp)}; });
using make_mssn = decltype([](auto qp) { return slant::mssn{std::move(qp)}; });

}  // namespace

std::span<method const> active_set_methods() {
  static constexpr method list[]{
      {"kprgp", on_dual<make_kprgp>},   {"as_s", on_dual<make_as_s>},
      {"qpq", on_dual<make_qpq>},       {"qpc", on_dual<make_qpc>},
      {"gimssn", on_dual<make_gimssn>}, {"imssn", on_dual<make_imssn>},
      {"mssn", on_dual<make_mssn>},
  };
  return list;
}

}  // namespace stability
