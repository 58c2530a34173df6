// SPDX-License-Identifier: MIT
#include <slant/sets/sets.hpp>
#include <slant/testing/archetypes.hpp>

#include <support/testing.hpp>

namespace convex_set_test {

using Eigen::Matrix2d;
using Eigen::Vector2f;

TEST_CASE("numbers_like: the scalar is the same, sizes agree as far as types tell") {
  static_assert(slant::numbers_like<Vector2d, VectorXd, 2, 1>);
  static_assert(slant::numbers_like<VectorXd, Vector2d, 2, 1>);
  static_assert(slant::numbers_like<Vector2d const&, VectorXd, 2, 1>);
  static_assert(slant::numbers_like<decltype(2 * Vector2d()), Vector2d, 2, 1>);
  static_assert(!slant::numbers_like<Vector3d, VectorXd, 2, 1>);
  static_assert(!slant::numbers_like<Matrix2d, VectorXd, 2, 1>);
  static_assert(!slant::numbers_like<Vector2f, Vector2d, 2, 1>);
  static_assert(!slant::numbers_like<double, Vector2d, 2, 1>);
  static_assert(!slant::numbers_like<void, Vector2d, 2, 1>);
  static_assert(slant::numbers_like<Matrix2d, Vector2d, 2, 2>);
  static_assert(slant::numbers_like<Eigen::DiagonalMatrix<double, 2>, Vector2d, 2, 2>);
}

/// A point and a set that know nothing of Eigen.
struct plain_point {
  std::array<double, 2> entries;
};
struct plain_set {
  static constexpr int dimension = 2;
  [[nodiscard]] plain_point project(plain_point const&) const { return {}; }
  [[nodiscard]] bool contains(plain_point const& x) const { return x.entries[0] == 0; }
};
struct set_of_numbers : plain_set {
  [[nodiscard]] double project(plain_point const&) const { return 0; }
};

/// A vector of another library that tells its scalar, but no sizes.
struct foreign_vector {
  using Scalar = double;
  std::array<double, 2> entries;
};
struct foreign_set {
  [[nodiscard]] static std::ptrdiff_t size() { return 2; }
  [[nodiscard]] foreign_vector project(foreign_vector const& x) const { return x; }
  [[nodiscard]] bool contains(foreign_vector const&) const { return true; }
};

TEST_CASE("convex_set: points need not be Eigen's") {
  static_assert(slant::convex_set<plain_set, plain_point>);
  static_assert(!slant::convex_set<set_of_numbers, plain_point>);
  static_assert(slant::convex_set<foreign_set, foreign_vector>);
}

struct origin {
  static constexpr int dimension = 2;
  [[nodiscard]] Vector2d project(auto const&) const { return {0, 0}; }
  [[nodiscard]] bool contains(auto const& x) const { return x[0] == 0; }
};
struct origin_in_place {
  static constexpr int dimension = 2;
  void project(auto const&, auto& y) const { y.setZero(); }
  [[nodiscard]] bool contains(auto const& x) const { return x[0] == 0; }
};
struct origin_in_space : origin {
  [[nodiscard]] Vector3d project(auto const&) const { return {0, 0, 0}; }
};
struct origin_without_value : origin {
  void project(auto const&) const {}
};

TEST_CASE("convex_set: what project returns has the scalar of the points and the dimension") {
  static_assert(slant::convex_set<origin, Vector2d> && slant::convex_set<origin, VectorXd>);
  static_assert(slant::convex_set<origin_in_place, Vector2d>);
  static_assert(!slant::convex_set<origin, Vector2f>);
  static_assert(!slant::convex_set<origin_in_space, VectorXd>);
  static_assert(!slant::convex_set<origin_without_value, Vector2d>);
}

template <class G>
struct with_slant : origin {
  [[nodiscard]] G slant(auto const&) const { return {}; }
};

TEST_CASE("has_slant: a matrix of the dimension or an operator") {
  static_assert(slant::has_slant<with_slant<Matrix2d>, Vector2d>);
  static_assert(slant::has_slant<with_slant<Eigen::DiagonalMatrix<double, 2>>, Vector2d>);
  static_assert(!slant::has_slant<with_slant<Eigen::Matrix3d>, Vector2d>);
  static_assert(!slant::has_slant<with_slant<Vector2d>, Vector2d>);
  static_assert(!slant::has_slant<with_slant<Eigen::Matrix2f>, Vector2d>);
  static_assert(!slant::has_slant<with_slant<void>, Vector2d>);
}

template <class Values, class Gradient, class Hessian>
struct with_form : origin {
  static constexpr int inequalities = 1;
  [[nodiscard]] Values inequality(auto const&) const { return {}; }
  [[nodiscard]] Gradient inequality_gradient(auto const&) const { return {}; }
  [[nodiscard]] Hessian inequality_hessian(auto const&, auto const&) const { return {}; }
};

TEST_CASE("has_inequality_form: values, gradients and Hessian fit each other") {
  using one = Eigen::Matrix<double, 1, 1>;
  static_assert(slant::has_inequality_form<with_form<one, Vector2d, Matrix2d>, Vector2d>);
  static_assert(!slant::has_inequality_form<with_form<double, Vector2d, Matrix2d>, Vector2d>);
  static_assert(!slant::has_inequality_form<with_form<Vector2d, Vector2d, Matrix2d>, Vector2d>);
  static_assert(!slant::has_inequality_form<with_form<one, Vector3d, Matrix2d>, Vector2d>);
  static_assert(!slant::has_inequality_form<with_form<one, Vector2d, Vector2d>, Vector2d>);
}

TEST_CASE("project names the argument whose size is wrong, and resizes nothing") {
  auto const check = [](auto const& set) {
    auto const in_place = [&](VectorXd const& x, VectorXd y) {
      return SLANT_COMPLAINT(slant::project(set, x, y));
    };
    VectorXd const two = VectorXd::Ones(2);
    VectorXd const three = VectorXd::Ones(3);
    CHECK(in_place(two, two) == "nothing thrown");
    CHECK(in_place(two, VectorXd()) == "y: got 0 rows, expected 2 (the dimension of the set)");
    CHECK(in_place(two, three) == "y: got 3 rows, expected 2 (the dimension of the set)");
    CHECK(in_place(three, two) == "x: got 3 rows, expected 2 (the dimension of the set)");
    CHECK(SLANT_COMPLAINT(slant::project(set, three)) ==
          "x: got 3 rows, expected 2 (the dimension of the set)");
  };
  check(slant::ball<2>(1.0));
  check(slant::half_lines(2));
  check(slant::testing::archetype::basic_convex_set<VectorXd>(2));
}

}  // namespace convex_set_test
