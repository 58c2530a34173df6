// SPDX-License-Identifier: MIT
//
// The law check itself: it passes right functions, also at kinks, and finds wrong ones.
#include <slant/operators/operators.hpp>
#include <slant/testing/archetypes.hpp>
#include <slant/testing/laws.hpp>

#include <support/testing.hpp>

namespace slanting_laws_test {

using slant::testing::slanting_breaches;

/// v_i = φ(y_i) with slope φ°(y_i), both callables.
template <class Value, class Slope>
struct pointwise {
  slant::index n;
  Value φ;
  Slope slope;

  [[nodiscard]] slant::index rows() const { return n; }
  [[nodiscard]] slant::index cols() const { return n; }
  template <class Y, class V>
  void value(Y const& y, V& v) const {
    v = y.unaryExpr(φ);
  }
  template <class Y>
  [[nodiscard]] auto slant(Y const& y) const {
    Eigen::Matrix<typename Y::Scalar, Eigen::Dynamic, 1> d = y.unaryExpr(slope);
    using plain = decltype(d);
    return slant::diagonal_operator<plain>(slant::held<plain>(std::move(d)));
  }
};
template <class Value, class Slope>
pointwise(slant::index, Value, Slope) -> pointwise<Value, Slope>;

auto const maximum = pointwise{3, [](double a) { return std::max(0.0, a); },
                               [](double a) { return a >= 0 ? 1.0 : 0.0; }};

/// A right function with one member replaced.
struct square_base {
  [[nodiscard]] slant::index rows() const { return 2; }
  [[nodiscard]] slant::index cols() const { return 2; }
  void value(VectorXd const& y, VectorXd& v) const { v = y.cwiseAbs2(); }
  [[nodiscard]] auto slant(VectorXd const& y) const { return slant::diagonal(VectorXd(2 * y)); }
};

template <class F, class V>
bool finds(std::string const& law, F const& f, V const& y) {
  auto const breaches = slanting_breaches(f, y);
  return std::any_of(breaches.begin(), breaches.end(),
                     [&](auto const& breach) { return breach.law == law; });
}

VectorXd const zero = VectorXd::Zero(3);
VectorXd const near{{0.3, -2.0, 1e-3}};

TEST_CASE("right functions pass, at and away from kinks, at any scale") {
  slant::testing::check_slanting_laws(maximum, zero, near, VectorXd(1e150 * near),
                                      VectorXd(1e-150 * near));
  auto const square = pointwise{3, [](double a) { return a * a; }, [](double a) { return 2 * a; }};
  slant::testing::check_slanting_laws(square, zero, near, VectorXd(1e100 * near));
  // Semismooth of order 1/2 only: slow, but the limit is 0.
  auto const power =
      pointwise{3, [](double a) { return std::pow(std::abs(a), 1.5); },
                [](double a) { return std::copysign(1.5, a) * std::sqrt(std::abs(a)); }};
  slant::testing::check_slanting_laws(power, zero, near);
  slant::testing::check_slanting_laws(square_base{}, VectorXd{{1.0, -3.0}});
}

TEST_CASE("float, long double and fixed sizes") {
  auto const as_float = pointwise{3, [](float a) { return std::max(0.0F, a); },
                                  [](float a) { return a >= 0 ? 1.0F : 0.0F; }};
  slant::testing::check_slanting_laws(as_float, Eigen::VectorXf::Zero(3).eval(),
                                      Eigen::VectorXf{{1.0F, -2.0F, 0.5F}});
  auto const as_long = pointwise{3, [](long double a) { return a * a * a; },
                                 [](long double a) { return 3 * a * a; }};
  using vector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
  slant::testing::check_slanting_laws(as_long, vector(vector::Constant(3, 0.7L)));
  auto const in_plane =
      pointwise{2, [](double a) { return std::sin(a); }, [](double a) { return std::cos(a); }};
  slant::testing::check_slanting_laws(in_plane, Vector2d(0.4, -1.0));
}

TEST_CASE("the archetype keeps the laws, on archetype vectors") {
  slant::testing::archetype::slanting_function const f(3);
  slant::testing::check_slanting_laws(f, slant::testing::archetype::vector(zero),
                                      slant::testing::archetype::vector(near));
}

TEST_CASE("a wrong derivative is found, also if it is wrong by a millionth") {
  for (double const wrong : {-1.0, 1e-2, 1e-6}) {
    CAPTURE(wrong);
    auto const f = pointwise{3, [](double a) { return a * a; },
                             [wrong](double a) { return 2 * a * (1 + wrong); }};
    CHECK(finds("slanting limit", f, near));
  }
}

TEST_CASE("a wrong value at the kink only is admissible, next to it is not") {
  auto const at_kink = pointwise{3, [](double a) { return std::max(0.0, a); },
                                 [](double a) { return a > 0   ? 1.0
                                                       : a < 0 ? 0.0
                                                               : 0.4; }};
  CHECK(slanting_breaches(at_kink, zero).empty());
  auto const shifted = pointwise{3, [](double a) { return std::max(0.0, a); },
                                 [](double a) { return a >= 0.1 ? 1.0 : 0.0; }};
  CHECK(finds("slanting limit", shifted, zero));
  CHECK(slanting_breaches(shifted, VectorXd{{3.0, 2.0, 1.0}}).empty() == false);  // by its search
}

TEST_CASE("sqrt|y| sign(y) is not slantly differentiable at 0") {
  auto const root = pointwise{3, [](double a) { return std::copysign(std::sqrt(std::abs(a)), a); },
                              [](double a) { return a == 0 ? 0.0 : 0.5 / std::sqrt(std::abs(a)); }};
  CHECK(finds("slanting limit", root, zero));
  CHECK(finds("slant bounded", root, zero));
  CHECK(slanting_breaches(root, VectorXd{{3.0, -2.0, 1.0}}).empty() == false);  // by its search
}

TEST_CASE("a huge slope at one point hides neither growth nor errors elsewhere") {
  for (double const huge : {1e8, 1e20, 0.5 / std::sqrt(1e-300)}) {
    CAPTURE(huge);
    auto const root =
        pointwise{3, [](double a) { return std::copysign(std::sqrt(std::abs(a)), a); },
                  [huge](double a) { return a == 0 ? huge : 0.5 / std::sqrt(std::abs(a)); }};
    CHECK(finds("slanting limit", root, zero));
    CHECK(finds("slant bounded", root, zero));
    CHECK(finds("slant bounded", root, VectorXd{{0.0, 1.0, -2.0}}));

    struct wrong_in_one : square_base {  // (max(0, y₀), y₁²/2), with 2 y₁ in place of y₁
      double at_kink = 0;
      void value(VectorXd const& y, VectorXd& v) const {
        v = VectorXd{{std::max(0.0, y[0]), y[1] * y[1] / 2}};
      }
      [[nodiscard]] auto slant(VectorXd const& y) const {
        return slant::diagonal(VectorXd{{y[0] == 0 ? at_kink : double(y[0] > 0), 2 * y[1]}});
      }
    };
    wrong_in_one f;
    f.at_kink = huge;
    CHECK(finds("slanting limit", f, VectorXd{{0.0, 1.0}}));
  }
}

TEST_CASE("y log|y| is not slantly differentiable at 0: its derivative grows slowly") {
  auto const f = pointwise{3, [](double a) { return a == 0 ? 0.0 : a * std::log(std::abs(a)); },
                           [](double a) { return a == 0 ? 0.0 : std::log(std::abs(a)) + 1; }};
  CHECK(finds("slanting limit", f, zero));
}

TEST_CASE("NaN and jumps are found") {
  auto const with_nan = pointwise{3, [](double a) { return std::sqrt(a); },
                                  [](double a) { return 0.5 / std::sqrt(a); }};
  CHECK(finds("slanting limit", with_nan, near));
  auto const jump =
      pointwise{3, [](double a) { return a < 0.5 ? 0.0 : 1.0; }, [](double) { return 0.0; }};
  CHECK(finds("slanting limit", jump, VectorXd::Constant(3, 0.5).eval()));
}

TEST_CASE("broken protocol is found") {
  VectorXd const y{{1.0, -3.0}};
  REQUIRE(slanting_breaches(square_base{}, y).empty());

  struct accumulates : square_base {
    void value(VectorXd const& y, VectorXd& v) const { v += y.cwiseAbs2(); }
  };
  CHECK(finds("value overwrites", accumulates{}, y));

  struct too_wide : square_base {
    [[nodiscard]] auto slant(VectorXd const&) const {
      return slant::matrix(MatrixXd::Zero(2, 3).eval());
    }
  };
  CHECK(finds("sizes", too_wide{}, y));

  struct quadratic_operator {
    VectorXd d;
    [[nodiscard]] slant::index rows() const { return 2; }
    [[nodiscard]] slant::index cols() const { return 2; }
    void apply(VectorXd const& x, VectorXd& y) const { y = d.cwiseProduct(x.cwiseAbs()); }
  };
  struct not_linear : square_base {
    [[nodiscard]] quadratic_operator slant(VectorXd const& y) const { return {2 * y}; }
  };
  CHECK(finds("slant is linear", not_linear{}, y));

  struct adding_operator : quadratic_operator {
    void apply(VectorXd const& x, VectorXd& y) const { y += d.cwiseProduct(x); }
  };
  struct slant_accumulates : square_base {
    [[nodiscard]] adding_operator slant(VectorXd const& y) const { return {{2 * y}}; }
  };
  CHECK(finds("slant overwrites", slant_accumulates{}, y));
}

struct slope_operator {
  VectorXd d;
  [[nodiscard]] slant::index rows() const { return d.size(); }
  [[nodiscard]] slant::index cols() const { return d.size(); }
  void apply(VectorXd const& x, VectorXd& y) const { y = d.cwiseProduct(x); }
};

struct renewable : square_base {
  VectorXd workspace(VectorXd const& y) const { return y; }
  void value(VectorXd const& y, VectorXd& v, VectorXd& w) const {
    w = y;
    v = y.cwiseAbs2();
  }
  [[nodiscard]] slope_operator slant(VectorXd const& y) const { return {2 * y}; }
  void slant(VectorXd const& y, slope_operator& g, VectorXd&) const { g.d = 2 * y; }
  void slant_after_value(VectorXd const&, slope_operator& g, VectorXd& w) const { g.d = 2 * w; }
};

TEST_CASE("a slant that is renewed wrongly is found") {
  VectorXd const y{{1.0, -3.0}};
  REQUIRE(slanting_breaches(renewable{}, y).empty());

  struct forgets : renewable {
    void slant(VectorXd const&, slope_operator&, VectorXd&) const {}
    [[nodiscard]] slope_operator slant(VectorXd const& y) const { return {2 * y}; }
  };
  CHECK(finds("renewed slant = new slant", forgets{}, y));

  struct trusts_the_workspace : renewable {
    void slant(VectorXd const&, slope_operator& g, VectorXd& w) const { g.d = 2 * w; }
    [[nodiscard]] slope_operator slant(VectorXd const& y) const { return {2 * y}; }
  };
  CHECK(finds("renewed slant = new slant", trusts_the_workspace{}, y));

  struct wrong_after_value : renewable {
    void slant_after_value(VectorXd const&, slope_operator&, VectorXd&) const {}
  };
  CHECK(finds("slant after value = new slant", wrong_after_value{}, y));

  struct remembers : renewable {
    void value(VectorXd const& y, VectorXd& v, VectorXd& w) const {
      v = y.cwiseAbs2() + 1e-3 * (w - y);
      w = y;
    }
  };
  CHECK(finds("value with a used workspace", remembers{}, y));
}

}  // namespace slanting_laws_test
