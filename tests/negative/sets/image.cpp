// SPDX-License-Identifier: MIT
// case USE=shifted WITHOUT_SIZE: has_size
// case USE=shifted WITHOUT_SIZE, max-lines-clang: 31
// case USE=turned PRODUCT: set_block
// case USE=many WITHOUT_WITH: takes_parameters
// case USE=many WITHOUT_WITH, max-lines-gcc: 20
// max-lines-gcc: 25
// max-lines-clang: 30
//
// A set of run-time dimension minus its size; a product of run-time size where a rotation, which mixes
// components, needs a block; a block with a parameter minus the way to give each copy its own.
#include <slant/slant.hpp>

struct nonnegative {
  slant::index n;
#ifndef WITHOUT_SIZE
  slant::index size() const { return n; }
#endif
  void project(auto const& x, auto& y) const { y = x.cwiseMax(0.0); }
  bool contains(auto const& x) const { return (x.array() >= 0.0).all(); }
};

struct above {
  static constexpr int dimension = 1;
  using vector_type = Eigen::Matrix<double, 1, 1>;
  double bound = 0;
  vector_type project(auto const& x) const { return vector_type(x[0] < bound ? bound : x[0]); }
  bool contains(auto const& x) const { return x[0] >= bound; }
#ifndef WITHOUT_WITH
  above with(double b) const { return {b}; }
#endif
};

auto shifted(auto const& c) {
  return slant::shifted(nonnegative{2}, c);
}
auto turned(auto const&) {
#ifdef PRODUCT
  auto const set = slant::power(slant::ball<2>{}, 1);
#else
  slant::ball<2> const set;
#endif
  return slant::rotated(set, Eigen::Matrix2d::Identity());
}
auto many(auto const&) {
  return slant::power(above{}, std::vector<double>{1, 2});
}

auto const result = USE(Eigen::VectorXd(Eigen::Vector2d(1, 2)));
