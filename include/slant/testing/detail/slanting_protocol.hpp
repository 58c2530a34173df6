// SPDX-License-Identifier: MIT
//
// What can be asked of a slanting function at one point, without limits: sizes, overwriting,
// linearity of F°(y), and renewal of F°(y) in place.
#pragma once

#include <slant/concepts/bad_input.hpp>
#include <slant/testing/breach.hpp>
#include <slant/testing/detail/slanting_samples.hpp>

#include <string>

namespace slant::testing::detail {

/// Looks at F at y; `elsewhere` is another point, `rounding` a number of ε.
template <class F, class V>
class slanting_protocol {
  using S = scalar_t<V>;

 public:
  slanting_protocol(F const& f, V const& y, V const& elsewhere, S const& rounding, sampler& sample,
                    breach_log& report)
      : f_(f),
        y_(y),
        elsewhere_(elsewhere),
        rounding_(rounding),
        sample_(sample),
        report_(report) {}

  /// Without the right sizes nothing else can be asked.
  [[nodiscard]] bool sizes() const {
    auto const g = f_.slant(y_);
    index const n = slant::local(y_).size();
    bool const fit = g.rows() == f_.rows() && g.cols() == f_.cols() && f_.cols() == n;
    if (!fit) {
      report_("sizes", std::to_string(g.rows()) + " x " + std::to_string(g.cols()) + " for F of " +
                           std::to_string(f_.rows()) + " values, " + std::to_string(f_.cols()) +
                           " arguments, at y with " + std::to_string(n));
    }
    return fit;
  }

  void overwriting() const {
    S const nan = std::numeric_limits<S>::quiet_NaN();
    auto w = slant::workspace(f_, y_);
    auto into_zero = slant::like(y_, f_.rows());
    auto into_nan = into_zero;
    slant::local(into_zero).setZero();
    slant::local(into_nan).setConstant(nan);
    slant::evaluate(f_, y_, into_zero, w);
    slant::evaluate(f_, y_, into_nan, w);
    expect("value overwrites", into_zero, into_nan, S(0));
    auto const g = f_.slant(y_);
    auto const x = sample_(y_, f_.cols());
    slant::local(into_zero).setZero();
    slant::local(into_nan).setConstant(nan);
    apply_into(g, x, into_zero);
    apply_into(g, x, into_nan);
    expect("slant overwrites", into_zero, into_nan, S(0));
  }

  void linear() const {
    auto const g = f_.slant(y_);
    auto const x = sample_(y_, f_.cols());
    auto const z = sample_(y_, f_.cols());
    V const gx = apply_to(g, x, f_.rows());
    V const gz = apply_to(g, z, f_.rows());
    V mixed = x;
    slant::local(mixed) = S(3) / S(4) * slant::local(x) - S(5) / S(4) * slant::local(z);
    V mixed_g = gx;
    slant::local(mixed_g) = S(3) / S(4) * slant::local(gx) - S(5) / S(4) * slant::local(gz);
    expect("slant is linear", apply_to(g, mixed, f_.rows()), mixed_g,
           tolerance() * (slant::norm(gx) + slant::norm(gz)));
  }

  void renewal() const {
    auto w = slant::workspace(f_, y_);
    auto v = slant::like(y_, f_.rows());
    auto const fresh = f_.slant(y_);
    auto renewed = f_.slant(elsewhere_);
    slant::evaluate(f_, elsewhere_, v, w);  // what this leaves in w must not be taken for F(y)
    slant::update_slant(f_, y_, renewed, w);
    same("renewed slant = new slant", fresh, renewed);
    slant::update_slant(f_, elsewhere_, renewed, w);
    slant::evaluate(f_, y_, v, w);
    slant::update_slant_after_value(f_, y_, renewed, w);
    same("slant after value = new slant", fresh, renewed);
    expect("value with a used workspace", v, slant::evaluate(f_, y_), S(0));
  }

 private:
  [[nodiscard]] S tolerance() const { return rounding_ * std::numeric_limits<S>::epsilon(); }
  /// ‖a − b‖ <= bound, and not NaN.
  void expect(std::string const& law, V const& a, V const& b, S const& bound) const {
    V difference = a;
    slant::local(difference) -= slant::local(b);
    S const size = slant::norm(difference);
    if (!(size <= bound)) {
      report_(law, "difference " + slant::detail::show(static_cast<double>(size)));
    }
  }
  template <class G>
  void same(std::string const& law, G const& fresh, G const& renewed) const {
    for (int k = 0; k < 4; ++k) {
      auto const x = sample_(y_, f_.cols());
      V const expected = apply_to(fresh, x, f_.rows());
      expect(law, expected, apply_to(renewed, x, f_.rows()), tolerance() * slant::norm(expected));
    }
  }

  F const& f_;
  V const& y_;
  V const& elsewhere_;
  S rounding_;
  sampler& sample_;
  breach_log& report_;
};

}  // namespace slant::testing::detail
